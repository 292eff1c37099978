#include <kedge/simulation/attachments.h>
#include <kedge/simulation/equilibrium.h>
#include <kedge/simulation/run.h>

#include <kedge/io/checks.h>
#include <kedge/io/collective.h>
#include <kedge/io/command_name.h>
#include <kedge/io/files.h>
#include <kedge/io/versions.h>

#include <iomanip>

namespace kedge
{
  template <int dim>
  Run<dim>::Run(const Scene<dim> &scene, const RunOptions &options, const MPI_Comm communicator)
    : options(options)
    , communicator(communicator)
    , wall_start(MPI_Wtime())
    , folder(options.output,
             options.resume ? RunFolder::Mode::resume : RunFolder::Mode::fresh,
             communicator)
    , model(scene, communicator)
    , step(model)
    , clock(scene.time)
    , checkpoints(folder)
    , log(folder, scene)
    , supports(model)
    , limit(scene.time.failure_displacement)
  {
    std::vector<std::string> probe_names;
    for (const auto &probe : scene.probes)
      probe_names.push_back(probe.name);
    verify_checks<dim>(scene.checks,
                       history_columns(model.ledger.columns()),
                       probe_names,
                       scene.pore_fluid.has_value());

    if (scene.output.hit_output_times)
      clock.set_output_times(scene.time.start, scene.output.points_interval);
    model.create_points();
    if (options.resume)
      resume();
    else
      start_fresh();
    model.forget_generated_points();
    run_on_root(communicator, [&] {
      replace_file(folder.path("parameters.prm"), scene.parameters);
    });
  }



  template <int dim>
  double
  Run<dim>::wall_time() const
  {
    return counts.wall_before + MPI_Wtime() - wall_start;
  }



  template <int dim>
  void
  Run<dim>::start_fresh()
  {
    output = std::make_unique<RunOutput<dim>>(model, step, folder, nullptr);
    folder.log() << "kedge: " << (model.scene.title.empty() ? model.scene.name : model.scene.title)
                 << std::endl;
    const bool            has_stage = model.scene.equilibrium.steps > 0;
    EquilibriumState<dim> stage;
    if (has_stage)
      {
        stage = find_equilibrium(model.scene, communicator, folder.log());
        for (const auto &term : model.terms)
          term->take_over(stage.points);
        model.points.replace(std::move(stage.points));
        for (auto &term : model.terms)
          term->restore(stage.terms);
        step.points_changed();
      }
    step.initialise_points(clock.time(), has_stage);
    step.book_state();
    model.ledger.set_start();
    row.time_step = 0.;
    fill_row();
    const auto columns = model.ledger.columns();
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (const auto force = stage.forces.find(columns[k].name); force != stage.forces.end())
        row.books[k] = force->second;
    std::string bad = bad_number(clock.time());
    if (bad.empty())
      bad = output->write_start(row);
    if (!bad.empty())
      throw UserError("At the start " + bad + ".");
    folder.log() << "  " << row.n_points << " material points in "
                 << static_cast<std::uint64_t>(model.ledger.value("n_active_cells")) << " cells, "
                 << static_cast<std::uint64_t>(model.ledger.value("n_dofs")) << " unknowns, "
                 << dealii::Utilities::MPI::n_mpi_processes(communicator) << " process(es)"
                 << std::endl;
    describe_attachments(model, step, folder.log());
    for (const std::string &note : options.notes)
      folder.log() << "  note: " << note << std::endl;
    output->write_first_pictures(clock);
  }



  template <int dim>
  void
  Run<dim>::set_step()
  {
    const TimeParameters &time = model.scene.time;
    if (time.step_kind == StepSizeKind::fixed)
      clock.set_nominal_step(time.step);
    else
      clock.set_nominal_step(time.cfl_factor * cfl_step(model, step, time.step_kind));
  }



  template <int dim>
  RunEnd
  Run<dim>::run()
  {
    const StopSignals     signals(communicator);
    std::optional<RunEnd> end;
    while (!end)
      end = advance([&]() {
        return signals.stop_requested();
      });
    return *end;
  }



  template <int dim>
  std::optional<RunEnd>
  Run<dim>::advance(const std::function<bool()> &stop_requested)
  {
    bool accepted = false;
    while (!accepted && !clock.finished())
      {
        set_step();
        const StepReport report = step.attempt({clock.time(), clock.step_size()}, stop_requested);
        if (report.interrupted)
          {
            write_checkpoint();
            return finish("interrupted", "a signal asked for it");
          }
        counts.newton += report.newton.iterations;
        counts.linear += report.newton.linear_iterations;
        accepted = report.accepted;
        if (!accepted)
          {
            if (reject_step(report))
              continue;
            return end_without_equilibrium(report);
          }
        if (const std::string bad = finish_step(report); !bad.empty())
          {
            state_is_good = false;
            return finish("numerical_stop", bad);
          }
        if (limit.has_failed())
          return finish("finished", "a limit load: " + limit.growth());
        if (!watch_porosity())
          {
            write_checkpoint();
            return finish("numerical_stop", "a material point has lost its pores");
          }
        if (const std::string lost = watch_supports(); !lost.empty())
          {
            write_checkpoint();
            return finish("numerical_stop", lost);
          }
        if (stop_requested())
          {
            write_checkpoint();
            return finish("interrupted", "a signal asked for it");
          }
        write_checkpoint_if_due();
      }
    if (accepted)
      return {};
    return finish("finished", "");
  }



