#include <kedge/io/surface_output.h>
#include <kedge/io/vtu_file.h>

#include <deal.II/base/utilities.h>

namespace kedge
{
  namespace
  {
    template <int dim>
    VtuFile
    make_piece(const ContactPicture<dim> &picture)
    {
      constexpr std::uint8_t line = 3, triangle = 5;

      std::vector<std::int64_t>           connectivity, body, state, partner;
      std::vector<double>                 pressure, gap;
      std::vector<dealii::Tensor<1, dim>> force, slip_rate;
      for (const auto &facet : picture.facets())
        {
          connectivity.insert(connectivity.end(), facet.corners.begin(), facet.corners.end());
          body.push_back(facet.body);
          pressure.push_back(facet.pressure);
          force.push_back(facet.force);
          gap.push_back(facet.gap);
          slip_rate.push_back(facet.slip_rate);
          state.push_back(static_cast<std::int64_t>(facet.state));
          partner.push_back(facet.partner);
        }
      VtuFile piece;
      piece.set_nodes(with_three_components<dim>(picture.vertices()));
      piece.set_cells(connectivity, dim, dim == 2 ? line : triangle);
      piece.add_cell_field({"body", "", 1, {}}, body);
      piece.add_cell_field({"contact_pressure", "", 1, {}}, pressure);
      piece.add_cell_field({"contact_force", "", 3, {"x", "y", "z"}},
                           with_three_components<dim>(force));
      piece.add_cell_field({"gap", "", 1, {}}, gap);
      piece.add_cell_field({"slip_rate", "", 3, {"x", "y", "z"}},
                           with_three_components<dim>(slip_rate));
      piece.add_cell_field({"state", "", 1, {}}, state);
      piece.add_cell_field({"partner", "", 1, {}}, partner);
      return piece;
    }
  } // namespace



  template <int dim>
  SurfaceOutput<dim>::SurfaceOutput(const RunFolder &folder, const unsigned int n_kept)
    : folder(folder)
    , n_done(n_kept)
    , pvd(folder, "surfaces.pvd", TimeSeries::Format::pvd, n_kept)
  {}



  template <int dim>
  void
  SurfaceOutput<dim>::write(const double time, const ContactPicture<dim> &picture)
  {
    folder.make_subfolder("surfaces");
    const std::string stem = "surfaces-" + dealii::Utilities::int_to_string(n_done, 6);
    pvd.add(time, write_pieces(folder, "surfaces", stem, make_piece(picture), time));
    ++n_done;
  }



  template <int dim>
  unsigned int
  SurfaceOutput<dim>::n_written() const
  {
    return n_done;
  }



  template <int dim>
  void
  SurfaceOutput<dim>::flush() const
  {
    pvd.flush();
  }

  template class SurfaceOutput<2>;
  template class SurfaceOutput<3>;
} // namespace kedge
