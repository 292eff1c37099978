// Drucker-Prager and Mohr-Coulomb: against tables of another program, the
// conditions that define the return, and differences of 113-bit evaluations.
#include <kedge/base/pack.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace kedge
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;
} // namespace kedge

#include "plastic_checks.h"

#include <kedge/materials/drucker_prager.h>
#include <kedge/materials/mohr_coulomb.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  /** K 20 MPa, G 12 MPa over @p unit. */
  MaterialParameters
  sand(const double unit)
  {
    const double       K = 20e6 / unit, G = 12e6 / unit;
    MaterialParameters parameters;
    parameters.young_modulus  = 9. * K * G / (3. * K + G);
    parameters.poisson_ratio  = (3. * K - 2. * G) / (6. * K + 2. * G);
    parameters.friction_angle = 30.;
    parameters.dilation_angle = 10.;
    parameters.cohesion       = 10e3 / unit;
    parameters.apex_rounding  = 0.1;
    return parameters;
  }

  struct Row
  {
    double strain[3], stress[3], dissipation;
  };

  template <class Law>
  void
  expect_row(const Law &law, const Row &row)
  {
    const double nothing[3] = {0., 0., 0.};
    const auto   r          = law.respond(nothing, row.strain, HistoryOf<Law>{0., 0., 10e3, 1.});
    ASSERT_TRUE(r.valid);
    // to the digits printed
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(r.kirchhoff_stress[i] / row.stress[i], 1., 1e-8) << row.strain[0] << ' ' << i;
    EXPECT_NEAR(r.dissipation / row.dissipation, 1., 5e-6) << row.strain[0];
  }

  /** Random steps in all regimes with G = 1: elastic, on the cone or faces, edges, tension. */
  template <class Law, typename Check>
  void
  for_random_steps(const Check &check)
  {
    std::mt19937                           generator(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int                                    n_plastic = 0, n_steps = 0;
    for (const double dilation : {30., 10., 0.})
      for (const double mean : {-0.02, 0., 0.02})
        for (int repeat = 0; repeat < 60; ++repeat)
          {
            MaterialParameters parameters = sand(12e6);
            parameters.dilation_angle     = dilation;
            parameters.tension_cut_off    = repeat % 2 == 0 ? 0.8 : 0.3;
            const Law          law(parameters);
            PrincipalStep<Law> step;
            // a soft place, of which the shear strength is as large as elsewhere over its G
            const double stiffness = repeat % 3 == 0 ? 0.25 : 1.;
            step.history = {0.1, 0.2, stiffness * 0.005 * (1.2 + uniform(generator)), stiffness};
            // torn open, to be closed in part or wholly where it is compressed
            if (repeat % 4 == 1)
              step.history.opening = 0.04 * (1. + uniform(generator));
            for (int i = 0; i < 3; ++i)
              {
                step.strain[i]    = 2e-3 * uniform(generator) + 0.2 * mean;
                step.increment[i] = 0.02 * uniform(generator) + mean;
              }
            if (repeat % 5 == 1) // near an edge, and with two strains equal
              step.increment[1] = step.strain[0] + step.increment[0] - step.strain[1] + 1e-4;
            if (repeat % 5 == 2)
              step.increment[2] = step.strain[1] + step.increment[1] - step.strain[2];
            const auto response = law.respond(step.strain, step.increment, step.history);
            ASSERT_TRUE(response.valid);
            check(law, step, response);
            n_plastic += response.dissipation > 0.;
            ++n_steps;
          }
    EXPECT_GT(n_plastic, 0.5 * n_steps);
    EXPECT_LT(n_plastic, 0.98 * n_steps);
  }

  /** The largest of the functions that must not be positive [of G = 1]. */
  double
  beyond(const DruckerPrager &law, const double c, const double (&tau)[3])
  {
    const double k = law.cone.strength * c, e = law.rounding * k;
    const double P = (tau[0] + tau[1] + tau[2]) / 3., J = 0.5 * std::pow(deviator_norm(tau), 2);
    return std::max(3. * law.cone.friction * P + std::sqrt(J + e * e) - k,
                    P - law.cut_off * (k - e) / (3. * law.cone.friction));
  }

  double
  beyond(const MohrCoulomb &law, const double c, const double (&tau)[3])
  {
    const double high = std::max({tau[0], tau[1], tau[2]}),
                 low  = std::min({tau[0], tau[1], tau[2]});
    return std::max((1. + law.sin_friction) * high - (1. - law.sin_friction) * low -
                      2. * c * law.cos_friction,
                    high - law.cut_off * c * law.cos_friction / law.sin_friction);
  }

  template <typename Law>
  class MaterialsFrictional : public testing::Test
  {};
  using Laws = testing::Types<DruckerPrager, MohrCoulomb>;
} // namespace