  template <int dim>
  std::string
  Run<dim>::bad_number(const double begin) const
  {
    const auto columns = model.ledger.columns();
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (!std::isfinite(row.books[k]))
        {
          const std::string loads = log.bad_loads(begin, row.time);
          return columns[k].name + " is " + exact_text(row.books[k]) +
                 (loads.empty() ? "" : "; " + loads);
        }
    return "";
  }



  template <int dim>
  std::string
  Run<dim>::finish_step(const StepReport &report)
  {
    const double begin = clock.time();
    row.time_step      = clock.step_size();
    step.commit();
    watch_limit();
    clock.advance(report.newton.iterations);
    row.newton_iterations = report.newton.iterations;
    row.linear_iterations = report.newton.linear_iterations;
    row.rejected_attempts = static_cast<unsigned int>(counts.rejected_pending);
    fill_row();
    log.outflow(model.ledger.value_or("outflow_points", 0.), clock.time());
    counts.rejected_pending = 0;
    counts.points_times_steps += static_cast<double>(row.n_points) * report.newton.iterations;

    std::string bad = bad_number(begin);
    if (bad.empty())
      bad = output->write_step(row, report.newton);
    if (!bad.empty())
      return bad + ", after step " + std::to_string(row.step);
    output->write_points(clock, false);
    log.accepted(row, wall_time());
    return "";
  }



  /** The books as they stand, of the step that the clock shows. */
  template <int dim>
  void
  Run<dim>::fill_row()
  {
    row.step      = clock.n_steps();
    row.time      = clock.time();
    row.books     = model.ledger.values();
    row.n_points  = static_cast<std::uint64_t>(model.ledger.value("n_points"));
    row.wall_time = wall_time();
  }



  template <int dim>
  bool
  Run<dim>::watch_porosity()
  {
    const double lowest = model.ledger.value_or("min_porosity", 1.);
    if (lowest > 0.)
      return true;
    if (!porosity_is_lost)
      folder.log() << "  the porosity of a material point has fallen to " << lowest
                   << " at t = " << row.time << " s, step " << row.step
                   << ": its grains would overlap, which this skeleton does not see; from here on "
                      "the answer is not one of a soil (Pore fluid/Lost porosity)"
                   << std::endl;
    porosity_is_lost = true;
    return model.scene.pore_fluid->fluid.porosity_watch == PorosityWatch::warn;
  }



  template <int dim>
  std::string
  Run<dim>::watch_supports()
  {
    const auto finding = supports.look(row.step, row.time, clock.finished());
    for (const std::string &line : finding.lines)
      if (line != finding.stop)
        folder.log() << "  WARNING: " << line << std::endl;
    return finding.stop;
  }



  template <int dim>
  bool
  Run<dim>::reject_step(const StepReport &report)
  {
    ++counts.rejected;
    ++counts.rejected_pending;
    output->write_rejected(clock.n_steps() + 1, clock.next_time(), report.newton);
    const double size = clock.step_size();
    const bool   cut  = !report.hopeless && clock.cut_step();
    if (cut)
      log.cut(size, clock.time(), report.cause);
    else
      log.stopped(size, clock.time(), report.cause, !report.hopeless);
    return cut;
  }



  template <int dim>
  void
  Run<dim>::watch_limit()
  {
    if (model.scheme.dynamic)
      return;
    double square = 0.;
    model.points.points().for_each_core([&](const unsigned int,
                                            const std::uint64_t,
                                            const dealii::Point<dim> &,
                                            const PointCore<dim> &core) {
      square = std::max(square, core.displacement.norm_square());
    });
    limit.add(row.time_step, std::sqrt(dealii::Utilities::MPI::max(square, communicator)));
  }



