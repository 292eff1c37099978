// A single point of soil along paths of strain, against figures found elsewhere.
#include "../materials/soils.h"

#include <kedge/stress/single_point.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  MaterialParameters
  improved_soil()
  {
    MaterialParameters parameters = test::soil();
    parameters.kind               = MaterialKind::critical_state_improved;
    return parameters;
  }

  /** Strains a along z and r across it. */
  void
  strain(SinglePoint &point, const double a, const double r)
  {
    dealii::Tensor<2, 3> F;
    F[0][0] = F[1][1] = std::exp(r);
    F[2][2]           = std::exp(a);
    ASSERT_TRUE(point.deform_to(F));
    EXPECT_GE(point.state().plastic_dissipation, 0.);
  }

  double
  pressure(const SinglePoint &point)
  {
    return -trace(point.state().kirchhoff_stress) / 3.;
  }

  double
  shear(const SinglePoint &point)
  {
    return deviator(point.state().kirchhoff_stress).norm();
  }
} // namespace

TEST(StressSoilPaths, IsotropicCompression)
{
  SinglePoint point(improved_soil());
  // to the digits given; F = exp(eps) carries 1e-16 of 1, the strain 1e-12 of its own
  const std::map<int, double> expected = {{10, 154638.8856},
                                          {16, 252098.8534},
                                          {20, 254693.7336},
                                          {40, 254741.0856}};
  for (int step = 1; step <= 40; ++step)
    {
      strain(point, -5e-4 * step / 3., -5e-4 * step / 3.);
      if (expected.count(step) > 0)
        {
          EXPECT_NEAR(pressure(point) / expected.at(step), 1., 5e-10) << step;
        }
      if (step == 16)
        {
          EXPECT_EQ(point.state().plastic_dissipation, 0.);
        }
    }
  EXPECT_NEAR(shear(point), 0., 1e-5); // rounding of stresses of 1e7 Pa in the trial
}

TEST(StressSoilPaths, IsochoricCompressionEndsAtTheCriticalState)
{
  struct Path
  {
    double                                   volume_strain, pressure;
    std::map<int, std::pair<double, double>> expected;
  };
  const Path paths[] = {{-.006410281046,
                         200e3,
                         {{20, {196106.7713, 130154.2672}}, {400, {113351.4187, 109024.5373}}}},
                        {-.001650165123, 50e3, {{400, {113341.2416, 109017.6698}}}}};
  for (const Path &path : paths)
    {
      SinglePoint point(improved_soil());
      strain(point, path.volume_strain / 3., path.volume_strain / 3.);
      EXPECT_NEAR(pressure(point) / path.pressure, 1., 1e-9);
      for (int step = 1; step <= 400; ++step)
        {
          strain(point,
                 path.volume_strain / 3. - 1e-4 * step,
                 path.volume_strain / 3. + 5e-5 * step);
          if (path.expected.count(step) > 0)
            {
              EXPECT_NEAR(pressure(point) / path.expected.at(step).first, 1., 5e-10) << step;
              EXPECT_NEAR(shear(point) / path.expected.at(step).second, 1., 5e-10) << step;
            }
        }
      // phi = 0: P = a_0 + a_0^2 (1 - n)/(2 K~), rho = B there; 400 steps come near
      const double a_0 = 112500., n = 1. - 0.8 * std::exp(-path.volume_strain);
      const double critical = a_0 + a_0 * a_0 * (1. - n) / (2. * 6e6);
      EXPECT_NEAR(pressure(point) / critical, 1., 1e-4);
      EXPECT_NEAR(shear(point) / (0.964 * (0.7 * critical + 0.3 * a_0)), 1., 1e-4);
    }
}
