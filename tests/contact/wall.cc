// Contact of a body with a rigid plane: its tangent, its books, what it refuses.
#include "../equations/term_cloud.h"
#include "two_blocks.h"

#include <kedge/contact/wall_term.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  /** The two blocks, of which the upper one falls on an oblique plane that the lower one does not
   * feel. */
  template <int dim>
  std::string
  on_plane(const std::string &law, const std::string &scheme)
  {
    std::string       text   = two_blocks<dim>(law, scheme);
    const std::string second = "set Second = upper";
    text.replace(text.find(second),
                 second.size(),
                 dim == 2 ? "set Wall normal = 0.1, 1\n    set Wall point = 0.4, 0.6"
                          : "set Wall normal = 0.1, 1, -0.1\n    set Wall point = 0.4, 0.6, 0.3");
    const std::string first = "set First  = lower";
    text.replace(text.find(first), first.size(), "set First  = upper");
    const std::string geometry =
      dim == 2 ? "box(0.13, 0.1; 1.4, 0.6)" : "box(0.13, 0.1, 0.2; 1.4, 0.6, 1.1)";
    text.replace(text.find(geometry),
                 geometry.size(),
                 dim == 2 ? "box(0.13, 0.1; 1.4, 0.2)" : "box(0.13, 0.1, 0.2; 1.4, 0.2, 1.1)");
    return text;
  }

  template <typename Dimension>
  class Wall : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  const std::string rough  = "    set Friction coefficient = 0.3\n    set Surface spacing = 0.1";
  const std::string smooth = "    set Friction coefficient = 0\n    set Surface spacing = 0.1";
} // namespace

TYPED_TEST_SUITE(Wall, Dimensions);

TYPED_TEST(Wall, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : {smooth, rough, rough + "\n    set Adhesion = 100"})
    {
      Setting<dim> setting(on_plane<dim>(law, "clc-midpoint"));
      setting.run(2, 0.01);
      EXPECT_GT(setting.model.ledger.value("contact_area_blocks"), 0.);
      setting.start_step(0.01);
      setting.correct({0.9, 0.1, 0.1});
      test::expect_slope_of_residual(*setting.equations);
    }
}

TYPED_TEST(Wall, BooksCloseAndTheForceIsWhatMomentumLoses)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : {smooth, rough})
    {
      Setting<dim>  setting(on_plane<dim>(law, "clc-midpoint"));
      const Ledger &ledger = setting.model.ledger;
      const double  energy = ledger.value("total_energy");
      for (unsigned int k = 0; k < 8; ++k)
        {
          const double before = ledger.value("linear_momentum_y");
          setting.run(1, 0.01);
          EXPECT_NEAR(ledger.value("linear_momentum_y") - before,
                      0.01 * ledger.value("contact_force_y_blocks"),
                      1e-10 * std::abs(before));
        }
      EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11 * energy);
      EXPECT_GT(ledger.value("contact_duration_blocks"), 0.03);
      if (law == rough)
        EXPECT_GT(ledger.value("friction_dissipation"), 1e-3 * energy);
      else
        EXPECT_EQ(ledger.value("friction_dissipation"), 0.);
    }
}

TEST(WallScene, RefusesWhatIsNoWall)
{
  const auto with = [](const std::string &entries) {
    std::string       text   = two_blocks<2>(entries, "clc-midpoint");
    const std::string second = "set Second = upper";
    return text.replace(text.find(second), second.size(), "");
  };
  expect_parts(message_of(with("")), {"Contact/blocks/Second", "or give a Wall"});
  expect_parts(message_of(two_blocks<2>("    set Wall = bottom", "clc-midpoint")),
               {"Contact/blocks/Second", "in place of the second group"});
  expect_parts(message_of(with("    set Wall = bottom\n    set Wall normal = 0, 1")),
               {"Contact/blocks/Wall normal", "Leave one of the two out"});
  expect_parts(message_of(with("    set Wall normal = 0, 1")),
               {"Contact/blocks/Wall point", "needs a point"});
  expect_parts(message_of(with("    set Wall normal = 0, 0\n    set Wall point = 0, 0")),
               {"Contact/blocks/Wall normal", "no direction"});
  expect_parts(message_of(with("    set Wall = bottom\n    set Method = penalty")),
               {"Contact/blocks/Method", "surface points"});
  expect_parts(message_of(two_blocks<2>("    set Wall point = 0, 1", "clc-midpoint")),
               {"Contact/blocks/Wall point", "There is no Wall"});
  expect_parts(message_of(with("    set Wall = under")), {"Contact/blocks/Wall", "under"});
  try
    {
      Setting<2> setting(with("    set Wall = bottom\n    set Wall point = 0, 0.3"));
      FAIL();
    }
  catch (const UserError &error)
    {
      expect_parts(error.what(),
                   {"body 'lower' reaches", "behind the wall", "more than half a cell"});
    }
}
