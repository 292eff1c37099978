#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/vtu_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <zlib.h>

namespace kedge
{
  namespace
  {
    constexpr std::size_t block_size = std::size_t(1) << 18;

    std::string
    byte_order()
    {
      return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "LittleEndian" : "BigEndian";
    }

    void
    append_bytes(std::string &target, const std::vector<std::uint64_t> &values)
    {
      target.append(reinterpret_cast<const char *>(values.data()),
                    values.size() * sizeof(std::uint64_t));
    }

    /**
     * VTK's compressed array: number of blocks, size of a block, size of the
     * last one if it is shorter (else 0), compressed size of each, the blocks.
     */
    std::string
    compressed(const unsigned char *values, const std::size_t n_bytes)
    {
      const std::size_t          n_blocks = (n_bytes + block_size - 1) / block_size;
      std::vector<std::uint64_t> header   = {n_blocks, block_size, n_bytes % block_size};
      std::string                blocks;
      std::vector<unsigned char> buffer(compressBound(block_size));
      for (std::size_t begin = 0; begin < n_bytes; begin += block_size)
        {
          uLongf    size   = buffer.size();
          const int status = compress2(buffer.data(),
                                       &size,
                                       values + begin,
                                       std::min(block_size, n_bytes - begin),
                                       Z_BEST_SPEED);
          AssertThrow(status == Z_OK, dealii::ExcInternalError());
          header.push_back(size);
          blocks.append(reinterpret_cast<const char *>(buffer.data()), size);
        }
      std::string result;
      append_bytes(result, header);
      return result + blocks;
    }

    std::string
    attributes(const VtuFile::Array &array)
    {
      std::string text = " type=\"" + array.type + "\" Name=\"" + array.name +
                         "\" NumberOfComponents=\"" + std::to_string(array.n_components) + '"';
      for (std::size_t i = 0; i < array.component_names.size(); ++i)
        text += " ComponentName" + std::to_string(i) + "=\"" + array.component_names[i] + '"';
      return text;
    }

    const char *const head = "<?xml version=\"1.0\"?>\n";
  } // namespace



  VtuFile::Block
  VtuFile::append(const Array &array, const void *values, const std::size_t n_bytes)
  {
    const Block block{array, appended.size()};
    appended += compressed(static_cast<const unsigned char *>(values), n_bytes);
    return block;
  }



  void
  VtuFile::set_nodes(const std::vector<double> &coordinates)
  {
    n_nodes = coordinates.size() / 3;
    nodes   = {append({"Points", "Float64", 3, {}},
                    coordinates.data(),
                    coordinates.size() * sizeof(double))};
  }



  void
  VtuFile::set_cells(const std::vector<std::int64_t> &connectivity,
                     const unsigned int               nodes_per_cell,
                     const std::uint8_t               cell_type)
  {
    n_cells = connectivity.size() / nodes_per_cell;
    std::vector<std::int64_t> ends(n_cells);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
      ends[cell] = (cell + 1) * nodes_per_cell;
    const std::vector<std::uint8_t> types(n_cells, cell_type);

    cells = {append({"connectivity", "Int64", 1, {}},
                    connectivity.data(),
                    connectivity.size() * sizeof(std::int64_t)),
             append({"offsets", "Int64", 1, {}}, ends.data(), n_cells * sizeof(std::int64_t)),
             append({"types", "UInt8", 1, {}}, types.data(), n_cells)};
  }



  template <typename Number>
  VtuFile::Block
  VtuFile::field(Array array, const std::vector<Number> &values)
  {
    array.type = std::is_same<Number, double>::value ? "Float64" : "Int64";
    return append(array, values.data(), values.size() * sizeof(Number));
  }



  void
  VtuFile::add_field(Array array, const std::vector<double> &values)
  {
    fields.push_back(field(array, values));
  }



  void
  VtuFile::add_field(Array array, const std::vector<std::int64_t> &values)
  {
    fields.push_back(field(array, values));
  }



  void
  VtuFile::add_cell_field(Array array, const std::vector<double> &values)
  {
    cell_fields.push_back(field(array, values));
  }



  void
  VtuFile::add_cell_field(Array array, const std::vector<std::int64_t> &values)
  {
    cell_fields.push_back(field(array, values));
  }



  void
  VtuFile::write(const std::filesystem::path &file, const double time) const
  {
    std::string text = head;
    text +=
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" + byte_order() +
      "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n" +
      "<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
      "format=\"ascii\">" +
      exact_text(time) + "</DataArray></FieldData>\n<Piece NumberOfPoints=\"" +
      std::to_string(n_nodes) + "\" NumberOfCells=\"" + std::to_string(n_cells) + "\">\n";

    const auto group = [&](const std::string &name, const std::vector<Block> &blocks) {
      text += '<' + name + ">\n";
      for (const Block &block : blocks)
        text += "<DataArray" + attributes(block.array) + " format=\"appended\" offset=\"" +
                std::to_string(block.offset) + "\"/>\n";
      text += "</" + name + ">\n";
    };
    group("Points", nodes);
    group("Cells", cells);
    group("PointData", fields);
    group("CellData", cell_fields);

    text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    text += appended;
    text += "\n</AppendedData>\n</VTKFile>\n";
    write_file(file, text);
  }



  std::string
  VtuFile::parallel_index(const std::vector<std::string> &pieces) const
  {
    std::string text = head;
    text += "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"" + byte_order() +
            "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
            "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n";
    for (const Block &block : nodes)
      text += "<PDataArray" + attributes(block.array) + "/>\n";
    text += "</PPoints>\n";
    const auto group = [&](const std::string &name, const std::vector<Block> &blocks) {
      text += '<' + name + ">\n";
      for (const Block &block : blocks)
        text += "<PDataArray" + attributes(block.array) + "/>\n";
      text += "</" + name + ">\n";
    };
    group("PPointData", fields);
    group("PCellData", cell_fields);
    for (const std::string &piece : pieces)
      text += "<Piece Source=\"" + piece + "\"/>\n";
    return text + "</PUnstructuredGrid>\n</VTKFile>\n";
  }



  std::string
  write_pieces(const RunFolder   &folder,
               const std::string &subfolder,
               const std::string &stem,
               const VtuFile     &piece,
               const double       time)
  {
    const MPI_Comm     communicator = folder.communicator();
    const unsigned int n_ranks      = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const auto         file_name    = [&](const unsigned int r) {
      return n_ranks == 1 ? stem + ".vtu"
                                     : stem + '.' + dealii::Utilities::int_to_string(r, 4) + ".vtu";
    };
    const std::filesystem::path location = folder.path(subfolder);
    run_on_all(communicator, [&]() {
      piece.write(location / file_name(rank), time);
    });
    if (n_ranks == 1)
      return subfolder + '/' + file_name(0);

    std::vector<std::string> names;
    for (unsigned int r = 0; r < n_ranks; ++r)
      names.push_back(file_name(r));
    run_on_root(communicator, [&]() {
      write_file(location / (stem + ".pvtu"), piece.parallel_index(names));
    });
    return subfolder + '/' + stem + ".pvtu";
  }
} // namespace kedge
