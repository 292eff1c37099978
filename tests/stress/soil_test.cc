// Element tests of soil: what is prescribed is there, and the fluid keeps its mass.
#include "../materials/soils.h"

#include <kedge/stress/soil_test.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  MaterialParameters
  soil_of_kind(const MaterialKind kind)
  {
    MaterialParameters parameters = test::soil();
    parameters.kind               = kind;
    return parameters;
  }

  /** Triaxial compression at a cell pressure of 100 kPa. */
  PathParameters
  triaxial()
  {
    PathParameters path;
    path.kind                   = PathParameters::Kind::control;
    path.control                = {{{true, "-1e5"}, {true, "-1e5"}, {false, "-t"}}};
    path.consolidation_pressure = 1e5;
    return path;
  }

  double
  volume(const SoilTest &test)
  {
    return determinant(test.state().deformation_gradient);
  }
} // namespace

TEST(StressSoilTest, DrainedItKeepsTheCellPressure)
{
  SoilTest test(triaxial(), soil_of_kind(MaterialKind::critical_state_improved), {});
  ASSERT_TRUE(test.consolidate());
  // Newton's method ends at strains of 1e-12 and better: 1e-4 Pa times a little
  EXPECT_NEAR(trace(test.state().cauchy_stress()), -3e5, 1e-4);
  const double height = test.state().deformation_gradient[2][2];
  for (int step = 1; step <= 20; ++step)
    {
      ASSERT_TRUE(test.advance_to(1e-3 * step));
      EXPECT_NEAR(test.state().cauchy_stress()[0][0], -1e5, 1e-4);
      EXPECT_NEAR(test.state().cauchy_stress()[1][1], -1e5, 1e-4);
      EXPECT_NEAR(test.state().deformation_gradient[2][2] / height, std::exp(-1e-3 * step), 1e-14);
      EXPECT_EQ(test.pore_pressure(), 0.);
    }
  EXPECT_GT(test.state().plastic_dissipation, 0.);
}

TEST(StressSoilTest, UndrainedItKeepsTheMassOfTheFluid)
{
  PathParameters path     = triaxial();
  path.undrained          = true;
  path.fluid_bulk_modulus = 2.2e9;
  SoilTest test(path, soil_of_kind(MaterialKind::critical_state_improved), {});
  ASSERT_TRUE(test.consolidate());
  EXPECT_EQ(test.pore_pressure(), 0.);
  const double fluid = volume(test) - 0.8; // per volume, the grains being 0.8
  for (int step = 1; step <= 20; ++step)
    {
      ASSERT_TRUE(test.advance_to(1e-3 * step));
      // density over that at p = 0 times volume; exp(p/K_f) - 1 is known to 1e-16
      EXPECT_NEAR(std::exp(test.pore_pressure() / 2.2e9) * (volume(test) - 0.8), fluid, 1e-15);
      // total stress; K_f/n_0 times strains of 1e-16
      EXPECT_NEAR(test.state().cauchy_stress()[0][0] - test.pore_pressure(), -1e5, 1e-4);
    }
  EXPECT_GT(test.pore_pressure(), 1e4);
}

TEST(StressSoilTest, AStiffFluidTendsToAnIncompressibleOne)
{
  // volumes differ by p n/K_f, pressures by that times K: both go with 1/K_f
  std::vector<double> pressures;
  for (const double K_f : {0., 2e10, 2e11})
    {
      PathParameters path     = triaxial();
      path.undrained          = true;
      path.fluid_bulk_modulus = K_f;
      SoilTest test(path, soil_of_kind(MaterialKind::critical_state_improved), {});
      ASSERT_TRUE(test.consolidate());
      const double volume_0 = volume(test);
      for (int step = 1; step <= 10; ++step)
        ASSERT_TRUE(test.advance_to(1e-3 * step));
      pressures.push_back(test.pore_pressure());
      if (K_f == 0.)
        {
          EXPECT_NEAR(volume(test), volume_0, 1e-14);
        }
    }
  EXPECT_GT(pressures[0], 1e3);
  const double soft  = std::abs(pressures[1] - pressures[0]),
               stiff = std::abs(pressures[2] - pressures[0]);
  EXPECT_LT(soft, 2. * 30e6 * pressures[0] * 0.2 / 2e10);
  EXPECT_NEAR(soft / stiff, 10., 0.1);
}

TEST(StressSoilTest, ElasticOedometerFollowsTheClosedForm)
{
  // tau_zz = p' + 4/3 G eps, p' of the improved law at the given strain
  PathParameters path;
  path.kind    = PathParameters::Kind::control;
  path.control = {{{false, "0"}, {false, "0"}, {false, "-t"}}};
  SoilTest test(path, soil_of_kind(MaterialKind::improved_hencky), {});
  ASSERT_TRUE(test.consolidate());
  for (const double eps : {-0.05, -0.1, -0.2})
    {
      ASSERT_TRUE(test.advance_to(-eps));
      const double n = 1. - 0.8 * std::exp(-eps);
      const double p = 6e6 * eps / n * (1. - eps * (1. - n) / (2. * n));
      EXPECT_NEAR(test.state().kirchhoff_stress[2][2] / (p + 4. / 3. * 28e6 * eps), 1., 1e-12);
    }
  EXPECT_FALSE(test.advance_to(0.23)); // ln 0.8 = -0.2231: all pores closed
  EXPECT_TRUE(test.advance_to(0.22));  // the state before it was kept
}

TEST(StressSoilTest, AStressItCannotBearIsRefused)
{
  PathParameters path = triaxial();
  path.control        = {{{true, "-1e5"}, {true, "-1e5"}, {true, "-1e5 - 1e6*t"}}};
  SoilTest test(path, soil_of_kind(MaterialKind::critical_state), {});
  ASSERT_TRUE(test.consolidate());
  const double q = 0.05e6;
  ASSERT_TRUE(test.advance_to(0.05));
  EXPECT_NEAR(test.state().cauchy_stress()[2][2], -1e5 - q, 1e-4);
  EXPECT_FALSE(test.advance_to(1.)); // q = 1 MPa, the surface ends at some 150 kPa
  EXPECT_NEAR(test.state().cauchy_stress()[2][2], -1e5 - q, 1e-4);
}
