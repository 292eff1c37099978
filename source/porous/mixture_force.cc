#include "mixture_surface_kernels.h"

namespace kedge
{
  template <int dim>
  template <class Run>
  void
  MixtureForce<dim>::for_batches(const Patch<dim>         &patch,
                                 const MixturePoints<dim> &points,
                                 const MixtureField<dim>  &field,
                                 const Run                &run) const
  {
    for (const auto &batch : patch.points.batches)
      {
        const Soil      &soil = soil_of_body[batch.body];
        MixtureStep<dim> step{soil, field.dt, field.theta, {}};
        for (int d = 0; d < dim && soil.has_body_force; ++d)
          step.acceleration[d] = field.body_force[d];
        const Material &material = material_of_body[batch.body];
        const auto      law      = [&](const bool with_tangent) {
          return internal::law_function<dim>(material,
                                             {StressRule::conserving, false, with_tangent});
        };
        const bool goes_on =
          run(internal::MixtureBatch<dim>{{patch, field.values, batch, 0.5, nullptr},
                                          points,
                                          field,
                                          step,
                                          material,
                                          law(false),
                                          law(true)});
        if (!goes_on)
          return;
      }
  }



  template <int dim>
  PointStatus
  MixtureForce<dim>::add_residual(const Patch<dim>            &patch,
                                  const MixturePoints<dim>    &points,
                                  const MixtureField<dim>     &field,
                                  std::vector<double>         &residual,
                                  std::vector<MixtureOutflow> &outflow,
                                  PorousSize                  &size) const
  {
    PointStatus status;
    for_batches(patch, points, field, [&](const auto &batch) {
      dispatch_pattern<dim>(batch.context.batch.pattern,
                            internal::MixtureResidualKernel<dim>{batch, residual, size, status});
      if (status.ok())
        internal::for_mixture_faces(batch, [&](const auto &face, const std::size_t number) {
          dispatch_pattern<dim>(
            face.face.functions.pattern,
            internal::MixtureSurfaceResidual<dim>{face, residual, outflow[number], status});
        });
      return status.ok();
    });
    return status;
  }



  template <int dim>
  void
  MixtureForce<dim>::add_tangent(const Patch<dim>         &patch,
                                 const MixturePoints<dim> &points,
                                 const MixtureField<dim>  &field,
                                 NodeMatrix<dim>          &tangent) const
  {
    for_batches(patch, points, field, [&](const auto &batch) {
      dispatch_pattern<dim>(batch.context.batch.pattern,
                            internal::MixtureTangentKernel<dim>{batch, tangent});
      internal::for_mixture_faces(batch, [&](const auto &face, const std::size_t) {
        dispatch_pattern<dim>(face.face.functions.pattern,
                              internal::MixtureSurfaceTangent<dim>{face, tangent});
      });
      return true;
    });
  }



  template <int dim>
  void
  MixtureForce<dim>::evaluate_updates(const Patch<dim>                &patch,
                                      const MixturePoints<dim>        &points,
                                      const MixtureField<dim>         &field,
                                      std::vector<MixtureUpdate<dim>> &updates) const
  {
    updates.resize(patch.points.size());
    for_batches(patch, points, field, [&](const auto &batch) {
      dispatch_pattern<dim>(batch.context.batch.pattern,
                            internal::MixtureUpdateKernel<dim>{batch, updates});
      return true;
    });
  }

  template class MixtureForce<2>;
  template class MixtureForce<3>;
} // namespace kedge
