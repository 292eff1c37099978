#include <kedge/simulation/step_engine.h>

#include <set>

namespace kedge
{
  namespace
  {
    template <int dim>
    int
    radius_of(const Scene<dim> &scene)
    {
      if (scene.stabilisation.method == StabilisationKind::ghost)
        return 2; // a face couples the outer nodes of its two cells
      for (const auto &body : scene.bodies)
        if (body.basis != BasisKind::linear)
          return 2;
      return 1;
    }

    template <int dim>
    std::vector<bool>
    bodies_with_shared_volume(const Scene<dim> &scene)
    {
      std::vector<bool> result;
      for (const auto &body : scene.bodies)
        result.push_back(scene.materials[body.material].volume_change == VolumeChange::cell_mean);
      return result;
    }

    /** How far the points of a cell couple nodes, which is further than one point does. */
    template <int dim>
    int
    stiffness_radius_of(const Scene<dim> &scene)
    {
      for (const auto &body : scene.bodies)
        if (body.basis == BasisKind::gimp &&
            scene.materials[body.material].volume_change == VolumeChange::cell_mean)
          return 3;
      return radius_of(scene);
    }

    /** In saturated bodies the balance itself applies it, to a mass that changes. */
    template <int dim>
    std::vector<bool>
    bodies_with_body_force(const Scene<dim> &scene)
    {
      std::vector<bool> result;
      for (const auto &body : scene.bodies)
        result.push_back(body.body_force && !scene.pore_fluid);
      return result;
    }

    template <int dim>
    std::vector<Material>
    materials_of_bodies(const Scene<dim> &scene)
    {
      std::vector<Material> result;
      for (const auto &body : scene.bodies)
        result.push_back(make_material(scene.materials[body.material]));
      return result;
    }

    MemoryColumns
    columns_of_bodies(const std::vector<Material> &materials)
    {
      MemoryColumns result;
      for (const Material &material : materials)
        result.push_back(memory_indices(material));
      return result;
    }

    /** What the points of a scene have to remember. */
    template <int dim>
    PointLayout<dim>
    layout_of(const Scene<dim> &scene, const Scheme &scheme, const std::vector<Material> &materials)
    {
      AssertThrow(memory_columns().size() <= most_memory_columns, dealii::ExcInternalError());
      std::set<unsigned int> used;
      for (const auto &columns : columns_of_bodies(materials))
        used.insert(columns.begin(), columns.end());
      used.erase(not_in_memory);
      return PointLayout<dim>({used.begin(), used.end()},
                              std::any_of(materials.begin(),
                                          materials.end(),
                                          [](const Material &m) {
                                            return yields(m);
                                          }),
                              scene.pore_fluid.has_value(),
                              scheme.carries_acceleration);
    }

    /** What to change if bodies have too few points to hold their nodes; else empty. */
    template <int dim>
    std::string
    hint_on_points(const Scene<dim> &scene)
    {
      for (const auto &body : scene.bodies)
        for (const unsigned int n : body.points_per_cell)
          if (n < 2)
            return "; body '" + body.name +
                   "' has one material point per cell in some direction, which cannot hold all "
                   "motions of its nodes: take two or more (Points per cell), or damp them "
                   "(Mapping/Lumping > 0)";
      return "";
    }

    template <int dim>
    std::vector<std::string>
    names_of_bodies(const Scene<dim> &scene)
    {
      std::vector<std::string> result;
      for (const auto &body : scene.bodies)
        result.push_back(body.name);
      return result;
    }
  } // namespace



  template <int dim>
  StepEngine<dim>::StepEngine(const Scene<dim> &scene, const MPI_Comm communicator)
    : scene(scene)
    , communicator(communicator)
    , scheme(scene.time)
    , stencil_radius(radius_of(scene))
    , stiffness_radius(stiffness_radius_of(scene))
    , shared_volume(bodies_with_shared_volume(scene))
    , material_of_body(materials_of_bodies(scene))
    , columns_of_body(columns_of_bodies(material_of_body))
    , body_names(names_of_bodies(scene))
    , background(scene.grid, communicator)
    , cloud(layout_of(scene, scheme, material_of_body))
    , conditions(scene.node_conditions, scene.constants)
    , loads(scene.body_force,
            bodies_with_body_force(scene),
            scene.point_loads,
            scene.tractions,
            scene.constants)
    , surfaces(scene.surface_pressures, scene.constants)
    , fluxes(scene.surface_fluxes, scene.constants)
    , balance(make_balance())
  {
    for (const auto &body : scene.bodies)
      {
        basis_of_body.push_back(body.basis);
        modulus_of_body.push_back(scene.materials[body.material].young_modulus);
      }
  }



  template <int dim>
  void
  StepEngine<dim>::activate()
  {
    if (activated)
      return;
    {
      const Stopwatch stopwatch(phases["activation"]);
      find_nodes();
    }
    const Stopwatch stopwatch(phases["transfer"]);
    if (scheme.dynamic)
      {
        assemble_mass(step_points, background.window(), nodes, mass);
        blend_mass(scene.transfer.lumping, mass, nodes.n_local());
      }
    if (has_ghosts())
      assemble_ghosts();
    if (scheme.dynamic)
      mapping.reinit(background, nodes, conditions, ties, mapping_mass(), new_pattern);
    activated = true;
  }



