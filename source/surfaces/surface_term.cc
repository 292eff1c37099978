#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/surfaces/seed_surface.h>
#include <kedge/surfaces/surface_term.h>

#include <algorithm>

namespace kedge
{
  /** Loads act on the facets of a side if its surface is not where the domains of points end. */
  template <int dim>
  void
  SurfaceTerm<dim>::find_sides(const std::vector<GeneratedPoint<dim>> &points)
  {
    on_facets.fill(false);
    if (sides.empty() || !is_clipped)
      return;
    for (const GeneratedPoint<dim> &point : points)
      if (static_cast<unsigned int>(point.record.state.body) == surface_.body)
        for (unsigned int side = 0; side < 2 * dim; ++side)
          if (!on_facets[side] && ((point.exposed_sides >> side) & 1u) != 0)
            on_facets[side] = lies_off_the_surface(PointOrigin<dim>(point), side, *geometry);
    on_facets.back() = true; // all sides: the closed surface, which stays closed however it turns
  }



  template <int dim>
  void
  SurfaceTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    find_sides(points);
    const bool loaded = std::any_of(sides.begin(), sides.end(), [&](const unsigned int side) {
      return on_facets[side];
    });
    if (!contact && !loaded)
      return;
    const auto        &lattice = surface_.patch.grid().lattice();
    dealii::Point<dim> upper;
    for (int d = 0; d < dim; ++d)
      upper[d] = lattice.upper(d);
    surface_.seed(seed_surface(*geometry,
                               spacing,
                               dealii::BoundingBox<dim>({lattice.origin, upper})),
                  EdgeLengths::around(spacing));
    if (surface_.n_facets() == 0)
      throw UserError("The surface of body '" + surface_.body_name +
                      "' cannot be found: at the spacing of its points the body has no inside.");
  }



  template <int dim>
  void
  SurfaceTerm<dim>::claim(const unsigned int field, std::vector<unsigned char> &reached)
  {
    const auto &communicator = surface_.patch.grid().communicator();
    if (contact && field == surface_.field && surface_.n_facets() > 0 &&
        dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      surface_.claim_nodes(reached);
  }



  template <int dim>
  void
  SurfaceTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    if (surface_.n_facets() > 0)
      surface_.find_roots();
  }



  template <int dim>
  Answer
  SurfaceTerm<dim>::finish(const Trial<dim> &trial)
  {
    std::vector<dealii::Tensor<1, dim>> displacements;
    surface_.interpolate(trial.displacement(surface_.field), displacements);
    surface_.move(displacements);
    return {};
  }



  template <int dim>
  void
  SurfaceTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    surface_.commit();
  }



  template <int dim>
  void
  SurfaceTerm<dim>::save(SavedState &state) const
  {
    if (surface_.n_facets() > 0)
      state[name()] = surface_.save();
  }



  template <int dim>
  void
  SurfaceTerm<dim>::restore(const SavedState &state)
  {
    if (surface_.n_facets() > 0)
      surface_.restore(state.at(name()));
  }

  template class SurfaceTerm<2>;
  template class SurfaceTerm<3>;
} // namespace kedge
