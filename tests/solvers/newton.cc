#include <kedge/solvers/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace kedge;

namespace
{
  /** f(x) = 0 of one unknown, admissible for x > lowest. */
  class Scalar : public NewtonProblem
  {
  public:
    Scalar(std::function<double(double)> f, std::function<double(double)> slope, const double start)
      : f(std::move(f))
      , slope(std::move(slope))
      , x(start)
    {}

    Evaluation
    evaluate() override
    {
      ++n_evaluations;
      Evaluation result;
      result.ok    = x > lowest;
      result.cause = result.ok ? "" : "point 7 is inside out";
      // at an inadmissible state there is no residual
      result.residual_norm = result.ok ? std::abs(f(x)) : std::numeric_limits<double>::quiet_NaN();
      result.scale         = scale;
      return result;
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override
    {
      if (!linear_cause.empty())
        return LinearStatus::failure(linear_cause, 3);
      if (!keep_tangent)
        tangent = slope(x);
      correction = -f(x) / tangent;
      base       = x;
      norm       = std::abs(correction);
      LinearStatus status;
      status.iterations = 5;
      return status;
    }

    void
    retract(const double factor) override
    {
      x = base + factor * correction;
    }

    std::function<double(double)> f, slope;
    double                        x, base = 0., tangent = 0., correction = 0., scale = 1.;
    double                        lowest = -std::numeric_limits<double>::infinity();
    std::string                   linear_cause;
    unsigned int                  n_evaluations = 0;
  };