TYPED_TEST_SUITE(MaterialsFrictional, Laws);

TYPED_TEST(MaterialsFrictional, EndsWithinTheSurfaceAndDissipates)
{
  for_random_steps<TypeParam>([](const auto &law, const auto &step, const auto &r) {
    // stresses of order 0.05 and, in the return, tractions of the trial with a few roundings
    EXPECT_LE(beyond(law, step.history.cohesion, r.kirchhoff_stress), 2e-15);
    if (r.dissipation > 0. && step.history.opening == 0.) // else it may just close
      {
        EXPECT_NEAR(beyond(law, step.history.cohesion, r.kirchhoff_stress), 0., 2e-15);
      }
    EXPECT_GE(r.dissipation, -1e-18);
    const auto end = law.updated(r, step.history);
    EXPECT_EQ(end.cohesion, step.history.cohesion);
    EXPECT_DOUBLE_EQ(end.plastic_volume_strain,
                     step.history.plastic_volume_strain + r.plastic_strain[0] +
                       r.plastic_strain[1] + r.plastic_strain[2]);
  });
}

// elastic, on faces, edges, corners and torn at once
TYPED_TEST(MaterialsFrictional, LanesAnswerAsPointsDo)
{
  std::vector<PrincipalStep<TypeParam>> steps;
  for_random_steps<TypeParam>([&](const auto &, const auto &step, const auto &) {
    steps.push_back(step);
  });
  for (const double cut_off : {0.3, 0.8})
    {
      MaterialParameters parameters = sand(12e6);
      parameters.tension_cut_off    = cut_off;
      expect_lanes_alike(TypeParam(parameters), steps, 1e-12);
    }
}

TYPED_TEST(MaterialsFrictional, SlopesAreThoseOf113BitDifferences)
{
  // the condition of a small pivot or of a cone near its apex costs some digits
  for_random_steps<TypeParam>([](const auto &law, const auto &step, const auto &) {
    expect_slopes(law, step, 1e-8);
  });
}

TYPED_TEST(MaterialsFrictional, StiffnessOfPlaceIsThatOfTheModuli)
{
  // a quarter of the stiffness of the place, or of both moduli: the same
  for_random_steps<TypeParam>([](const auto &law, const auto &step, const auto &) {
    MaterialParameters parameters = sand(12e6);
    parameters.dilation_angle     = 10.;
    parameters.tension_cut_off    = law.cut_off;
    const TypeParam of_place(parameters);
    parameters.young_modulus *= 0.25;
    const TypeParam soft(parameters);
    auto            history = step.history;
    history.stiffness       = 0.25;
    const auto   r          = of_place.respond(step.strain, step.increment, history);
    const double energy     = of_place.energy(step.strain, history);
    history.stiffness       = 1.;
    const auto expected     = soft.respond(step.strain, step.increment, history);
    EXPECT_NEAR(energy, soft.energy(step.strain, history), 1e-16);
    EXPECT_NEAR(r.work_increment, expected.work_increment, 1e-16);
    EXPECT_NEAR(r.dissipation, expected.dissipation, 1e-16);
    for (int i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(r.kirchhoff_stress[i], expected.kirchhoff_stress[i], 1e-15);
        EXPECT_NEAR(of_place.work_slope(r, i), soft.work_slope(expected, i), 1e-14);
        for (int j = 0; j < 3; ++j)
          EXPECT_NEAR(r.tangent[i][j], expected.tangent[i][j], 1e-13);
      }
  });
}

