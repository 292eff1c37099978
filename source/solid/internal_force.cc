#include "internal_force_kernels.h"

namespace kedge
{
  namespace internal
  {
    // compiled in internal_force_2d.cc and internal_force_3d.cc
    extern template void
    add_batch_force(const BatchContext<2> &,
                    const Material &,
                    const StressRule,
                    std::vector<double> &,
                    PointStatus &);
    extern template void
    add_batch_stiffness(const BatchContext<2> &,
                        const Material &,
                        const StressRule,
                        NodeMatrix<2> &);
    extern template void
    add_batch_force(const BatchContext<3> &,
                    const Material &,
                    const StressRule,
                    std::vector<double> &,
                    PointStatus &);
    extern template void
    add_batch_stiffness(const BatchContext<3> &,
                        const Material &,
                        const StressRule,
                        NodeMatrix<3> &);
  } // namespace internal



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
  InternalForce<dim>::evaluate_groups(const StepPoints<dim>     &points,
                                      const LatticeWindow<dim>  &window,
                                      const ActiveNodes<dim>    &nodes,
                                      const std::vector<double> &displacement,
                                      GroupDilatation           &dilatation) const
  {
    const double at = stress_rule == StressRule::conserving ? 1. : fraction;
    return evaluate_group_dilatation(points, window, nodes, displacement, at, dilatation);
  }



  template <int dim>
  PointStatus
  InternalForce<dim>::add_force(const StepPoints<dim>     &points,
                                const LatticeWindow<dim>  &window,
                                const ActiveNodes<dim>    &nodes,
                                const std::vector<double> &displacement,
                                std::vector<double>       &force) const
  {
    GroupDilatation dilatation;
    PointStatus     status = evaluate_groups(points, window, nodes, displacement, dilatation);
    if (!status.ok())
      return status;
    for (const auto &batch : points.batches)
      {
        const internal::BatchContext<dim> context{points,
                                                  window,
                                                  nodes,
                                                  displacement,
                                                  batch,
                                                  fraction,
                                                  points.is_grouped(batch) ? &dilatation : nullptr};
        internal::add_batch_force(context, materials[batch.body], stress_rule, force, status);
        if (!status.ok())
          break;
      }
    return status;
  }



  template <int dim>
  void
  InternalForce<dim>::add_stiffness(const StepPoints<dim>     &points,
                                    const LatticeWindow<dim>  &window,
                                    const ActiveNodes<dim>    &nodes,
                                    const std::vector<double> &displacement,
                                    NodeMatrix<dim>           &stiffness) const
  {
    GroupDilatation dilatation;
    evaluate_groups(points, window, nodes, displacement, dilatation);
    for (const auto &batch : points.batches)
      {
        const internal::BatchContext<dim> context{points,
                                                  window,
                                                  nodes,
                                                  displacement,
                                                  batch,
                                                  fraction,
                                                  points.is_grouped(batch) ? &dilatation : nullptr};
        internal::add_batch_stiffness(context, materials[batch.body], stress_rule, stiffness);
      }
    add_group_stiffness(materials,
                        stress_rule,
                        fraction,
                        points,
                        window,
                        nodes,
                        displacement,
                        stiffness);
  }

  template class InternalForce<2>;
  template class InternalForce<3>;
} // namespace kedge
