// Contact at a node by the thesis's laws: each against its printed equation, and its slopes.
#include <kedge/contact/nodal_law.h>

#include <gtest/gtest.h>

#include <random>

using namespace kedge;

namespace
{
  NodalLaw
  some_law(const double friction)
  {
    NodalLaw law;
    law.stiffness       = 3.;
    law.friction        = friction;
    law.alpha           = 0.5;
    law.begin           = 0.02;
    law.first_bend      = -0.1;
    law.last_bend       = -0.3;
    law.final_stiffness = 40.;
    return law;
  }

  template <int dim>
  struct State
  {
    explicit State(const unsigned int seed)
    {
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> number(-1., 1.);
      for (int d = 0; d < dim; ++d)
        {
          lambda[d] = number(generator);
          D[d]      = number(generator);
        }
    }
    dealii::Tensor<1, dim> lambda, D;
  };

  const ContactMethod all_methods[] = {ContactMethod::penalty,
                                       ContactMethod::nonlinear_penalty,
                                       ContactMethod::augmented_lagrangian,
                                       ContactMethod::lagrange_multipliers};

  template <int dim>
  dealii::Tensor<1, dim>
  along_surface(dealii::Tensor<1, dim> vector)
  {
    vector[0] = 0.;
    return vector;
  }

  template <typename Dimension>
  class NodalLawTest : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
} // namespace

TYPED_TEST_SUITE(NodalLawTest, Dimensions);

/** (5.71), (5.72), (5.62) with [a]_- of (5.39), and for penalties (5.105)-(5.107). */
TYPED_TEST(NodalLawTest, ForcesAreThoseOfThePrint)
{
  constexpr int dim       = TypeParam::value;
  unsigned int  counts[3] = {};
  for (unsigned int seed = 0; seed < 200; ++seed)
    for (const double mu : {0., 2.})
      {
        const NodalLaw law = some_law(mu);
        State<dim>     s(seed);
        for (const bool augmented : {false, true})
          {
            if (!augmented)
              s.lambda = 0;
            const double g          = -0.5 * s.D[0]; // at the middle of the step
            const double a          = s.lambda[0] + 3. * g;
            const double lambda_hat = a <= 0. ? -a : 0.;
            const auto   trial      = along_surface<dim>(s.lambda - 3. * s.D);
            const auto   P =
              trial.norm() <= mu * lambda_hat ? trial : mu * lambda_hat / trial.norm() * trial;
            auto force          = P;
            force[0]            = -lambda_hat;
            const auto response = nodal_function<dim>(
              augmented ? ContactMethod::augmented_lagrangian
                        : ContactMethod::penalty)(law, dim, s.lambda, s.D, NodalHold::none);
            EXPECT_LT((response.force - force).norm(), 1e-15);
            EXPECT_EQ(response.closed, a <= 0.);
            if (augmented) // (5.80)
              {
                EXPECT_LT((response.constraint - (s.lambda - force)).norm(), 1e-15);
              }
            ++counts[a > 0. ? 0 : trial.norm() <= mu * lambda_hat ? 1 : 2];
          }
      }
  for (const unsigned int count : counts) // open, sticking, sliding
    EXPECT_GT(count, 5u);
}

/** With C = 0 the conditions of Signorini and Coulomb hold, (5.38) and (5.40), and only then. */
TYPED_TEST(NodalLawTest, TheConstraintIsThatOfContact)
{
  constexpr int  dim = TypeParam::value;
  const NodalLaw law = some_law(0.4);
  for (const auto method :
       {ContactMethod::augmented_lagrangian, ContactMethod::lagrange_multipliers})
    {
      const auto constraint = [&](const dealii::Tensor<1, dim> &lambda,
                                  const dealii::Tensor<1, dim> &D) {
        return nodal_function<dim>(method)(law, dim, lambda, D, NodalHold::none).constraint.norm();
      };
      dealii::Tensor<1, dim> lambda, D;
      lambda[0] = -2.;
      EXPECT_LT(constraint(lambda, D), 1e-15); // presses
      lambda[1] = 0.3;
      EXPECT_LT(constraint(lambda, D), 1e-15); // sticks
      D[1] = 0.1;
      EXPECT_GT(constraint(lambda, D), 0.1); // slips below the bound
      lambda[1] = -0.8;
      EXPECT_LT(constraint(lambda, D), 1e-9); // slides against the force
      lambda[1] = 0.8; // slides with it: which the multipliers by themselves do not see
      EXPECT_EQ(constraint(lambda, D) < 1e-9, method == ContactMethod::lagrange_multipliers);
      lambda[1] = -1.;
      EXPECT_GT(constraint(lambda, D), 0.1); // more than Coulomb's bound
      lambda = 0;
      D      = 0;
      D[0]   = 0.1;
      EXPECT_GT(constraint(lambda, D), 0.1); // overlaps
      lambda[0] = 1.;
      EXPECT_GT(constraint(lambda, D), 0.1); // pulls
      lambda = 0;
      D[0]   = -0.1; // open: which the multipliers by themselves do not see
      EXPECT_EQ(constraint(lambda, D) < 1e-15, method == ContactMethod::augmented_lagrangian);
    }
}

