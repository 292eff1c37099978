#include <kedge/simulation/equilibrium.h>
#include <kedge/simulation/simulation.h>

#include <kedge/io/checks.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/versions.h>

#include <iomanip>

namespace kedge
{
  template <int dim>
  Simulation<dim>::Simulation(const Scene<dim> &scene,
                              const RunOptions &options,
                              const MPI_Comm    communicator)
    : scene(scene)
    , options(options)
    , communicator(communicator)
    , wall_start(MPI_Wtime())
    , folder(options.output,
             options.resume ? RunFolder::Mode::resume : RunFolder::Mode::fresh,
             communicator)
    , engine(scene, communicator)
    , clock(scene.time)
    , checkpoints(folder)
    , progress(folder, scene.output.progress_interval, scene.time.start, scene.time.end)
  {
    std::vector<std::string> probe_names;
    for (const auto &probe : scene.probes)
      probe_names.push_back(probe.name);
    verify_checks<dim>(scene.checks, columns().names(), probe_names, engine.has_pores());

    engine.create_points();
    if (options.resume)
      resume();
    else
      start_fresh();
    engine.forget_generated_points();
    run_on_root(communicator, [&] {
      replace_file(folder.path("parameters.prm"), scene.parameters);
    });
  }



  template <int dim>
  double
  Simulation<dim>::wall_time() const
  {
    return totals.wall_before + MPI_Wtime() - wall_start;
  }



  template <int dim>
  void
  Simulation<dim>::start_fresh()
  {
    history       = std::make_unique<HistoryWriter>(folder, columns());
    probes        = std::make_unique<ProbeWriter<dim>>(folder,
                                                find_probes(),
                                                std::optional<std::uint64_t>(),
                                                engine.has_pores());
    points_output = std::make_unique<PointsOutput<dim>>(folder, scene.output);
    if (scene.output.grid)
      grid_output = std::make_unique<GridOutput<dim>>(folder);
    if (scene.newton.log)
      newton_log = std::make_unique<NewtonLog>(folder);
    if (engine.audits_transfer())
      audit_writer = std::make_unique<AuditWriter<dim>>(folder);

    if (scene.equilibrium.steps > 0)
      engine.replace_points(points_in_equilibrium(scene, communicator));
    engine.initialise_points(clock.time());
    engine.write_books(row);
    row.time                  = clock.time();
    row.time_step             = 0.;
    row.wall_time             = wall_time();
    totals.initial_energy     = row.total_energy();
    totals.initial_fluid_mass = row.fluid_mass;
    totals.next_output_time   = clock.time();
    history->write(row);
    folder.log() << "kedge: " << (scene.title.empty() ? scene.name : scene.title) << "\n  "
                 << row.n_points << " material points in " << row.n_active_cells << " cells, "
                 << row.n_dofs << " unknowns, "
                 << dealii::Utilities::MPI::n_mpi_processes(communicator) << " process(es)"
                 << std::endl;
    write_points(true);
    write_grid();
  }



  template <int dim>
  void
  Simulation<dim>::set_step()
  {
    const TimeParameters &time = scene.time;
    if (time.step_kind == StepSizeKind::fixed)
      clock.set_nominal_step(time.step);
    else
      clock.set_nominal_step(time.cfl_factor * engine.cfl_step(time.step_kind));
  }



  template <int dim>
  HistoryColumns
  Simulation<dim>::columns() const
  {
    HistoryColumns columns = {dim,
                              engine.has_plasticity(),
                              engine.has_stabilisation(),
                              engine.has_pores(),
                              {}};
    for (const auto &condition : scene.node_conditions)
      if (condition.reaction)
        for (int d = 0; d < dim; ++d)
          columns.reactions.push_back("reaction_" + condition.name + "_" + "xyz"[d]);
    return columns;
  }



  template <int dim>
  std::vector<double>
  Simulation<dim>::reactions() const
  {
    std::vector<double> result;
    for (unsigned int c = 0; c < scene.node_conditions.size(); ++c)
      if (scene.node_conditions[c].reaction)
        for (int d = 0; d < dim; ++d)
          result.push_back(engine.reactions_of_last_step()[c * dim + d]);
    return result;
  }



  template <int dim>
  ExitCode
  Simulation<dim>::run()
  {
    const StopSignals signals(communicator);
    while (!clock.finished())
      {
        set_step();
        const StepReport step = engine.try_step(clock.time(), clock.step_size());
        totals.newton += step.newton.iterations;
        totals.linear += step.newton.linear_iterations;
        if (!step.accepted)
          {
            if (!reject_step(step))
              return finish("numerical_stop", step.cause);
            continue;
          }
        finish_step(step);
        if (!watch_porosity())
          {
            write_checkpoint();
            return finish("numerical_stop", "a material point has lost its pores");
          }
        if (signals.stop_requested())
          {
            write_checkpoint();
            return finish("interrupted", "a signal asked for it");
          }
        write_checkpoint_if_due();
      }
    return finish("finished", "");
  }



