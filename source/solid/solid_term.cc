#include <kedge/solid/point_failure.h>
#include <kedge/solid/solid_term.h>
#include <kedge/stress/viscous_stress.h>
#include <kedge/transfer/node_sums.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  SolidTerm<dim>::SolidTerm(const unsigned int           field,
                            const Patch<dim>            &patch,
                            const std::vector<Material> &material_of_body,
                            const Scheme                &scheme,
                            const std::vector<double>   &viscosity_of_body)
    : field(field)
    , patch(patch)
    , internal_force(material_of_body,
                     scheme.conserving_stress ? StressRule::conserving
                                              : StressRule::at_configuration,
                     scheme.alpha_f)
    , force_at_rest(material_of_body, StressRule::at_configuration, 1.)
  {
    if (std::any_of(viscosity_of_body.begin(), viscosity_of_body.end(), [](const double eta) {
          return eta > 0.;
        }))
      viscosities = viscosity_of_body;
  }



  template <int dim>
  std::vector<double>
  SolidTerm<dim>::viscous_moduli(const double dt) const
  {
    std::vector<double> result;
    for (const double eta : viscosities)
      result.push_back(2. * eta / dt);
    return result;
  }



  template <int dim>
  void
  SolidTerm<dim>::declare_books(Ledger &ledger)
  {
    if (!viscosities.empty())
      viscous_dissipation = ledger.declare({"viscous_dissipation",
                                            "J",
                                            Ledger::Section::energy,
                                            Ledger::Kind::total,
                                            Ledger::Role::lost,
                                            "energy"});
  }



  template <int dim>
  void
  SolidTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    if (viscosities.empty())
      return;
    const auto                         &points = patch.points;
    const std::vector<double>           moduli = viscous_moduli(trial.times.dt);
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(patch, trial.displacement(field), gradients);
    double work = 0.;
    for (const auto &batch : points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          double A[dim][dim], E[dim][dim];
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              A[i][j] = gradients[slot][i][j];
          internal::strain_of_step<dim>(A, E);
          for (const auto &row : E)
            for (const double e : row)
              work += moduli[batch.body] * points.volume[slot] * points.determinant[slot] * e * e;
        }
    ledger.book(viscous_dissipation, work);
  }



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
    const PointStatus status = internal_force.add_force(patch,
                                                        trial.displacement(field),
                                                        residual.partial(field),
                                                        viscous_moduli(trial.times.dt));
    return status.ok() ? Answer()
                       : Answer::failure(describe_failure(patch,
                                                          status.failed_slot,
                                                          trial.displacement(field),
                                                          internal_force.alpha(),
                                                          {},
                                                          "no finite stress"));
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
    internal_force.add_stiffness(patch,
                                 trial.displacement(field),
                                 tangent.lattice(field),
                                 viscous_moduli(trial.times.dt));
  }

  template class SolidTerm<2>;
  template class SolidTerm<3>;
} // namespace kedge
