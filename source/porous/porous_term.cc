#include <kedge/porous/porous_term.h>
#include <kedge/solid/load_columns.h>
#include <kedge/solid/point_failure.h>

namespace kedge
{
  namespace
  {
    /** A tangent worse than this may be why Newton's method fails. */
    constexpr double suspicious_condition = 1e12;
  } // namespace



  template <int dim>
  PorousTerm<dim>::PorousTerm(const unsigned int           field,
                              const Patch<dim>            &patch,
                              const SoilBodies            &bodies,
                              const ExternalLoads<dim>    &loads,
                              const SurfacePressures<dim> &surfaces,
                              const SurfaceFluxes<dim>    &fluxes,
                              const PorousParameters      &parameters,
                              const Scheme                &scheme,
                              const PoreScheme            &pore_scheme,
                              const int                    radius)
    : field(field)
    , patch(patch)
    , bodies(bodies)
    , porous_force(bodies.materials, bodies.soils, scheme.alpha_f, pore_scheme)
    , loads(loads)
    , surfaces(surfaces)
    , fluxes(fluxes)
    , parameters(parameters)
    , scheme(scheme)
    , radius(radius)
    , pressure_mapping(parameters.pressure_map)
  {
    for (const Material &material : bodies.materials)
      modulus_of_body.push_back(p_wave_modulus(material));
  }



