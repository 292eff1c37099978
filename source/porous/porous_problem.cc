#include <kedge/porous/porous_problem.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  namespace
  {
    /** A tangent worse than this may be why Newton's method fails. */
    constexpr double suspicious_condition = 1e12;
  } // namespace



  template <int dim>
  PorousProblem<dim>::PorousProblem(const PorousForce<dim>         &force,
                                    const ExternalLoads<dim>       &loads,
                                    const SurfacePressures<dim>    &surfaces,
                                    const SurfaceFluxes<dim>       &fluxes,
                                    const PorousParameters         &pore_fluid,
                                    const Scheme                   &scheme,
                                    const LinearSolverParameters   &parameters,
                                    const std::vector<double>      &p_wave_modulus_of_body,
                                    const std::vector<std::string> &body_names)
    : Balance<dim>(dim + 1, suspicious_condition, parameters, {dim, false, false, true}, body_names)
    , porous_force(force)
    , loads(loads)
    , surfaces(surfaces)
    , fluxes(fluxes)
    , surface_penalty(pore_fluid.surface_penalty)
    , scheme(scheme)
    , modulus_of_body(p_wave_modulus_of_body)
    , modulus(*std::max_element(modulus_of_body.begin(), modulus_of_body.end()))
    , pressure_mapping(pore_fluid.pressure_map)
  {}



  template <int dim>
  void
  PorousProblem<dim>::read_pores(const MaterialPoints<dim> &cloud)
  {
    pores.reinit(cloud, *points, porous_force.scheme());
  }



  template <int dim>
  void
  PorousProblem<dim>::start(NodalState &state, const double t_n, const double dt)
  {
    this->begin_step(state, t_n, dt);
    weights[dim]       = modulus / grid->lattice().smallest_cell_size();
    blocks_have_values = false;
    unknowns.assign(std::size_t(nodes->n_local()) * (dim + 1), 0.);
    residual.resize(unknowns.size());
    outflow.resize(surfaces.pressures(t_n).size());
    acceleration.resize(scheme.dynamic ? std::size_t(nodes->n_local()) * dim : 0);
    pressure_mapping
      .map(*points, grid->window(), *nodes, *ties, pores.pressure, tangent.radius(), unknowns);
    set_supply();
    set_prescribed();
    if (ghosts != nullptr && ghosts->has_storage)
      project_pressure();
  }



  template <int dim>
  void
  PorousProblem<dim>::set_supply()
  {
    supply.assign(fluxes.empty() ? 0 : unknowns.size(), 0.);
    if (fluxes.empty())
      return;
    const double t = t_n + porous_force.scheme().theta * dt;
    fluxes.add_supply(*points, grid->window(), *nodes, t, dt, supply);
    ties->restrict_sums(supply, dim + 1);
    nodes->add_to_owners(supply, dim + 1);
  }



  template <int dim>
  void
  PorousProblem<dim>::set_prescribed()
  {
    const double theta = porous_force.scheme().theta;
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        double *x = &unknowns[std::size_t(i) * (dim + 1)];
        for (int d = 0; d < dim; ++d)
          if (conditions->prescribed(i, d))
            x[d] = conditions->increment(i, d, t_n, t_n + dt);
        if (conditions->pressure_prescribed(i))
          x[dim] = conditions->pressure(i, t_n + theta * dt);
      }
    ties->prolong(unknowns, dim + 1);
    copy_displacement();
  }



  template <int dim>
  void
  PorousProblem<dim>::copy_displacement()
  {
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      std::copy_n(&unknowns[std::size_t(i) * (dim + 1)],
                  dim,
                  &state->displacement[std::size_t(i) * dim]);
  }



  template <int dim>
  PorousTrial<dim>
  PorousProblem<dim>::trial_at(const std::vector<double> &accelerations,
                               const double               inertia,
                               const double               step,
                               const double               t_load,
                               const double               t_pressure) const
  {
    return {unknowns,
            accelerations,
            inertia,
            step,
            grid->lattice().smallest_cell_size(),
            loads.body_acceleration(t_load),
            surfaces.points(),
            surfaces.pressures(t_pressure),
            surface_penalty};
  }



  template <int dim>
  PorousTrial<dim>
  PorousProblem<dim>::trial() const
  {
    return trial_at(acceleration,
                    scheme.dynamic ? scheme.inertia_coefficient(dt) : 0.,
                    dt,
                    scheme.load_time(t_n, dt),
                    t_n + porous_force.scheme().theta * dt);
  }



  template <int dim>
  NewtonProblem::Evaluation
  PorousProblem<dim>::evaluate()
  {
    const Stopwatch stopwatch(timings_.residual);
    for (std::size_t k = 0; k < acceleration.size(); ++k)
      acceleration[k] = scheme.equilibrium_acceleration(state->displacement[k],
                                                        state->velocity_n[k],
                                                        state->acceleration_n[k],
                                                        dt);
    std::fill(residual.begin(), residual.end(), 0.);
    std::fill(outflow.begin(), outflow.end(), 0.);
    PorousSize        size;
    const PointStatus answer =
      porous_force
        .add_residual(*points, pores, grid->window(), *nodes, trial(), residual, outflow, size);
    if (ghosts != nullptr)
      add_ghosts(size);
    ties->restrict_sums(residual, dim + 1);
    nodes->add_to_owners(residual, dim + 1);
    double external = 0.;
    for (unsigned int i = 0; i < nodes->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double f = state->external_force[std::size_t(i) * dim + d];
          residual[std::size_t(i) * (dim + 1) + d] -= f;
          external += f * f;
        }

    for (std::size_t k = dim; k < supply.size() && k < std::size_t(nodes->n_owned()) * (dim + 1);
         k += dim + 1)
      {
        residual[k] -= supply[k];
        external += std::pow(weights[dim] * supply[k], 2);
      }

    double sums[5] = {0., size.momentum, size.fluid, external, answer.ok() ? 0. : 1.};
    for (unsigned int e = 0; e < equations.system().n_rows(); ++e)
      {
        const unsigned int k = equations.nodal_index(e);
        sums[0] += std::pow(weights[k % (dim + 1)] * residual[k], 2);
      }
    MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, nodes->communicator());

    NewtonProblem::Evaluation result = this->conclude(sums[0], sums[4], answer);
    result.scale = std::sqrt(sums[1]) + weights[dim] * std::sqrt(sums[2]) + std::sqrt(sums[3]);
    return result;
  }



  template <int dim>
  void
  PorousProblem<dim>::assemble_tangent()
  {
    const Stopwatch stopwatch(timings_.tangent);
    tangent.set_zero();
    porous_force.add_tangent(*points, pores, grid->window(), *nodes, trial(), tangent);
    if (ghosts != nullptr)
      add_ghosts_to_tangent();
    equations.fill(*nodes, tangent);
    if (linear_solver.choose(equations.system()) == LinearSolverKind::krylov_blocks)
      assemble_blocks();
  }



  /** At the first tangent of a step; the preconditioner needs no more. */
  template <int dim>
  void
  PorousProblem<dim>::assemble_blocks()
  {
    if (!blocks_have_pattern)
      blocks.reinit(*grid, *nodes, *ties, status, equations, tangent.radius());
    blocks_have_pattern = true;
    if (blocks_have_values)
      return;
    const double factor  = porous_force.scheme().content_factor();
    const double inertia = scheme.dynamic ? scheme.inertia_coefficient(dt) : 0.;
    blocks.assemble(*points,
                    grid->window(),
                    *nodes,
                    modulus_of_body,
                    factor / scheme.alpha_f,
                    inertia > 0. ? factor / inertia : 0.);
    blocks_have_values = true;
    linear_solver.set_blocks(blocks.blocks());
  }



  template <int dim>
  void
  PorousProblem<dim>::apply_correction(const double factor)
  {
    for (std::size_t k = 0; k < correction.size(); ++k)
      unknowns[k] += factor * correction[k];
    copy_displacement();
  }



  template <int dim>
  void
  PorousProblem<dim>::evaluate_updates(std::vector<PoreUpdate<dim>> &updates) const
  {
    porous_force.evaluate_updates(*points, pores, grid->window(), *nodes, trial(), updates);
  }



  template <int dim>
  FluidInflow
  PorousProblem<dim>::inflow() const
  {
    const PoreFluid &fluid  = porous_force.soils().front().fluid;
    double           sum[2] = {0., 0.};
    const auto       add    = [&](const double mass, const double pressure) {
      sum[0] += mass;
      // mu = K_f/rho_0 (1 - rho_0/rho_f), (4.112)
      sum[1] -= mass * fluid.bulk_modulus / fluid.reference_density *
                std::expm1(-pressure / fluid.bulk_modulus);
    };
    for (unsigned int i = 0; i < nodes->n_owned(); ++i)
      if (conditions->pressure_prescribed(i))
        {
          const std::size_t k = std::size_t(i) * (dim + 1) + dim;
          add(fluid.reference_density * residual[k], unknowns[k]);
        }
    for (std::size_t k = dim; k < supply.size() && k < std::size_t(nodes->n_owned()) * (dim + 1);
         k += dim + 1)
      add(fluid.reference_density * supply[k], unknowns[k]);
    const auto pressures = surfaces.pressures(t_n + porous_force.scheme().theta * dt);
    for (unsigned int s = 0; s < outflow.size(); ++s)
      add(-fluid.reference_density * outflow[s], pressures[s]);
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, nodes->communicator());
    return {sum[0], sum[1]};
  }



  template <int dim>
  std::vector<double>
  PorousProblem<dim>::unbalanced_force(const std::vector<double> &external_force, const double t)
  {
    unknowns.assign(std::size_t(nodes->n_local()) * (dim + 1), 0.);
    residual.assign(unknowns.size(), 0.);
    pressure_mapping
      .map(*points, grid->window(), *nodes, *ties, pores.pressure, tangent.radius(), unknowns);
    outflow.assign(surfaces.pressures(t).size(), 0.);
    const std::vector<double> at_rest;
    PorousSize                size;
    porous_force.add_residual(*points,
                              pores,
                              grid->window(),
                              *nodes,
                              trial_at(at_rest, 0., 1., t, t),
                              residual,
                              outflow,
                              size);
    ties->restrict_sums(residual, dim + 1);
    nodes->add_to_owners(residual, dim + 1);
    std::vector<double> forces(external_force);
    for (unsigned int i = 0; i < nodes->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        forces[std::size_t(i) * dim + d] -= residual[std::size_t(i) * (dim + 1) + d];
    return forces;
  }

  template class PorousProblem<2>;
  template class PorousProblem<3>;
} // namespace kedge
