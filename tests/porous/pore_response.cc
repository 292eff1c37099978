// The stabilisation of a step against its formula.
#include <kedge/porous/pore_response.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  /** rho = 0.6 * 2500 + 0.4 * 1000 = 1900. */
  Soil
  soil(const double stabilisation)
  {
    PoreFluidParameters parameters;
    parameters.initial_porosity       = 0.4;
    parameters.fluid_density          = 1000.;
    parameters.fluid_bulk_modulus     = 2e9;
    parameters.hydraulic_conductivity = 1e-4;
    parameters.reference_gravity      = 10.;
    return {PoreFluid(parameters), 2500., stabilisation, false};
  }
} // namespace

TEST(PorousStabilisation, IsThePrintsWithoutInertia)
{
  EXPECT_DOUBLE_EQ(stabilisation_of_step(soil(2e-8), 0., 10.), 2e-8);
}

TEST(PorousStabilisation, StiffnessAndInertiaAddUp)
{
  // h = 0.1: rho h^2/12 * 1.2e7 = 1.9e7; 1/2e-8 = 5e7
  EXPECT_DOUBLE_EQ(stabilisation_of_step(soil(2e-8), 1.2e7, 10.), 1. / 6.9e7);
}

TEST(PorousStabilisation, NoneStaysNone)
{
  EXPECT_EQ(stabilisation_of_step(soil(0.), 4e6, 10.), 0.);
}
