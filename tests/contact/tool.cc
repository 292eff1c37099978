// Contact of a body with a rigid body: its tangent, its books, what it refuses.
#include "../equations/term_cloud.h"
#include "two_blocks.h"

#include <kedge/contact/tool_edges.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  std::string
  replaced(std::string text, const std::string &from, const std::string &to)
  {
    return text.replace(text.find(from), from.size(), to);
  }

  /** The upper one of the two blocks, which falls on a free rigid box that turns. */
  template <int dim>
  std::string
  on_tool(const std::string &law, const std::string &scheme)
  {
    std::string text = two_blocks<dim>(law, scheme);
    text             = replaced(text, "set Second = upper", "set Tool = anvil");
    text             = replaced(text, "set First  = lower", "set First  = upper");
    // not even nodes that hold next to nothing are shared with another body
    const std::size_t lower = text.find("  subsection lower");
    text.erase(lower, text.find("  subsection upper") - lower);
    return text + "subsection Rigid bodies\n  subsection anvil\n    set Density = 2000\n" +
           (dim == 2
              ? "    set Geometry = polygon(-0.2, 0.3; 1.7, 0.3; 1.7, 0.6; -0.2, 0.59)\n"
                "    set Angular velocity = 0.2\n    set Velocity = 0.1, 0.3\n"
              : "    set Geometry = box(-0.2, 0.3, -0.1; 1.7, 0.6, 1.5)\n"
                "    set Surface spacing = 10\n"
                "    set Angular velocity = 0.1, 0.1, 0.2\n    set Velocity = 0.1, 0.3, 0\n") +
           "  end\nend\n";
  }

  template <typename Dimension>
  class Tool : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  const std::string rough  = "    set Friction coefficient = 0.3\n    set Surface spacing = 0.1";
  const std::string smooth = "    set Friction coefficient = 0\n    set Surface spacing = 0.1";
} // namespace

TYPED_TEST_SUITE(Tool, Dimensions);

TYPED_TEST(Tool, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : {smooth, rough})
    {
      Setting<dim> setting(on_tool<dim>(law, "clc-midpoint"));
      setting.run(3, 0.01);
      EXPECT_GT(setting.model.ledger.value("contact_area_blocks"), 0.);
      setting.start_step(0.01);
      setting.correct({0.9, 0.1, 0.1});
      test::expect_slope_of_residual(*setting.equations);
    }
}

TYPED_TEST(Tool, BooksCloseAndMomentumIsKept)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : {smooth, rough})
    {
      Setting<dim>  setting(on_tool<dim>(law, "clc-midpoint"));
      const Ledger &ledger = setting.model.ledger;
      const double  energy = ledger.value("total_energy"), x = ledger.value("linear_momentum_x"),
                   y      = ledger.value("linear_momentum_y"),
                   turned = ledger.value("angular_momentum_z"),
                   before = ledger.value("velocity_anvil_y");
      setting.run(8, 0.01);
      EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-12 * energy); // measured 2e-14
      EXPECT_NEAR(ledger.value("linear_momentum_x"), x, 1e-11 * std::abs(y));
      EXPECT_NEAR(ledger.value("linear_momentum_y"), y, 1e-11 * std::abs(y));
      // friction acts across the overlap and has a moment
      if (law == smooth)
        {
          EXPECT_NEAR(ledger.value("angular_momentum_z"), turned, 1e-4 * std::abs(turned));
        }
      EXPECT_GT(ledger.value("contact_duration_blocks"), 0.03);
      EXPECT_LT(ledger.value("velocity_anvil_y"), before);
      if (law == rough)
        {
          EXPECT_GT(ledger.value("friction_dissipation"), 1e-4 * energy);
        }
    }
}

