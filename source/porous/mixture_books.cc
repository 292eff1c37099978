// The books of saturated soil in the conserving scheme.
#include <kedge/porous/mixture_term.h>
#include <kedge/solid/load_columns.h>

namespace kedge
{
  template <int dim>
  void
  MixtureTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section            = Ledger::Section;
    using Kind               = Ledger::Kind;
    using Role               = Ledger::Role;
    const std::string energy = "energy", fluid = "fluid";
    const auto        stored = [&](const std::string &name) {
      return ledger.declare({name, "J", Section::energy, Kind::present, Role::stored, energy});
    };
    const auto lost = [&](const std::string &name) {
      return ledger.declare({name, "J", Section::energy, Kind::total, Role::lost, energy});
    };
    columns.kinetic_energy = stored("kinetic_energy"); // with the skeleton's
    columns.fluid_kinetic_energy =
      ledger.declare({"fluid_kinetic_energy", "J", Section::energy}); // a part of it
    columns.fluid_energy = stored("fluid_energy");
    columns.darcy        = lost("darcy_dissipation");
    for (int d = 0; d < dim; ++d)
      columns.momentum[d] =
        ledger.declare({std::string("linear_momentum_") + "xyz"[d], "kg m/s", Section::momentum});
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      columns.angular_momentum[d] = ledger.declare(
        {std::string("angular_momentum_") + "xyz"[d], "kg m^2/s", Section::momentum});
    if (parameters.stabilisation > 0.)
      {
        columns.stabilisation        = lost("stabilisation_energy");
        columns.stabilisation_stored = stored("stabilisation_stored");
        for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
          columns.stabilisation_torque[d] =
            ledger.declare({std::string("stabilisation_torque_") + "xyz"[d],
                            "kg m^2/s",
                            Section::momentum,
                            Kind::total});
      }
    if (!surfaces.empty())
      columns.surface = lost("surface_dissipation");
    if (parameters.velocity_filter > 0.)
      columns.filter = lost("velocity_filter_dissipation");
    columns.work       = ledger.declare(external_work);
    columns.mass       = ledger.declare({"mass", "kg", Section::state});
    columns.solid_mass = ledger.declare({"solid_mass", "kg", Section::content});
    columns.fluid_mass =
      ledger.declare({"fluid_mass", "kg", Section::content, Kind::present, Role::stored, fluid});
    columns.inflow =
      ledger.declare({"fluid_inflow", "kg", Section::content, Kind::total, Role::supplied, fluid});
    ledger.declare_error("fluid_error", "kg", Section::content, fluid);
    columns.min_porosity = ledger.declare({"min_porosity", "", Section::content, Kind::lowest});
  }



  /**
   * What prescribed nodes and fluxes supply: volume at the potential lambda, with the kinetic
   * energy of what fluxes bring. Summed over all nodes, lambda and the velocity are fields of the
   * grid, so that ties need no care.
   */
  template <int dim>
  typename MixtureTerm<dim>::Exchange
  MixtureTerm<dim>::exchange(const Trial<dim> &trial, const Residual<dim> &residual) const
  {
    const double               density = bodies.soils.front().fluid.reference_density;
    const std::vector<double>  values  = potential(trial).values(trial.unknowns.fields[field]);
    const std::vector<double> &sums    = residual.of_field(field);
    Exchange                   result;
    for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
      if (patch.conditions.pressure_prescribed(i))
        {
          const std::size_t k = std::size_t(i) * (dim + 1) + dim;
          result.mass += density * sums[k];
          result.energy += values[k] * sums[k];
        }
    for (std::size_t k = 0; k < supply.size(); k += dim + 1)
      {
        double square = 0.;
        for (int d = 0; d < dim; ++d)
          square += values[k + d] * values[k + d] / (trial.times.dt * trial.times.dt);
        result.mass += density * supply[k + dim];
        result.energy += supply[k + dim] * (values[k + dim] + density * square);
      }
    for (const MixtureOutflow &at : outflow)
      {
        result.mass -= at.mass;
        result.energy -= at.energy;
        result.dissipation += at.dissipation;
      }
    return result;
  }



  /**
   * The sum is exact:
   *   d(kinetic + skeleton's + fluid's energy + stored stabilisation) + dissipations = work.
   */
  template <int dim>
  void
  MixtureTerm<dim>::book(const Trial<dim>    &trial,
                         const Residual<dim> &residual,
                         Ledger              &ledger) const
  {
    double work = 0., darcy = 0., loss = 0., filtered = 0., torque[3] = {0., 0., 0.};
    for (const MixtureUpdate<dim> &update : updates)
      {
        work += update.weight_work;
        darcy += update.darcy_dissipation;
        loss += update.stabilisation_loss;
        filtered += update.filter_loss;
        for (int d = 0; d < 3; ++d)
          torque[d] += update.stabilisation_torque[d];
      }
    Exchange in = exchange(trial, residual);
    for (const MixtureUpdate<dim> &update : updates)
      in.mass -= bodies.soils.front().fluid.reference_density * update.swallowed;
    ledger.book(columns.work, work + in.energy);
    ledger.book(columns.darcy, darcy);
    ledger.book(columns.inflow, in.mass);
    if (!surfaces.empty())
      ledger.book(columns.surface, in.dissipation);
    if (parameters.velocity_filter > 0.)
      ledger.book(columns.filter, filtered);
    if (parameters.stabilisation == 0.)
      return;
    ledger.book(columns.stabilisation, loss);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      ledger.book(columns.stabilisation_torque[d], torque[d]);
  }



  /** Of a point at the start of the step, 0 of a dry one [kg]. */
  template <int dim>
  double
  MixtureTerm<dim>::fluid_mass(const Soil &soil, const unsigned int slot) const
  {
    if (soil.dry_storage > 0.)
      return 0.;
    return patch.points.volume[slot] * soil.fluid.density(points.end_pressure[slot]) *
           (patch.points.determinant[slot] - (1. - soil.fluid.initial_porosity));
  }



  /** The fluid's part in kinetic energy and momenta. */
  template <int dim>
  void
  MixtureTerm<dim>::book_motion(Ledger &ledger) const
  {
    double kinetic = 0., linear[3] = {0., 0., 0.}, angular[3] = {0., 0., 0.};
    for (const auto &batch : patch.points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          const double mass = fluid_mass(bodies.soils[batch.body], slot);
          double       x[3] = {0., 0., 0.}, p[3] = {0., 0., 0.};
          for (int d = 0; d < dim; ++d)
            {
              x[d] = patch.points.location[slot][d];
              p[d] = mass * points.fluid_velocity[slot][d];
              linear[d] += p[d];
            }
          kinetic += 0.5 * mass * points.fluid_velocity[slot].norm_square();
          for (int d = 0; d < 3; ++d)
            angular[d] += x[(d + 1) % 3] * p[(d + 2) % 3] - x[(d + 2) % 3] * p[(d + 1) % 3];
        }
    ledger.book(columns.kinetic_energy, kinetic);
    ledger.book(columns.fluid_kinetic_energy, kinetic);
    for (int d = 0; d < dim; ++d)
      ledger.book(columns.momentum[d], linear[d]);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      ledger.book(columns.angular_momentum[d], angular[d]);
  }



  template <int dim>
  void
  MixtureTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    double solid = 0., fluid = 0., energy = 0., stabilisation = 0.;
    double smallest = std::numeric_limits<double>::max();
    for (const auto &batch : patch.points.batches)
      {
        const Soil &soil = bodies.soils[batch.body];
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const double mass = fluid_mass(soil, slot);
            solid += patch.points.mass[slot];
            fluid += mass;
            if (soil.dry_storage == 0.)
              energy += mass * soil.fluid.energy(points.end_pressure[slot]);
            stabilisation += 0.5 * patch.points.volume[slot] * soil.stabilisation *
                             points.fluctuation[slot] * points.fluctuation[slot];
            smallest = std::min(smallest, soil.fluid.porosity(patch.points.determinant[slot]));
          }
      }
    book_motion(ledger);
    ledger.book(columns.fluid_energy, energy);
    if (parameters.stabilisation > 0.)
      ledger.book(columns.stabilisation_stored, stabilisation);
    ledger.book(columns.mass, fluid);
    ledger.book(columns.solid_mass, solid);
    ledger.book(columns.fluid_mass, fluid);
    ledger.book(columns.min_porosity, smallest);
  }

#define KEDGE_INSTANTIATE(dim)                                                                       \
  template void   MixtureTerm<dim>::declare_books(Ledger &);                                         \
  template void   MixtureTerm<dim>::book(const Trial<dim> &, const Residual<dim> &, Ledger &) const; \
  template void   MixtureTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &) const;         \
  template double MixtureTerm<dim>::fluid_mass(const Soil &, const unsigned int) const;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
