#ifndef kedge_solid_balance_h
#define kedge_solid_balance_h

#include <kedge/base/stopwatch.h>
#include <kedge/grid/node_conditions.h>
#include <kedge/solid/internal_force.h>
#include <kedge/solvers/newton.h>
#include <kedge/transfer/equation_system.h>
#include <kedge/transfer/ghost_penalty.h>

namespace kedge
{
  /** The nodal quantities of a step, dim values per local node, ghosts up to date. */
  struct NodalState
  {
    std::vector<double> velocity_n;     ///< v_n [m/s]
    std::vector<double> acceleration_n; ///< a_n [m/s^2]; zero where the scheme carries none
    std::vector<double> external_force; ///< f_ext at the scheme's load time [N], owned nodes
    std::vector<double> displacement;   ///< u, the unknown: over the step [m]
  };

  /** Time spent in the parts of the Newton iteration. */
  struct SolidTimings
  {
    PhaseTime residual, tangent, linear_solve;
  };

  /**
   * The balance equations of a step, as the algorithm of the step sees them:
   * of momentum in dry bodies (SolidProblem), of momentum and mass in
   * saturated ones (PorousProblem).
   *
   * What both have in common stands here: equations for @p n_components values
   * per node, of which dim + 1 are the displacement and the pore pressure; the
   * correction of Newton's method by their tangent; the supports; the words for
   * what went wrong. What is left to them: evaluate() fills the residual,
   * assemble_tangent() the tangent, apply_correction() changes the unknowns.
   */
  template <int dim>
  class Balance : public NewtonProblem
  {
  public:
    /**
     * Announces points, nodes and conditions of a step. The stiffness couples
     * nodes up to @p stiffness_radius apart, no less than the mass does.
     *
     * @param mass of velocities and accelerations, that of ghosts included
     * @param ghosts the ghost terms; nullptr for none
     */
    void
    reinit(const BackgroundGrid<dim> &grid,
           const ActiveNodes<dim>    &nodes,
           const NodeConditions<dim> &conditions,
           const NodeTies<dim>       &ties,
           const StepPoints<dim>     &points,
           const NodeMatrix<dim>     &mass,
           const GhostMatrices<dim>  *ghosts,
           const int                  stiffness_radius,
           const bool                 new_pattern);

    /**
     * Starts a step from t_n of size dt. @p state.displacement is the first
     * guess at the free components; the prescribed and tied ones are set here.
     */
    virtual void
    start(NodalState &state, const double t_n, const double dt) = 0;

    void
    set_linear_tolerance(const double tolerance) override
    {
      linear_tolerance = tolerance;
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override;

    /** Work of the supports that move in this step, after convergence [J] (collective). */
    double
    reaction_work() const;

    /**
     * The forces of the supports on the bodies in the balance of this step,
     * after convergence [N]: dim values per node condition (collective).
     */
    std::vector<double>
    reactions() const;

    /**
     * Says where the tangent was singular, or nearly so, in this step; empty
     * if nowhere (collective).
     */
    std::string
    diagnosis() const;

    /** Worst condition estimate of a tangent so far; 0 if the linear solver gives none. */
    double
    largest_condition() const
    {
      return largest_condition_;
    }

    std::uint64_t
    n_equations() const
    {
      return equations.system().n_global;
    }

    std::string
    linear_method() const
    {
      return linear_solver.method();
    }

    const SolidTimings &
    timings() const
    {
      return timings_;
    }

  protected:
    /** @param suspicious_condition a tangent worse than this may be why Newton's method fails */
    Balance(const int                       n_components,
            const double                    suspicious_condition,
            const LinearSolverParameters   &parameters,
            const MatrixTraits             &traits,
            const std::vector<std::string> &body_names);

    /** Fills the tangent and the equations with it. */
    virtual void
    assemble_tangent() = 0;

    /** The equations have another pattern than in the last step. */
    virtual void
    pattern_changed()
    {}

    /** Forgets the last step. */
    void
    begin_step(NodalState &state, const double t_n, const double dt);

    /** Adds a matrix that acts alike on the components from @p first to before @p end. */
    void
    add_to_diagonal_blocks(const double           coefficient,
                           const NodeMatrix<dim> &matrix,
                           const int              first,
                           const int              end);

    /**
     * Ends an evaluation: its norm, and why it is of no use if a point failed on
     * any rank or the norm is not finite.
     */
    NewtonProblem::Evaluation
    conclude(const double squared_norm, const double n_failed, const PointStatus &answer) const;

    LinearSolver                linear_solver;
    std::array<double, dim + 1> weights; ///< of the components' equations in Newton's norm

    const BackgroundGrid<dim> *grid       = nullptr;
    const ActiveNodes<dim>    *nodes      = nullptr;
    const NodeConditions<dim> *conditions = nullptr;
    const NodeTies<dim>       *ties       = nullptr;
    const StepPoints<dim>     *points     = nullptr;
    const NodeMatrix<dim>     *mass       = nullptr;
    const GhostMatrices<dim>  *ghosts     = nullptr;
    NodalState                *state      = nullptr;
    double                     t_n        = 0.;
    double                     dt         = 0.;

    NodeMatrix<dim>          tangent;
    EquationSystem<dim>      equations;
    std::vector<NodalStatus> status;
    std::vector<double>      residual, correction; ///< n_components per local node
    SolidTimings             timings_;

  private:
    std::string
    describe_point(const unsigned int slot) const;
    std::string
    describe_equation(const std::int64_t equation) const;

    const int                      n_components;
    const double                   suspicious_condition;
    const std::vector<std::string> body_names;
    double                         linear_tolerance = 0.;
    std::string                    warning_;                ///< of a singular tangent in this step
    double                         condition          = 0.; ///< worst of this step
    double                         largest_condition_ = 0.;
    std::int64_t                   weakest_equation   = -1;
  };
} // namespace kedge

#endif
