#include <kedge/materials/pore_fluid.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  PoreFluid
  water(const bool kozeny_carman = true)
  {
    PoreFluidParameters parameters;
    parameters.initial_porosity       = 0.3;
    parameters.fluid_density          = 1000.;
    parameters.fluid_bulk_modulus     = 2.2e9;
    parameters.hydraulic_conductivity = 1e-5;
    parameters.kozeny_carman          = kozeny_carman;
    parameters.reference_gravity      = 10.;
    return PoreFluid(parameters);
  }

  /** Central difference; its error is about h^2 times the third derivative. */
  template <class Function>
  double
  slope(const Function &f, const double x, const double h)
  {
    return (f(x + h) - f(x - h)) / (2. * h);
  }
} // namespace

TEST(MaterialsPoreFluid, DensityIsThatOfABarotropicFluid)
{
  // K_f d rho = rho dp: ln(rho/rho_0) = p/K_f
  EXPECT_EQ(water().density(0.), 1000.);
  EXPECT_NEAR(water().density(2.2e9) / (1000. * std::exp(1.)), 1., 1e-15);
  for (const double p : {-1e5, 0., 3e5, 1e8})
    {
      // steps of K_f/1000: their square is 1e-6, divided by 6
      const double by_difference = slope(
        [](const double x) {
          return water().density(x);
        },
        p,
        2.2e6);
      EXPECT_NEAR(water().density_slope(p) / by_difference, 1., 2e-7);
    }
}

TEST(MaterialsPoreFluid, StoredEnergyIsTheWorkOfCompression)
{
  // du = p/rho^2 d rho
  EXPECT_EQ(water().energy(0.), 0.);
  for (const double p : {-1e5, 3e5, 2.1e6, 2.3e6, 1e8})
    {
      const double by_difference = slope(
        [](const double x) {
          return water().energy(x);
        },
        p,
        1e-3 * std::abs(p));
      const double rho = water().density(p);
      EXPECT_NEAR(by_difference / (p / (rho * rho) * water().density_slope(p)), 1., 1e-6);
    }
  // both formulas where one takes over from the other, x = 1e-3; the closed form cancels to 1e-10
  EXPECT_NEAR(water().energy(2.2e6 * (1. - 1e-12)) / water().energy(2.2e6 * (1. + 1e-12)),
              1.,
              1e-9);
}

TEST(MaterialsPoreFluid, GrainsKeepTheirVolume)
{
  // (1 - n) J = 1 - n_0
  EXPECT_NEAR(water().porosity(1.), 0.3, 1e-15);
  EXPECT_NEAR(water().porosity(0.7), 0., 1e-15); // all pores closed
  for (const double J : {0.71, 1., 3.})
    {
      EXPECT_NEAR((1. - water().porosity(J)) * J, 0.7, 1e-15);
      const double by_difference = slope(
        [](const double x) {
          return water().porosity(x);
        },
        J,
        1e-4);
      EXPECT_NEAR(water().porosity_slope(J) / by_difference, 1., 1e-7); // (1e-4/J)^2
    }
}

TEST(MaterialsPoreFluid, ConductivityFollowsKozenyAndCarman)
{
  EXPECT_EQ(water(false).conductivity(0.1), 1e-5);
  EXPECT_EQ(water(false).conductivity_slope(0.1), 0.);
  EXPECT_NEAR(water().conductivity(0.3) / 1e-5, 1., 1e-14); // as measured
  // n^3/(1-n)^2 at 0.5 is 1/2, at 0.3 it is 0.027/0.49
  EXPECT_NEAR(water().conductivity(0.5) / (1e-5 * 0.5 * 0.49 / 0.027), 1., 1e-14);
  EXPECT_NEAR(water().mass_mobility(0.3) / 1e-6, 1., 1e-14); // g = 10
  for (const double n : {0.05, 0.3, 0.8})
    {
      const double by_difference = slope(
        [](const double x) {
          return water().conductivity(x);
        },
        n,
        1e-5);
      // (1e-5/n)^2/3 at most, 2e-8 at the smallest n
      EXPECT_NEAR(water().conductivity_slope(n) / by_difference, 1., 1e-7);
      EXPECT_NEAR(water().mass_mobility_slope(n), water().conductivity_slope(n) / 10., 1e-18);
    }
  // without pores there is no flow, nor does it flow against the pressure
  for (const double n : {0., -0.1})
    {
      EXPECT_EQ(water().conductivity(n), 0.);
      EXPECT_EQ(water().conductivity_slope(n), 0.);
    }
}