  template <int dim>
  void
  StepEngine<dim>::find_nodes()
  {
    step_points.reinit(background, cloud, basis_of_body, columns_of_body, shared_volume);
    auto       reached  = step_points.reached_nodes(background.window());
    const bool has_ties = scene.stabilisation.method == StabilisationKind::aggregation;
    ties.find(background,
              step_points,
              has_ties ? scene.stabilisation.smallest_filling : 0.,
              reached,
              has_pores() && scene.pore_fluid->coarse_pressure);
    if (has_ghosts())
      ghosts.find(background, step_points, modulus_of_body, reached);
    const bool new_nodes = nodes.reinit(background, reached);
    new_pattern          = new_nodes || ties.changed();
    if (new_nodes)
      {
        conditions.reinit(background, nodes);
        if (scheme.dynamic)
          mass.reinit(nodes.n_local(), 1, stencil_radius);
      }
    if (new_pattern)
      ties.localise(nodes, conditions);
    balance->reinit(background,
                    nodes,
                    conditions,
                    ties,
                    step_points,
                    has_ghosts() ? ghosted_mass : mass,
                    has_ghosts() ? &ghost_terms : nullptr,
                    stiffness_radius,
                    new_pattern);
    if (porous != nullptr)
      {
        porous->read_pores(cloud);
        surfaces.reinit(cloud, step_points);
        fluxes.reinit(cloud, step_points);
      }
  }



  template <int dim>
  void
  StepEngine<dim>::assemble_ghosts()
  {
    const StabilisationParameters &factors = scene.stabilisation;
    const auto                     start   = [&](NodeMatrix<dim> &matrix) -> NodeMatrix<dim>                       &{
      if (new_pattern)
        matrix.reinit(nodes.n_local(), 1, stencil_radius);
      matrix.set_zero();
      return matrix;
    };
    ghosts.add_stiffness(background,
                         nodes,
                         factors.ghost_stiffness_factor,
                         start(ghost_terms.stiffness));
    if (has_pores())
      {
        const PoreFluidParameters &fluid = scene.pore_fluid->fluid;
        ghosts.add_gradient_penalty(background,
                                    nodes,
                                    factors.ghost_conductivity_factor *
                                      fluid.hydraulic_conductivity /
                                      (fluid.fluid_density * fluid.reference_gravity),
                                    start(ghost_terms.conductance));
        ghosts.add_value_penalty(background,
                                 nodes,
                                 factors.ghost_storage_factor / fluid.fluid_bulk_modulus,
                                 start(ghost_terms.storage));
        ghost_terms.has_storage = factors.ghost_storage_factor > 0.;
      }
    if (!scheme.dynamic)
      return;
    ghosts.add_mass(background, nodes, factors.ghost_mass_factor, start(ghost_terms.mass));
    ghosted_mass = mass;
    ghosts.add_mass(background, nodes, factors.ghost_mass_factor, ghosted_mass);
    ghosts_in_mapping = lumped_mass_ratio(nodes, mass) < badly_conditioned_mass;
  }



  template <int dim>
  StepReport
  StepEngine<dim>::try_step(const double t, const double dt)
  {
    StepReport report;
    step_t  = t;
    step_dt = dt;
    activate();

    {
      const Stopwatch    stopwatch(phases["transfer"]);
      const LinearStatus mapped = particle_to_grid(t, dt);
      if (!mapped.success)
        {
          report.hopeless = true;
          report.cause    = "the mass matrix cannot be solved: " + mapped.cause;
          return report;
        }
      apply_external_forces(scheme.load_time(t, dt));
      // u = 0 as in (3.184): the velocities of the points hold more than a smooth motion
      nodal.displacement.assign(std::size_t(nodes.n_local()) * dim, 0.);
    }

    balance->start(nodal, t, dt);
    report.newton = solve_newton(*balance, scene.newton);
    report.cause  = report.newton.cause;
    if (!report.newton.converged)
      {
        const std::string diagnosis = balance->diagnosis();
        if (!diagnosis.empty())
          report.cause += "; " + diagnosis;
        report.cause += hint_on_points(scene);
        return report;
      }

    const Stopwatch stopwatch(phases["history update"]);
    report.cause    = check_points();
    report.accepted = report.cause.empty();
    return report;
  }



