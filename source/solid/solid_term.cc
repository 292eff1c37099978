#include <kedge/solid/solid_term.h>

namespace kedge
{
  template <int dim>
  SolidTerm<dim>::SolidTerm(const unsigned int           field,
                            const Patch<dim>            &patch,
                            const std::vector<Material> &material_of_body,
                            const Scheme                &scheme)
    : field(field)
    , patch(patch)
    , internal_force(material_of_body,
                     scheme.conserving_stress ? StressRule::conserving
                                              : StressRule::at_configuration,
                     scheme.alpha_f)
    , force_at_rest(material_of_body, StressRule::at_configuration, 1.)
  {}



  template <int dim>
  void
  SolidTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    unknowns.fields[field].measure_diagonal = true;
  }



  template <int dim>
  Answer
  SolidTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    const PointStatus status =
      internal_force.add_force(patch, trial.displacement(field), residual.partial(field));
    return status.ok() ? Answer()
                       : Answer::failure(patch.describe_point(status.failed_slot) +
                                         " has det F <= 0 or no finite stress");
  }



  template <int dim>
  void
  SolidTerm<dim>::add_residual_at_rest(const double, Residual<dim> &residual)
  {
    const std::vector<double> at_rest(std::size_t(patch.nodes.n_local()) * dim, 0.);
    force_at_rest.add_force(patch, at_rest, residual.partial(field));
  }



  template <int dim>
  void
  SolidTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    internal_force.add_stiffness(patch, trial.displacement(field), tangent.lattice(field));
  }

  template class SolidTerm<2>;
  template class SolidTerm<3>;
} // namespace kedge
