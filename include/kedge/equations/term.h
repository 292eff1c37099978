#ifndef kedge_equations_term_h
#define kedge_equations_term_h

#include <kedge/equations/ledger.h>
#include <kedge/equations/residual.h>
#include <kedge/equations/tangent.h>
#include <kedge/equations/trial.h>
#include <kedge/points/generation.h>

#include <map>

namespace kedge
{
  /** Whether a term could answer to a trial state, and why not. */
  struct Answer
  {
    bool        ok = true;
    std::string cause; ///< what happened at which point, if not ok

    static Answer
    failure(const std::string &cause)
    {
      return {false, cause};
    }
  };

  /** What terms keep in a checkpoint: numbers under names of their own. */
  using SavedState = std::map<std::string, std::vector<double>>;

  /**
   * A part of the balance equations: internal forces, inertia, loads, pore water,
   * ghosts, and what is to come. Terms are chosen once, from the scene; physics that is
   * off has no term. They are called per step or per iteration, never per point.
   *
   * In the course of a run:
   *   attach                      to the points just generated
   *   take_over                   those of a stage of equilibrium in their place
   *   declare                     its unknowns, its columns of the books
   *   each configuration:         reach, activate
   *   each attempt at a step:     start; add_residual, add_tangent, prepare_solver; refresh; finish
   *   each accepted step:         book, commit; book_outflow of points that have left the grid
   *   each state that is shown:   book_state
   *
   *   each checkpoint:            save; restore in the run that resumes it
   *
   * Nothing but attach(), initialise(), commit() and restore() changes what is committed: a
   * rejected step leaves nothing to undo.
   */
  template <int dim>
  class Term
  {
  public:
    virtual ~Term() = default;

    /** Its name for messages. */
    virtual std::string
    name() const = 0;

    /**
     * Gives the points just generated (all of them, on all ranks) what the term knows of
     * them, and finds those that it acts on.
     *
     * @throws UserError for what the scene does not allow
     */
    virtual void
    attach(std::vector<GeneratedPoint<dim>> &)
    {}

    /** Prepares points that a stage of equilibrium has left for the scheme of the run. */
    virtual void
    take_over(std::vector<PointRecord<dim>> &) const
    {}

    /** Declares unknowns, weights and traits of the equations. */
    virtual void
    declare_unknowns(Unknowns<dim> &)
    {}

    /** Declares energies, works, dissipations, masses and forces. */
    virtual void
    declare_books(Ledger &)
    {}

    /**
     * Flags nodes of a field that other ranks' points reach and that this rank must know, with
     * what they are tied to, one entry per window node (collective).
     */
    virtual void
    claim(const unsigned int /*field*/, std::vector<unsigned char> &)
    {}

    /** Flags nodes of a field beyond those that points reach, one entry per window node. */
    virtual void
    reach(const unsigned int /*field*/, std::vector<unsigned char> &)
    {}

    /** Reads the points of a new configuration, once its nodes are known (collective). */
    virtual void
    activate(const MaterialPoints<dim> &)
    {}

    /** Adds what the term has to the mass of the velocity mapping of a field, this rank's share. */
    virtual void
    add_mapping_mass(const unsigned int /*field*/, NodeMatrix<dim> &) const
    {}

    /** Sets what only the grid can tell the points before the first step (collective). */
    virtual void
    initialise(MaterialPoints<dim> &)
    {}

    /** Before Newton's method: loads of the step, first guesses (collective). */
    virtual void
    start(Trial<dim> &)
    {}

    /** Adds its residual, or says why it has none; called on all ranks alike. */
    virtual Answer
    add_residual(const Trial<dim> &, Residual<dim> &)
    {
      return {};
    }

    /** The residual of bodies at rest in the present configuration under the loads of time @p t. */
    virtual void
    add_residual_at_rest(const double /*t*/, Residual<dim> &)
    {}

    /** Adds the derivative of its residual; only where that had an answer. */
    virtual void
    add_tangent(const Trial<dim> &, Tangent<dim> &)
    {}

    /** Tells the linear solver what it needs to know, after the tangent was assembled. */
    virtual void
    prepare_solver(const Trial<dim> &, const Tangent<dim> &, LinearSolver &)
    {}

    /**
     * After convergence: takes anew from the trial state what the term holds fixed while the
     * equations are solved, such as directions or multipliers of contact. Says whether they
     * must be solved again (collective; all ranks must say the same).
     */
    virtual bool
    refresh(const Trial<dim> &)
    {
      return false;
    }

    /** After convergence: what the points will be, or why the step cannot be taken. */
    virtual Answer
    finish(const Trial<dim> &)
    {
      return {};
    }

    /** Books the accepted step before it is committed: this rank's shares. */
    virtual void
    book(const Trial<dim> &, const Residual<dim> &, Ledger &) const
    {}

    /** Writes the step into the points. */
    virtual void
    commit(const Trial<dim> &, MaterialPoints<dim> &)
    {}

    /**
     * Books what points have taken with them that the step has brought out of the grid
     * through open sides: as they are after the step, this rank's.
     */
    virtual void
    book_outflow(const std::vector<PointRecord<dim>> &, Ledger &) const
    {}

    /** Books the committed state: this rank's shares. */
    virtual void
    book_state(const MaterialPoints<dim> &, Ledger &) const
    {}

    /** Adds what is committed of the term itself, beside the points and the books. */
    virtual void
    save(SavedState &) const
    {}

    /** Goes on from what save() has kept. */
    virtual void
    restore(const SavedState &)
    {}
  };

  template <int dim>
  using Terms = std::vector<std::unique_ptr<Term<dim>>>;
} // namespace kedge

#endif
