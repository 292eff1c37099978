// The books of saturated soil.
#include <kedge/porous/porous_term.h>

namespace kedge
{
  template <int dim>
  typename PorousTerm<dim>::Inflow
  PorousTerm<dim>::inflow(const Trial<dim> &trial, const Residual<dim> &residual) const
  {
    const PoreFluid           &fluid    = porous_force.soils().front().fluid;
    const std::vector<double> &unknowns = trial.unknowns.fields[field];
    const std::vector<double> &sums     = residual.of_field(field);
    Inflow                     result;
    const auto                 add = [&](const double mass, const double pressure) {
      result.mass += mass;
      // mu = K_f/rho_0 (1 - rho_0/rho_f), (4.112)
      result.work -= mass * fluid.bulk_modulus / fluid.reference_density *
                     std::expm1(-pressure / fluid.bulk_modulus);
    };
    for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
      if (patch.conditions.pressure_prescribed(i))
        {
          const std::size_t k = std::size_t(i) * (dim + 1) + dim;
          add(fluid.reference_density * sums[k], unknowns[k]);
        }
    for (std::size_t k = dim;
         k < supply.size() && k < std::size_t(patch.nodes.n_owned()) * (dim + 1);
         k += dim + 1)
      add(fluid.reference_density * supply[k], unknowns[k]);
    const auto pressures = surfaces.pressures(pressure_time(trial.times));
    for (std::size_t f = 0; f < outflow.size(); ++f)
      add(-fluid.reference_density * outflow[f], pressures[f]);
    return result;
  }



  /**
   * The work is what the body force does on the mixture and the flow and the fluid that is pressed
   * in; beside it stands the power -pi.a of the fluid's own acceleration, which the u-p equations
   * leave out and no energy answers to:
   *   d(kinetic + skeleton's + fluid's energy) + dissipation = work + neglected_inertia_work.
   */
  template <int dim>
  void
  PorousTerm<dim>::book(const Trial<dim>    &trial,
                        const Residual<dim> &residual,
                        Ledger              &ledger) const
  {
    std::vector<dealii::Tensor<1, dim>> displacement;
    interpolate_to_points(patch, trial.displacement(field), displacement);
    // work, Darcy, stabilisation, known part of the inflow, work of the inertia left out
    double       sums[5] = {0., 0., 0., 0., 0.};
    const auto   f       = loads.body_acceleration(trial.times.t_n + 0.5 * trial.times.dt);
    const auto  &soils   = porous_force.soils();
    const double factor  = porous_force.scheme().content_factor();
    for (const auto &batch : patch.points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          const PoreUpdate<dim> &update = updates[slot];
          const double           mass   = 0.5 * (patch.points.mass[slot] + update.mass);
          for (int d = 0; d < dim && soils[batch.body].has_body_force; ++d)
            sums[0] += mass * f[d] * displacement[slot][d];
          sums[0] += update.flow_work;
          sums[1] += update.darcy_dissipation;
          sums[2] += update.stabilisation_work;
          sums[3] += update.known_inflow;
          sums[4] += update.inertia_work;
        }
    const Inflow in = inflow(trial, residual);
    ledger.book(columns.inflow, (in.mass - sums[3]) / factor);
    ledger.book(columns.darcy, sums[1]);
    if (parameters.stabilisation > 0.)
      ledger.book(columns.stabilisation, sums[2]);
    ledger.book(columns.work, sums[0] + in.work);
    if (scheme.dynamic)
      ledger.book(columns.neglected, sums[4]);
  }



  template <int dim>
  void
  PorousTerm<dim>::book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const
  {
    const auto         &soils = porous_force.soils();
    std::vector<double> energies(patch.points.size()), fluid_masses(patch.points.size());
    double              smallest = std::numeric_limits<double>::max();
    cloud.for_each([&](const unsigned int number,
                       const std::uint64_t,
                       const dealii::Point<dim> &,
                       const PointState<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot == StepPoints<dim>::no_slot)
        return;
      const Soil &soil = soils[static_cast<unsigned int>(state.body)];
      smallest         = std::min(smallest, state.porosity);
      if (soil.dry_storage > 0.)
        return;
      const PoreFluid &fluid = soil.fluid;
      fluid_masses[slot]     = fluid.density(state.pore_pressure) * state.porosity *
                           determinant(state.deformation_gradient) * state.reference_volume;
      energies[slot] = fluid_masses[slot] * fluid.energy(state.pore_pressure);
    });
    double sums[3] = {0., 0., 0.};
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      {
        sums[0] += patch.points.mass[slot] - fluid_masses[slot];
        sums[1] += fluid_masses[slot];
        sums[2] += energies[slot];
      }
    ledger.book(columns.solid_mass, sums[0]);
    ledger.book(columns.fluid_mass, sums[1]);
    ledger.book(columns.fluid_energy, sums[2]);
    ledger.book(columns.min_porosity, smallest);
  }

#define KEDGE_INSTANTIATE(dim)                                                                    \
  template void PorousTerm<dim>::book(const Trial<dim> &, const Residual<dim> &, Ledger &) const; \
  template void PorousTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &) const;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
