#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/grid_output.h>
#include <kedge/io/vtu_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

namespace kedge
{
  namespace
  {
    template <int dim>
    VtuFile
    make_piece(const GridSnapshot<dim> &snapshot)
    {
      constexpr unsigned int                n_vertices = 1 << dim;
      constexpr std::array<unsigned int, 8> vtk_order  = {{0, 1, 3, 2, 4, 5, 7, 6}};
      constexpr std::uint8_t                cell_type  = dim == 2 ? 9 : 12;

      VtuFile piece;
      piece.set_nodes(with_three_components<dim>(snapshot.nodes));
      std::vector<std::int64_t> connectivity;
      connectivity.reserve(n_vertices * snapshot.cells.size());
      for (const auto &cell : snapshot.cells)
        for (unsigned int v = 0; v < n_vertices; ++v)
          connectivity.push_back(cell[vtk_order[v]]);
      piece.set_cells(connectivity, n_vertices, cell_type);
      for (const auto &[name, values] : snapshot.nodal_scalars)
        piece.add_field({name, "", 1, {}}, values);
      for (const auto &[name, values] : snapshot.nodal_vectors)
        piece.add_field({name, "", 3, {"x", "y", "z"}}, with_three_components<dim>(values));
      return piece;
    }
  } // namespace



  template <int dim>
  GridOutput<dim>::GridOutput(const RunFolder &folder, const unsigned int n_kept)
    : folder(folder)
    , n_done(n_kept)
    , pvd(folder, "grid.pvd", TimeSeries::Format::pvd, n_kept)
  {}



  template <int dim>
  void
  GridOutput<dim>::write(const double time, const GridSnapshot<dim> &snapshot)
  {
    folder.make_subfolder("grid");
    const std::string stem = "grid-" + dealii::Utilities::int_to_string(n_done, 6);
    pvd.add(time, write_pieces(folder, "grid", stem, make_piece(snapshot), time));
    ++n_done;
  }



  template <int dim>
  unsigned int
  GridOutput<dim>::n_written() const
  {
    return n_done;
  }



  template <int dim>
  void
  GridOutput<dim>::flush() const
  {
    pvd.flush();
  }



  template class GridOutput<2>;
  template class GridOutput<3>;
} // namespace kedge
