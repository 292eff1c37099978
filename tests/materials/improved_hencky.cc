#include "soils.h"

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  ImprovedHencky
  skeleton()
  {
    return ImprovedHencky(soil());
  }

  /** P of the undeformed skeleton compressed elastically to a volume strain. */
  double
  pressure_at(const double volume_strain)
  {
    const double third        = volume_strain / 3.;
    const double nothing[3]   = {0, 0, 0};
    const double increment[3] = {third, third, third};
    const auto   response     = skeleton().respond(nothing, increment, {});
    return response.valid ? pressure_of(response.kirchhoff_stress) : HUGE_VAL;
  }
} // namespace

TEST(MaterialsImprovedHencky, SmallStrainsAreThoseOfTheOriginal)
{
  // K~ = n_0 K_0, so the two differ by the order of the strain: 1e-9 of 1e-9
  const ImprovedHencky law        = skeleton();
  const double         nothing[3] = {0, 0, 0}, strain[3] = {1e-9, -2e-9, -0.5e-9};
  const auto           improved = law.respond(nothing, strain, {});
  const auto           original = law.original.respond(nothing, strain);
  EXPECT_NEAR(law.bulk_modulus, 30e6, 1e-7);
  EXPECT_NEAR(law.bulk_parameter, 6e6, 1e-8);
  for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(improved.kirchhoff_stress[i], original.kirchhoff_stress[i], 1e-9);
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(law.tangent(improved, i, j) / law.original.tangent(original, i, j), 1., 1e-7);
    }
}

TEST(MaterialsImprovedHencky, StressIsTheSlopeOfTheEnergy)
{
  // with the printed (C.5) the pressure would be half of it
  std::mt19937         generator(1);
  const ImprovedHencky law = skeleton();
  for (int repeat = 0; repeat < 50; ++repeat)
    {
      const SoilStep                        step    = random_step(generator, 0.02, 0.005);
      const ImprovedHencky::History<double> history = step.history;
      const auto response = law.respond(step.strain, step.increment, history);
      ASSERT_TRUE(response.valid);
      double begin[3], end[3];
      for (int i = 0; i < 3; ++i)
        {
          begin[i] = step.strain[i];
          end[i]   = step.strain[i] + step.increment[i];
        }
      // energies of up to 1e5 J/m^3 with their round-off
      EXPECT_NEAR(response.work_increment,
                  law.energy(end, law.updated(response, history)) - law.energy(begin, history),
                  1e-9);
      // differences of strains of 3e-6: (3e-6/n)^2 where the porosity is 0.08, round-off 1e-16/3e-6
      const auto [tangent_error, work_error] = slope_errors(law, step, 3e-6);
      EXPECT_LT(tangent_error, 1e-8);
      EXPECT_LT(work_error, 1e-7);
    }
}

TEST(MaterialsImprovedHencky, BulkModulusIsPrintedC7)
{
  // K~/(2 n^3) (n^2 (e^2 + 4 e + 2) - e n (3 e + 4) + 2 e^2), which is right
  for (const double e : {-0.2, -0.05, 0., 0.1})
    {
      const double nothing[3] = {0, 0, 0}, strain[3] = {e, 0, 0};
      const auto   response = skeleton().respond(nothing, strain, {});
      const double n        = 1. - 0.8 * std::exp(-e);
      const double printed =
        6e6 / (2 * n * n * n) * (n * n * (e * e + 4 * e + 2) - e * n * (3 * e + 4) + 2 * e * e);
      EXPECT_NEAR(response.bulk_modulus / printed, 1., 1e-11); // the sum cancels some digits
    }
}

TEST(MaterialsImprovedHencky, NoPressureClosesThePores)
{
  // bisection for the volume strain of each pressure, from 1 Pa to 1e9 GPa
  double last = 0.;
  for (double P = 1.; P < 2e18; P *= 10.)
    {
      double open = 0., closed = -0.5;
      while (open - closed > 1e-15)
        {
          const double middle                       = 0.5 * (open + closed);
          (pressure_at(middle) < P ? open : closed) = middle;
        }
      EXPECT_LT(open, last);
      EXPECT_GT(skeleton().porosity(open), 0.);
      last = open;
    }
  EXPECT_LT(skeleton().porosity(last), 1e-5);
}

TEST(MaterialsImprovedHencky, StrainsThatWouldCloseThePoresAreRefused)
{
  // the last strain with an answer is ln(1 - n_0) = ln 0.8, however small the step before
  const double bound = std::log(0.8);
  for (double strain = 0.; strain > -100.; strain -= 0.01)
    {
      const double P = pressure_at(strain);
      EXPECT_EQ(std::isfinite(P), strain > bound) << strain;
      EXPECT_FALSE(std::isnan(P));
    }
  EXPECT_TRUE(std::isfinite(pressure_at(bound + 1e-12)));
  EXPECT_FALSE(std::isfinite(pressure_at(bound - 1e-12)));
}

TEST(MaterialsImprovedHencky, TheOriginalDoesNotNoticeItsPores)
{
  // the same strain, beyond the bound: a finite stress and n = 1 - 0.8/0.75 < 0
  const double nothing[3] = {0, 0, 0}, strain[3] = {std::log(0.75), 0, 0};
  const auto   response = Hencky(soil()).respond(nothing, strain);
  EXPECT_NEAR(pressure_of(response.kirchhoff_stress), -30e6 * std::log(0.75), 1e-7);
  EXPECT_NEAR(porosity(0.2, 0.75), 1. - 0.8 / 0.75, 1e-15);
}
