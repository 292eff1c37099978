#ifndef kedge_simulation_run_h
#define kedge_simulation_run_h

#include <kedge/io/checkpoint.h>
#include <kedge/io/run_folder.h>
#include <kedge/io/signals.h>
#include <kedge/io/summary.h>
#include <kedge/simulation/limit_watch.h>
#include <kedge/simulation/run_log.h>
#include <kedge/simulation/run_options.h>
#include <kedge/simulation/run_output.h>
#include <kedge/simulation/support_watch.h>

namespace kedge
{
  /** A whole run of a scene: the time loop with its books, output and checkpoints. */
  template <int dim>
  class Run
  {
  public:
    /** @throws UserError for what the scene or the folder do not allow */
    Run(const Scene<dim> &scene, const RunOptions &options, const MPI_Comm communicator);

    /** Runs to the end (or the stop) and says how it ended. */
    RunEnd
    run();

    /**
     * Goes on by one accepted step and writes what is due, or ends the run: not to be
     * called again once it has said how that ended. Collective.
     *
     * @param stop_requested asked between iterations; true, on all ranks, ends the run
     */
    std::optional<RunEnd>
    advance(const std::function<bool()> &stop_requested);

    /** The scene with its points as they are after the last step. */
    const Model<dim> &
    current() const
    {
      return model;
    }

    /** What the last step has written into history.csv. */
    const HistoryRow &
    last_row() const
    {
      return row;
    }

    /** Keeps the present state on the disk (collective). */
    void
    write_checkpoint();

  private:
    /** Counts of a run beside the books; part of every checkpoint. */
    struct Counts
    {
      double        wall_before        = 0.; ///< of the runs that this one resumes [s]
      double        points_times_steps = 0.;
      std::uint64_t newton             = 0;
      std::uint64_t linear             = 0;
      std::uint64_t rejected           = 0;
      std::uint64_t rejected_pending   = 0; ///< since the last accepted step
    };

    void
    start_fresh();
    void
    resume();
    void
    set_step();
    /** Commits an accepted step and writes what is due, or says what of it is no number. */
    std::string
    finish_step(const StepReport &report);
    /** The first of the books that is not finite, and the loads that may be why. */
    std::string
    bad_number(const double begin) const;
    void
    fill_row();
    /** Warns of the first point without pores; false if the run is to stop there. */
    bool
    watch_porosity();
    /** Warns of node conditions that lose their material; why the run is to stop, if it is. */
    std::string
    watch_supports();
    bool
    reject_step(const StepReport &report);
    /** How far the points have moved, of a quasi-static run. */
    void
    watch_limit();
    /** Ends a run whose load has no equilibrium: what says that it is a limit load, if it is one.
     */
    RunEnd
    end_without_equilibrium(const StepReport &report);
    void
    write_checkpoint_if_due();
    RunEnd
    finish(const std::string &status, const std::string &reason);
    void
    say_where_results_are(const bool finished);
    RunSummary
    make_summary(const std::string &status, const std::string &reason);

    double
    wall_time() const;

    const RunOptions options;
    const MPI_Comm   communicator;
    const double     wall_start;
    RunFolder        folder;
    Model<dim>       model;
    Step<dim>        step;
    Clock            clock;
    Counts           counts;
    HistoryRow       row;
    bool             porosity_is_lost = false;
    bool             state_is_good    = true; ///< what a checkpoint may keep

    std::unique_ptr<RunOutput<dim>> output;
    CheckpointStore<dim>            checkpoints;
    RunLog                          log;
    SupportWatch<dim>               supports;
    LimitWatch                      limit;
    double                          last_checkpoint_wall = 0.;
    std::uint64_t                   last_checkpoint_step = 0;
  };

  /**
   * Builds the scene and prints what a run would start with: bodies, points,
   * active cells, unknowns, first step, memory. Runs nothing, writes nothing.
   */
  template <int dim>
  void
  validate_scene(const Scene<dim> &scene, std::ostream &out, const MPI_Comm communicator);
} // namespace kedge

#endif