  template <int dim>
  RunEnd
  Run<dim>::end_without_equilibrium(const StepReport &report)
  {
    const std::string bad   = log.bad_loads(clock.time(), clock.next_time());
    const std::string cause = report.cause + (bad.empty() ? "" : "; " + bad);
    const std::string load  = log.load_factors(clock.time());
    // what moves by given displacements has no limit load, however fast it moves
    const bool is_one = bad.empty() && !report.hopeless && limit.runs_away() && !load.empty();
    if (is_one && model.scene.time.failure_displacement > 0.)
      return finish("finished", "a limit load, no equilibrium beyond it: " + limit.growth());
    const std::string growth = model.scheme.dynamic || !bad.empty() ? "" : limit.growth();
    if (is_one)
      return finish("numerical_stop",
                    "no equilibrium beyond load factor " + load + ": " + growth +
                      "; a limit load (to find it without a stop: Time/Failure displacement); " +
                      cause);
    return finish("numerical_stop", cause + (growth.empty() ? "" : "; " + growth));
  }



  template <int dim>
  RunSummary
  Run<dim>::make_summary(const std::string &status, const std::string &reason)
  {
    RunSummary summary;
    if (status == "finished")
      summary.checks = evaluate_checks<dim>(model.scene.checks,
                                            folder,
                                            model.points.points().records(),
                                            model.scene.constants);
    summary.versions = software_versions();
    summary.scene    = model.scene.name;
    summary.title    = model.scene.title;
    summary.status   = status;
    summary.reason   = reason;
    summary.dim      = dim;
    summary.n_ranks  = dealii::Utilities::MPI::n_mpi_processes(communicator);
    summary.bodies   = model.bodies.names;
    const auto count = [&](const std::string &column) {
      return static_cast<std::uint64_t>(model.ledger.value(column));
    };
    summary.counts              = {{"material_points", count("n_points")},
                                   {"active_cells", count("n_active_cells")},
                                   {"dofs", count("n_dofs")}};
    summary.n_steps             = clock.n_steps();
    summary.n_newton_iterations = counts.newton;
    summary.n_linear_iterations = counts.linear;
    summary.n_rejected_attempts = counts.rejected;
    if (!model.scheme.dynamic)
      summary.largest_displacement = limit.largest_displacement();
    summary.largest_condition_estimate = step.equations().largest_condition();
    summary.wall_seconds               = wall_time();
    summary.cpu_seconds                = cpu_seconds(communicator);
    auto   phases                      = step.phase_times();
    double in_steps                    = 0.;
    for (const auto &phase : phases)
      in_steps += phase.second.wall;
    phases["output"] = output->time();
    for (const auto &[name, time] : phases)
      {
        summary.phase_wall_seconds[name] = time.wall;
        summary.phase_cpu_seconds[name]  = dealii::Utilities::MPI::sum(time.cpu, communicator);
      }
    summary.peak_memory_bytes = peak_memory(communicator);
    if (in_steps > 0.)
      summary.point_updates_per_second = counts.points_times_steps / in_steps;
    summary.columns   = model.ledger.columns();
    summary.final_row = row;
    return summary;
  }



  template <int dim>
  RunEnd
  Run<dim>::finish(const std::string &status, const std::string &reason)
  {
    const bool finished = status == "finished";
    const bool stopped  = status == "numerical_stop" && state_is_good;
    log.finish(row);
    if (finished || stopped)
      output->write_points(clock, true);
    if (stopped || (finished && (model.scene.output.checkpoint_every_steps > 0 ||
                                 model.scene.output.checkpoint_interval > 0.)))
      write_checkpoint(); // one goes on from the end, too, with a later Time/End
    const RunSummary summary = make_summary(status, reason);
    write_summary(folder, summary);

    std::ostream &out = folder.log();
    if (finished)
      {
        if (!reason.empty())
          log.say_loads(clock.time());
        print_checks(summary.checks, out);
        if (!reason.empty())
          out << "  " << reason << std::endl;
        out << "kedge: finished at t = " << clock.time() << " s after " << clock.n_steps()
            << " steps, " << counts.newton << " Newton iterations, " << std::setprecision(3)
            << wall_time() << " s" << std::setprecision(6) << std::endl;
        say_where_results_are(finished);
        for (const auto &check : summary.checks)
          if (!check.pass && options.strict)
            return {ExitCode::numerical_stop, "a check has failed"};
        return {ExitCode::finished, ""};
      }
    log.say_loads(clock.time());
    out << "kedge: stopped at t = " << clock.time() << " s: " << reason << std::endl;
    say_where_results_are(finished);
    return {status == "interrupted" ? ExitCode::interrupted : ExitCode::numerical_stop, reason};
  }

  template <int dim>
  void
  Run<dim>::say_where_results_are(const bool finished)
  {
    const std::string name = folder.path().string();
    folder.log() << "kedge: results in " << name << "; to draw them: " << command_name() << " plot "
                 << name << std::endl;
    if (!finished && state_is_good && !options.resume_command.empty())
      folder.log() << "kedge: to go on: " << options.resume_command << std::endl;
    folder.check_log();
  }

  template class Run<2>;
  template class Run<3>;
} // namespace kedge
