#ifndef kedge_solid_balance_h
#define kedge_solid_balance_h

#include <kedge/base/stopwatch.h>
#include <kedge/grid/node_conditions.h>
#include <kedge/solvers/newton.h>
#include <kedge/transfer/node_matrix.h>
#include <kedge/transfer/node_ties.h>

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
   */
  template <int dim>
  class Balance : public NewtonProblem
  {
  public:
    /**
     * Announces points, nodes and conditions of a step. The stiffness couples
     * nodes up to @p stiffness_radius apart, no less than the mass does.
     *
     * @param ghost_stiffness K_G, acts alike on all components [N/m]; nullptr for none
     */
    virtual void
    reinit(const BackgroundGrid<dim> &grid,
           const ActiveNodes<dim>    &nodes,
           const NodeConditions<dim> &conditions,
           const NodeTies<dim>       &ties,
           const StepPoints<dim>     &points,
           const NodeMatrix<dim>     &mass,
           const NodeMatrix<dim>     *ghost_stiffness,
           const int                  stiffness_radius,
           const bool                 new_pattern) = 0;

    /**
     * Starts a step from t_n of size dt. @p state.displacement is the first
     * guess at the free components; the prescribed and tied ones are set here.
     */
    virtual void
    start(NodalState &state, const double t_n, const double dt) = 0;

    /** Work of the supports that move in this step, after convergence [J] (collective). */
    virtual double
    reaction_work() const = 0;

    /**
     * The forces of the supports on the bodies in the balance of this step,
     * after convergence [N]: dim values per node condition (collective).
     */
    virtual std::vector<double>
    reactions() const = 0;

    /**
     * Says where the tangent was singular, or nearly so, in this step; empty
     * if nowhere (collective).
     */
    virtual std::string
    diagnosis() const = 0;

    /** Worst condition estimate of a tangent so far; 0 if the linear solver gives none. */
    virtual double
    largest_condition() const = 0;

    virtual std::uint64_t
    n_equations() const = 0;

    virtual std::string
    linear_method() const = 0;

    virtual const SolidTimings &
    timings() const = 0;
  };
} // namespace kedge

#endif
