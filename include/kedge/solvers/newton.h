#ifndef kedge_solvers_newton_h
#define kedge_solvers_newton_h

#include <kedge/solvers/linear_solver.h>
#include <kedge/solvers/parameters.h>

#include <string>
#include <vector>

namespace kedge
{
  /** How a Newton iteration ended; never an exception. */
  struct NewtonReport
  {
    bool                converged         = false;
    unsigned int        iterations        = 0; ///< corrections solved for
    unsigned int        linear_iterations = 0;
    std::string         cause;          ///< of a failure: what, where
    std::vector<double> residual_norms; ///< before the first and after each correction
    std::vector<double> correction_norms;
  };

  /** A non-linear system r(u) = 0 as Newton's method sees it. All calls are collective. */
  class NewtonProblem
  {
  public:
    struct Evaluation
    {
      bool   ok            = true;
      double residual_norm = 0.; ///< 2-norm over the free components
      /** Size of the terms that cancel in the residual: its round-off is a fraction of this. */
      double      scale = 0.;
      std::string cause; ///< if !ok: which point, what happened
    };

    virtual ~NewtonProblem() = default;

    /** The residual at the present u. */
    virtual Evaluation
    evaluate() = 0;

    /**
     * Says which relative residual of its linear system suffices for the next
     * corrections. Direct solvers need not know.
     */
    virtual void
    set_linear_tolerance(const double /*tolerance*/)
    {}

    /**
     * Solves for the correction at the present u and gives its 2-norm.
     *
     * @param keep_tangent use the tangent of the last call (and its factors)
     */
    virtual LinearStatus
    solve_correction(double &norm, const bool keep_tangent) = 0;

    /**
     * Goes from u as it was at the last solve_correction() by @p factor times the
     * correction; 0 goes back there.
     */
    virtual void
    retract(const double factor) = 0;
  };

  /**
   * Newton's method with the criterion (3.185),
   *   |r_k| |du_k| / (|r_0| |du_1|) < tolerance,
   * made safe against small first steps: a residual at the round-off of its
   * own terms is converged too. A correction that leads to an inadmissible
   * state (det F <= 0, not finite) is halved. When the criterion holds, one
   * more correction with the tangent at hand polishes the solution, and a few
   * more as long as each helps and round-off is not near: they cost no
   * factorisation, and what is left of the residual is what conservation of
   * energy and momenta lacks. If it is still more than 1e-12 of the residual's
   * terms, up to three iterations are added; the criterion must hold at the last
   * one too. Iterative linear solvers may leave a relative residual of 1e-3 in the
   * first iteration and then of a tenth of (|r_k|/|r_k-1|)^2, which keeps the
   * order (Eisenstat and Walker 1996). From the fifth correction on, one that
   * stagnates is halved until the residual falls. At the limit of iterations a residual that still
   * falls (halved within the last four) is given more of them, up to three times the limit.
   */
  NewtonReport
  solve_newton(NewtonProblem &problem, const NewtonParameters &parameters);
} // namespace kedge

#endif
