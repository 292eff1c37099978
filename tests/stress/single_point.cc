// A single material point along paths with known stresses.
#include <kedge/base/exceptions.h>
#include <kedge/stress/single_point.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  const std::map<std::string, double> no_constants;

  /** Steel of the manufactured solution: G = 79 GPa, nu = 1/3, rho_y = 165 sqrt(2) MPa. */
  MaterialParameters
  steel()
  {
    MaterialParameters parameters;
    parameters.kind          = MaterialKind::von_mises;
    parameters.poisson_ratio = 1. / 3.;
    parameters.young_modulus = 2. * 79e9 * (1. + parameters.poisson_ratio);
    parameters.yield_stress  = std::sqrt(1.5) * 165e6 * std::sqrt(2.);
    return parameters;
  }

  /** Thesis 3.7.2: two straight legs in the space of strains, t = 0 to 1 to 2. */
  StrainPath
  turning_strain()
  {
    PathParameters parameters;
    parameters.kind               = PathParameters::Kind::logarithmic_strain;
    parameters.logarithmic_strain = {{"-0.003*min(t, 1) - 0.0073923*max(t - 1, 0)",
                                      "-0.003*min(t, 1) + 0.003*max(t - 1, 0)",
                                      "0.006*min(t, 1) + 0.0043923*max(t - 1, 0)"}};
    return StrainPath(parameters, no_constants);
  }

  /** Largest error [Pa] against the closed form with so many steps per leg. */
  double
  error_of_turning_strain(const unsigned int n_steps)
  {
    // the flow along straight strain paths, integrated in closed form
    const std::map<unsigned int, std::array<double, 3>> exact = {
      {200, {{-95.262794416288e6, -95.262794416288e6, 190.525588832577e6}}},
      {250, {{-180.57529088127e6, 37.662335537896e6, 142.91295534337e6}}},
      {300, {{-188.24784642282e6, 68.686524801255e6, 119.56132162157e6}}},
      {400, {{-189.3647579217e6, 76.4960834903e6, 112.8686744314e6}}}};

    const StrainPath path = turning_strain();
    SinglePoint      point(steel());
    double           largest = 0.;
    for (unsigned int step = 1; step <= 2 * n_steps; ++step)
      {
        EXPECT_TRUE(point.deform_to(path.deformation_gradient(double(step) / n_steps)));
        const auto found = exact.find(step * 200 / n_steps);
        if (step * 200 % n_steps == 0 && found != exact.end())
          for (int i = 0; i < 3; ++i)
            largest =
              std::max(largest, std::abs(point.state().kirchhoff_stress[i][i] - found->second[i]));
      }
    return largest;
  }
} // namespace

TEST(StressSinglePoint, TurningFlowIsOfFirstOrderInTheStep)
{
  // backward Euler, evaluated elsewhere: 1.603, 0.810 and 0.163 MPa at t = 1.25
  const double coarse = error_of_turning_strain(100), middle = error_of_turning_strain(200),
               fine = error_of_turning_strain(400), finest = error_of_turning_strain(1000);
  EXPECT_NEAR(coarse, 1.603e6, 0.001e6);
  EXPECT_NEAR(middle, 0.810e6, 0.001e6);
  EXPECT_NEAR(finest, 0.163e6, 0.001e6);
  EXPECT_NEAR(coarse / middle, 2., 0.05);
  EXPECT_NEAR(middle / fine, 2., 0.02);
}

TEST(StressSinglePoint, TheFirstLegNeedsNoSmallSteps)
{
  // a straight path from the origin: the return is radial, exact in one step
  SinglePoint one_step(steel());
  ASSERT_TRUE(one_step.deform_to(turning_strain().deformation_gradient(1.)));
  EXPECT_NEAR(one_step.state().kirchhoff_stress[2][2], 190.525588832577e6, 1e-3);
  EXPECT_NEAR(one_step.state().kirchhoff_stress[0][0], -95.262794416288e6, 1e-3);
}

