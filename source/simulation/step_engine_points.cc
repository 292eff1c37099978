#include <kedge/base/exceptions.h>
#include <kedge/simulation/step_engine.h>
#include <kedge/solid/initial_history.h>
#include <kedge/solid/initial_stress.h>

namespace kedge
{
  template <int dim>
  void
  StepEngine<dim>::create_points()
  {
    std::vector<PointRecord<dim>> records = generate_records();
    covered                               = {};
    weights.clear();
    cover_points(records);
    // every rank made all points: only one may hand them out
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      records.clear();
    cloud.distribute(background, std::move(records));
    activated = false;
  }



  template <int dim>
  std::vector<PointRecord<dim>>
  StepEngine<dim>::generate_records()
  {
    GridParameters<dim> elements = scene.grid;
    elements.node_intervals      = 1;
    std::vector<GeneratedPoint<dim>> points;
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        auto of_body = generate_points(scene.bodies[b],
                                       b,
                                       scene.materials[scene.bodies[b].material].density,
                                       Lattice<dim>(elements),
                                       scene.constants,
                                       points.size());
        if (points.empty())
          points = std::move(of_body);
        else
          points.insert(points.end(), of_body.begin(), of_body.end());
      }
    std::vector<MaterialParameters> parameters;
    for (const auto &body : scene.bodies)
      parameters.push_back(scene.materials[body.material]);
    set_initial_history(parameters, scene.constants, points);
    set_initial_stress(scene.bodies, material_of_body, scene.constants, points);
    if (has_pores())
      saturate(points);
    loads.attach(points, body_names);
    surfaces.attach(points, body_names);
    fluxes.attach(points, body_names);

