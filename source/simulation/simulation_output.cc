#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/points/volume_report.h>
#include <kedge/simulation/simulation.h>

namespace kedge
{
  namespace
  {
    /**
     * What must agree between a checkpoint and the scene that resumes it: all
     * parameters but those of output, the end of the run, and what one changes
     * to go on after a stop at the step floor.
     */
    std::string
    physics_of(const std::string &parameters)
    {
      std::istringstream lines(parameters);
      std::string        line, result;
      bool               in_output = false;
      while (std::getline(lines, line))
        {
          const auto first = line.find_first_not_of(' ');
          if (first == std::string::npos || line[first] == '#')
            continue;
          const std::string word = line.substr(first);
          if (word == "subsection Output" || word == "subsection Checks")
            in_output = true;
          bool may_change = in_output;
          for (const char *name : {"End", "Title", "Step", "Smallest step factor", "Iterations"})
            may_change = may_change || word.rfind("set " + std::string(name) + " ", 0) == 0;
          if (!may_change)
            result += word + "\n";
          if (in_output && first == 0 && word == "end")
            in_output = false;
        }
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<Probe>
  Simulation<dim>::find_probes() const
  {
    std::vector<Probe> result;
    for (const auto &parameters : scene.probes)
      {
        Probe                   probe{parameters.name, {}};
        double                  nearest       = std::numeric_limits<double>::max();
        const PointOrigin<dim> *nearest_point = nullptr;
        for (const auto &point : engine.generated_points())
          {
            if (!parameters.body.empty() && scene.bodies[point.body].name != parameters.body)
              continue;
            if (parameters.face_mean)
              {
                if ((point.exposed_sides >> parameters.side) & 1u)
                  probe.points.emplace_back(point.id,
                                            point.volume /
                                              (2. * point.half_lengths[parameters.side / 2]));
                continue;
              }
            const double distance = point.location.distance_square(parameters.place);
            if (distance < nearest)
              {
                nearest       = distance;
                nearest_point = &point;
                probe.points  = {{point.id, 1.}};
              }
          }
        if (nearest_point != nullptr)
          check_nearness<dim>("Probe '" + parameters.name + "'",
                              parameters.place,
                              nearest_point->location,
                              nearest_point->half_lengths);
        result.push_back(std::move(probe));
      }
    return result;
  }



  template <int dim>
  void
  Simulation<dim>::write_probes()
  {
    if (probes->empty())
      return;
    probes->begin();
    engine.points().for_each([&](const unsigned int,
                                 const std::uint64_t       id,
                                 const dealii::Point<dim> &location,
                                 const PointState<dim>    &state) {
      if (probes->tracks(id))
        probes->add({id, location, state});
    });
    probes->end_row(clock.time());
  }



  template <int dim>
  void
  Simulation<dim>::write_points(const bool force)
  {
    const OutputParameters &output  = scene.output;
    const bool              enabled = output.points_interval > 0. || output.points_every_steps > 0;
    bool                    due     = force;
    if (output.points_every_steps > 0 && clock.n_steps() % output.points_every_steps == 0)
      due = true;
    const double tolerance = 1e-9 * output.points_interval;
    if (output.points_interval > 0. && clock.time() >= totals.next_output_time - tolerance)
      due = true;
    if (!enabled || !due || (!output.vtu && !output.hdf5))
      return;
    while (output.points_interval > 0. && totals.next_output_time <= clock.time() + tolerance)
      totals.next_output_time += output.points_interval;
    if (last_points_step && *last_points_step == clock.n_steps())
      return;
    last_points_step = clock.n_steps();
    points_output->write(clock.time(), engine.points().records());
    write_grid();
  }



  template <int dim>
  void
  Simulation<dim>::write_grid()
  {
    if (!grid_output)
      return;
    engine.activate();
    const auto       &nodes = engine.active_nodes();
    const auto       &grid  = engine.grid();
    GridSnapshot<dim> snapshot;
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      snapshot.nodes.push_back(
        grid.lattice().node_position(grid.window().node_index(nodes.window_node(i))));
    for (unsigned int c = 0; c < grid.window().n_cells_total(); ++c)
      {
        const auto                           cell = grid.window().cell_index(c);
        std::array<unsigned int, (1 << dim)> vertices;
        bool                                 complete = true;
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            auto node = cell;
            for (int d = 0; d < dim; ++d)
              node[d] += (v >> d) & 1u;
            const int local = nodes.local(grid.window().node_number(node));
            complete        = complete && local >= 0;
            vertices[v]     = static_cast<unsigned int>(local);
          }
        if (complete)
          snapshot.cells.push_back(vertices);
      }
    grid_output->write(clock.time(), snapshot);
  }



