#ifndef kedge_solvers_interruptible_h
#define kedge_solvers_interruptible_h

#include <kedge/solvers/newton.h>

#include <functional>

namespace kedge
{
  /** A problem whose solution can be given up between the iterations of Newton's method. */
  class Interruptible : public NewtonProblem
  {
  public:
    Interruptible(NewtonProblem &problem, const std::function<bool()> &stop)
      : problem(problem)
      , stop(stop)
    {}

    Evaluation
    evaluate() override
    {
      return problem.evaluate();
    }

    void
    set_linear_tolerance(const double tolerance) override
    {
      problem.set_linear_tolerance(tolerance);
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override
    {
      // a step that converged is only polished with the tangent at hand, and is worth keeping
      interrupted = interrupted || (!keep_tangent && stop());
      if (!interrupted)
        return problem.solve_correction(norm, keep_tangent);
      LinearStatus status;
      status.success = false;
      status.cause   = "the run is to stop";
      return status;
    }

    void
    retract(const double factor) override
    {
      problem.retract(factor);
    }

    bool interrupted = false;

  private:
    NewtonProblem               &problem;
    const std::function<bool()> &stop;
  };
} // namespace kedge

#endif
