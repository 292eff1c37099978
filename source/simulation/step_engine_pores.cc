#include <kedge/simulation/step_engine.h>

namespace kedge
{
  template <int dim>
  std::vector<Soil>
  StepEngine<dim>::soils_of_bodies() const
  {
    std::vector<Soil> result;
    for (const auto &body : scene.bodies)
      {
        const MaterialParameters &material = scene.materials[body.material];
        const double              G = 0.5 * material.young_modulus / (1. + material.poisson_ratio);
        PoreFluidParameters       fluid = scene.pore_fluid->fluid;
        fluid.initial_porosity          = material.initial_porosity;
        result.push_back({PoreFluid(fluid),
                          material.density,
                          0.5 * scene.pore_fluid->stabilisation / G,
                          body.body_force});
      }
    return result;
  }



  template <int dim>
  std::unique_ptr<Balance<dim>>
  StepEngine<dim>::make_balance()
  {
    if (!has_pores())
      return std::make_unique<SolidProblem<dim>>(
        InternalForce<dim>(material_of_body,
                           scheme.conserving_stress ? StressRule::conserving
                                                    : StressRule::at_configuration,
                           scheme.alpha_f),
        scheme,
        scene.linear_solver,
        body_names);
    std::vector<double> moduli;
    for (const Material &material : material_of_body)
      moduli.push_back(p_wave_modulus(material));
    auto problem = std::make_unique<PorousProblem<dim>>(
      PorousForce<dim>(material_of_body, soils_of_bodies(), scheme.alpha_f, PoreScheme(scene.time)),
      loads,
      surfaces,
      fluxes,
      *scene.pore_fluid,
      scheme,
      scene.linear_solver,
      moduli,
      body_names);
    porous = problem.get();
    return problem;
  }



  template <int dim>
  void
  StepEngine<dim>::saturate(std::vector<GeneratedPoint<dim>> &points) const
  {
    const std::vector<Soil> soils = soils_of_bodies();
    std::vector<Expression> pressure;
    for (const auto &body : scene.bodies)
      pressure.emplace_back(body.initial_pore_pressure,
                            std::vector<std::string>{"x", "y", "z"},
                            scene.constants);
    for (auto &point : points)
      {
        PointState<dim> &state = point.record.state;
        const auto       body  = static_cast<unsigned int>(state.body);
        const PoreFluid &fluid = soils[body].fluid;
        double           x[3]  = {0, 0, 0};
        for (int d = 0; d < dim; ++d)
          x[d] = point.record.location[d];
        state.pore_pressure = pressure[body](x);
        state.porosity      = fluid.initial_porosity;
        // mass is that of grains without pores up to here
        state.mass = (1. - state.porosity) * state.mass +
                     state.porosity * fluid.density(state.pore_pressure) * state.reference_volume;
      }
  }



  template <int dim>
  void
  StepEngine<dim>::initialise_fluctuations()
  {
    activate();
    std::vector<double> fluctuation(step_points.size());
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        const Expression    pressure(scene.bodies[b].initial_pore_pressure,
                                  {"x", "y", "z"},
                                  scene.constants);
        std::vector<double> at_nodes(nodes.n_local());
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          {
            const auto x = background.lattice().node_position(
              background.window().node_index(nodes.window_node(i)));
            double v[3] = {0, 0, 0};
            for (int d = 0; d < dim; ++d)
              v[d] = x[d];
            at_nodes[i] = pressure(v);
          }
        const auto of_body =
          PorousForce<dim>::fluctuations(step_points, background.window(), nodes, at_nodes);
        for (const auto &batch : step_points.batches)
          if (batch.body == b)
            std::copy(of_body.begin() + batch.begin,
                      of_body.begin() + batch.end,
                      fluctuation.begin() + batch.begin);
      }
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      state.pore_pressure_fluctuation = fluctuation[step_points.slot_of[number]];
    });
    activated = false;
  }



  /**
   * Adds to the work of the step what the body force does on the mixture, f - a
   * on the flow and the fluid that is pressed in, so that
   *   d(kinetic + skeleton's + fluid's energy) + dissipation = work.
   */
  template <int dim>
  void
  StepEngine<dim>::add_pore_work()
  {
    double       sums[4] = {0., 0., 0., 0.}; // work, Darcy, stabilisation, known part of the inflow
    const auto   f       = loads.body_acceleration(step_t + 0.5 * step_dt);
    const auto  &soils   = porous->force().soils();
    const double factor  = porous->force().scheme().content_factor();
    for (const auto &batch : step_points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          const PoreUpdate<dim> &update = pore_updates[slot];
          const double           mass   = 0.5 * (step_points.mass[slot] + update.mass);
          for (int d = 0; d < dim && soils[batch.body].has_body_force; ++d)
            sums[0] += mass * f[d] * point_displacements[slot][d];
          sums[0] += update.flow_work;
          sums[1] += update.darcy_dissipation;
          sums[2] += update.stabilisation_work;
          sums[3] += update.known_inflow;
        }
    MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, communicator);
    const FluidInflow inflow     = porous->inflow();
    pore_books.inflow            = (inflow.mass - sums[3]) / factor;
    pore_books.darcy_dissipation = sums[1];
    pore_books.stabilisation     = sums[2];
    step_work += sums[0] + inflow.work;
  }



  template <int dim>
  void
  StepEngine<dim>::write_pore_books(HistoryRow &row) const
  {
    const auto         &soils = porous->force().soils();
    std::vector<double> energies(step_points.size()), fluid_masses(step_points.size());
    double              smallest = std::numeric_limits<double>::max();
    cloud.for_each([&](const unsigned int number,
                       const std::uint64_t,
                       const dealii::Point<dim> &,
                       const PointState<dim> &state) {
      const unsigned int slot  = step_points.slot_of[number];
      const PoreFluid   &fluid = soils[static_cast<unsigned int>(state.body)].fluid;
      fluid_masses[slot]       = fluid.density(state.pore_pressure) * state.porosity *
                           determinant(state.deformation_gradient) * state.reference_volume;
      smallest       = std::min(smallest, state.porosity);
      energies[slot] = fluid_masses[slot] * fluid.energy(state.pore_pressure);
    });
    double sums[3] = {0., 0., 0.};
    for (unsigned int slot = 0; slot < step_points.size(); ++slot)
      {
        sums[0] += step_points.mass[slot] - fluid_masses[slot];
        sums[1] += fluid_masses[slot];
        sums[2] += energies[slot];
      }
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, communicator);
    row.solid_mass   = sums[0];
    row.fluid_mass   = sums[1];
    row.fluid_energy = sums[2];
    row.min_porosity = dealii::Utilities::MPI::min(smallest, communicator);
  }

  template class StepEngine<2>;
  template class StepEngine<3>;
} // namespace kedge