  template <int dim>
  void
  Simulation<dim>::finish_step(const StepReport &step)
  {
    row.time_step = clock.step_size();
    engine.accept_step();
    clock.advance(step.newton.iterations);
    totals.external_work += engine.work_of_last_step();
    totals.ghost_work += engine.ghost_work_of_last_step();
    const PoreBooks &pores = engine.pore_books_of_last_step();
    totals.ghost_work += pores.stabilisation;
    totals.fluid_inflow += pores.inflow;
    totals.darcy_dissipation += pores.darcy_dissipation;

    row.step                 = clock.n_steps();
    row.time                 = clock.time();
    row.newton_iterations    = step.newton.iterations;
    row.linear_iterations    = step.newton.linear_iterations;
    row.rejected_attempts    = static_cast<unsigned int>(totals.rejected_pending);
    row.external_work        = totals.external_work;
    row.stabilisation_energy = totals.ghost_work;
    row.fluid_inflow         = totals.fluid_inflow;
    row.darcy_dissipation    = totals.darcy_dissipation;
    row.reactions            = reactions();
    engine.write_books(row);
    row.energy_error = row.total_energy() + row.plastic_dissipation + row.darcy_dissipation +
                       row.stabilisation_energy - totals.initial_energy - row.external_work;
    row.fluid_error         = row.fluid_mass - totals.initial_fluid_mass - row.fluid_inflow;
    row.wall_time           = wall_time();
    totals.rejected_pending = 0;
    totals.points_times_steps += static_cast<double>(row.n_points) * step.newton.iterations;

    const Stopwatch stopwatch(output_time);
    if (newton_log)
      newton_log->write(row.step, row.time, true, step.newton);
    if (audit_writer)
      audit_writer->write(row.step, row.time, *engine.transfer_audit());
    history->write(row);
    write_probes();
    write_points(false);
    progress.report(row);
  }



  template <int dim>
  bool
  Simulation<dim>::watch_porosity()
  {
    if (!scene.pore_fluid || row.min_porosity > 0.)
      return true;
    if (!porosity_is_lost)
      folder.log() << "  the porosity of a material point has fallen to " << row.min_porosity
                   << " at t = " << row.time << " s, step " << row.step
                   << ": its grains would overlap, which this skeleton does not see; from here on "
                      "the answer is not one of a soil (Pore fluid/Lost porosity)"
                   << std::endl;
    porosity_is_lost = true;
    return scene.pore_fluid->fluid.porosity_watch == PorosityWatch::warn;
  }



  template <int dim>
  bool
  Simulation<dim>::reject_step(const StepReport &step)
  {
    ++totals.rejected;
    ++totals.rejected_pending;
    if (newton_log)
      newton_log->write(clock.n_steps() + 1, clock.next_time(), false, step.newton);
    const double size = clock.step_size();
    const bool   cut  = !step.hopeless && clock.cut_step();
    folder.log() << "  step of " << size << " s at t = " << clock.time()
                 << " s rejected: " << step.cause
                 << (cut ? "; trying half of it"
                         : (step.hopeless ? "" : "; the step is at its floor"))
                 << std::endl;
    return cut;
  }



  template <int dim>
  ExitCode
  Simulation<dim>::finish(const std::string &status, const std::string &reason)
  {
    const bool finished = status == "finished";
    progress.finish(row);
    if (finished)
      write_points(true);
    if (status == "numerical_stop" || (finished && scene.output.checkpoint_every_steps > 0))
      write_checkpoint();

    RunSummary summary;
    if (finished)
      summary.checks =
        evaluate_checks<dim>(scene.checks, folder, engine.points().records(), scene.constants);
    summary.versions                   = software_versions();
    summary.scene                      = scene.name;
    summary.title                      = scene.title;
    summary.status                     = status;
    summary.reason                     = reason;
    summary.dim                        = dim;
    summary.n_ranks                    = dealii::Utilities::MPI::n_mpi_processes(communicator);
    summary.counts                     = {{"material_points", row.n_points},
                                          {"active_cells", row.n_active_cells},
                                          {"dofs", row.n_dofs}};
    summary.n_steps                    = clock.n_steps();
    summary.n_newton_iterations        = totals.newton;
    summary.n_linear_iterations        = totals.linear;
    summary.n_rejected_attempts        = totals.rejected;
    summary.largest_condition_estimate = engine.largest_condition();
    summary.wall_seconds               = wall_time();
    summary.cpu_seconds                = cpu_seconds(communicator);
    auto   phases                      = engine.phase_times();
    double in_steps                    = 0.;
    for (const auto &phase : phases)
      in_steps += phase.second.wall;
    phases["output"] = output_time;
    for (const auto &[name, time] : phases)
      {
        summary.phase_wall_seconds[name] = time.wall;
        summary.phase_cpu_seconds[name]  = dealii::Utilities::MPI::sum(time.cpu, communicator);
      }
    summary.peak_memory_bytes = peak_memory(communicator);
    if (in_steps > 0.)
      summary.point_updates_per_second = totals.points_times_steps / in_steps;
    summary.final_row = row;
    write_summary(folder, summary);

    std::ostream &log = folder.log();
    if (finished)
      {
        print_checks(summary.checks, log);
        log << "kedge: finished at t = " << clock.time() << " s after " << clock.n_steps()
            << " steps, " << totals.newton << " Newton iterations, " << std::setprecision(3)
            << wall_time() << " s" << std::setprecision(6) << std::endl;
        for (const auto &check : summary.checks)
          if (!check.pass && options.strict)
            return ExitCode::numerical_stop;
        return ExitCode::finished;
      }
    log << "kedge: stopped at t = " << clock.time() << " s: " << reason << std::endl;
    return status == "interrupted" ? ExitCode::interrupted : ExitCode::numerical_stop;
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace kedge