  template <int dim>
  void
  Simulation<dim>::write_checkpoint_if_due()
  {
    const OutputParameters &output = scene.output;
    bool                    due =
      output.checkpoint_every_steps > 0 && clock.n_steps() % output.checkpoint_every_steps == 0;
    if (!due && output.checkpoint_interval > 0.)
      due = dealii::Utilities::MPI::logical_or(wall_time() - last_checkpoint_wall >
                                                 output.checkpoint_interval,
                                               communicator);
    if (due)
      write_checkpoint();
  }



  template <int dim>
  void
  Simulation<dim>::write_checkpoint()
  {
    if (last_checkpoint_step == clock.n_steps())
      return;
    points_output->flush();
    if (grid_output)
      grid_output->flush();
    CheckpointData<dim> data;
    data.scene_fingerprint = fingerprint(physics_of(scene.parameters));
    data.n_ranks           = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const auto state       = clock.state();
    data.scalars           = {{"time", state.time},
                              {"nominal_step", state.nominal},
                              {"external_work", totals.external_work},
                              {"stabilisation_energy", totals.ghost_work},
                              {"fluid_inflow", totals.fluid_inflow},
                              {"darcy_dissipation", totals.darcy_dissipation},
                              {"initial_energy", totals.initial_energy},
                              {"initial_fluid_mass", totals.initial_fluid_mass},
                              {"wall_time", wall_time()},
                              {"points_times_steps", totals.points_times_steps},
                              {"next_output_time", totals.next_output_time}};
    data.counters          = {{"steps", state.n_steps},
                              {"cuts", state.cuts},
                              {"accepted_since_cut", state.accepted_since_cut},
                              {"newton", totals.newton},
                              {"linear", totals.linear},
                              {"rejected", totals.rejected},
                              {"rejected_pending", totals.rejected_pending},
                              {"history_position", history->position()},
                              {"probes_position", probes->position()},
                              {"newton_position", newton_log ? newton_log->position() : 0},
                              {"audit_position", audit_writer ? audit_writer->position() : 0},
                              {"points_written", points_output->n_written()},
                              {"last_points_step", last_points_step.value_or(0)},
                              {"grid_written", grid_output ? grid_output->n_written() : 0}};
    auto &window           = data.arrays["covered_cells"];
    for (int d = 0; d < dim; ++d)
      {
        window.push_back(engine.covered_cells().low[d]);
        window.push_back(engine.covered_cells().n_cells[d]);
      }
    data.arrays["covered_weights"].assign(engine.covered_weights().begin(),
                                          engine.covered_weights().end());
    data.points = engine.points().records();
    checkpoints.write(data);
    last_checkpoint_wall = wall_time();
    last_checkpoint_step = clock.n_steps();
  }



