// The inverse of the laws, by which bodies start under stress.
#include "soils.h"

#include <kedge/base/exceptions.h>
#include <kedge/materials/initial_strain.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  std::vector<Material>
  all_laws()
  {
    MaterialParameters parameters = soil();
    parameters.yield_stress       = 1e5;
    parameters.hardening_modulus  = 1e6;
    return {Hencky(parameters),
            ImprovedHencky(parameters),
            VonMises(parameters),
            CriticalState<Hencky>(parameters),
            CriticalState<ImprovedHencky>(parameters)};
  }

  /** The history of an undeformed material: sigma_y, if it has one, is 1e5. */
  std::vector<double>
  virgin(const Material &material)
  {
    MaterialParameters parameters = soil();
    parameters.yield_stress       = 1e5;
    return start_history(material, parameters);
  }

  std::array<double, 3>
  strain_of(const Material &material, const std::array<double, 3> &stress)
  {
    return initial_elastic_strain(material, stress, virgin(material));
  }

  /** The stress at an elastic strain of the undeformed material. */
  std::array<double, 3>
  stress_at(const Material &material, const std::array<double, 3> &strain)
  {
    const double values[3] = {strain[0], strain[1], strain[2]}, nothing[3] = {0., 0., 0.};
    return std::visit(
      [&](const auto &law) {
        const auto response =
          law.respond(values,
                      nothing,
                      read_history<std::decay_t<decltype(law)>>(virgin(material).data()));
        return std::array<double, 3>{{response.kirchhoff_stress[0],
                                      response.kirchhoff_stress[1],
                                      response.kirchhoff_stress[2]}};
      },
      material);
  }
} // namespace

TEST(MaterialsInitialStrain, GivesTheStressBack)
{
  // states within all yield surfaces: K_0 states of 50 to 150 kPa, and one with three axes
  for (const Material &material : all_laws())
    for (const auto &stress : std::vector<std::array<double, 3>>{{{-5e4, -1e5, -5e4}},
                                                                 {{-1.2e5, -1.5e5, -1.2e5}},
                                                                 {{-9e4, -7e4, -1.1e5}}})
      {
        const auto back = stress_at(material, strain_of(material, stress));
        // round-off of moduli times strains: some eps over their ratio of 3e-3
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(back[i] / stress[i], 1., 1e-12);
      }
}

TEST(MaterialsInitialStrain, TensionOfTheImprovedLawIsBounded)
{
  // p' = K_0 (eps - c eps^2/2), c = (1 - n_0)/n_0 = 4, is largest at eps = 1/c: K_0/(2 c)
  const Material law     = ImprovedHencky(soil());
  const double   largest = 30e6 / 8.;
  const auto     strain  = strain_of(law, {{largest, largest, largest * (1. - 1e-9)}});
  EXPECT_NEAR(strain[0] + strain[1] + strain[2], 0.25, 1e-4); // square root of 1e-9
  EXPECT_THROW(strain_of(law, {{largest, largest, largest * (1. + 1e-9)}}), UserError);
}

TEST(MaterialsInitialStrain, StressesBeyondTheYieldSurfaceAreRefused)
{
  const auto laws = all_laws();
  // |s| = sqrt(2/3) 1e5 is the radius of von Mises
  EXPECT_NO_THROW(strain_of(laws[2], {{0.999e5, 0., 0.}}));
  EXPECT_THROW(strain_of(laws[2], {{1.001e5, 0., 0.}}), UserError);
  for (const Material &material : {laws[3], laws[4]})
    {
      // zero stress lies on the surface, tension beyond it; p_c = 250 kPa bounds the original
      EXPECT_NO_THROW(strain_of(material, {{0., 0., 0.}}));
      EXPECT_THROW(strain_of(material, {{1., 1., 1.}}), UserError);
      EXPECT_THROW(strain_of(material, {{0., -3e5, 0.}}), UserError);
    }
  // returned instead: von Mises' deviator shrinks to its radius, the pressure stays
  const InitialState start = initial_state(laws[2], {{2e5, 0., 0.}}, virgin(laws[2]));
  const double       third = 2e5 / 3.;
  // q = sigma_y + H alpha, alpha = (q^tr - sigma_y)/(3 G + H), as in any step from there
  const double q = 1e5 + 1e6 * 1e5 / (3. * 28e6 + 1e6);
  EXPECT_NEAR(start.stress[0] - start.stress[1], q, 1e-9 * q);
  EXPECT_NEAR(start.strain[0] - start.strain[1], q / (2. * 28e6), 1e-9 * q / 28e6);
  EXPECT_NEAR(start.stress[0] + start.stress[1] + start.stress[2], 3. * third, 1e-9 * third);
  EXPECT_NEAR(start.returned, (2e5 - start.stress[0]) / 2e5, 1e-15);
  EXPECT_NEAR(start.history[0], 1e5 / (3. * 28e6 + 1e6), 1e-12);
  EXPECT_NO_THROW(strain_of(laws[3], {{-2.499e5, -2.499e5, -2.499e5}}));
  EXPECT_THROW(strain_of(laws[3], {{-2.501e5, -2.501e5, -2.501e5}}), UserError);
}

TEST(MaterialsInitialStrain, PreconsolidationByItsRatioFollowsTheStress)
{
  // M = 1: the surface through p = 1e5, q = 5e4 has p_c = p + q^2/p = 1.25e5
  MaterialParameters parameters;
  parameters.young_modulus                   = 1e7;
  parameters.poisson_ratio                   = 0.;
  parameters.swelling_slope                  = 0.02;
  parameters.compression_slope               = 0.2;
  parameters.initial_void_ratio              = 1.;
  parameters.critical_state_ratio            = 1.;
  parameters.reference_pressure              = 1e3;
  parameters.start_preconsolidation_pressure = 1.5;
  parameters.preconsolidation_by_ratio       = true;
  const Material law                         = ModifiedCamClay(parameters);
  // vertical less by q of horizontal: p + 2 q/3, p - q/3
  const double vertical = -(1e5 + 5e4 * 2. / 3.), horizontal = -(1e5 - 5e4 / 3.);
  const auto   start =
    initial_state(law, {{horizontal, vertical, horizontal}}, start_history(law, parameters));
  EXPECT_NEAR(start.history[2], 1.5 * 1.25e5, 1e-9 * 1e5);
  EXPECT_EQ(start.returned, 0.);
  // normally consolidated: on the surface, which is no stress beyond it
  parameters.start_preconsolidation_pressure = 1.;
  const Material normal                      = ModifiedCamClay(parameters);
  EXPECT_EQ(initial_state(normal,
                          {{horizontal, vertical, horizontal}},
                          start_history(normal, parameters))
              .returned,
            0.);
}
