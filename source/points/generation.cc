#include <kedge/base/exceptions.h>
#include <kedge/points/generation.h>

namespace kedge
{
  namespace
  {
    /** Integer box of sub-cells [low, high) that may hold points of a body. */
    template <int dim>
    struct SubCells
    {
      Lattice<dim>         lattice;
      std::array<int, dim> per_cell;
      LatticeIndex<dim>    low, high;

      dealii::Point<dim>
      centre(const LatticeIndex<dim> &sub) const
      {
        dealii::Point<dim> x;
        for (int d = 0; d < dim; ++d)
          {
            // cell and place in it apart: the same in every cell to round-off
            const int cell = sub[d] / per_cell[d], within = sub[d] % per_cell[d];
            x[d] = lattice.origin[d] + (cell + (within + 0.5) / per_cell[d]) * lattice.h[d];
          }
        return x;
      }

      /** Number of a sub-cell of the box or of the layer of sub-cells around it. */
      std::size_t
      key(const LatticeIndex<dim> &sub) const
      {
        std::size_t key = 0;
        for (int d = dim - 1; d >= 0; --d)
          key = key * (high[d] - low[d] + 2) + (sub[d] - low[d] + 1);
        return key;
      }

      std::size_t
      n_keys() const
      {
        std::size_t n = 1;
        for (int d = 0; d < dim; ++d)
          n *= high[d] - low[d] + 2;
        return n;
      }

      /** Calls visit(sub) for all sub-cells, cell after cell. */
      template <typename Visitor>
      void
      for_each(const Visitor &visit) const
      {
        LatticeIndex<dim> sub = low;
        while (true)
          {
            visit(sub);
            int d = 0;
            while (d < dim && ++sub[d] == high[d])
              {
                sub[d] = low[d];
                ++d;
              }
            if (d == dim)
              return;
          }
      }
    };

    template <int dim>
    SubCells<dim>
    sub_cells_of(const BodyParameters<dim> &body, const Lattice<dim> &lattice)
    {
      dealii::Point<dim> upper;
      for (int d = 0; d < dim; ++d)
        upper[d] = lattice.upper(d);
      const dealii::BoundingBox<dim> domain({lattice.origin, upper});
      const auto bounds = body.geometry->bounding_box(domain).get_boundary_points();

      SubCells<dim> sub_cells{lattice, {}, {}, {}};
      for (int d = 0; d < dim; ++d)
        {
          const double tolerance = 1e-9 * (upper[d] - lattice.origin[d]);
          if (bounds.first[d] < lattice.origin[d] - tolerance ||
              bounds.second[d] > upper[d] + tolerance)
            {
              std::ostringstream message;
              message << "Body '" << body.name << "' reaches past the background grid: it spans "
                      << bounds.first << " to " << bounds.second << ", the grid " << lattice.origin
                      << " to " << upper
                      << ". Move the body or make the grid (Grid/Origin, Grid/Extent) larger.";
              throw UserError(message.str());
            }
          const int per_cell    = body.points_per_cell[d];
          sub_cells.per_cell[d] = per_cell;
          const auto line       = [&](const double x) {
            return lattice.scaled(x, d) * per_cell;
          };
          sub_cells.low[d]  = std::max(0, static_cast<int>(std::floor(line(bounds.first[d]))) - 1);
          sub_cells.high[d] = std::min(per_cell * lattice.n_cells[d],
                                       static_cast<int>(std::ceil(line(bounds.second[d]))) + 1);
        }
      return sub_cells;
    }

    template <int dim>
    PointState<dim>
    state_at_rest(const SubCells<dim>                            &sub_cells,
                  const dealii::Point<dim>                       &x,
                  const unsigned int                              body_index,
                  const double                                    density,
                  const std::array<Expression, std::size_t(dim)> &velocity)
    {
      PointState<dim> state;
      std::fill_n(reinterpret_cast<double *>(&state), n_state_values<dim>, 0.);
      state.body             = body_index;
      state.reference_volume = 1.;
      double coordinates[3]  = {0, 0, 0};
      for (int d = 0; d < dim; ++d)
        {
          coordinates[d]                  = x[d];
          const double length             = sub_cells.lattice.h[d] / sub_cells.per_cell[d];
          state.reference_half_lengths[d] = state.half_lengths[d] = 0.5 * length;
          state.reference_volume *= length;
          state.reference_position[d]      = x[d];
          state.deformation_gradient[d][d] = state.elastic_frame[d][d] = 1.;
        }
      state.out_of_plane_elastic_stretch = 1.;
      state.mass                         = density * state.reference_volume;
      for (int d = 0; d < dim; ++d)
        state.velocity[d] = velocity[d](coordinates);
      return state;
    }
  } // namespace



  template <int dim>
  std::vector<GeneratedPoint<dim>>
  generate_points(const BodyParameters<dim>           &body,
                  const unsigned int                   body_index,
                  const double                         density,
                  const Lattice<dim>                  &lattice,
                  const std::map<std::string, double> &constants,
                  const std::uint64_t                  first_id)
  {
    std::array<Expression, dim> velocity;
    for (int d = 0; d < dim; ++d)
      velocity[d] = Expression(body.initial_velocity[d], {"x", "y", "z"}, constants);

    const SubCells<dim> sub_cells = sub_cells_of(body, lattice);
    std::vector<bool>   filled(sub_cells.n_keys(), false);
    std::size_t         n_points = 0;
    sub_cells.for_each([&](const LatticeIndex<dim> &sub) {
      if (!body.geometry->contains(sub_cells.centre(sub)))
        return;
      filled[sub_cells.key(sub)] = true;
      ++n_points;
    });
    if (n_points == 0)
      throw UserError("Body '" + body.name +
                      "' got no material point: its geometry contains no centre of the grid's "
                      "sub-cells. Refine the grid (Grid/Cells) or use more points per cell "
                      "(Bodies/" +
                      body.name + "/Points per cell).");

    std::vector<GeneratedPoint<dim>> points;
    points.reserve(n_points);
    sub_cells.for_each([&](const LatticeIndex<dim> &sub) {
      if (!filled[sub_cells.key(sub)])
        return;
      const auto x = sub_cells.centre(sub);
      points.push_back({{first_id + points.size(),
                         x,
                         state_at_rest<dim>(sub_cells, x, body_index, density, velocity)},
                        0u});
      for (int side = 0; side < 2 * dim; ++side)
        {
          LatticeIndex<dim> neighbour = sub;
          neighbour[side / 2] += side % 2 == 0 ? -1 : 1;
          if (!filled[sub_cells.key(neighbour)])
            points.back().exposed_sides |= 1u << side;
        }
    });
    return points;
  }

  template std::vector<GeneratedPoint<2>>
  generate_points(const BodyParameters<2> &,
                  const unsigned int,
                  const double,
                  const Lattice<2> &,
                  const std::map<std::string, double> &,
                  const std::uint64_t);
  template std::vector<GeneratedPoint<3>>
  generate_points(const BodyParameters<3> &,
                  const unsigned int,
                  const double,
                  const Lattice<3> &,
                  const std::map<std::string, double> &,
                  const std::uint64_t);
} // namespace kedge
