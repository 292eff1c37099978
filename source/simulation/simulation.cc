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
    verify_checks<dim>(scene.checks, history_columns(), probe_names);

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
  HistoryColumns
  Simulation<dim>::history_columns() const
  {
    return {dim, false, scene.stabilisation.method == StabilisationKind::ghost};
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
    history       = std::make_unique<HistoryWriter>(folder, history_columns());
    probes        = std::make_unique<ProbeWriter<dim>>(folder, find_probes());
    points_output = std::make_unique<PointsOutput<dim>>(folder, scene.output);
    if (scene.output.grid)
      grid_output = std::make_unique<GridOutput<dim>>(folder);
    if (scene.newton.log && folder.is_root())
      newton_log = std::make_unique<CsvFile>(folder.path("newton.csv"),
                                             std::vector<std::string>{"step",
                                                                      "time",
                                                                      "accepted",
                                                                      "iteration",
                                                                      "residual",
                                                                      "correction"});

    engine.initialise_accelerations(clock.time());
    engine.write_books(row);
    row.time                = clock.time();
    totals.initial_energy   = row.total_energy();
    totals.next_output_time = clock.time();
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
    else if (time.step_kind != StepSizeKind::cfl_initial || clock.n_steps() == 0)
      clock.set_nominal_step(time.cfl_factor * engine.cfl_step(time.step_kind));
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
    clock.advance();
    totals.external_work += engine.work_of_last_step();
    totals.ghost_work += engine.ghost_work_of_last_step();

    row.step                 = clock.n_steps();
    row.time                 = clock.time();
    row.newton_iterations    = step.newton.iterations;
    row.linear_iterations    = step.newton.linear_iterations;
    row.rejected_attempts    = static_cast<unsigned int>(totals.rejected_pending);
    row.external_work        = totals.external_work;
    row.stabilisation_energy = totals.ghost_work;
    engine.write_books(row);
    row.energy_error = row.total_energy() + row.plastic_dissipation + row.stabilisation_energy -
                       totals.initial_energy - row.external_work;
    row.wall_time           = wall_time();
    totals.rejected_pending = 0;
    totals.points_times_steps += static_cast<double>(row.n_points) * step.newton.iterations;

    const double begin = MPI_Wtime();
    if (newton_log)
      for (unsigned int k = 0; k < step.newton.residual_norms.size(); ++k)
        {
          *newton_log << row.step << row.time << std::uint64_t(1) << std::uint64_t(k)
                      << step.newton.residual_norms[k]
                      << (k == 0 ? 0. : step.newton.correction_norms[k - 1]);
          newton_log->end_row();
        }
    history->write(row);
    write_probes();
    write_points(false);
    progress.report(row);
    output_seconds += MPI_Wtime() - begin;
  }



  template <int dim>
  bool
  Simulation<dim>::reject_step(const StepReport &step)
  {
    ++totals.rejected;
    ++totals.rejected_pending;
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
    if (finished && (scene.output.checkpoint_every_steps > 0))
      write_checkpoint();

    RunSummary summary;
    if (finished)
      summary.checks =
        evaluate_checks<dim>(scene.checks, folder, engine.points().records(), scene.constants);
    summary.versions            = software_versions();
    summary.scene               = scene.name;
    summary.title               = scene.title;
    summary.status              = status;
    summary.reason              = reason;
    summary.dim                 = dim;
    summary.n_ranks             = dealii::Utilities::MPI::n_mpi_processes(communicator);
    summary.counts              = {{"material_points", row.n_points},
                                   {"active_cells", row.n_active_cells},
                                   {"dofs", row.n_dofs}};
    summary.n_steps             = clock.n_steps();
    summary.n_newton_iterations = totals.newton;
    summary.n_linear_iterations = totals.linear;
    summary.n_rejected_attempts = totals.rejected;
    summary.wall_seconds        = wall_time();
    summary.cpu_seconds         = cpu_seconds(communicator);
    summary.phase_wall_seconds  = engine.phase_seconds();
    double in_steps             = 0.;
    for (const auto &phase : summary.phase_wall_seconds)
      in_steps += phase.second;
    summary.phase_wall_seconds["output"] = output_seconds;
    summary.peak_memory_bytes            = peak_memory(communicator);
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
