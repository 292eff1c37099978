#include <kedge/points/clipped_moments.h>
#include <kedge/points/volume_report.h>

namespace kedge
{
  template <int dim>
  VolumeMoments<dim>
  geometry_moments(const Geometry<dim> &geometry, const Lattice<dim> &lattice)
  {
    dealii::Point<dim> upper;
    for (int d = 0; d < dim; ++d)
      upper[d] = lattice.upper(d);
    const auto [low, high] =
      geometry.bounding_box(dealii::BoundingBox<dim>({lattice.origin, upper}))
        .get_boundary_points();
    LatticeWindow<dim> cells;
    for (int d = 0; d < dim; ++d)
      {
        cells.low[d] = std::max(0, static_cast<int>(std::floor(lattice.scaled(low[d], d))));
        cells.n_cells[d] =
          std::min(lattice.n_cells[d], static_cast<int>(std::ceil(lattice.scaled(high[d], d)))) -
          cells.low[d];
      }
    VolumeMoments<dim> sum;
    for (unsigned int c = 0; c < cells.n_cells_total(); ++c)
      {
        const auto                     lower = lattice.node_position(cells.cell_index(c));
        const dealii::BoundingBox<dim> cell({lower, lower + lattice.h});
        const Filling                  filling = geometry.filling(cell);
        if (filling == Filling::empty)
          continue;
        const auto moments = filling == Filling::full ? VolumeMoments<dim>::of_box(0.5 * lattice.h)
                                                      : clipped_moments(geometry, cell);
        sum.add(moments.about(-1. * dealii::Tensor<1, dim>(cell.center())));
      }
    return sum;
  }



  template <int dim>
  VolumeMoments<dim>
  points_moments(const std::vector<PointOrigin<dim>> &points, const unsigned int body)
  {
    VolumeMoments<dim> sum;
    for (const auto &point : points)
      if (point.body == body)
        {
          // the domain of a cut point may be smaller than what it stands for: it ends with its cell
          auto         moments = VolumeMoments<dim>::of_box(point.half_lengths);
          const double part    = point.volume / moments.volume;
          moments.volume *= part;
          moments.second *= part;
          sum.add(moments.about(-1. * dealii::Tensor<1, dim>(point.location)));
        }
    return sum;
  }



  template <int dim>
  void
  write_volumes(std::ostream                           &out,
                const std::vector<BodyParameters<dim>> &bodies,
                const Lattice<dim>                     &lattice,
                const std::vector<PointOrigin<dim>>    &points)
  {
    const std::string unit  = dim == 2 ? " m^2" : " m^3";
    const auto        trace = [](const VolumeMoments<dim> &moments) {
      return dealii::trace(moments.about(moments.centre()).second);
    };
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const auto body = geometry_moments(*bodies[b].geometry, lattice);
        const auto sum  = points_moments(points, b);
        out << "volume:           " << bodies[b].name << ", " << body.volume << unit
            << "; of its points " << sum.volume << unit << " ("
            << 100. * (sum.volume / body.volume - 1.) << " %)\n"
            << "centre:           " << bodies[b].name << ", (" << body.centre()
            << ") m; of its points off by " << (sum.centre() - body.centre()).norm()
            << " m; their polar moment of inertia by " << 100. * (trace(sum) / trace(body) - 1.)
            << " %\n";
      }
  }

  template VolumeMoments<2>
  geometry_moments(const Geometry<2> &, const Lattice<2> &);
  template VolumeMoments<3>
  geometry_moments(const Geometry<3> &, const Lattice<3> &);
  template VolumeMoments<2>
  points_moments(const std::vector<PointOrigin<2>> &, const unsigned int);
  template VolumeMoments<3>
  points_moments(const std::vector<PointOrigin<3>> &, const unsigned int);
  template void
  write_volumes(std::ostream &,
                const std::vector<BodyParameters<2>> &,
                const Lattice<2> &,
                const std::vector<PointOrigin<2>> &);
  template void
  write_volumes(std::ostream &,
                const std::vector<BodyParameters<3>> &,
                const Lattice<3> &,
                const std::vector<PointOrigin<3>> &);
} // namespace kedge
