#include "surface_kernels.h"

namespace kedge
{
  template <int dim>
  PorousForce<dim>::PorousForce(const std::vector<Material> &material_of_body,
                                const std::vector<Soil>     &soil_of_body,
                                const double                 alpha,
                                const PoreScheme            &scheme)
    : material_of_body(material_of_body)
    , soil_of_body(soil_of_body)
    , alpha(alpha)
    , pore_scheme(scheme)
  {}



  template <int dim>
  template <class Run>
  void
  PorousForce<dim>::for_batches(const Patch<dim>       &patch,
                                const PorePoints<dim>  &pores,
                                const PorousTrial<dim> &trial,
                                const Run              &run) const
  {
    for (const auto &batch : patch.points.batches)
      {
        const Soil   &soil = soil_of_body[batch.body];
        PoreStep<dim> step{soil,
                           pore_scheme,
                           trial.dt,
                           alpha,
                           trial.inertia,
                           1. / trial.cell_size,
                           stabilisation_of_step(soil, trial.inertia, 1. / trial.cell_size),
                           {}};
        for (int d = 0; d < dim && soil.has_body_force; ++d)
          step.acceleration[d] = trial.body_force[d];
        const Material &material = material_of_body[batch.body];
        const auto      law      = [&](const bool with_tangent) {
          return internal::law_function<dim>(material,
                                             {StressRule::at_configuration, false, with_tangent});
        };
        const bool goes_on =
          run(internal::PorousBatch<dim>{{patch, trial.unknowns, batch, alpha, nullptr},
                                         pores,
                                         trial,
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
  PorousForce<dim>::add_residual(const Patch<dim>       &patch,
                                 const PorePoints<dim>  &pores,
                                 const PorousTrial<dim> &trial,
                                 std::vector<double>    &residual,
                                 std::vector<double>    &outflow,
                                 PorousSize             &size) const
  {
    PointStatus status;
    for_batches(patch, pores, trial, [&](const auto &batch) {
      dispatch_pattern<dim>(batch.context.batch.pattern,
                            internal::PorousResidualKernel<dim>{batch, residual, size, status});
      if (status.ok())
        internal::for_faces(batch, [&](const auto &face, const std::size_t number) {
          dispatch_pattern<dim>(
            face.face.functions.pattern,
            internal::SurfaceResidualKernel<dim>{face, residual, outflow[number], status});
        });
      return status.ok();
    });
    return status;
  }



  template <int dim>
  void
  PorousForce<dim>::add_tangent(const Patch<dim>       &patch,
                                const PorePoints<dim>  &pores,
                                const PorousTrial<dim> &trial,
                                NodeMatrix<dim>        &tangent) const
  {
    for_batches(patch, pores, trial, [&](const auto &batch) {
      dispatch_pattern<dim>(batch.context.batch.pattern,
                            internal::PorousTangentKernel<dim>{batch, tangent});
      internal::for_faces(batch, [&](const auto &face, const std::size_t) {
        dispatch_pattern<dim>(face.face.functions.pattern,
                              internal::SurfaceTangentKernel<dim>{face, tangent});
      });
      return true;
    });
  }



  template <int dim>
  void
  PorousForce<dim>::evaluate_updates(const Patch<dim>             &patch,
                                     const PorePoints<dim>        &pores,
                                     const PorousTrial<dim>       &trial,
                                     std::vector<PoreUpdate<dim>> &updates) const
  {
    updates.resize(patch.points.size());
    for_batches(patch, pores, trial, [&](const auto &batch) {
      dispatch_pattern<dim>(batch.context.batch.pattern,
                            internal::PoreUpdateKernel<dim>{batch, updates});
      return true;
    });
  }



  template <int dim>
  std::vector<double>
  PorousForce<dim>::fluctuations(const Patch<dim> &patch, const std::vector<double> &nodal_pressure)
  {
    std::vector<double> result(patch.points.size());
    for (const auto &batch : patch.points.batches)
      dispatch_pattern<dim>(batch.pattern,
                            internal::FluctuationKernel<dim>{patch, nodal_pressure, batch, result});
    return result;
  }



  template <int dim>
  void
  apply_pore_update(const PoreUpdate<dim> &update, PointState<dim> &state)
  {
    state.pore_pressure             = update.pressure;
    state.pore_pressure_fluctuation = update.fluctuation;
    state.porosity                  = update.porosity;
    state.mass                      = update.mass;
    state.fluid_content_rate        = update.content_rate;
    state.fluid_content_rate_change = update.content_rate_change;
    for (int d = 0; d < dim; ++d)
      state.darcy_velocity[d] = update.darcy_velocity[d];
  }

  template class PorousForce<2>;
  template class PorousForce<3>;
  template void
  apply_pore_update(const PoreUpdate<2> &, PointState<2> &);
  template void
  apply_pore_update(const PoreUpdate<3> &, PointState<3> &);
} // namespace kedge