// The tip of a wedge strikes the block between the middles of two facets. It comes no deeper than
// what the contact's stiffness asks for; without places of their own tips came in until a side met
// a middle, by 0.014 m here. The books close to round-off.
TEST(ToolScene, ATipMeetsWhatIsBetweenMiddles)
{
  Setting<2>    setting(replaced(on_tool<2>(rough, "clc-midpoint"),
                              "polygon(-0.2, 0.3; 1.7, 0.3; 1.7, 0.6; -0.2, 0.59)",
                              "polygon(0.68, 0.3; 0.88, 0.3; 0.78, 0.605)"));
  const Ledger &ledger  = setting.model.ledger;
  const double  energy  = ledger.value("total_energy");
  double        deepest = 0.;
  for (unsigned int step = 0; step < 8; ++step)
    {
      setting.run(1, 0.01);
      deepest = std::max(deepest, ledger.value("contact_penetration_blocks"));
    }
  EXPECT_GT(ledger.value("contact_duration_blocks"), 0.03);
  EXPECT_LT(deepest, 0.02 * 0.2); // of a cell
  EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-12 * energy);
}

// The edges of a box, whole and in parts no longer than asked for; a dent has none.
TEST(ToolScene, SharpPlacesAreEdgesAndCorners)
{
  const auto   box     = mesh_of_box<3>({0., 0., 0.}, {1., 2., 3.}, 10.);
  const auto   places  = sharp_places<3>(box, 0.5);
  double       length  = 0.;
  unsigned int corners = 0;
  for (const auto &place : places)
    {
      length += place.length;
      const dealii::Tensor<1, 3> from_middle = place.at - dealii::Point<3>(0.5, 1., 1.5);
      EXPECT_GT(place.outward * from_middle, 0.);
      EXPECT_NEAR(place.outward.norm(), 1., 1e-15);
      corners += place.length > 0.6;
    }
  EXPECT_NEAR(length, 4. * (1. + 2. + 3.), 1e-12);
  EXPECT_EQ(corners, 8u);                         // each stands for a quarter metre of three edges
  EXPECT_EQ(places.size(), 8u + 4 * (1 + 3 + 5)); // and those between them
  // an arrowhead: its tip and two barbs, not the dent between them; counter-clockwise
  const auto arrow = mesh_of_polygon({{0., 0.}, {2., -1.}, {0.5, 0.}, {2., 1.}}, 10.);
  EXPECT_EQ(sharp_places<2>(arrow, 0.5).size(), 3u);
}

TEST(ToolScene, RefusesWhatIsNoTool)
{
  const std::string good = on_tool<2>(smooth, "clc-midpoint");
  expect_parts(message_of(replaced(good, "set Tool = anvil", "set Tool = anvi")),
               {"Contact/blocks/Tool", "anvil"});
  expect_parts(message_of(replaced(good, "set Tool = anvil", "set Tool = anvil\n set Wall = left")),
               {"Contact/blocks/Wall", "in place of the second group"});
  expect_parts(message_of(
                 replaced(good, "set Tool = anvil", "set Tool = anvil\n set Second = upper")),
               {"Contact/blocks/Second", "in place of the second group"});
  // a tool in millimetres that were meant to be metres: longer than twenty grids
  expect_parts(message_of(replaced(good,
                                   "polygon(-0.2, 0.3; 1.7, 0.3; 1.7, 0.6; -0.2, 0.59)",
                                   "polygon(-200, 300; 1700, 300; 1700, 600; -200, 590)")),
               {"Rigid bodies/anvil/Geometry", "1900", "millimetres"});
  expect_parts(message_of(replaced(good,
                                   "set Friction coefficient = 0",
                                   "set Method = penalty\n    set Friction coefficient = 0")),
               {"Contact/blocks/"});
  const auto error_of = [](const std::string &text) -> std::string {
    try
      {
        Setting<2> setting(text);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  };
  expect_parts(error_of(
                 replaced(good,
                          "set Geometry = polygon(-0.2, 0.3; 1.7, 0.3; 1.7, 0.6; -0.2, 0.59)",
                          "set Mass = 1\n    set Centre = 0, 0")),
               {"Contact/blocks/Tool = anvil", "no shape"});
  expect_parts(error_of(replaced(good, "1.7, 0.6; -0.2, 0.59", "1.7, 0.76; -0.2, 0.76")),
               {"body 'upper' reaches", "into the rigid body 'anvil'", "more than half a cell"});
}
