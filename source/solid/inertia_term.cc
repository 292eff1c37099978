#include <kedge/solid/inertia_term.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  Answer
  InertiaTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    add_product(patch, 1., mass, trial.motion[field].acceleration, residual.partial(field));
    return {};
  }



  template <int dim>
  void
  InertiaTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    tangent.add_to_diagonal_blocks(field, scheme.inertia_coefficient(trial.times.dt), mass, 0, dim);
  }

  template class InertiaTerm<2>;
  template class InertiaTerm<3>;
} // namespace kedge