  Scalar
  logarithm(const double start)
  {
    Scalar problem(
      [](double x) {
        return std::log(x);
      },
      [](double x) {
        return 1. / x;
      },
      start);
    problem.lowest = 0.;
    return problem;
  }
} // namespace

// A step that begins in balance: what is left is the round-off of its terms, 3e-13 of their size,
// and corrections only turn it over. A hundred times as large a residual that does not fall is a
// failure.
TEST(SolversNewton, AStateInBalanceIsConverged)
{
  for (const double floor : {3e-13, 3e-11})
    {
      Scalar problem(
        [&](double x) {
          return x > 0. ? floor : -floor;
        },
        [](double) {
          return 1.;
        },
        0.4 * floor);
      const NewtonReport report = solve_newton(problem, NewtonParameters());
      EXPECT_EQ(report.converged, floor < 1e-12) << report.cause;
    }
}

TEST(SolversNewton, ConvergesQuadratically)
{
  // x e^x = 1: x = 0.567143290409784, the omega constant
  Scalar problem(
    [](double x) {
      return x * std::exp(x) - 1.;
    },
    [](double x) {
      return (1. + x) * std::exp(x);
    },
    1.5);
  NewtonParameters parameters;
  parameters.tolerance = 1e-22; // down to round-off
  const auto report    = solve_newton(problem, parameters);
  ASSERT_TRUE(report.converged) << report.cause;
  EXPECT_TRUE(report.cause.empty());
  EXPECT_NEAR(problem.x, 0.567143290409784, 1e-14);
  ASSERT_GE(report.residual_norms.size(), report.iterations + 1);
  EXPECT_EQ(report.correction_norms.size(), report.residual_norms.size() - 1);
  EXPECT_EQ(report.linear_iterations, 5 * report.correction_norms.size());
  EXPECT_NEAR(report.residual_norms[0], 1.5 * std::exp(1.5) - 1., 1e-14);
  // r_{k+1} <= f''/(2 f'^2) r_k^2 with f''/(2 f'^2) <= 0.4 on [0.56, 1.5], up to round-off
  for (unsigned int k = 0; k < report.iterations; ++k)
    EXPECT_LT(report.residual_norms[k + 1],
              0.5 * report.residual_norms[k] * report.residual_norms[k] + 1e-15);
  EXPECT_LE(report.iterations, 7u);
}

TEST(SolversNewton, PolishesWithTheLastTangent)
{
  unsigned int n_slopes = 0;
  Scalar       problem(
    [](double x) {
      return x * std::exp(x) - 1.;
    },
    [&](double x) {
      ++n_slopes;
      return (1. + x) * std::exp(x);
    },
    1.5);
  const auto report = solve_newton(problem, {});
  ASSERT_TRUE(report.converged);
  EXPECT_EQ(n_slopes, report.iterations); // none for the polish
  ASSERT_GE(report.residual_norms.size(), report.iterations + 2);
  // the tangent is that of the state before: its error, a few times |du| = 7e-5,
  // is the factor by which the residual falls with each polish
  for (std::size_t k = report.iterations + 1; k < report.residual_norms.size(); ++k)
    EXPECT_LT(report.residual_norms[k], 1e-3 * report.residual_norms[k - 1] + 1e-15);
  // the last one leaves round-off: terms of size 1, 1e-13 of them is asked for
  EXPECT_LT(report.residual_norms.back(), 1e-12);
  EXPECT_NEAR(problem.x, 0.567143290409784, 1e-12);

  // a residual that cannot fall: the polish is taken back
  Scalar rough(
    [](double x) {
      return std::abs(x) > 1e-7 ? x : 1e-8;
    },
    [](double) {
      return 1.;
    },
    1.);
  rough.scale            = 1e5; // 1e-8 is not round-off of it, but accurate
  const auto not_smaller = solve_newton(rough, {});
  EXPECT_TRUE(not_smaller.converged);
  EXPECT_EQ(not_smaller.iterations, 2u);
  EXPECT_EQ(not_smaller.residual_norms.size(), not_smaller.iterations + 1);
  EXPECT_NEAR(rough.x, -1e-8, 1e-20); // 1 -> 0 -> -1e-8, tried -2e-8

  // a residual that meets the criterion but is large beside its terms: three
  // iterations more, then it counts as converged all the same
  rough.x          = 1.;
  rough.scale      = 1.;
  const auto large = solve_newton(rough, {});
  EXPECT_TRUE(large.converged);
  EXPECT_EQ(large.iterations, 5u);
}

// A linear solver that leaves just the residual that it may leave: as many
// iterations as with exact solutions, and the books as good
TEST(SolversNewton, LooseLinearSolutionsCostNoIteration)
{
  class Loose : public Scalar
  {
  public:
    using Scalar::Scalar;

    void
    set_linear_tolerance(const double tolerance) override
    {
      tolerances.push_back(tolerance);
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override
    {
      const LinearStatus status = Scalar::solve_correction(norm, keep_tangent);
      correction *= 1. - tolerances.back();
      return status;
    }

    std::vector<double> tolerances;
  };
  const auto f = [](double x) {
    return x * std::exp(x) - 1.;
  };
  const auto slope = [](double x) {
    return (1. + x) * std::exp(x);
  };
  Scalar     exact(f, slope, 1.5);
  Loose      loose(f, slope, 1.5);
  const auto exact_report = solve_newton(exact, {});
  const auto loose_report = solve_newton(loose, {});
  ASSERT_TRUE(loose_report.converged) << loose_report.cause;
  EXPECT_EQ(loose_report.iterations, exact_report.iterations);
  EXPECT_LT(loose_report.residual_norms.back(), 1e-12); // as in the test above
  // what the definition gives for the residuals that there were
  const auto &norms = loose_report.residual_norms;
  ASSERT_GE(loose.tolerances.size(), loose_report.iterations + 1);
  EXPECT_EQ(loose.tolerances[0], 1e-3);
  for (unsigned int k = 1; k < loose_report.iterations; ++k)
    {
      const double needed = std::max(0.1 * std::pow(norms[k] / norms[k - 1], 2),
                                     0.1 * 1e-13 / norms[k]); // of terms of size 1
      EXPECT_NEAR(loose.tolerances[k] / std::min(needed, 1e-3), 1., 1e-9);
    }
}

TEST(SolversNewton, NeedsOneIterationForALinearProblem)
{
  Scalar problem(
    [](double x) {
      return 3. * x - 1.;
    },
    [](double) {
      return 3.;
    },
    100.);
  const auto report = solve_newton(problem, {});
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 1u);
}

TEST(SolversNewton, StopsAtRoundOffOfTheTermsThatCancel)
{
  // terms of 1e6 that cancel: residuals come in steps of 1e-10, so the
  // product of (3.185) can never fall far below its first value
  const double step  = 1e-10;
  const auto   rough = [=](double x) {
    return step * std::round((1e6 * x - 2e6) / step);
  };
  Scalar problem(
    rough,
    [](double) {
      return 0.9e6;
    },
    2. + 3e-15);
  problem.scale     = 1e6;
  const auto report = solve_newton(problem, {});
  EXPECT_TRUE(report.converged) << report.cause;
  EXPECT_LE(report.iterations, 3u);
  // a state in perfect balance is accepted after one look
  Scalar balanced(
    [](double) {
      return 0.;
    },
    [](double) {
      return 1.;
    },
    2.);
  EXPECT_TRUE(solve_newton(balanced, {}).converged);
}

TEST(SolversNewton, HalvesStepsIntoInadmissibleStates)
{
  // from 3, Newton's step for log x leads to 3 - 3 log 3 = -0.3
  Scalar     problem = logarithm(3.);
  const auto report  = solve_newton(problem, {});
  ASSERT_TRUE(report.converged) << report.cause;
  EXPECT_NEAR(problem.x, 1., 1e-6);                        // |r| |du| < 1e-11 of the first
  EXPECT_GT(problem.n_evaluations, report.iterations + 1); // it did try
  EXPECT_NEAR(report.residual_norms[1], std::abs(std::log(3. - 1.5 * std::log(3.))), 1e-14);
}

TEST(SolversNewton, ReportsAStateThatStaysInadmissible)
{
  Scalar problem(
    [](double x) {
      return x;
    },
    [](double) {
      return 1e-3;
    },
    1.);
  problem.lowest    = 0.; // step -1000, halved eight times: -3.9
  const auto report = solve_newton(problem, {});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.cause, "point 7 is inside out (Newton iteration 1)");
}