  template <int dim>
  LinearStatus
  StepEngine<dim>::particle_to_grid(const double t, const double dt)
  {
    const std::size_t size = std::size_t(nodes.n_local()) * dim;
    nodal.velocity_n.assign(size, 0.);
    nodal.acceleration_n.assign(size, 0.);
    if (!scheme.dynamic)
      return {};

    const auto &window = background.window();
    if (conditions.any_moving())
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        for (int d = 0; d < dim; ++d)
          if (conditions.prescribed(i, d))
            nodal.velocity_n[std::size_t(i) * dim + d] =
              conditions.velocity(i, d, t, t + 1e-6 * dt);

    const auto project = [&](const std::vector<dealii::Tensor<1, dim>> &at_points,
                             std::vector<double>                       &at_nodes) {
      std::vector<double> momentum(size, 0.);
      add_to_nodes(step_points, window, nodes, step_points.mass, at_points, momentum);
      ties.restrict_sums(momentum);
      nodes.add_to_owners(momentum, dim);
      return mapping.solve(background, nodes, ties, mapping_mass(), momentum, at_nodes);
    };
    LinearStatus status = project(step_points.velocity, nodal.velocity_n);
    if (status.success && scheme.carries_acceleration)
      status = project(step_points.acceleration, nodal.acceleration_n);
    return status;
  }



  template <int dim>
  void
  StepEngine<dim>::apply_external_forces(const double t)
  {
    nodal.external_force.assign(std::size_t(nodes.n_local()) * dim, 0.);
    if (loads.empty() && surfaces.empty())
      return;
    loads.force(step_points, t, point_forces);
    surfaces.add_force(t, point_forces);
    const std::vector<double> ones(step_points.size(), 1.);
    add_to_nodes(step_points, background.window(), nodes, ones, point_forces, nodal.external_force);
    ties.restrict_sums(nodal.external_force);
    nodes.add_to_owners(nodal.external_force, dim);
  }



  template <int dim>
  std::string
  StepEngine<dim>::check_points()
  {
    const auto        &window = background.window();
    const unsigned int failed = evaluate_point_updates(material_of_body,
                                                       step_points,
                                                       window,
                                                       nodes,
                                                       nodal.displacement,
                                                       updates);
    interpolate_to_points(step_points, window, nodes, nodal.displacement, point_displacements);
    if (porous != nullptr)
      porous->evaluate_updates(pore_updates);

    std::ostringstream cause;
    if (failed != PointStatus::none)
      cause << "material point " << step_points.id[failed] << " at ("
            << step_points.location[failed] << ") has det F <= 0 at the end of the step";
    else
      for (unsigned int slot = 0; slot < step_points.size(); ++slot)
        {
          const auto x = step_points.location[slot] + point_displacements[slot];
          if (background.lattice().contains(x))
            continue;
          cause << "material point " << step_points.id[slot] << " leaves the background grid at ("
                << x << "), displaced by (" << point_displacements[slot]
                << ") in this step; enlarge the grid (Grid/Origin, Grid/Extent)";
          break;
        }
    const bool any = dealii::Utilities::MPI::logical_or(!cause.str().empty(), communicator);
    return any && cause.str().empty() ? "a material point of another rank cannot be updated"
                                      : cause.str();
  }



  template <int dim>
  double
  StepEngine<dim>::cfl_step(const StepSizeKind kind)
  {
    if (kind == StepSizeKind::cfl_initial)
      {
        double slowness = std::numeric_limits<double>::max();
        for (unsigned int b = 0; b < scene.bodies.size(); ++b)
          slowness = std::min(slowness,
                              std::sqrt(scene.materials[scene.bodies[b].material].density /
                                        p_wave_modulus(material_of_body[b])));
        return background.lattice().smallest_cell_size() * slowness;
      }
    activate();
    const bool          by_density = kind == StepSizeKind::cfl_density;
    std::vector<double> at_points(3 * std::size_t(step_points.size()));
    for (const auto &batch : step_points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          double volume = step_points.volume[slot];
          if (!by_density) // (3.128) sums the present volume
            volume *= step_points.determinant[slot];
          double *values = &at_points[3 * std::size_t(slot)];
          values[0]      = by_density ? step_points.mass[slot] /
                                     (step_points.volume[slot] * step_points.determinant[slot])
                                      : step_points.mass[slot];
          values[1]      = by_density ? 0. : volume;
          values[2]      = p_wave_modulus(material_of_body[batch.body]);
        }
    std::vector<double> at_nodes(3 * std::size_t(nodes.n_local()), 0.);
    add_scalars_to_nodes(step_points, background.window(), nodes, at_points, 3, at_nodes);
    nodes.add_to_owners(at_nodes, 3);
    double square = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        const double *s = &at_nodes[3 * std::size_t(i)];
        if (s[2] > 0.)
          square = std::min(square, s[0] / ((by_density ? 1. : s[1]) * s[2]));
      }
    square = dealii::Utilities::MPI::min(square, communicator);
    return background.lattice().smallest_cell_size() * std::sqrt(square);
  }



  template <int dim>
  std::map<std::string, PhaseTime>
  StepEngine<dim>::phase_times() const
  {
    auto result            = phases;
    result["residual"]     = balance->timings().residual;
    result["tangent"]      = balance->timings().tangent;
    result["linear solve"] = balance->timings().linear_solve;
    return result;
  }
} // namespace kedge

namespace kedge
{
  template class StepEngine<2>;
  template class StepEngine<3>;
} // namespace kedge
