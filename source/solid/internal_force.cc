#include "internal_force_kernels.h"

namespace kedge
{
  namespace
  {
    template <int dim>
    internal::BatchContext<dim>
    context_of(const Patch<dim>                      &patch,
               const std::vector<double>             &displacement,
               const typename StepPoints<dim>::Batch &batch,
               const double                           alpha,
               const GroupDilatation                 &dilatation,
               const std::vector<double>             &viscous_moduli)
    {
      return {patch,
              displacement,
              batch,
              alpha,
              patch.points.is_grouped(batch) ? &dilatation : nullptr,
              viscous_moduli.empty() ? 0. : viscous_moduli[batch.body]};
    }
  } // namespace



  template <int dim>
  InternalForce<dim>::InternalForce(const std::vector<Material> &material_of_body,
                                    const StressRule             rule,
                                    const double                 alpha)
    : materials(material_of_body)
    , stress_rule(rule)
    , fraction(alpha)
  {}



  template <int dim>
  PointStatus
  InternalForce<dim>::evaluate_groups(const Patch<dim>          &patch,
                                      const std::vector<double> &displacement,
                                      GroupDilatation           &dilatation) const
  {
    const double at = stress_rule == StressRule::conserving ? 1. : fraction;
    return evaluate_group_dilatation(patch, displacement, at, dilatation);
  }



  template <int dim>
  PointStatus
  InternalForce<dim>::add_force(const Patch<dim>          &patch,
                                const std::vector<double> &displacement,
                                std::vector<double>       &force,
                                const std::vector<double> &viscous_moduli) const
  {
    GroupDilatation dilatation;
    PointStatus     status = evaluate_groups(patch, displacement, dilatation);
    if (!status.ok())
      return status;
    for (const auto &batch : patch.points.batches)
      {
        const auto context =
          context_of(patch, displacement, batch, fraction, dilatation, viscous_moduli);
        const internal::BatchLaw<dim> law(context, materials[batch.body], stress_rule, false);
        dispatch_pattern<dim>(batch.pattern,
                              internal::ForceKernel<dim>{context, law, force, status});
        if (!status.ok())
          break;
      }
    return status;
  }



  template <int dim>
  void
  InternalForce<dim>::add_stiffness(const Patch<dim>          &patch,
                                    const std::vector<double> &displacement,
                                    NodeMatrix<dim>           &stiffness,
                                    const std::vector<double> &viscous_moduli) const
  {
    GroupDilatation dilatation;
    evaluate_groups(patch, displacement, dilatation);
    for (const auto &batch : patch.points.batches)
      {
        const auto context =
          context_of(patch, displacement, batch, fraction, dilatation, viscous_moduli);
        const internal::BatchLaw<dim> law(context, materials[batch.body], stress_rule, true);
        dispatch_pattern<dim>(batch.pattern,
                              internal::StiffnessKernel<dim>{context, law, stiffness});
      }
    add_group_stiffness(materials, stress_rule, fraction, patch, displacement, stiffness);
  }

  template class InternalForce<2>;
  template class InternalForce<3>;
} // namespace kedge