  template <int dim>
  void
  PorousTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    saturate(bodies, patch, points);
    surfaces.attach(points, bodies.names);
    fluxes.attach(points, bodies.names);
  }



  template <int dim>
  void
  PorousTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    auto &of_field = unknowns.fields[field];
    volume_weight  = *std::max_element(modulus_of_body.begin(), modulus_of_body.end()) /
                    patch.grid().lattice().smallest_cell_size();
    of_field.n_components     = dim + 1;
    of_field.weight[dim]      = volume_weight;
    of_field.measure_diagonal = true; // a body that hardly moves has no stress to measure
    // blocks are known of a single field alone
    unknowns.traits.mixed         = unknowns.fields.size() == 1;
    unknowns.suspicious_condition = suspicious_condition;
  }



  template <int dim>
  void
  PorousTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section            = Ledger::Section;
    using Kind               = Ledger::Kind;
    using Role               = Ledger::Role;
    const std::string energy = "energy", fluid = "fluid";
    if (parameters.stabilisation > 0.)
      columns.stabilisation = ledger.declare(
        {"stabilisation_energy", "J", Section::energy, Kind::total, Role::lost, energy});
    columns.fluid_energy =
      ledger.declare({"fluid_energy", "J", Section::energy, Kind::present, Role::stored, energy});
    columns.darcy =
      ledger.declare({"darcy_dissipation", "J", Section::energy, Kind::total, Role::lost, energy});
    columns.work = ledger.declare(external_work);
    if (scheme.dynamic)
      columns.neglected = ledger.declare(
        {"neglected_inertia_work", "J", Section::work, Kind::total, Role::supplied, energy});
    columns.solid_mass = ledger.declare({"solid_mass", "kg", Section::content});
    columns.fluid_mass =
      ledger.declare({"fluid_mass", "kg", Section::content, Kind::present, Role::stored, fluid});
    columns.inflow =
      ledger.declare({"fluid_inflow", "kg", Section::content, Kind::total, Role::supplied, fluid});
    ledger.declare_error("fluid_error", "kg", Section::content, fluid);
    columns.min_porosity = ledger.declare({"min_porosity", "", Section::content, Kind::lowest});
  }



  template <int dim>
  void
  PorousTerm<dim>::activate(const MaterialPoints<dim> &cloud)
  {
    pores.reinit(cloud, patch.points, porous_force.scheme());
    surfaces.reinit(cloud, patch);
    fluxes.reinit(cloud, patch);
    surfaces.valves.reinit(surfaces.one_way());
    prepared.activate(patch);
  }



  /** The fluctuation of the initial pore pressures, which the grid alone can tell. */
  template <int dim>
  void
  PorousTerm<dim>::initialise(MaterialPoints<dim> &cloud)
  {
    const std::vector<double> fluctuation =
      fluctuations_of(bodies, patch, [](const PoreFluid &, const double p) {
        return p;
      });
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot != StepPoints<dim>::no_slot)
        state.pore_pressure_fluctuation = fluctuation[slot];
    });
  }



  /** Time at which pressures and fluxes act: the scheme's theta on the way through the step. */
  template <int dim>
  double
  PorousTerm<dim>::pressure_time(const StepTimes &times) const
  {
    return times.t_n + porous_force.scheme().theta * times.dt;
  }



  template <int dim>
  void
  PorousTerm<dim>::start(Trial<dim> &trial)
  {
    prepared.start();
    surfaces.valves.start();
    outflow.assign(surfaces.points().size(), 0.);
    pressure_mapping.map(patch, pores.pressure, radius, trial.unknowns.fields[field]);
    set_supply(trial.times);
  }



  template <int dim>
  void
  PorousTerm<dim>::set_supply(const StepTimes &times)
  {
    supply_share.assign(fluxes.empty() ? 0 : std::size_t(patch.nodes.n_local()) * (dim + 1), 0.);
    if (!fluxes.empty())
      fluxes.add_supply(patch, pressure_time(times), times.dt, supply_share);
    supply = supply_share;
    if (fluxes.empty())
      return;
    patch.constraints.restrict_sums(supply);
    patch.nodes.add_to_owners(supply, dim + 1);
  }



  template <int dim>
  PorousTrial<dim>
  PorousTerm<dim>::at(const std::vector<double> &unknowns,
                      const std::vector<double> &accelerations,
                      const double               inertia,
                      const double               step,
                      const double               t_load,
                      const double               t_pressure) const
  {
    return {unknowns,
            accelerations,
            inertia,
            step,
            patch.grid().lattice().smallest_cell_size(),
            loads.body_acceleration(t_load),
            surfaces.points(),
            surfaces.pressures(t_pressure),
            surfaces.valves.flows(),
            parameters.surface_penalty};
  }



  template <int dim>
  PorousTrial<dim>
  PorousTerm<dim>::at_trial(const Trial<dim> &trial) const
  {
    const StepTimes &times = trial.times;
    return at(trial.unknowns.fields[field],
              trial.motion[field].acceleration,
              scheme.inertia_coefficient(times.dt),
              times.dt,
              scheme.load_time(times.t_n, times.dt),
              pressure_time(times));
  }



  template <int dim>
  Answer
  PorousTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    std::fill(outflow.begin(), outflow.end(), 0.);
    PorousSize           size;
    std::vector<double> &sums = residual.partial(field);
    const PointStatus    status =
      porous_force.add_residual(patch, pores, at_trial(trial), sums, outflow, size);
    double supplied = 0.;
    for (std::size_t k = dim; k < supply.size(); k += dim + 1)
      {
        sums[k] -= supply_share[k];
        if (k < std::size_t(patch.nodes.n_owned()) * (dim + 1))
          supplied += supply[k] * supply[k];
      }
    residual.add_square(size.momentum);
    residual.add_square(volume_weight * volume_weight * size.fluid);
    residual.add_square(volume_weight * volume_weight * supplied);
    return status.ok() ? Answer()
                       : Answer::failure(describe_failure(patch,
                                                          status.failed_slot,
                                                          trial.displacement(field),
                                                          scheme.alpha_f,
                                                          {},
                                                          "no finite stress"));
  }



  template <int dim>
  void
  PorousTerm<dim>::add_residual_at_rest(const double t, Residual<dim> &residual)
  {
    std::vector<double> &sums = residual.partial(field);
    std::vector<double>  unknowns(sums.size(), 0.);
    pressure_mapping.map(patch, pores.pressure, radius, unknowns);
    outflow.assign(surfaces.points().size(), 0.);
    const std::vector<double> at_rest;
    PorousSize                size;
    porous_force
      .add_residual(patch, pores, at(unknowns, at_rest, 0., 1., t, t), sums, outflow, size);
  }



  template <int dim>
  void
  PorousTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    if (surfaces.has_one_way() && surfaces.valves.count_tangent())
      surfaces.valves.hold(open_outflow(trial));
    porous_force.add_tangent(patch, pores, at_trial(trial), tangent.lattice(field));
  }



  /** What would leave at each place of the surfaces if all seepage faces were open [m^3]. */
  template <int dim>
  std::vector<double>
  PorousTerm<dim>::open_outflow(const Trial<dim> &trial) const
  {
    PorousTrial<dim>    at_open = at_trial(trial);
    std::vector<double> sums(at_open.unknowns.size(), 0.), result(at_open.surface.size());
    PorousSize          size;
    std::fill(at_open.surface_flows.begin(), at_open.surface_flows.end(), SurfaceFlow::both_ways);
    porous_force.add_residual(patch, pores, at_open, sums, result, size);
    return result;
  }



  template <int dim>
  bool
  PorousTerm<dim>::refresh(const Trial<dim> &trial)
  {
    if (!surfaces.has_one_way() || !surfaces.valves.may_turn()) // all ranks alike
      return false;
    const bool again = surfaces.valves.hold(open_outflow(trial));
    return dealii::Utilities::MPI::logical_or(again, patch.nodes.communicator());
  }



  /** At the first tangent of a step; the preconditioner needs no more. */
  template <int dim>
  void
  PorousTerm<dim>::prepare_solver(const Trial<dim>   &trial,
                                  const Tangent<dim> &tangent,
                                  LinearSolver       &solver)
  {
    const double factor  = porous_force.scheme().content_factor();
    const double inertia = scheme.inertia_coefficient(trial.times.dt);
    prepared.tell(patch,
                  tangent.equations(field),
                  tangent.lattice(field).radius(),
                  tangent.system(),
                  {modulus_of_body, factor / scheme.alpha_f, inertia > 0. ? factor / inertia : 0.},
                  solver);
  }



  template <int dim>
  Answer
  PorousTerm<dim>::finish(const Trial<dim> &trial)
  {
    porous_force.evaluate_updates(patch, pores, at_trial(trial), updates);
    return {};
  }



  template <int dim>
  void
  PorousTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &cloud)
  {
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot != StepPoints<dim>::no_slot)
        apply_pore_update(updates[slot], state);
    });
  }

  template class PorousTerm<2>;
  template class PorousTerm<3>;
} // namespace kedge