TEST(StressSinglePoint, BooksCloseOverACycle)
{
  // work of the stress by the trapezoidal rule over fine steps, against what
  // is stored and dissipated; the error of the rule is of second order
  const StrainPath path = turning_strain();
  SinglePoint      point(steel());
  double           work    = 0.;
  const int        n_steps = 4000;
  for (int step = 1; step <= n_steps; ++step)
    {
      const auto before = point.state().kirchhoff_stress;
      const auto F_n    = point.state().deformation_gradient,
                 F      = path.deformation_gradient(2. * step / n_steps);
      ASSERT_TRUE(point.deform_to(F));
      for (int i = 0; i < 3; ++i)
        work += 0.5 * (before[i][i] + point.state().kirchhoff_stress[i][i]) *
                std::log(F[i][i] / F_n[i][i]);
    }
  const auto &state = point.state();
  EXPECT_GT(state.plastic_dissipation, 0.5 * work);
  EXPECT_EQ(state.hardening_energy, 0.); // perfect plasticity
  EXPECT_NEAR(state.strain_energy + state.plastic_dissipation, work, 1e-3 * work);
  // dD = rho_y d lambda, alpha = sqrt(2/3) of all lambda
  EXPECT_NEAR(state.plastic_dissipation,
              165e6 * std::sqrt(2.) * std::sqrt(1.5) * point.column("equivalent_plastic_strain"),
              1e-12 * work);
}

TEST(StressSinglePoint, RotationsTurnTheStressAndNothingElse)
{
  // the path in a frame that turns by a radian, step by step
  const StrainPath path = turning_strain();
  SinglePoint      still(steel()), turning(steel());
  const int        n_steps = 50;
  for (int step = 1; step <= n_steps; ++step)
    {
      const double         t = 2. * step / n_steps, angle = 0.5 * t;
      dealii::Tensor<2, 3> R = dealii::unit_symmetric_tensor<3>();
      R[0][0] = R[2][2] = std::cos(angle);
      R[0][2]           = -std::sin(angle);
      R[2][0]           = std::sin(angle);
      ASSERT_TRUE(still.deform_to(path.deformation_gradient(t)));
      ASSERT_TRUE(turning.deform_to(R * path.deformation_gradient(t)));
      const dealii::Tensor<2, 3> turned =
        R * dealii::Tensor<2, 3>(still.state().kirchhoff_stress) * transpose(R);
      // round-off of 1e-16 in F costs K * 1e-16 = 2e-5 Pa a step
      EXPECT_LT((turned - dealii::Tensor<2, 3>(turning.state().kirchhoff_stress)).norm(), 0.01);
    }
  EXPECT_NEAR(still.column("equivalent_plastic_strain"),
              turning.column("equivalent_plastic_strain"),
              1e-13);
  EXPECT_NEAR(turning.state().plastic_dissipation, still.state().plastic_dissipation, 1e-2);
}

TEST(StressSinglePoint, RefusesWhatTurnsInsideOutAndStaysWhereItWas)
{
  SinglePoint point(steel());
  ASSERT_TRUE(point.deform_to(turning_strain().deformation_gradient(0.5)));
  const auto           before = point.state();
  dealii::Tensor<2, 3> F      = dealii::unit_symmetric_tensor<3>();
  F[0][0]                     = -1.;
  EXPECT_FALSE(point.deform_to(F));
  EXPECT_EQ((point.state().deformation_gradient - before.deformation_gradient).norm(), 0.);
  EXPECT_EQ((point.state().kirchhoff_stress - before.kirchhoff_stress).norm(), 0.);
  // a trial changes nothing either
  PointUpdate<3> update;
  EXPECT_TRUE(point.evaluate(turning_strain().deformation_gradient(2.), update));
  EXPECT_EQ((point.state().kirchhoff_stress - before.kirchhoff_stress).norm(), 0.);
}

TEST(StressSinglePoint, APathBeginsUndeformed)
{
  PathParameters parameters;
  parameters.deformation_gradient = {{"1 + t", "g*t", "0", "0", "1", "0", "0", "0", "1 - t/2"}};
  const dealii::Tensor<2, 3> F    = StrainPath(parameters, {{"g", 3.}}).deformation_gradient(0.5);
  EXPECT_EQ(F[0][0], 1.5);
  EXPECT_EQ(F[0][1], 1.5);
  EXPECT_EQ(F[1][0], 0.);
  EXPECT_EQ(F[2][2], 0.75);
  parameters.deformation_gradient[1] = "t + 1";
  EXPECT_THROW(StrainPath(parameters, no_constants), UserError);
  parameters.kind               = PathParameters::Kind::logarithmic_strain;
  parameters.logarithmic_strain = {{"t", "0.1", "0"}};
  EXPECT_THROW(StrainPath(parameters, no_constants), UserError);
}
