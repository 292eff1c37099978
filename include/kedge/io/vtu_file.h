#ifndef kedge_io_vtu_file_h
#define kedge_io_vtu_file_h

#include <kedge/io/run_folder.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * One piece of an unstructured grid in VTK's XML format: arrays appended
   * raw, zlib-compressed, doubles as Float64 and whole numbers as Int64.
   */
  class VtuFile
  {
  public:
    /** What a .pvtu must know of an array. */
    struct Array
    {
      std::string              name;
      std::string              type; ///< of VTK: Float64, Int64, UInt8
      unsigned int             n_components = 1;
      std::vector<std::string> component_names; ///< may be empty
    };

    /** Nodes as x, y, z. */
    void
    set_nodes(const std::vector<double> &coordinates);

    /**
     * Cells of one kind: @p cell_type is VTK's number (1 vertex, 9 quad,
     * 12 hexahedron), @p connectivity the nodes in VTK's order.
     */
    void
    set_cells(const std::vector<std::int64_t> &connectivity,
              const unsigned int               nodes_per_cell,
              const std::uint8_t               cell_type);

    /** A field on the nodes; @p array.type is set from the kind of the values. */
    void
    add_field(Array array, const std::vector<double> &values);
    void
    add_field(Array array, const std::vector<std::int64_t> &values);

    /** A field on the cells, likewise. */
    void
    add_cell_field(Array array, const std::vector<double> &values);
    void
    add_cell_field(Array array, const std::vector<std::int64_t> &values);

    /** Throws UserError if the file cannot be written. */
    void
    write(const std::filesystem::path &file, const double time) const;

    /** The text of a .pvtu of @p pieces (file names) with the fields of this piece. */
    std::string
    parallel_index(const std::vector<std::string> &pieces) const;

  private:
    struct Block
    {
      Array         array;
      std::uint64_t offset;
    };

    template <typename Number>
    Block
    field(Array array, const std::vector<Number> &values);
    Block
    append(const Array &array, const void *values, const std::size_t n_bytes);

    std::size_t        n_nodes = 0;
    std::size_t        n_cells = 0;
    std::vector<Block> nodes, cells, fields, cell_fields;
    std::string        appended;
  };

  /** x, y, z of vectors side by side, as VTK wants them: z = 0 in 2D. */
  template <int dim, typename Vector>
  std::vector<double>
  with_three_components(const std::vector<Vector> &vectors)
  {
    std::vector<double> values(3 * vectors.size(), 0.);
    for (std::size_t i = 0; i < vectors.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        values[3 * i + d] = vectors[i][d];
    return values;
  }

  /**
   * Writes @p piece of each rank into a folder inside the run's: STEM.vtu, on
   * several ranks STEM.RRRR.vtu and STEM.pvtu. Returns what the index of times
   * has to name. Collective. Throws UserError if a file cannot be written.
   */
  std::string
  write_pieces(const RunFolder   &folder,
               const std::string &subfolder,
               const std::string &stem,
               const VtuFile     &piece,
               const double       time);
} // namespace kedge

#endif
