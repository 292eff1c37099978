#include <kedge/scene/read_geometry.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    /** How far, in edges of the grid, a body may reach past the grid by rounding. */
    constexpr double domain_tolerance = 1e-10;

    /** A body so many times larger than the grid was probably given in other units. */
    constexpr double suspicious_size = 20;

    template <int dim>
    dealii::BoundingBox<dim>
    grid_box(const GridParameters<dim> &grid)
    {
      return dealii::BoundingBox<dim>({grid.origin, grid.origin + grid.extent});
    }

    template <int dim>
    void
    check_inside_grid(const SectionReader       &section,
                      const Geometry<dim>       &geometry,
                      const GridParameters<dim> &grid)
    {
      const auto [lower, upper] = geometry.bounding_box(grid_box(grid)).get_boundary_points();
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double low    = grid.origin[d];
          const double high   = grid.origin[d] + grid.extent[d];
          const double margin = domain_tolerance * grid.extent[d];
          if (lower[d] < low - margin || upper[d] > high + margin)
            {
              std::ostringstream problem;
              problem << "The body reaches from " << lower[d] << " to " << upper[d]
                      << " in direction "
                      << "xyz"[d] << ", the grid only from " << low << " to " << high
                      << " (Grid/Origin and Grid/Extent).";
              if (upper[d] - lower[d] > suspicious_size * (high - low) &&
                  section.text("Geometry").find("stl") != std::string::npos)
                problem << " If the STL file is in millimetres, its scale is 0.001.";
              throw section.error("Geometry", problem.str());
            }
        }
    }
  } // namespace



  template <int dim>
  std::shared_ptr<Geometry<dim>>
  read_geometry(const SectionReader         &section,
                const GridParameters<dim>   &grid,
                const std::filesystem::path &folder,
                const BodyExtent             extent)
  {
    std::shared_ptr<Geometry<dim>> geometry;
    try
      {
        // reads files too, which the check of the entry's text does not
        geometry = parse_geometry<dim>(section.text("Geometry"), section.constants(), folder);
      }
    catch (const UserError &error)
      {
        throw section.error("Geometry", error.what());
      }
    if (extent == BodyExtent::in_grid)
      check_inside_grid(section, *geometry, grid);
    return geometry;
  }

  template <int dim>
  std::vector<std::shared_ptr<Geometry<dim>>>
  read_pieces(const SectionReader         &section,
              const GridParameters<dim>   &grid,
              const std::filesystem::path &folder)
  {
    return parse_pieces<dim>(section.text("Geometry"), grid_box(grid), section.constants(), folder);
  }

  template std::vector<std::shared_ptr<Geometry<2>>>
  read_pieces(const SectionReader &, const GridParameters<2> &, const std::filesystem::path &);
  template std::vector<std::shared_ptr<Geometry<3>>>
  read_pieces(const SectionReader &, const GridParameters<3> &, const std::filesystem::path &);
  template std::shared_ptr<Geometry<2>>
  read_geometry(const SectionReader &,
                const GridParameters<2> &,
                const std::filesystem::path &,
                const BodyExtent);
  template std::shared_ptr<Geometry<3>>
  read_geometry(const SectionReader &,
                const GridParameters<3> &,
                const std::filesystem::path &,
                const BodyExtent);
} // namespace kedge
