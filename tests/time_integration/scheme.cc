// The schemes on systems of one degree of freedom with closed solutions.
#include <kedge/time_integration/scheme.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace kedge;

namespace
{
  TimeParameters
  parameters_of(const SchemeKind kind, const bool carry = true)
  {
    TimeParameters parameters;
    parameters.scheme             = kind;
    parameters.carry_acceleration = carry;
    return parameters;
  }

  const std::vector<SchemeKind> dynamic_kinds = {SchemeKind::clc_midpoint,
                                                 SchemeKind::midpoint,
                                                 SchemeKind::trapezoidal,
                                                 SchemeKind::newmark,
                                                 SchemeKind::generalised_alpha};

  struct State
  {
    double x = 0., v = 0., a = 0.;
  };

  /** One step of x'' + omega^2 x = g: linear in u, solved at once. */
  State
  step(const Scheme &scheme,
       const State  &state,
       const double  omega,
       const double  g,
       const double  dt)
  {
    const double a_n       = scheme.carries_acceleration ? state.a : 0.;
    const double at_rest   = scheme.equilibrium_acceleration(0., state.v, a_n, dt);
    const double stiffness = scheme.alpha_f * omega * omega;
    const double u =
      (g - omega * omega * state.x - at_rest) / (scheme.inertia_coefficient(dt) + stiffness);
    return {state.x + u,
            scheme.end_velocity(u, state.v, a_n, dt),
            scheme.end_acceleration(u, state.v, a_n, dt)};
  }

  /** Error at t = 2 of x(0) = 1, v(0) = 0.5, omega = 3. */
  double
  oscillator_error(const Scheme &scheme, const int n_steps)
  {
    const double omega = 3., end = 2., dt = end / n_steps;
    State        state{1., 0.5, -9.};
    for (int i = 0; i < n_steps; ++i)
      state = step(scheme, state, omega, 0., dt);
    const double x = std::cos(omega * end) + 0.5 / omega * std::sin(omega * end);
    const double v = 0.5 * std::cos(omega * end) - omega * std::sin(omega * end);
    return std::hypot(omega * (state.x - x), state.v - v);
  }
} // namespace

TEST(TimeIntegrationScheme, CoefficientsAreThoseOfTable34)
{
  const Scheme alpha(parameters_of(SchemeKind::generalised_alpha)); // rho = 0.818
  // alpha_m = (2 - rho)/(1 + rho), alpha_f = 1/(1 + rho), then beta and gamma
  EXPECT_NEAR(alpha.alpha_m, 0.650165016501650, 1e-14);
  EXPECT_NEAR(alpha.alpha_f, 0.550055005500550, 1e-14);
  EXPECT_NEAR(alpha.beta, 0.302560509076210, 1e-14);
  EXPECT_NEAR(alpha.gamma, 0.600110011001100, 1e-14);
  const Scheme middle(parameters_of(SchemeKind::midpoint));
  EXPECT_EQ(middle.alpha_m, 0.5);
  EXPECT_EQ(middle.alpha_f, 0.5);
  EXPECT_FALSE(middle.conserving_stress);
  const Scheme clc(parameters_of(SchemeKind::clc_midpoint));
  EXPECT_TRUE(clc.conserving_stress);
  EXPECT_FALSE(clc.carries_acceleration); // a_n drops out of the mid-point
  TimeParameters linear = parameters_of(SchemeKind::newmark);
  linear.newmark_beta   = 1. / 6.;
  EXPECT_EQ(Scheme(linear).beta, 1. / 6.);
  EXPECT_EQ(Scheme(linear).gamma, 0.5);
  EXPECT_FALSE(Scheme(parameters_of(SchemeKind::quasi_static)).dynamic);
  EXPECT_EQ(Scheme(parameters_of(SchemeKind::quasi_static)).alpha_f, 1.);
  const Scheme conserving(parameters_of(SchemeKind::clc_quasi_static));
  EXPECT_FALSE(conserving.dynamic);
  EXPECT_TRUE(conserving.conserving_stress);
  EXPECT_EQ(conserving.alpha_f, 0.5);
}

TEST(TimeIntegrationScheme, KinematicsOfTable33WithoutItsMisprints)
{
  // CLC: v_{n+1} = 2u/dt - v_n (printed without the 2), a = 4/dt^2 (u - dt v_n),
  // of which equilibrium takes the half
  const Scheme clc(parameters_of(SchemeKind::clc_midpoint));
  const double u = 0.3, v = 0.7, dt = 0.1;
  EXPECT_NEAR(clc.end_velocity(u, v, 123., dt), 2. * u / dt - v, 1e-14);
  EXPECT_NEAR(clc.end_acceleration(u, v, 0., dt), 4. / (dt * dt) * (u - dt * v), 1e-12);
  EXPECT_NEAR(clc.equilibrium_acceleration(u, v, 123., dt), 2. / (dt * dt) * (u - dt * v), 1e-12);

  // the family with a_n = 0: v_{n+1} = gamma/(beta dt) u + v_n (1 - gamma/beta), as printed
  const Scheme alpha(parameters_of(SchemeKind::generalised_alpha, false));
  EXPECT_FALSE(alpha.carries_acceleration);
  EXPECT_NEAR(alpha.end_velocity(u, v, 0., dt),
              alpha.gamma / (alpha.beta * dt) * u + v * (1. - alpha.gamma / alpha.beta),
              1e-14);
  EXPECT_NEAR(alpha.equilibrium_acceleration(u, v, 0., dt),
              alpha.alpha_m / (alpha.beta * dt * dt) * (u - dt * v),
              1e-12);
  // d a_m / du is the inertia's part of the tangent
  for (const SchemeKind kind : dynamic_kinds)
    {
      const Scheme scheme(parameters_of(kind));
      EXPECT_NEAR(scheme.equilibrium_acceleration(u + 1., v, 2., dt) -
                    scheme.equilibrium_acceleration(u, v, 2., dt),
                  scheme.inertia_coefficient(dt),
                  1e-11);
      EXPECT_NEAR(scheme.load_time(5., 0.1), 5. + 0.1 * scheme.alpha_f, 1e-15);
    }
}

