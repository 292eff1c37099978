// Tresca's and von Mises' clays: against the conditions that define the return,
// and their slopes against differences of 113-bit evaluations.
#include <kedge/base/pack.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace kedge
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;
} // namespace kedge

#include "plastic_checks.h"

#include <kedge/materials/tresca.h>
#include <kedge/materials/undrained_von_mises.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  /** G = 1, so that stresses are of the size of strains. */
  MaterialParameters
  clay(const double remoulded, const double rate_coefficient = 0.)
  {
    MaterialParameters parameters;
    parameters.young_modulus      = 2.6;
    parameters.poisson_ratio      = 0.3;
    parameters.undrained_strength = 0.1;
    parameters.remoulded_strength = remoulded;
    parameters.softening_strain   = 2.;
    parameters.rate_coefficient   = rate_coefficient;
    parameters.reference_rate     = 1e-3;
    return parameters;
  }

  template <typename Law>
  class MaterialsUndrainedClay : public testing::Test
  {};
  using Laws = testing::Types<Tresca, UndrainedVonMises>;

  /** Calls check(law, step, response) for random steps, and says how many yielded. */
  template <class Law, typename Check>
  void
  for_random_steps(const Check &check)
  {
    std::mt19937                           generator(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int                                    n_plastic = 0, n_steps = 0;
    for (const double remoulded : {1., 0.25})
      for (int repeat = 0; repeat < 150; ++repeat)
        {
          // rates of xi up to 100 times the reference in one half, up to 1/100 of it in a tenth
          const Law          law(clay(remoulded, repeat % 2 == 0 ? 0. : 0.1));
          PrincipalStep<Law> step;
          step.history = {0.3,
                          0.5 * (1. + uniform(generator)),
                          0.1,
                          repeat % 10 == 9 ? 1e4 : 1. + 0.5 * uniform(generator)};
          for (int i = 0; i < 3; ++i)
            {
              step.strain[i]    = 0.03 * uniform(generator);
              step.increment[i] = 0.12 * uniform(generator);
            }
          // near and on the edges too: two strains apart by little, or equal
          if (repeat % 4 == 1)
            step.increment[1] = step.strain[0] + step.increment[0] - step.strain[1] + 1e-3;
          if (repeat % 4 == 2)
            step.increment[2] = step.strain[1] + step.increment[1] - step.strain[2];
          const auto response = law.respond(step.strain, step.increment, step.history);
          ASSERT_TRUE(response.valid);
          check(law, step, response);
          n_plastic += response.dissipation > 0.;
          ++n_steps;
        }
    EXPECT_GT(n_plastic, 0.3 * n_steps);
    EXPECT_LT(n_plastic, 0.95 * n_steps);
  }

  /** The largest shear of the stresses, or |s|/sqrt(2). */
  double
  shear(const Tresca &, const double (&tau)[3])
  {
    return 0.5 * (std::max({tau[0], tau[1], tau[2]}) - std::min({tau[0], tau[1], tau[2]}));
  }

  double
  shear(const UndrainedVonMises &, const double (&tau)[3])
  {
    return std::sqrt(0.5) * deviator_norm(tau);
  }
} // namespace

TYPED_TEST_SUITE(MaterialsUndrainedClay, Laws);

