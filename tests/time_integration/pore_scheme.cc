#include <kedge/time_integration/pore_scheme.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace kedge;

namespace
{
  PoreScheme
  scheme(const SchemeKind kind, const bool carry = true)
  {
    TimeParameters parameters;
    parameters.scheme             = kind;
    parameters.newmark_beta       = 0.3;
    parameters.newmark_gamma      = 0.6;
    parameters.carry_acceleration = carry;
    return PoreScheme(parameters);
  }

  /** Content that drains as m' = -m for a second in @p n steps. */
  double
  drained(const PoreScheme &scheme, const unsigned int n)
  {
    const double dt = 1. / n;
    double       m = 1., rate = scheme.carries_rates ? -1. : 0., change = -rate;
    for (unsigned int k = 0; k < n; ++k)
      {
        // m' = -m at the pressure of balance, m + theta dm here
        const double c  = scheme.content_factor() / dt;
        const double dm = (-m - scheme.known_rate(rate, change, dt)) / (c + scheme.theta);
        if (scheme.carries_rates)
          {
            const double new_rate = scheme.end_rate(dm, rate, change, dt);
            change                = scheme.end_rate_change(dm, rate, change, dt);
            rate                  = new_rate;
          }
        m += dm;
      }
    return m;
  }
} // namespace

TEST(TimePoreScheme, DrainsAsTheExponential)
{
  // errors of first and second order, measured by halving the step
  const auto order = [](const PoreScheme &s) {
    const double exact = std::exp(-1.);
    return std::log2(std::abs(drained(s, 50) - exact) / std::abs(drained(s, 100) - exact));
  };
  EXPECT_NEAR(order(scheme(SchemeKind::quasi_static)), 1., 0.05);
  EXPECT_NEAR(order(scheme(SchemeKind::trapezoidal)), 2., 0.05);
  // gamma != 1/2 does no harm: the equation itself gives m', only m is integrated
  EXPECT_NEAR(order(scheme(SchemeKind::newmark)), 2., 0.05);
  EXPECT_NEAR(order(scheme(SchemeKind::midpoint)), 2., 0.05);
}

TEST(TimePoreScheme, PrintedFormConsolidatesTooSlowly)
{
  // without the carried rates, at beta/gamma of the speed: exp(-1/2), not exp(-1)
  EXPECT_NEAR(drained(scheme(SchemeKind::trapezoidal, false), 2000), std::exp(-0.5), 1e-3);
}
