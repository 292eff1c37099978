#include <kedge/solvers/newton.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace kedge
{
  namespace
  {
    constexpr unsigned int most_halvings = 8;

    /** A residual below this part of its terms is round-off. */
    constexpr double round_off = 1e-14;

    /** A residual that has grown by this factor will not come back. */
    constexpr double divergence = 1e8;

    /** Below this part of its terms a residual needs no polish: energy drifts by less, but in steps
     * of saturated soil far beyond the waves. */
    constexpr double polished = 1e-13;

    /**
     * Above this part of its terms a residual that meets the criterion is still
     * too large for the books of energy: a few iterations are added.
     */
    constexpr double       accurate              = 1e-12;
    constexpr unsigned int most_iterations_added = 3;

    /** Corrections with kept factors, at most; each costs a residual and a substitution. */
    constexpr unsigned int most_polishes = 4;

    /** Corrections that are tried before the residual is asked to fall. */
    constexpr unsigned int free_corrections = 4;

    /** From the third correction on the residual may grow by this factor, or up to the first. */
    constexpr double       largest_growth     = 10.;
    constexpr unsigned int bounded_correction = 3;

    /** Linear systems are solved to this relative residual at least. */
    constexpr double loosest_linear_tolerance = 1e-3;

    /** A residual that has halved within so many corrections falls. */
    constexpr unsigned int patience = 4;

    /** A residual that falls is given so many times the limit of iterations. */
    constexpr unsigned int longest_extension = 3;

    constexpr double no_bound = std::numeric_limits<double>::infinity();

    /**
     * True if the last two corrections have not halved the residual: material
     * points that yield and unload in turn keep Newton's method in a cycle,
     * which shorter corrections break.
     */
    bool
    stagnates(const NewtonReport &report)
    {
      const auto &norms = report.residual_norms;
      return norms.size() > free_corrections &&
             norms[norms.size() - 1] > 0.5 * norms[norms.size() - 3];
    }

    /**
     * What the residual of the next correction may not exceed. A correction that far
     * overshoots into a law that stiffens without bound, as that of closing pores,
     * would leave a state from which Newton's method does not come back.
     */
    double
    residual_bound(const NewtonReport &report)
    {
      const auto &norms = report.residual_norms;
      if (stagnates(report))
        return norms.back();
      if (norms.size() < bounded_correction)
        return no_bound;
      return std::max(norms.front(), largest_growth * norms.back());
    }

    /** Relative residual that leaves a linear system no larger than needed for polished books. */
    double
    tolerance_of_polish(const NewtonProblem::Evaluation &evaluation)
    {
      return evaluation.residual_norm > 0.
               ? std::min(0.1 * polished * evaluation.scale / evaluation.residual_norm,
                          loosest_linear_tolerance)
               : loosest_linear_tolerance;
    }

    /** Relative residual at which a quadratic iteration goes on as fast as with exact solutions. */
    double
    tolerance_of_correction(const NewtonReport &report, const NewtonProblem::Evaluation &evaluation)
    {
      const auto &norms = report.residual_norms;
      if (norms.size() < 2)
        return loosest_linear_tolerance;
      const double ratio = norms[norms.size() - 1] / norms[norms.size() - 2];
      return std::max(std::min(0.1 * ratio * ratio, loosest_linear_tolerance),
                      tolerance_of_polish(evaluation));
    }

    /**
     * One correction with the last tangent, taken back if it does not help.
     *
     * @return whether another one may help too
     */
    bool
    polish(NewtonProblem             &problem,
           const bool                 to_round_off,
           NewtonProblem::Evaluation &evaluation,
           NewtonReport              &report)
    {
      double norm = 0.;
      problem.set_linear_tolerance(tolerance_of_polish(evaluation));
      const LinearStatus linear = problem.solve_correction(norm, true);
      report.linear_iterations += linear.iterations;
      if (!linear.success || !std::isfinite(norm))
        return false;
      problem.retract(1.);
      const NewtonProblem::Evaluation attempt = problem.evaluate();
      if (!attempt.ok || attempt.residual_norm >= evaluation.residual_norm)
        {
          problem.retract(0.);
          problem.evaluate();
          return false;
        }
      const double gain = evaluation.residual_norm / attempt.residual_norm;
      evaluation        = attempt;
      report.residual_norms.push_back(attempt.residual_norm);
      report.correction_norms.push_back(norm);
      return gain > 4. && (to_round_off || attempt.residual_norm > polished * attempt.scale);
    }

    std::string
    iteration_text(const unsigned int iteration)
    {
      return " (Newton iteration " + std::to_string(iteration) + ")";
    }

    /** The last residuals, which tell stagnation from divergence. */
    std::string
    residual_trail(const NewtonReport &report)
    {
      std::ostringstream text;
      text << std::scientific << std::setprecision(1) << ", residual " << report.residual_norms[0]
           << " N at first, at last";
      const auto       &norms = report.residual_norms;
      const std::size_t begin = norms.size() > 4 ? norms.size() - 4 : 1;
      for (std::size_t k = begin; k < norms.size(); ++k)
        text << " " << norms[k];
      return text.str();
    }

    /**
     * Applies the correction, halved until the state is admissible and, if the
     * iteration stagnates, the residual below @p bound.
     */
    NewtonProblem::Evaluation
    advance(NewtonProblem &problem, const double bound)
    {
      problem.retract(1.);
      NewtonProblem::Evaluation evaluation = problem.evaluate();
      double                    factor     = 1.;
      for (unsigned int k = 0;
           k < most_halvings && !(evaluation.ok && evaluation.residual_norm < bound);
           ++k)
        {
          factor *= 0.5;
          problem.retract(factor);
          evaluation = problem.evaluate();
        }
      return evaluation;
    }

    /** Whether the residual has halved within the last corrections. */
    bool
    falls(const NewtonReport &report)
    {
      const auto &norms = report.residual_norms;
      if (norms.size() <= patience)
        return false;
      const auto recent = norms.end() - patience;
      return *std::min_element(recent, norms.end()) <
             0.5 * *std::min_element(norms.begin(), recent);
    }

    /** Whether another correction may be made. */
    bool
    may_go_on(const NewtonReport &report, const unsigned int limit)
    {
      return report.iterations < limit ||
             (report.iterations < longest_extension * limit && falls(report));
    }

    /** Corrects the unknowns once, and evaluates there; false, with the cause, if that fails. */
    bool
    correct(NewtonProblem &problem, NewtonProblem::Evaluation &evaluation, NewtonReport &report)
    {
      double correction_norm = 0.;
      problem.set_linear_tolerance(tolerance_of_correction(report, evaluation));
      const LinearStatus linear = problem.solve_correction(correction_norm, false);
      ++report.iterations;
      report.linear_iterations += linear.iterations;
      if (!linear.success || !std::isfinite(correction_norm))
        {
          report.cause =
            (linear.success ? "the linear solver gave a value that is not finite" : linear.cause) +
            iteration_text(report.iterations);
          return false;
        }
      evaluation = advance(problem, residual_bound(report));
      report.residual_norms.push_back(evaluation.residual_norm);
      report.correction_norms.push_back(correction_norm);
      if (!evaluation.ok)
        report.cause = evaluation.cause + iteration_text(report.iterations);
      return evaluation.ok;
    }
  } // namespace



  NewtonReport
  solve_newton(NewtonProblem &problem, const NewtonParameters &parameters)
  {
    NewtonReport              report;
    NewtonProblem::Evaluation evaluation = problem.evaluate();
    if (!evaluation.ok)
      {
        report.cause = evaluation.cause + " before the first Newton iteration";
        return report;
      }

    const double first_residual = evaluation.residual_norm;
    double       first_product  = 0.;
    report.residual_norms       = {first_residual};
    const auto at_round_off     = [&]() {
      return evaluation.residual_norm <= round_off * evaluation.scale;
    };

    unsigned int n_added = 0;
    while (may_go_on(report, parameters.max_iterations))
      {
        report.converged = false; // an added iteration has to hold as well
        if (!correct(problem, evaluation, report))
          return report;
        const double correction_norm = report.correction_norms.back();
        if (report.iterations == 1)
          first_product = first_residual * correction_norm;
        const double product = evaluation.residual_norm * correction_norm;
        if (product < parameters.tolerance * first_product || at_round_off())
          {
            report.converged = true;
            for (unsigned int k = 0; k < most_polishes && !at_round_off(); ++k)
              if (!polish(problem, parameters.to_round_off, evaluation, report))
                break;
            if (evaluation.residual_norm <= accurate * evaluation.scale ||
                n_added++ == most_iterations_added)
              return report;
          }
        if (evaluation.residual_norm > divergence * first_residual && report.iterations > 2)
          {
            report.converged = false;
            report.cause = "the residual grew without bound" + iteration_text(report.iterations);
            return report;
          }
      }
    // a step that begins in balance has no larger residual that it could be compared with
    report.converged = report.converged || evaluation.residual_norm <= accurate * evaluation.scale;
    if (report.converged)
      return report;
    report.cause = "no convergence in " + std::to_string(report.iterations) + " Newton iterations" +
                   residual_trail(report);
    return report;
  }
} // namespace kedge