    generated = std::vector<PointOrigin<dim>>(points.begin(), points.end());
    check_overlaps();
    std::vector<PointRecord<dim>> records;
    records.reserve(points.size());
    for (const auto &point : points)
      records.push_back(point.record);
    return records;
  }



  template <int dim>
  void
  StepEngine<dim>::check_overlaps() const
  {
    for (const auto &point : generated)
      for (unsigned int b = 0; b < scene.bodies.size(); ++b)
        {
          if (b == point.body || !scene.bodies[b].geometry->contains(point.location))
            continue;
          std::ostringstream message;
          message << "Bodies '" << scene.bodies[point.body].name << "' and '"
                  << scene.bodies[b].name << "' overlap: a material point of the first, at ("
                  << point.location << "), lies in the second. Change Bodies/"
                  << scene.bodies[b].name << "/Geometry.";
          throw UserError(message.str());
        }
  }



  template <int dim>
  void
  StepEngine<dim>::cover_points(const std::vector<PointRecord<dim>> &records)
  {
    const auto       &lattice = background.lattice();
    LatticeIndex<dim> low, high;
    low.fill(std::numeric_limits<int>::max());
    high.fill(std::numeric_limits<int>::min());
    for (const auto &record : records)
      {
        const auto cell = lattice.cell_of(record.location);
        for (int d = 0; d < dim; ++d)
          {
            low[d]  = std::min(low[d], cell[d]);
            high[d] = std::max(high[d], cell[d]);
          }
      }
    MPI_Allreduce(MPI_IN_PLACE, low.data(), dim, MPI_INT, MPI_MIN, communicator);
    MPI_Allreduce(MPI_IN_PLACE, high.data(), dim, MPI_INT, MPI_MAX, communicator);

    covered.low = low;
    for (int d = 0; d < dim; ++d)
      covered.n_cells[d] = high[d] - low[d] + 1;
    weights.clear();
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        weights.assign(covered.n_cells_total(), 0);
        for (const auto &record : records)
          ++weights[covered.cell_number(lattice.cell_of(record.location))];
        MPI_Allreduce(MPI_IN_PLACE,
                      weights.data(),
                      static_cast<int>(weights.size()),
                      MPI_UNSIGNED,
                      MPI_SUM,
                      communicator);
      }
    cloud.clear();
    background.cover(covered, weights);
  }



  template <int dim>
  void
  StepEngine<dim>::restore_points(const std::vector<PointRecord<dim>> &records,
                                  const LatticeWindow<dim>            &covered_cells,
                                  const std::vector<unsigned int>     &covered_weights)
  {
    covered = covered_cells;
    weights = covered_weights;
    cloud.clear();
    background.cover(covered, weights);
    cloud.distribute(background, records);
    activated = false;
  }



  template <int dim>
  void
  StepEngine<dim>::replace_points(const std::vector<PointRecord<dim>> &records)
  {
    cover_points(records);
    cloud.distribute(background, records);
    activated = false;
  }



  template <int dim>
  void
  StepEngine<dim>::forget_generated_points()
  {
    generated.clear();
    generated.shrink_to_fit();
  }



  template <int dim>
  void
  StepEngine<dim>::follow_points()
  {
    bool close = false, outside = false;
    cloud.for_each([&](const unsigned int,
                       const std::uint64_t,
                       const dealii::Point<dim> &x,
                       const PointState<dim> &) {
      const auto cell = background.lattice().cell_of(x);
      close           = close || background.too_close_to_border(cell);
      outside         = outside || !background.window().contains_cell(cell);
    });
    if (dealii::Utilities::MPI::logical_or(close || outside, communicator))
      {
        replace_points(cloud.records());
        return;
      }
    const std::uint64_t missing = cloud.relocate(background);
    AssertThrow(missing == 0,
                dealii::ExcMessage(std::to_string(missing) +
                                   " material points were lost while they were sorted into "
                                   "the cells of the background grid."));
  }



  template <int dim>
  void
  StepEngine<dim>::map_velocities_back()
  {
    const auto         &window = background.window();
    const bool          flip   = scene.transfer.velocity_mapping == VelocityUpdate::flip;
    std::vector<double> v_end(nodal.displacement.size()), change(v_end.size()), a_end;
    for (std::size_t i = 0; i < v_end.size(); ++i)
      {
        v_end[i]  = scheme.end_velocity(nodal.displacement[i],
                                       nodal.velocity_n[i],
                                       nodal.acceleration_n[i],
                                       step_dt);
        change[i] = v_end[i] - nodal.velocity_n[i];
      }
    interpolate_to_points(step_points, window, nodes, flip ? change : v_end, velocity_changes);
    if (scheme.carries_acceleration)
      {
        a_end.resize(v_end.size());
        for (std::size_t i = 0; i < v_end.size(); ++i)
          a_end[i] = scheme.end_acceleration(nodal.displacement[i],
                                             nodal.velocity_n[i],
                                             nodal.acceleration_n[i],
                                             step_dt);
        interpolate_to_points(step_points, window, nodes, a_end, accelerations);
      }
    if (!scene.transfer.audit)
      return;
    auto velocities = velocity_changes;
    if (flip)
      for (unsigned int slot = 0; slot < step_points.size(); ++slot)
        velocities[slot] += step_points.velocity[slot];
    audit = audit_transfer(background,
                           nodes,
                           step_points,
                           velocities,
                           mass,
                           scene.transfer.lumping,
                           scene.transfer.velocity_mapping,
                           nodal.velocity_n,
                           v_end,
                           nodal.displacement);
  }



  template <int dim>
  void
  StepEngine<dim>::accept_step()
  {
    const Stopwatch stopwatch(phases["history update"]);
    double          work = 0.;
    if (!loads.empty() || !surfaces.empty())
      {
        // over the step a load does the work of its value in the middle
        loads.force(step_points, step_t + 0.5 * step_dt, point_forces);
        surfaces.add_force(step_t + 0.5 * step_dt, point_forces);
        for (unsigned int slot = 0; slot < step_points.size(); ++slot)
          work += point_forces[slot] * point_displacements[slot];
      }
    step_work = dealii::Utilities::MPI::sum(work, communicator);
    if (conditions.any_moving())
      step_work += balance->reaction_work();
    if (porous != nullptr)
      add_pore_work();
    if (has_ghosts())
      ghost_work = work_against_ghosts() + (porous != nullptr ? porous->work_against_ghosts() : 0.);
    if (std::any_of(scene.node_conditions.begin(),
                    scene.node_conditions.end(),
                    [](const auto &condition) {
                      return condition.reaction;
                    }))
      reactions = balance->reactions();

    if (scheme.dynamic)
      map_velocities_back();
    std::vector<dealii::Tensor<2, dim>> deformation_gradients(step_points.size());
    cloud.update_each(
      [&](const unsigned int number, dealii::Point<dim> &location, PointState<dim> &state) {
        const unsigned int slot = step_points.slot_of[number];
        location += point_displacements[slot];
        state.displacement += point_displacements[slot];
        apply_point_update(updates[slot],
                           columns_of_body[static_cast<unsigned int>(state.body)],
                           state);
        deformation_gradients[number] = state.deformation_gradient;
        if (porous != nullptr)
          apply_pore_update(pore_updates[slot], state);
        if (scheme.dynamic)
          update_velocities(slot, state);
      });
    const auto stretches = stretches_along_axes(deformation_gradients);
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      for (int d = 0; d < dim; ++d)
        state.half_lengths[d] = state.reference_half_lengths[d] * stretches[number][d];
    });
    follow_points();
    activated = false;
  }



  template <int dim>
  double
  StepEngine<dim>::work_against_ghosts() const
  {
    // u . (M_G a_m + alpha_f K_G u) - v_n . M_G dv, the last only if M_G is in the mapping
    const std::vector<double> &u = nodal.displacement;
    std::vector<double>        product(u.size()), acceleration(u.size()), change(u.size());
    double                     work = 0.;
    multiply(ghost_terms.stiffness, background.window(), nodes, dim, u, product);
    for (std::size_t i = 0; i < u.size(); ++i)
      work += scheme.alpha_f * u[i] * product[i];
    if (scheme.dynamic)
      {
        for (std::size_t i = 0; i < u.size(); ++i)
          {
            const double v_n = nodal.velocity_n[i], a_n = nodal.acceleration_n[i];
            acceleration[i] = scheme.equilibrium_acceleration(u[i], v_n, a_n, step_dt);
            change[i]       = scheme.end_velocity(u[i], v_n, a_n, step_dt) - v_n;
          }
        multiply(ghost_terms.mass, background.window(), nodes, dim, acceleration, product);
        for (std::size_t i = 0; i < u.size(); ++i)
          work += u[i] * product[i];
        multiply(ghost_terms.mass, background.window(), nodes, dim, change, product);
        for (std::size_t i = 0; i < u.size() && ghosts_in_mapping; ++i)
          work -= nodal.velocity_n[i] * product[i];
      }
    return dealii::Utilities::MPI::sum(work, communicator);
  }



  template <int dim>
  void
  StepEngine<dim>::initialise_points(const double t)
  {
    if (porous != nullptr && scene.equilibrium.steps == 0) // else the stage has left them
      initialise_fluctuations();
    if (scheme.carries_acceleration)
      initialise_accelerations(t);
  }



  template <int dim>
  void
  StepEngine<dim>::initialise_accelerations(const double t)
  {
    activate();
    apply_external_forces(t);
    const std::size_t   size = std::size_t(nodes.n_local()) * dim;
    std::vector<double> at_nodes(size, 0.), force(size, 0.);
    if (porous != nullptr)
      force = porous->unbalanced_force(nodal.external_force, t);
    else
      {
        const std::vector<double> at_rest(size, 0.);
        std::vector<double>       internal(size, 0.);
        InternalForce<dim>(material_of_body, StressRule::at_configuration, 1.)
          .add_force(step_points, background.window(), nodes, at_rest, internal);
        ties.restrict_sums(internal);
        nodes.add_to_owners(internal, dim);
        for (std::size_t i = 0; i < size; ++i)
          force[i] = nodal.external_force[i] - internal[i];
      }
    const LinearStatus status =
      mapping.solve(background, nodes, ties, mapping_mass(), force, at_nodes);
    AssertThrow(status.success, dealii::ExcMessage("mass matrix: " + status.cause));
    interpolate_to_points(step_points, background.window(), nodes, at_nodes, accelerations);
    cloud.update_each([&](const unsigned int number, dealii::Point<dim> &, PointState<dim> &state) {
      state.acceleration = accelerations[step_points.slot_of[number]];
    });
    activated = false;
  }



  template <int dim>
  void
  StepEngine<dim>::update_velocities(const unsigned int slot, PointState<dim> &state) const
  {
    if (scene.transfer.velocity_mapping == VelocityUpdate::flip)
      state.velocity += velocity_changes[slot];
    else
      state.velocity = velocity_changes[slot];
    if (scheme.carries_acceleration)
      state.acceleration = accelerations[slot];
  }



  template <int dim>
  void
  StepEngine<dim>::write_books(HistoryRow &row)
  {
    activate();
    // sums in the order of the slots, which does not depend on how the run got here
    enum
    {
      kinetic,
      strain,
      hardening,
      dissipation,
      mass_sum,
      linear,
      angular = linear + 3,
      n_sums  = angular + 3
    };
    double sums[n_sums] = {}, min_det = std::numeric_limits<double>::max();
    std::vector<std::array<double, 3>> energy(step_points.size());
    cloud.for_each([&](const unsigned int number,
                       const std::uint64_t,
                       const dealii::Point<dim> &,
                       const PointState<dim> &state) {
      const double V0                     = state.reference_volume;
      energy[step_points.slot_of[number]] = {
        {V0 * state.strain_energy, V0 * state.hardening_energy, V0 * state.plastic_dissipation}};
    });
    for (unsigned int slot = 0; slot < step_points.size(); ++slot)
      {
        const double m    = step_points.mass[slot];
        double       x[3] = {0, 0, 0}, p[3] = {0, 0, 0};
        for (int d = 0; d < dim; ++d)
          {
            x[d] = step_points.location[slot][d];
            p[d] = m * step_points.velocity[slot][d];
            sums[linear + d] += p[d];
          }
        sums[kinetic] += 0.5 * m * step_points.velocity[slot].norm_square();
        for (int e = 0; e < 3; ++e)
          sums[strain + e] += energy[slot][e];
        sums[mass_sum] += m;
        sums[angular + 0] += x[1] * p[2] - x[2] * p[1];
        sums[angular + 1] += x[2] * p[0] - x[0] * p[2];
        sums[angular + 2] += x[0] * p[1] - x[1] * p[0];
        min_det = std::min(min_det, step_points.determinant[slot]);
      }
    MPI_Allreduce(MPI_IN_PLACE, sums, n_sums, MPI_DOUBLE, MPI_SUM, communicator);
    row.kinetic_energy      = sums[kinetic];
    row.strain_energy       = sums[strain];
    row.hardening_energy    = sums[hardening];
    row.plastic_dissipation = sums[dissipation];
    row.mass                = sums[mass_sum];
    for (int d = 0; d < 3; ++d)
      {
        row.linear_momentum[d]  = sums[linear + d];
        row.angular_momentum[d] = sums[angular + d];
      }
    row.min_det_F      = dealii::Utilities::MPI::min(min_det, communicator);
    row.n_points       = cloud.n_global();
    row.n_active_cells = dealii::Utilities::MPI::sum(step_points.n_cells, communicator);
    row.n_dofs         = balance->n_equations();
    if (porous != nullptr)
      write_pore_books(row);
  }

  template class StepEngine<2>;
  template class StepEngine<3>;
} // namespace kedge
