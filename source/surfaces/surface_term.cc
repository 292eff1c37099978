#include <kedge/base/exceptions.h>
#include <kedge/surfaces/seed_surface.h>
#include <kedge/surfaces/surface_term.h>

namespace kedge
{
  template <int dim>
  void
  SurfaceTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &)
  {
    const auto        &lattice = surface_.patch.grid().lattice();
    dealii::Point<dim> upper;
    for (int d = 0; d < dim; ++d)
      upper[d] = lattice.upper(d);
    surface_.seed(
      seed_surface(*geometry, spacing, dealii::BoundingBox<dim>({lattice.origin, upper})));
    if (surface_.n_facets() == 0)
      throw UserError("The surface of body '" + surface_.body_name +
                      "' cannot be found: at the spacing of its points the body has no inside.");
  }



  template <int dim>
  void
  SurfaceTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    surface_.find_roots();
  }



  template <int dim>
  Answer
  SurfaceTerm<dim>::finish(const Trial<dim> &trial)
  {
    surface_.interpolate(trial.displacement(surface_.field), displacements);
    return {};
  }



  template <int dim>
  void
  SurfaceTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    surface_.commit(displacements);
  }



  template <int dim>
  void
  SurfaceTerm<dim>::save(SavedState &state) const
  {
    state[name()] = surface_.save();
  }



  template <int dim>
  void
  SurfaceTerm<dim>::restore(const SavedState &state)
  {
    surface_.restore(state.at(name()));
  }

  template class SurfaceTerm<2>;
  template class SurfaceTerm<3>;
} // namespace kedge
