#include "../transfer/cloud.h"

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class GridNodeConditions : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  template <int dim>
  NodeConditionParameters<dim>
  everywhere(const ConditionKind kind, const std::array<std::string, 3> &expressions)
  {
    NodeConditionParameters<dim> parameters;
    parameters.on_side = false;
    parameters.where   = "1";
    for (int d = 0; d < dim; ++d)
      parameters.components[d] = {kind, expressions[d]};
    return parameters;
  }
} // namespace

TYPED_TEST_SUITE(GridNodeConditions, Dimensions);

TYPED_TEST(GridNodeConditions, MotionsDependOnPlaceTimeAndStep)
{
  constexpr int dim = TypeParam::value;
  Cloud<dim>    cloud({BasisKind::linear}, 1, 5);
  cloud.prescribe(NodeConditions<dim>(
    {everywhere<dim>(ConditionKind::motion, {{"c*x*dt + y*dt^2", "x*y*t*dt", "(z + x)*dt"}})},
    {{"c", 3.}}));
  const double t = 0.7, dt = 0.25;
  EXPECT_TRUE(cloud.conditions.any_moving());
  for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
    {
      const auto   x           = cloud.node_position(i);
      const double slope[3]    = {3. * x[0], x[0] * x[1] * t, x[dim - 1] + x[0]};
      const double expected[3] = {3. * x[0] * dt + x[1] * dt * dt,
                                  x[0] * x[1] * t * dt,
                                  (x[dim - 1] + x[0]) * dt};
      for (int d = 0; d < dim; ++d)
        {
          ASSERT_TRUE(cloud.conditions.prescribed(i, d));
          // a handful of operations on numbers of a few metres
          EXPECT_NEAR(cloud.conditions.increment(i, d, t, t + dt), expected[d], 1e-14);
          // polynomials in dt are exact; weights of some hundreds times round-off over dt
          EXPECT_NEAR(cloud.conditions.velocity(i, d, t, dt), slope[d], 1e-11);
        }
    }
}

TYPED_TEST(GridNodeConditions, DisplacementsAndVelocitiesDependOnTime)
{
  constexpr int dim = TypeParam::value;
  Cloud<dim>    cloud({BasisKind::linear}, 1, 5);
  const double  t = 0.7, dt = 0.25;
  cloud.prescribe(
    NodeConditions<dim>({everywhere<dim>(ConditionKind::displacement, {{"t^2", "2*t", "0"}})}, {}));
  // the difference of both ends: t dt 2 + dt^2
  EXPECT_NEAR(cloud.conditions.increment(0, 0, t, t + dt), 0.4125, 1e-15);
  EXPECT_NEAR(cloud.conditions.increment(0, 1, t, t + dt), 0.5, 1e-15);
  // slopes from the right, 2 t and 2, of polynomials
  EXPECT_NEAR(cloud.conditions.velocity(0, 0, t, dt), 1.4, 1e-12);
  EXPECT_NEAR(cloud.conditions.velocity(0, 1, t, dt), 2., 1e-12);
  cloud.prescribe(
    NodeConditions<dim>({everywhere<dim>(ConditionKind::velocity, {{"t^2", "2*t", "0"}})}, {}));
  EXPECT_NEAR(cloud.conditions.velocity(0, 0, t, dt), 0.49, 1e-15); // what is prescribed at t
  // the value in the middle times dt
  EXPECT_NEAR(cloud.conditions.increment(0, 0, t, t + dt), 0.825 * 0.825 * 0.25, 1e-15);
}

TYPED_TEST(GridNodeConditions, TheLaterConditionWinsInItsComponents)
{
  constexpr int dim   = TypeParam::value;
  auto          first = everywhere<dim>(ConditionKind::fixed, {{"", "", ""}});
  auto          later = everywhere<dim>(ConditionKind::free, {{"", "", ""}});
  later.components[1] = {ConditionKind::motion, "x"};
  Cloud<dim> cloud({BasisKind::linear}, 1, 5);
  cloud.prescribe(NodeConditions<dim>({first, later}, {}));
  for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
    {
      EXPECT_EQ(cloud.conditions.increment(i, 0, 0., 1.), 0.);
      EXPECT_EQ(cloud.conditions.increment(i, 1, 0., 1.), cloud.node_position(i)[0]);
    }
}