  template <int dim>
  void
  Simulation<dim>::resume()
  {
    const CheckpointData<dim> data =
      checkpoints.read_latest(fingerprint(physics_of(scene.parameters)));
    LatticeWindow<dim> covered;
    const auto        &window = data.arrays.at("covered_cells");
    for (int d = 0; d < dim; ++d)
      {
        covered.low[d]     = static_cast<int>(window[2 * d]);
        covered.n_cells[d] = static_cast<int>(window[2 * d + 1]);
      }
    const auto                     &weights = data.arrays.at("covered_weights");
    const std::vector<unsigned int> counts(weights.begin(), weights.end());
    engine.restore_points(data.points, covered, counts);

    clock.restore({data.scalars.at("time"),
                   data.scalars.at("nominal_step"),
                   data.counters.at("steps"),
                   data.counters.at("cuts"),
                   data.counters.at("accepted_since_cut")});
    totals.external_work      = data.scalars.at("external_work");
    totals.ghost_work         = data.scalars.at("stabilisation_energy");
    totals.fluid_inflow       = data.scalars.at("fluid_inflow");
    totals.darcy_dissipation  = data.scalars.at("darcy_dissipation");
    totals.initial_energy     = data.scalars.at("initial_energy");
    totals.initial_fluid_mass = data.scalars.at("initial_fluid_mass");
    totals.wall_before        = data.scalars.at("wall_time");
    totals.points_times_steps = data.scalars.at("points_times_steps");
    totals.next_output_time   = data.scalars.at("next_output_time");
    totals.newton             = data.counters.at("newton");
    totals.linear             = data.counters.at("linear");
    totals.rejected           = data.counters.at("rejected");
    totals.rejected_pending   = data.counters.at("rejected_pending");
    last_checkpoint_step      = clock.n_steps();
    last_checkpoint_wall      = wall_time();

    const auto n_points_written = static_cast<unsigned int>(data.counters.at("points_written"));
    if (n_points_written > 0)
      last_points_step = data.counters.at("last_points_step");
    history =
      std::make_unique<HistoryWriter>(folder, columns(), data.counters.at("history_position"));
    probes        = std::make_unique<ProbeWriter<dim>>(folder,
                                                find_probes(),
                                                data.counters.at("probes_position"),
                                                engine.has_pores());
    points_output = std::make_unique<PointsOutput<dim>>(folder, scene.output, n_points_written);
    if (scene.newton.log)
      newton_log = std::make_unique<NewtonLog>(folder, data.counters.at("newton_position"));
    if (engine.audits_transfer())
      audit_writer = std::make_unique<AuditWriter<dim>>(folder, data.counters.at("audit_position"));
    if (scene.output.grid)
      grid_output = std::make_unique<GridOutput<dim>>(folder,
                                                      static_cast<unsigned int>(
                                                        data.counters.at("grid_written")));
    row.step                 = clock.n_steps();
    row.time                 = clock.time();
    row.external_work        = totals.external_work;
    row.stabilisation_energy = totals.ghost_work;
    row.fluid_inflow         = totals.fluid_inflow;
    row.darcy_dissipation    = totals.darcy_dissipation;
    engine.write_books(row);
    folder.log() << "kedge: goes on at t = " << clock.time() << " s, step " << clock.n_steps()
                 << std::endl;
  }



  template <int dim>
  void
  validate_scene(const Scene<dim> &scene, std::ostream &out, const MPI_Comm communicator)
  {
    StepEngine<dim> engine(scene, communicator);
    engine.create_points();
    HistoryRow row;
    engine.write_books(row);
    const double step = scene.time.step_kind == StepSizeKind::fixed
                          ? scene.time.step
                          : scene.time.cfl_factor * engine.cfl_step(scene.time.step_kind);

    std::vector<std::uint64_t> points_of_body(scene.bodies.size(), 0);
    for (const auto &point : engine.generated_points())
      ++points_of_body[point.body];
    const double memory = peak_memory(communicator);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    out << "scene:            " << (scene.title.empty() ? scene.name : scene.title) << "\n";
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      out << "body:             " << scene.bodies[b].name << ", " << points_of_body[b]
          << " material points of " << scene.materials[scene.bodies[b].material].name << "\n";
    for (const auto &name : idle_node_conditions(scene.node_conditions,
                                                 scene.constants,
                                                 engine.grid().lattice(),
                                                 engine.generated_points()))
      out << "note:             Node conditions/" << name
          << " holds no node of a cell with material points\n";
    write_volumes(out, scene.bodies, engine.grid().lattice(), engine.generated_points());
    // a block row of the tangent reaches 3^dim nodes, 5^dim with GIMP
    const double per_point = sizeof(PointRecord<dim>) + sizeof(Stencil<dim>) +
                             sizeof(StressState<dim>) + sizeof(PointUpdate<dim>) + 200.;
    const double per_dof = 8. * dim * std::pow(5., dim) * 3.;
    out << "material points:  " << row.n_points << "\n"
        << "active cells:     " << row.n_active_cells << "\n"
        << "unknowns:         " << row.n_dofs << "\n"
        << "mass:             " << row.mass << (dim == 2 ? " kg/m" : " kg") << "\n"
        << "first time step:  " << step << " s\n"
        << "estimated memory: "
        << std::ceil((memory + per_point * static_cast<double>(row.n_points) +
                      per_dof * static_cast<double>(row.n_dofs)) /
                     1e6)
        << " MB" << std::endl;
  }

  template class Simulation<2>;
  template class Simulation<3>;
  template void
  validate_scene(const Scene<2> &, std::ostream &, const MPI_Comm);
  template void
  validate_scene(const Scene<3> &, std::ostream &, const MPI_Comm);
} // namespace kedge
