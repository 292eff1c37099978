#include <kedge/materials/material.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace kedge;

namespace
{
  Hencky
  soft()
  {
    MaterialParameters parameters;
    parameters.young_modulus = 1e4;
    parameters.poisson_ratio = 0.3;
    return Hencky(parameters);
  }
} // namespace

TEST(MaterialsHencky, UniaxialStressObeysYoungAndPoisson)
{
  // eps = (e, -nu e, -nu e) must need tau = (E e, 0, 0) and store E e^2 / 2
  const double e           = 0.2;
  const double strain[3]   = {e, -0.3 * e, -0.3 * e};
  const double nothing[3]  = {0, 0, 0};
  const auto   all_at_once = soft().respond(nothing, strain);
  const auto   stay        = soft().respond(strain, nothing);
  // a few roundings of 1e-16 times K eps
  EXPECT_NEAR(all_at_once.kirchhoff_stress[0], 1e4 * e, 1e-11);
  EXPECT_NEAR(all_at_once.kirchhoff_stress[1], 0., 1e-11);
  EXPECT_NEAR(all_at_once.kirchhoff_stress[2], 0., 1e-11);
  EXPECT_NEAR(all_at_once.work_increment, 0.5 * 1e4 * e * e, 1e-12);
  EXPECT_NEAR(soft().energy(strain), 0.5 * 1e4 * e * e, 1e-12);
  EXPECT_NEAR(stay.kirchhoff_stress[0], 1e4 * e, 1e-11);
  EXPECT_EQ(stay.work_increment, 0.);
}

TEST(MaterialsHencky, WorkIsTheDifferenceOfEnergiesAndItsSlopeTheStress)
{
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Hencky                           material = soft();
  for (int repeat = 0; repeat < 50; ++repeat)
    {
      double strain[3], increment[3], end[3];
      for (int i = 0; i < 3; ++i)
        {
          strain[i]    = 0.3 * uniform(generator);
          increment[i] = 0.1 * uniform(generator);
          end[i]       = strain[i] + increment[i];
        }
      const auto response = material.respond(strain, increment);
      // energies of order 1e3 with round-off of 1e-16
      EXPECT_NEAR(response.work_increment, material.energy(end) - material.energy(strain), 1e-11);

      // dPsi = tau . deps exactly, for any tiny increment: tiny^2 is below round-off
      double tiny[3];
      for (int i = 0; i < 3; ++i)
        tiny[i] = 1e-17 * uniform(generator);
      const auto step = material.respond(strain, tiny);
      double     work = 0., scale = 0.;
      for (int i = 0; i < 3; ++i)
        {
          work += step.kirchhoff_stress[i] * tiny[i];
          scale += std::abs(step.kirchhoff_stress[i] * tiny[i]);
        }
      EXPECT_NEAR(step.work_increment, work, 1e-14 * scale + 1e-27);

      // tau is linear in eps, so differences of it are the tangent up to round-off
      for (int j = 0; j < 3; ++j)
        {
          double probe[3]  = {0, 0, 0};
          probe[j]         = 0.25;
          const auto moved = material.respond(strain, probe);
          const auto still = material.respond(strain, {0., 0., 0.});
          for (int i = 0; i < 3; ++i)
            EXPECT_NEAR((moved.kirchhoff_stress[i] - still.kirchhoff_stress[i]) / 0.25,
                        material.tangent(still, i, j),
                        1e-10);
        }
    }
}

TEST(MaterialsHencky, ModuliAreThoseOfTheTextbook)
{
  // E = 1e4, nu = 0.3: K = E/(3(1-2nu)), G = E/(2(1+nu)), M = E(1-nu)/((1+nu)(1-2nu))
  EXPECT_NEAR(soft().bulk_modulus, 8333.333333333333, 1e-9);
  EXPECT_NEAR(soft().shear_modulus, 3846.153846153846, 1e-9);
  EXPECT_NEAR(soft().p_wave_modulus(), 13461.53846153846, 1e-9);
  EXPECT_NEAR(p_wave_modulus(Material(soft())), 13461.53846153846, 1e-9);
}
