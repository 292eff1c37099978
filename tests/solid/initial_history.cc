// Constants of laws that depend on the place.
#include <kedge/base/exceptions.h>
#include <kedge/solid/initial_history.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  MaterialParameters
  clay(const std::string &strength)
  {
    MaterialParameters parameters;
    parameters.name                    = "clay";
    parameters.kind                    = MaterialKind::von_mises;
    parameters.young_modulus           = 1e6;
    parameters.yield_stress.entry      = "Yield radius rho_y";
    parameters.yield_stress.expression = strength;
    parameters.yield_stress.factor     = 2.;
    return parameters;
  }

  /** Points at (0.1 i, 0.5 i), of body i % 2. */
  std::vector<GeneratedPoint<2>>
  some_points()
  {
    std::vector<GeneratedPoint<2>> points(6);
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        points[i].record.state                       = PointState<2>{};
        points[i].record.state.body                  = i % 2;
        points[i].record.location                    = {0.1 * i, 0.5 * i};
        points[i].record.state.reference_position[0] = 0.1 * i;
        points[i].record.state.reference_position[1] = 0.5 * i;
      }
    return points;
  }
} // namespace

TEST(SolidInitialHistory, ConstantsOfPlaceAreThoseOfEachPointsPlace)
{
  auto                     points  = some_points();
  const MaterialParameters uniform = [] {
    MaterialParameters parameters = clay("");
    parameters.yield_stress       = 7.;
    return parameters;
  }();
  set_initial_history<2>({clay("c*(5 - y) + x + z"), uniform}, {{"c", 3.}}, points);
  const unsigned int column = memory_index("yield_stress");
  ASSERT_LT(column, memory_columns().size());
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      const double *memory = points[i].record.state.memory;
      // the factor times the expression, or the number
      EXPECT_DOUBLE_EQ(memory[column], i % 2 == 0 ? 2. * (3. * (5. - 0.5 * i) + 0.1 * i) : 7.);
      EXPECT_EQ(memory[memory_index("equivalent_plastic_strain")], 0.);
    }
}

TEST(SolidInitialHistory, DepthIsMeasuredFromTheHighestPointOfTheBody)
{
  auto points = some_points(); // the highest ones at y = 2 and 2.5, their domains reach 0.2 higher
  for (auto &point : points)
    point.record.state.reference_half_lengths[1] = 0.2;
  set_initial_history<2>({clay("1 + depth"), clay("1 + 3*depth")}, {}, points);
  const unsigned int column = memory_index("yield_stress");
  for (unsigned int i = 0; i < points.size(); ++i)
    EXPECT_DOUBLE_EQ(points[i].record.state.memory[column],
                     i % 2 == 0 ? 2. * (1. + 2.2 - 0.5 * i) : 2. * (1. + 3. * (2.7 - 0.5 * i)));
}

TEST(SolidInitialHistory, AStrengthThatIsNoneIsRefusedWithItsPlace)
{
  auto points = some_points();
  for (const std::string strength : {"1 - y", "1 + log(1 - y)"}) // 0 at y = 1; not a number beyond
    try
      {
        set_initial_history<2>({clay(strength), clay("1")}, {}, points);
        ADD_FAILURE() << strength;
      }
    catch (const UserError &error)
      {
        const std::string message = error.what();
        EXPECT_NE(message.find("Materials/clay/Yield radius rho_y"), std::string::npos) << message;
        EXPECT_NE(message.find("X = (0.2 1)"), std::string::npos) << message;
        EXPECT_NE(message.find("> 0"), std::string::npos) << message;
      }
}
