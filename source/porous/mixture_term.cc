#include <kedge/porous/mixture_term.h>
#include <kedge/solid/point_failure.h>
#include <kedge/transfer/node_sums.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** A tangent worse than this may be why Newton's method fails. */
    constexpr double suspicious_condition = 1e12;
  } // namespace



  template <int dim>
  MixtureTerm<dim>::MixtureTerm(const unsigned int           field,
                                const Patch<dim>            &patch,
                                const SoilBodies            &bodies,
                                const ExternalLoads<dim>    &loads,
                                const SurfacePressures<dim> &surfaces,
                                const SurfaceFluxes<dim>    &fluxes,
                                const PorousParameters      &parameters,
                                const Scheme                &scheme,
                                const int                    radius)
    : field(field)
    , patch(patch)
    , bodies(bodies)
    , force(bodies.materials, bodies.soils)
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
  MixtureTerm<dim>::attach(std::vector<GeneratedPoint<dim>> &points)
  {
    saturate(bodies, patch, points);
    for (auto &point : points)
      if (patch.holds(static_cast<unsigned int>(point.record.state.body)))
        begin_motion(bodies, point.record.state);
    surfaces.attach(points, bodies.names);
    fluxes.attach(points, bodies.names);
  }



  template <int dim>
  void
  MixtureTerm<dim>::take_over(std::vector<PointRecord<dim>> &points) const
  {
    for (auto &point : points)
      if (patch.holds(static_cast<unsigned int>(point.state.body)))
        begin_motion(bodies, point.state);
  }



  template <int dim>
  void
  MixtureTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
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
  MixtureTerm<dim>::activate(const MaterialPoints<dim> &cloud)
  {
    points.reinit(cloud, patch.points);
    surfaces.reinit(cloud, patch);
    fluxes.reinit(cloud, patch);
    surfaces.valves.reinit(surfaces.one_way());
    prepared.activate(patch);
  }



  /** The fluctuation of the initial pore pressures, which the grid alone can tell. */
  template <int dim>
  void
  MixtureTerm<dim>::initialise(MaterialPoints<dim> &cloud)
  {
    const std::vector<double> fluctuation =
      fluctuations_of(bodies, patch, [](const PoreFluid &fluid, const double p) {
        return fluid.potential(p);
      });
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot != StepPoints<dim>::no_slot)
        state.pore_pressure_fluctuation = fluctuation[slot];
    });
  }



  template <int dim>
  void
  MixtureTerm<dim>::start(Trial<dim> &trial)
  {
    prepared.start();
    surfaces.valves.start();
    outflow.assign(surfaces.points().size(), {});
    pressure_mapping.map(patch, points.pressure, radius, trial.unknowns.fields[field]);
    set_supply(trial.times);
    if (!holds_any_node())
      translate(trial);
  }



  template <int dim>
  bool
  MixtureTerm<dim>::holds_any_node() const
  {
    bool any = false;
    for (unsigned int i = 0; i < patch.nodes.n_local() && !any; ++i)
      for (int d = 0; d < dim; ++d)
        any = any || patch.conditions.prescribed(i, d);
    return dealii::Utilities::MPI::logical_or(any, patch.nodes.communicator());
  }



  /**
   * What nothing holds begins with the mean velocity of its points: a first guess that a moving
   * frame does not change. The nodes' own velocities are no better guess, they hold more than a
   * smooth motion.
   */
  template <int dim>
  void
  MixtureTerm<dim>::translate(Trial<dim> &trial) const
  {
    std::vector<double> sums(dim + 1, 0.);
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      {
        sums[dim] += patch.points.mass[slot];
        for (int d = 0; d < dim; ++d)
          sums[d] += patch.points.mass[slot] * patch.points.velocity[slot][d];
      }
    dealii::Utilities::MPI::sum(sums, patch.nodes.communicator(), sums);
    std::vector<double> &unknowns = trial.unknowns.fields[field];
    for (std::size_t k = 0; k < unknowns.size() && sums[dim] > 0.; k += dim + 1)
      for (int d = 0; d < dim; ++d)
        unknowns[k + d] = trial.times.dt * sums[d] / sums[dim];
  }



  template <int dim>
  void
  MixtureTerm<dim>::set_supply(const StepTimes &times)
  {
    supply.assign(fluxes.empty() ? 0 : std::size_t(patch.nodes.n_local()) * (dim + 1), 0.);
    if (!fluxes.empty())
      fluxes.add_supply(patch, times.t_n + 0.5 * times.dt, times.dt, supply);
  }



  template <int dim>
  NodalPotential<dim>
  MixtureTerm<dim>::potential(const Trial<dim> &trial) const
  {
    return NodalPotential<dim>(patch,
                               bodies.soils.front().fluid,
                               trial.motion[field].velocity_n,
                               trial.times.dt);
  }



  template <int dim>
  MixtureField<dim>
  MixtureTerm<dim>::at_trial(const Trial<dim> &trial) const
  {
    const double        middle     = trial.times.t_n + 0.5 * trial.times.dt;
    std::vector<double> prescribed = surfaces.pressures(middle);
    for (double &p : prescribed)
      p = bodies.soils.front().fluid.potential(p);
    return {potential(trial).values(trial.unknowns.fields[field]),
            trial.motion[field].velocity_n,
            trial.times.dt,
            parameters.stabilisation_theta,
            patch.grid().lattice().smallest_cell_size(),
            loads.body_acceleration(middle),
            surfaces.points(),
            prescribed,
            surfaces.valves.flows(),
            parameters.surface_penalty};
  }



  /** What fluxes bring in moves with the nodes that it comes to. */
  template <int dim>
  void
  MixtureTerm<dim>::add_supply(const Trial<dim> &trial, std::vector<double> &sums) const
  {
    const double               density  = bodies.soils.front().fluid.reference_density;
    const double               dt       = trial.times.dt;
    const std::vector<double> &unknowns = trial.unknowns.fields[field];
    for (std::size_t k = 0; k < supply.size(); k += dim + 1)
      {
        for (int d = 0; d < dim; ++d)
          sums[k + d] -= density * supply[k + dim] * unknowns[k + d] / (dt * dt);
        sums[k + dim] -= supply[k + dim];
      }
  }



  template <int dim>
  Answer
  MixtureTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    std::fill(outflow.begin(), outflow.end(), MixtureOutflow());
    PorousSize           size;
    std::vector<double> &sums = residual.partial(field);
    const PointStatus    status =
      force.add_residual(patch, points, at_trial(trial), sums, outflow, size);
    add_supply(trial, sums);
    double supplied = 0.;
    for (std::size_t k = dim; k < supply.size(); k += dim + 1)
      supplied += supply[k] * supply[k];
    residual.add_square(size.momentum);
    residual.add_square(volume_weight * volume_weight * size.fluid);
    residual.add_square(volume_weight * volume_weight * supplied);
    if (status.ok())
      return {};
    std::vector<double> grains;
    for (const Soil &soil : bodies.soils)
      grains.push_back(soil.dry_storage > 0. ? 0. : 1. - soil.fluid.initial_porosity);
    return Answer::failure(
      describe_failure(patch,
                       status.failed_slot,
                       trial.displacement(field),
                       scheme.alpha_f,
                       grains,
                       status.has_stress ? "no finite pore pressure" : "no finite stress"));
  }



  /** The weight of the fluid; what it presses on adds up to nothing. */
  template <int dim>
  void
  MixtureTerm<dim>::add_residual_at_rest(const double t, Residual<dim> &residual)
  {
    const auto                          f = loads.body_acceleration(t);
    std::vector<dealii::Tensor<1, dim>> weights(patch.points.size());
    for (const auto &batch : patch.points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        for (int d = 0; d < dim && bodies.soils[batch.body].has_body_force; ++d)
          weights[slot][d] = -fluid_mass(bodies.soils[batch.body], slot) * f[d];
    std::vector<double>       at_nodes(std::size_t(patch.nodes.n_local()) * dim, 0.);
    const std::vector<double> ones(patch.points.size(), 1.);
    add_to_nodes(patch, ones, weights, at_nodes);
    std::vector<double> &sums = residual.partial(field);
    for (std::size_t i = 0; i < patch.nodes.n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        sums[i * (dim + 1) + d] += at_nodes[i * dim + d];
  }



  template <int dim>
  void
  MixtureTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    if (surfaces.has_one_way() && surfaces.valves.count_tangent())
      surfaces.valves.hold(open_outflow(trial));
    NodeMatrix<dim> &matrix = tangent.lattice(field);
    force.add_tangent(patch, points, at_trial(trial), matrix);
    potential(trial).change_columns(trial.unknowns.fields[field], matrix);
    const double       density = bodies.soils.front().fluid.reference_density, dt = trial.times.dt;
    const unsigned int here = matrix.slot(LatticeIndex<dim>{});
    for (unsigned int i = 0; i < supply.size() / (dim + 1); ++i)
      for (int d = 0; d < dim; ++d)
        matrix.row(i, d)[here * (dim + 1) + d] -=
          density * supply[std::size_t(i) * (dim + 1) + dim] / (dt * dt);
  }



  /** What would leave at each place of the surfaces if all seepage faces were open [kg]. */
  template <int dim>
  std::vector<double>
  MixtureTerm<dim>::open_outflow(const Trial<dim> &trial) const
  {
    MixtureField<dim>           at_open = at_trial(trial);
    std::vector<double>         sums(at_open.values.size(), 0.), result;
    std::vector<MixtureOutflow> through(at_open.surface.size());
    PorousSize                  size;
    std::fill(at_open.surface_flows.begin(), at_open.surface_flows.end(), SurfaceFlow::both_ways);
    force.add_residual(patch, points, at_open, sums, through, size);
    for (const MixtureOutflow &at : through)
      result.push_back(at.mass);
    return result;
  }



  template <int dim>
  bool
  MixtureTerm<dim>::refresh(const Trial<dim> &trial)
  {
    if (!surfaces.has_one_way() || !surfaces.valves.may_turn()) // all ranks alike
      return false;
    const bool again = surfaces.valves.hold(open_outflow(trial));
    return dealii::Utilities::MPI::logical_or(again, patch.nodes.communicator());
  }



  template <int dim>
  void
  MixtureTerm<dim>::prepare_solver(const Trial<dim>   &trial,
                                   const Tangent<dim> &tangent,
                                   LinearSolver       &solver)
  {
    const double inertia = scheme.inertia_coefficient(trial.times.dt);
    prepared.tell(patch,
                  tangent.equations(field),
                  tangent.lattice(field).radius(),
                  tangent.system(),
                  {modulus_of_body, 1. / scheme.alpha_f, 1. / inertia},
                  solver);
  }



  template <int dim>
  Answer
  MixtureTerm<dim>::finish(const Trial<dim> &trial)
  {
    force.evaluate_updates(patch, points, at_trial(trial), updates);
    if (parameters.velocity_filter > 0.)
      filter_velocities(trial);
    return {};
  }



  /**
   * Takes a part of what the fluid's velocity against the skeleton has beside that of the balance,
   * which changes sign from step to step where friction is stiff: as an impact between both in one
   * place, that keeps momenta and loses energy. Where it would not lose it is left out.
   */
  template <int dim>
  void
  MixtureTerm<dim>::filter_velocities(const Trial<dim> &trial)
  {
    const std::vector<double> &v_n    = trial.motion[field].velocity_n;
    std::vector<double>        change = trial.end_velocity(scheme, field);
    for (std::size_t k = 0; k < change.size(); ++k)
      change[k] -= v_n[k];
    std::vector<dealii::Tensor<1, dim>> at_points;
    interpolate_to_points(patch, change, at_points);
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      {
        MixtureUpdate<dim> &update   = updates[slot];
        const double        skeleton = patch.points.mass[slot], fluid = update.mass;
        const auto          relative =
          update.fluid_velocity - (patch.points.velocity[slot] + at_points[slot]);
        const auto   taken   = parameters.velocity_filter * (relative - update.relative);
        const double reduced = skeleton * fluid / (skeleton + fluid);
        const double loss =
          0.5 * reduced * (relative.norm_square() - (relative - taken).norm_square());
        if (!(loss > 0.))
          continue;
        update.filter_loss     = loss;
        update.skeleton_change = fluid / (skeleton + fluid) * taken;
        update.fluid_velocity -= skeleton / (skeleton + fluid) * taken;
      }
  }



  template <int dim>
  void
  MixtureTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &cloud)
  {
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      const unsigned int slot = patch.points.slot_of[number];
      if (slot != StepPoints<dim>::no_slot)
        apply_mixture_update(updates[slot], state);
    });
  }

  template class MixtureTerm<2>;
  template class MixtureTerm<3>;
} // namespace kedge