TYPED_TEST(MaterialsFrictional, WhatWasTornOpenClosesBeforeItBearsPressure)
{
  MaterialParameters parameters = sand(12e6);
  parameters.tension_cut_off    = 0.5;
  const TypeParam      law(parameters);
  HistoryOf<TypeParam> history;
  history.cohesion     = 1e-3;
  double     strain[3] = {0., 0., 0.};
  double     total     = 0.;
  const auto go        = [&](const double volume) {
    const double increment[3] = {volume / 3., volume / 3., volume / 3.};
    const auto   r            = law.respond(strain, increment, history);
    EXPECT_TRUE(r.valid);
    EXPECT_GE(r.dissipation, -1e-16);
    for (int i = 0; i < 3; ++i)
      strain[i] += increment[i] - law.plastic_increment(r, i);
    history = law.updated(r, history);
    total += volume;
    return r.kirchhoff_stress[0];
  };
  const double tension = go(0.3); // P_t
  EXPECT_GT(tension, 0.);
  EXPECT_NEAR(go(0.1), tension, 1e-15);
  EXPECT_NEAR(history.opening, total - tension / law.bulk_modulus, 1e-15);
  EXPECT_NEAR(go(-0.1), 0., 1e-15); // closes without pressure
  EXPECT_NEAR(history.opening, total, 1e-15);
  EXPECT_NEAR(go(-0.25), 0., 1e-15);
  // what is left closes, and the rest is elastic: no volume was gained
  EXPECT_NEAR(go(-0.06) / (law.bulk_modulus * -0.01), 1., 1e-12);
  EXPECT_EQ(history.opening, 0.);
  EXPECT_NEAR(total, -0.01, 1e-15);
}

TEST(MaterialsDruckerPrager, FollowsTheTableOfAnotherProgram)
{
  MaterialParameters parameters = sand(1.);
  parameters.tension_cut_off    = 0.8;
  const DruckerPrager law(parameters);
  EXPECT_NEAR(law.cone.friction, .162790788, 5e-10);
  EXPECT_NEAR(law.cone.dilation, .057594004, 5e-10);
  EXPECT_NEAR(law.cone.strength * 10e3, 8458.857457, 5e-7);
  for (const Row &row :
       std::vector<Row>{{{1e-3, -2e-4, -2.2e-3}, {-10279.0907, -28225.1998, -58135.3817}, 22.6722},
                        {{1.2e-3, 1e-3, .8e-3}, {14683.0441, 12470.7658, 10258.4875}, 30.1134},
                        {{3e-3, 0, -1e-3}, {14950.5021, 11762.2697, 10699.5256}, 25.9681}})
    expect_row(law, row);
  parameters.tension_cut_off = 1.;
  const DruckerPrager whole(parameters);
  for (const Row &row :
       std::vector<Row>{{{1e-3, -1e-4, -3e-4}, {13255.4950, 6487.83811, 5257.35504}, 6.01146},
                        {{1.2e-3, 1e-3, .8e-3}, {15613.8225, 15587.6269, 15561.4314}, 34.6246}})
    expect_row(whole, row);
}

TEST(MaterialsDruckerPrager, ConesBearWhatMohrCoulombDoes)
{
  // uniaxial triaxial compression -2 c cos/(1 - sin), extension 2 c cos/(1 + sin)
  const double sine = 0.5, cosine = std::sqrt(0.75), c = 10e3;
  for (const bool compression : {true, false})
    {
      MaterialParameters parameters = sand(1.);
      parameters.cone_match         = compression ? ConeMatch::compression : ConeMatch::extension;
      const MatchedCone cone(parameters);
      const double      stress =
        compression ? -2. * c * cosine / (1. - sine) : 2. * c * cosine / (1. + sine);
      EXPECT_NEAR(cone.friction * stress + std::abs(stress) / std::sqrt(3.),
                  cone.strength * c,
                  1e-8);
    }
}

TEST(MaterialsMohrCoulomb, FollowsTheTableOfAnotherProgram)
{
  const MohrCoulomb law(sand(1.));
  for (const Row &row : std::vector<Row>{
         {{1e-3, -2e-4, -2.2e-3}, {-9031.80487, -23692.0589, -61736.4307}, 20.2882301},
         {{1e-3, -2.15e-3, -2.2e-3}, {-19082.1921, -91887.5924, -91887.5924}, 4.77190758},
         {{1e-3, .9e-3, -2.2e-3}, {-1368.44886, -1368.44886, -38746.3627}, 34.2730389},
         {{2e-3, 1.8e-3, 1.5e-3}, {17320.5081, 17320.5081, 17320.5081}, 76.7986928}})
    expect_row(law, row);
  const double nothing[3] = {0., 0., 0.}, strain[3] = {1e-3, -2e-4, -2.2e-3};
  const auto   r = law.respond(nothing, strain, HistoryOf<MohrCoulomb>{0., 0., 10e3, 1.});
  const double expected[3][3] = {{8449058.29, 5112264.57, 12000000},
                                 {8449058.29, 35112264.57, 12000000},
                                 {25347174.88, 15336793.72, 36000000}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(law.tangent(r, i, j), expected[i][j], 0.01);
}