TEST(TimeIntegrationScheme, FreeFallIsExactIfTheAccelerationIsCarried)
{
  const double g = -10., dt = 0.05;
  for (const SchemeKind kind : dynamic_kinds)
    {
      SCOPED_TRACE(static_cast<int>(kind));
      const Scheme scheme(parameters_of(kind));
      State        state{0., 3., g};
      for (int i = 0; i < 20; ++i)
        state = step(scheme, state, 0., g, dt);
      // x = 3 - g/2 at t = 1, v = 3 - g; a constant acceleration is in every scheme's reach
      EXPECT_NEAR(state.x, 3. - 5., 1e-12);
      EXPECT_NEAR(state.v, 3. - 10., 1e-12);
    }
}

TEST(TimeIntegrationScheme, FreeFallAsPrintedFallsAtGamma)
{
  // a_n = 0 at each step: v = g t gamma/alpha_m, errata of Table 3.3
  TimeParameters third = parameters_of(SchemeKind::newmark, false);
  third.newmark_gamma  = 1. / 3.;
  third.newmark_beta   = 1. / 6.;
  const Scheme alpha(parameters_of(SchemeKind::generalised_alpha, false));
  const std::vector<std::pair<Scheme, double>> cases = {
    {Scheme(parameters_of(SchemeKind::trapezoidal, false)), -5.},
    {Scheme(third), -10. / 3.},
    {alpha, -10. * alpha.gamma / alpha.alpha_m},
    {Scheme(parameters_of(SchemeKind::midpoint, false)), -10.}};
  for (const auto &[scheme, expected] : cases)
    {
      State state;
      for (int i = 0; i < 20; ++i)
        state = step(scheme, state, 0., -10., 0.05);
      EXPECT_NEAR(state.v, expected, 1e-12);
    }
}

TEST(TimeIntegrationScheme, OscillatorIsOfSecondOrder)
{
  TimeParameters linear       = parameters_of(SchemeKind::newmark);
  linear.newmark_beta         = 1. / 6.;
  std::vector<Scheme> schemes = {Scheme(linear)};
  for (const SchemeKind kind : dynamic_kinds)
    schemes.emplace_back(parameters_of(kind));
  for (const Scheme &scheme : schemes)
    {
      const double coarse = oscillator_error(scheme, 200), fine = oscillator_error(scheme, 400);
      EXPECT_LT(fine, 1e-3);
      EXPECT_NEAR(std::log2(coarse / fine), 2., 0.05); // the next order contributes dt
    }
  // forgetting the acceleration leaves the first order, or less
  const Scheme printed(parameters_of(SchemeKind::trapezoidal, false));
  EXPECT_GT(oscillator_error(printed, 400), 0.1);
}

TEST(TimeIntegrationScheme, MidpointAndTrapezoidalKeepTheOscillatorsEnergy)
{
  const double omega = 3., dt = 0.2;
  for (const SchemeKind kind :
       {SchemeKind::clc_midpoint, SchemeKind::midpoint, SchemeKind::trapezoidal})
    {
      const Scheme scheme(parameters_of(kind));
      State        state{1., 0.5, -9.};
      const double before = 0.5 * (state.v * state.v + omega * omega * state.x * state.x);
      for (int i = 0; i < 1000; ++i)
        state = step(scheme, state, omega, 0., dt);
      const double after = 0.5 * (state.v * state.v + omega * omega * state.x * state.x);
      EXPECT_NEAR(after, before, 1e-11); // 1000 steps of round-off of 1e-15
    }
}

TEST(TimeIntegrationScheme, GeneralisedAlphaDampsTheHighestFrequenciesByRho)
{
  // for omega dt -> infinity all three eigenvalues of a step are -rho: their product is -rho^3
  const Scheme scheme(parameters_of(SchemeKind::generalised_alpha));
  const double dt = 0.1, omega = 1e5 / dt;
  double       M[3][3];
  for (int j = 0; j < 3; ++j)
    {
      const State end =
        step(scheme,
             State{j == 0 ? 1. : 0., j == 1 ? 1. / dt : 0., j == 2 ? 1. / (dt * dt) : 0.},
             omega,
             0.,
             dt);
      M[0][j] = end.x;
      M[1][j] = end.v * dt;
      M[2][j] = end.a * dt * dt;
    }
  const double determinant = M[0][0] * (M[1][1] * M[2][2] - M[1][2] * M[2][1]) -
                             M[0][1] * (M[1][0] * M[2][2] - M[1][2] * M[2][0]) +
                             M[0][2] * (M[1][0] * M[2][1] - M[1][1] * M[2][0]);
  EXPECT_NEAR(determinant, -std::pow(0.818, 3), 1e-8); // (omega dt)^-2 = 1e-10
  EXPECT_NEAR(M[0][0] + M[1][1] + M[2][2], -3. * 0.818, 1e-8);
}
