#ifndef kedge_simulation_step_h
#define kedge_simulation_step_h

#include <kedge/equations/step_equations.h>
#include <kedge/simulation/model.h>

#include <functional>
#include <map>

namespace kedge
{
  /** How an attempt at a step ended. */
  struct StepReport
  {
    bool         accepted    = false;
    bool         hopeless    = false; ///< a smaller step would not help
    bool         interrupted = false; ///< given up because it was asked to
    std::string  cause;               ///< of a rejection
    NewtonReport newton;
  };

  /**
   * The algorithm of one step: (A) activate the grid around the points, (B) map
   * points to grid, (C, D) find the nodal unknowns, (E) map back. An attempt
   * changes nothing that is committed, so that a rejected one leaves nothing to undo; commit()
   * commits all at once.
   */
  template <int dim>
  class Step
  {
  public:
    /**
     * @param model  must last as long as this
     * @param solves false: no step is ever attempted, only looked at what one would find;
     * there are no matrices then, which would take most of the memory
     */
    explicit Step(Model<dim> &model, const bool solves = true);

    /** Points, nodes, unknowns of the present configuration, if they are not yet known
     * (collective). */
    void
    activate();

    /** Points have been replaced, or something of them changed. */
    void
    points_changed()
    {
      activated = false;
    }

    /**
     * Gives the points what only the grid can tell them: what terms initialise (unless
     * a stage before the run has), and for schemes that carry it the acceleration of
     * equilibrium at the start, M a = f_ext(t) - f_int (collective).
     */
    void
    initialise_points(const double t, const bool after_stage);

    /**
     * One attempt (collective).
     *
     * @param stop asked before each iteration of Newton's method; if it says true, on all
     * ranks, the attempt is given up
     */
    StepReport
    attempt(const StepTimes &times, const std::function<bool()> &stop = {});

    /** Commits the last attempt, which must have been accepted, and books it (collective). */
    void
    commit();

    /** Books the committed state alone (collective). */
    void
    book_state();

    /** The sum of all loads at a time, of all fields [N; N/m in 2D] (collective). */
    dealii::Tensor<1, dim>
    total_load(const double t);

    const StepEquations<dim> &
    equations() const
    {
      return step_equations;
    }

    /** Time spent so far by this process, by phase. */
    std::map<std::string, PhaseTime>
    phase_times() const;

  private:
    void
    find_nodes();
    void
    set_time(const double t);
    LinearStatus
    points_to_nodes();
    NewtonReport
    solve(NewtonProblem &problem);
    StepReport
    check_points(const NewtonReport &newton);
    std::string
    failure_of(const NewtonReport &newton) const;
    void
    book_present_state();

    Model<dim>                      &model;
    const bool                       solves;
    StepEquations<dim>               step_equations;
    Trial<dim>                       trial;
    const Ledger::Index              n_dofs;
    bool                             activated = false;
    std::map<std::string, PhaseTime> phases;
  };

  /** The step allowed by the waves, (3.126), (3.127) or (3.195) [s] (collective). */
  template <int dim>
  double
  cfl_step(const Model<dim> &model, Step<dim> &step, const StepSizeKind kind);
} // namespace kedge

#endif