TEST(SolversNewton, RefusesAnInadmissibleStart)
{
  Scalar     outside = logarithm(-1.);
  const auto report  = solve_newton(outside, {});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 0u);
  EXPECT_EQ(report.cause, "point 7 is inside out before the first Newton iteration");
}

TEST(SolversNewton, SaysWhyItDidNotConverge)
{
  // x^2 + 1 has no root
  Scalar rootless(
    [](double x) {
      return x * x + 1.;
    },
    [](double x) {
      return 2. * x;
    },
    0.8);
  const auto report = solve_newton(rootless, {});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 20u);
  EXPECT_EQ(report.cause.find(
              "no convergence in 20 Newton iterations, residual 1.6e+00 N at first"),
            0u)
    << report.cause; // 0.8^2 + 1 = 1.64

  Scalar unsolvable       = logarithm(2.);
  unsolvable.linear_cause = "singular matrix";
  EXPECT_EQ(solve_newton(unsolvable, {}).cause, "singular matrix (Newton iteration 1)");

  Scalar flat(
    [](double x) {
      return x * x + 1.;
    },
    [](double) {
      return 0.;
    },
    1.);
  EXPECT_NE(solve_newton(flat, {}).cause.find("not finite"), std::string::npos);

  // a wrong slope drives the residual away
  Scalar diverging(
    [](double x) {
      return x;
    },
    [](double) {
      return -1e-4;
    },
    1.);
  EXPECT_NE(solve_newton(diverging, {}).cause.find("grew without bound"), std::string::npos);
}

TEST(SolversNewton, BreaksACycleWithShorterCorrections)
{
  // full corrections of sign(x) sqrt|x| only change the sign of x; so do those
  // of points that yield and unload in turn
  Scalar problem(
    [](double x) {
      return std::copysign(std::sqrt(std::abs(x)), x) + (x > 0. ? 1e-3 * x : 0.);
    },
    [](double x) {
      return 0.5 / std::sqrt(std::abs(x)) + (x > 0. ? 1e-3 : 0.);
    },
    1.);
  const NewtonReport report = solve_newton(problem, NewtonParameters());
  EXPECT_TRUE(report.converged) << report.cause;
  EXPECT_NEAR(problem.x, 0., 1e-8);
  // they are left alone at first: the residual may grow on the way to a solution
  EXPECT_GE(report.residual_norms[2], 0.99 * report.residual_norms[1]);
}

// f = x^3: Newton's method shortens x by 2/3 and the residual by 8/27, so that the criterion,
// (8/27)^k (2/3)^(k-1) < 1e-11, holds at k = 16 first. With a tangent that is ten times too stiff
// the residual of f = x falls by 0.9, in four corrections by 0.66: that is not waited for.
TEST(SolversNewton, GoesOnBeyondItsLimitWhileTheResidualFalls)
{
  for (const unsigned int limit : {20u, 10u, 6u, 5u, 3u})
    {
      Scalar cubic(
        [](double x) {
          return x * x * x;
        },
        [](double x) {
          return 3. * x * x;
        },
        1.);
      cubic.scale = 1e4; // 1e-12 of it is more than what is left
      NewtonParameters parameters;
      parameters.max_iterations = limit;
      const NewtonReport report = solve_newton(cubic, parameters);
      EXPECT_EQ(report.converged, limit >= 6) << limit;
      EXPECT_EQ(report.iterations, limit >= 6 ? 16u : (limit == 5 ? 15u : 3u)) << limit;
    }
  Scalar slow(
    [](double x) {
      return x;
    },
    [](double) {
      return 10.;
    },
    1.);
  const NewtonReport report = solve_newton(slow, {});
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, NewtonParameters().max_iterations);
}