/** By central differences of 1e-6: round-off 1e-10 of numbers of order 10. */
TYPED_TEST(NodalLawTest, SlopesAreThoseOfTheForces)
{
  constexpr int dim = TypeParam::value;
  const double  e   = 1e-6;
  for (const auto method : all_methods)
    for (unsigned int seed = 0; seed < 100; ++seed)
      for (const double mu : {0., 0.7})
        {
          const NodalLaw   law = some_law(mu);
          const State<dim> s(seed);
          const auto       function = nodal_function<dim>(method);
          const auto       here     = function(law, dim, s.lambda, s.D, NodalHold::none);
          for (int j = 0; j < dim; ++j)
            {
              dealii::Tensor<1, dim> step;
              step[j]               = e;
              const auto by_lambda  = function(law, dim, s.lambda + step, s.D, NodalHold::none);
              const auto less       = function(law, dim, s.lambda - step, s.D, NodalHold::none);
              const auto by_D       = function(law, dim, s.lambda, s.D + step, NodalHold::none);
              const auto less_D     = function(law, dim, s.lambda, s.D - step, NodalHold::none);
              const auto difference = [&](const auto &plus, const auto &minus, const int i) {
                return (plus[i] - minus[i]) / (2. * e);
              };
              for (int i = 0; i < dim; ++i)
                {
                  EXPECT_NEAR(here.force_by_multiplier[i][j],
                              difference(by_lambda.force, less.force, i),
                              1e-8);
                  EXPECT_NEAR(here.force_by_displacement[i][j],
                              difference(by_D.force, less_D.force, i),
                              1e-8);
                  EXPECT_NEAR(here.constraint_by_multiplier[i][j],
                              difference(by_lambda.constraint, less.constraint, i),
                              1e-8);
                  EXPECT_NEAR(here.constraint_by_displacement[i][j],
                              difference(by_D.constraint, less_D.constraint, i),
                              1e-8);
                }
            }
        }
}

/** A held node is one of the law's states whatever the law says. */
TYPED_TEST(NodalLawTest, HeldNodesKeepTheirState)
{
  constexpr int          dim      = TypeParam::value;
  const auto             function = nodal_function<dim>(ContactMethod::augmented_lagrangian);
  const NodalLaw         law      = some_law(0.1);
  dealii::Tensor<1, dim> lambda, D;
  lambda[0] = -1.;
  lambda[1] = 2.; // far beyond the bound
  EXPECT_TRUE(function(law, dim, lambda, D, NodalHold::none).slides);
  const auto sticks = function(law, dim, lambda, D, NodalHold::sticks);
  EXPECT_FALSE(sticks.slides);
  EXPECT_EQ(sticks.force[1], 2.);
  const auto open = function(law, dim, lambda, D, NodalHold::open);
  EXPECT_FALSE(open.closed);
  EXPECT_EQ(open.force.norm(), 0.);
}

/** What (5.108) asks of its coefficients: value, slope and curvature go on at c_0, c_1 and c_2. */
TEST(NonlinearPenalty, IsSmoothAcrossItsBends)
{
  const NodalLaw law = some_law(0.);
  double         slope[2];
  const double   e = 1e-7;
  EXPECT_EQ(nonlinear_penalty(law, 0.021, slope[0]), 0.);
  EXPECT_NEAR(nonlinear_penalty(law, 0.02 - e, slope[0]), 0., 4. * e);
  for (const double c : {law.first_bend, law.last_bend})
    {
      const double above = nonlinear_penalty(law, c + e, slope[0]);
      const double below = nonlinear_penalty(law, c - e, slope[1]);
      const double mean  = 0.5 * (slope[0] + slope[1]);
      EXPECT_NEAR(above - below, 2. * e * mean, 1e-12);
      EXPECT_NEAR(slope[0], slope[1], 2e-9); // of second order in e: the curvature is 0 there
      EXPECT_NEAR(mean, c == law.first_bend ? law.stiffness : law.final_stiffness, 2e-9);
    }
  // and the slope is that of the value
  for (double g = -0.4; g < 0.05; g += 0.013)
    {
      double here, ignored;
      nonlinear_penalty(law, g, here);
      const double difference =
        (nonlinear_penalty(law, g + e, ignored) - nonlinear_penalty(law, g - e, ignored)) /
        (2. * e);
      EXPECT_NEAR(here, difference, 1e-7);
    }
}