TYPED_TEST(MaterialsUndrainedClay, EndsOnTheSurfaceThatHasSoftened)
{
  for_random_steps<TypeParam>([](const auto &law, const auto &step, const auto &r) {
    const auto   end   = law.updated(r, step.history);
    const double ratio = (end.plastic_shear_strain - step.history.plastic_shear_strain) /
                         step.history.time_step / 1e-3;
    const double s_u = 0.1 *
                       (1. + law.strength.rate_coefficient * std::log10(std::max(ratio, 1.))) *
                       (law.strength.remoulded + (1. - law.strength.remoulded) *
                                                   std::exp(-3. * end.plastic_shear_strain / 2.));
    // stresses of order 0.1 with a few roundings; those of the ratio come from a difference
    if (r.dissipation > 0.)
      EXPECT_NEAR(shear(law, r.kirchhoff_stress),
                  s_u,
                  law.strength.rate_coefficient > 0. ? 1e-13 : 1e-15);
    else
      EXPECT_LE(shear(law, r.kirchhoff_stress), s_u * (1. + 1e-15));
    // dD = s_u d xi >= 0, no change of volume, and no strength of place that changes
    EXPECT_NEAR(r.dissipation,
                s_u * r.softening_strain,
                law.strength.rate_coefficient > 0. ? 1e-14 : 1e-16);
    EXPECT_GE(r.dissipation, 0.);
    EXPECT_NEAR(r.plastic_strain[0] + r.plastic_strain[1] + r.plastic_strain[2], 0., 1e-16);
    EXPECT_EQ(end.undrained_strength, 0.1);
    EXPECT_EQ(end.plastic_shear_strain, step.history.plastic_shear_strain + r.softening_strain);
    // associated: no admissible stress does more work with the plastic strain
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    for (int trial = 0; trial < 20; ++trial)
      {
        double other[3], work = 0.;
        for (double &value : other)
          value = uniform(generator);
        if (shear(law, other) > s_u)
          continue;
        for (int i = 0; i < 3; ++i)
          work += other[i] * r.plastic_strain[i];
        EXPECT_LE(work, r.dissipation + 1e-16);
      }
  });
}

TYPED_TEST(MaterialsUndrainedClay, LanesAnswerAsPointsDo)
{
  // lanes that are elastic, on faces and on edges at once
  std::vector<PrincipalStep<TypeParam>> steps;
  for_random_steps<TypeParam>([&](const auto &law, const auto &step, const auto &) {
    if (law.strength.rate_coefficient > 0. && law.strength.remoulded < 1.)
      steps.push_back(step);
  });
  expect_lanes_alike(TypeParam(clay(0.25, 0.1)), steps, 1e-12);
}

TYPED_TEST(MaterialsUndrainedClay, FasterShearMeetsMoreStrength)
{
  // perfect plasticity: R = 1 + .1 log10(rate/reference) = 1, 1.1, 1.3 at ratios 1, 10, 1000
  const TypeParam law(clay(1., 0.1));
  const double    on_surface[3] = {0.05, 0., -0.05}; // tau_1 - tau_3 = 2 s_u at G = 1
  for (const auto &[ratio, factor] : {std::pair{1., 1.}, {10., 1.1}, {1000., 1.3}, {1e-3, 1.}})
    {
      // d xi = the increment of eps_1 - eps_3 less the elastic part that the growth of s_u takes
      const double growth = 0.02, dt = growth / (1e-3 * ratio);
      const double elastic = 0.1 * (factor - 1.) / 2.; // of each of eps_1, -eps_3
      const double step[3] = {0.5 * growth + elastic, 0., -0.5 * growth - elastic};
      const auto   r       = law.respond(on_surface, step, HistoryOf<TypeParam>{0., 0., 0.1, dt});
      EXPECT_NEAR(shear(law, r.kirchhoff_stress), 0.1 * factor, 1e-14);
      EXPECT_NEAR(r.softening_strain, growth, 1e-13);
    }
}

TYPED_TEST(MaterialsUndrainedClay, SlopesAreThoseOf113BitDifferences)
{
  for_random_steps<TypeParam>([](const auto &law, const auto &step, const auto &) {
    expect_slopes(law, step, 1e-13);
  });
}

TYPED_TEST(MaterialsUndrainedClay, SofteningFasterThanTheElasticStressFallsHasNoAnswer)
{
  // 2 G + 2 ds_u/dxi <= 0, Tresca 3 G + 4 ds_u/dxi: s_u0 (1 - d) 3/xi_95 = 60 G
  MaterialParameters brittle = clay(0.5);
  brittle.softening_strain   = 0.0025;
  const TypeParam law(brittle);
  const double    nothing[3] = {0, 0, 0}, little[3] = {0.01, 0., -0.01}, step[3] = {0.1, 0., -0.1};
  const HistoryOf<TypeParam> intact{0., 0., 0.1};
  EXPECT_TRUE(law.respond(nothing, little, intact).valid);
  EXPECT_FALSE(law.respond(nothing, step, intact).valid);
}
