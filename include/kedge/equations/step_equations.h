#ifndef kedge_equations_step_equations_h
#define kedge_equations_step_equations_h

#include <kedge/base/stopwatch.h>
#include <kedge/equations/term.h>

#include <optional>

namespace kedge
{
  /** Time spent in the parts of the Newton iteration. */
  struct EquationTimings
  {
    PhaseTime residual, tangent, linear_solve;
  };

  /**
   * The balance equations of a step, r(x) = 0 for all terms together, as Newton's
   * method sees them: residual and tangent summed over the terms, the correction by the
   * linear solver, and the words for what went wrong.
   */
  template <int dim>
  class StepEquations : public NewtonProblem
  {
  public:
    StepEquations(const std::vector<const Patch<dim> *> &patches,
                  const Unknowns<dim>                   &unknowns,
                  Terms<dim>                            &terms,
                  const Scheme                          &scheme,
                  const LinearSolverParameters          &parameters);

    /**
     * Takes a new configuration (collective).
     *
     * @param radius how far each field's tangent couples nodes
     */
    void
    reinit(const std::vector<int> &radius);

    /**
     * Starts a step: sets the prescribed values of @p trial, and, where supports move, lets
     * the first guess follow them (collective).
     *
     * @param t_pressure time at which prescribed pressures are taken
     */
    void
    start(Trial<dim> &trial, const double t_pressure);

    NewtonProblem::Evaluation
    evaluate() override;

    void
    set_linear_tolerance(const double tolerance) override
    {
      linear_tolerance = tolerance;
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override;

    void
    retract(const double factor) override;

    /** Residual of the bodies at rest under the loads of time @p t (collective). */
    const Residual<dim> &
    residual_at_rest(const double t);

    /** Of the last evaluation; at prescribed components the force of the support. */
    const Residual<dim> &
    last_residual() const
    {
      return residual;
    }

    /** Where the tangent was singular, or nearly so, in this step; empty if nowhere (collective).
     */
    std::string
    diagnosis() const;

    /** Worst condition estimate of a tangent so far; 0 if the linear solver gives none. */
    double
    largest_condition() const
    {
      return largest_condition_;
    }

    /** Equations of this rank. */
    unsigned int
    n_own_equations() const
    {
      return tangent.n_own_equations();
    }

    std::string
    linear_method() const
    {
      return linear_solver.method();
    }

    const EquationTimings &
    timings() const
    {
      return timings_;
    }

  private:
    void
    assemble_tangent();
    LinearStatus
    factorise();
    void
    describe_nodes();
    void
    follow_supports(const UnknownVector &at_rest);
    std::string
    describe_equation(const std::int64_t equation) const;

    const std::vector<const Patch<dim> *> patches;
    const Unknowns<dim>                  &unknowns;
    Terms<dim>                           &terms;
    const Scheme                         &scheme;

    Tangent<dim>                     tangent;
    Residual<dim>                    residual;
    std::vector<std::vector<double>> diagonal; ///< of the last tangent, by field
    LinearSolver                     linear_solver;
    double                           linear_tolerance = 0.;
    MixedBlocks                      displacements;      ///< nodes of the equations
    bool                             tell_solver = true; ///< of a step, before its first system

    Trial<dim>                  *trial = nullptr;
    UnknownVector                base, correction;
    std::optional<UnknownVector> replaced_residual; ///< solve for this one instead

    std::string     warning;                 ///< of a singular tangent in this step
    double          condition          = 0.; ///< worst of this step
    double          largest_condition_ = 0.;
    std::int64_t    weakest_equation   = -1;
    EquationTimings timings_;
  };
} // namespace kedge

#endif
