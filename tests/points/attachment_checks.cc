#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  Lattice<2>
  four_by_two_cells()
  {
    GridParameters<2> grid;
    grid.origin  = {0., -1.};
    grid.extent  = dealii::Tensor<1, 2>({2., 1.}); // nodes every half metre
    grid.n_cells = {{4, 2}};
    return Lattice<2>(grid);
  }

  NodeConditionParameters<2>
  condition(const std::string &name, const std::string &where)
  {
    NodeConditionParameters<2> result;
    result.name    = name;
    result.on_side = false;
    result.where   = where;
    return result;
  }

  std::string
  message_of(const NodeConditionParameters<2> &condition)
  {
    try
      {
        check_node_conditions<2>({condition}, {{"a", .5}}, four_by_two_cells());
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(PointsAttachment, PlacesAreNearWithinTwoDomains)
{
  // half-lengths 3 and 4: the corner of the domain is 5 away, twice the domain's diagonal 20
  const dealii::Tensor<1, 2> half({3., 4.});
  EXPECT_NO_THROW(check_nearness<2>("Probe 'a'", {13., 14.}, {10., 10.}, half));
  EXPECT_NO_THROW(check_nearness<2>("Probe 'a'", {21.9, 26.}, {10., 10.}, half));
  try
    {
      check_nearness<2>("Probe 'a'", {40., 50.}, {10., 10.}, half);
      FAIL();
    }
  catch (const UserError &error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("Probe 'a' is to act at (40 50), 50 m from"), std::string::npos);
      EXPECT_NE(message.find("20 m away at most"), std::string::npos);
    }
}

TEST(PointsAttachment, ConditionsMustHoldANodeOfTheGrid)
{
  EXPECT_EQ(message_of(condition("wall", "x < a")), ""); // nodes at 0
  EXPECT_EQ(message_of(condition("wall", "y == -0.5")), "");
  EXPECT_EQ(message_of(condition("wall", "x == 2 && y == 0")), ""); // the last node
  EXPECT_EQ(message_of(condition("wall", "0")), "");                // switched off
  const std::string message = message_of(condition("wall", "x == a/2"));
  EXPECT_NE(message.find("Node conditions/wall/Where = x == a/2"), std::string::npos);
  EXPECT_NE(message.find("none of the grid's nodes, which stand every (0.5 0.5) m from (0 -1)"),
            std::string::npos);
  EXPECT_NE(message_of(condition("roof", "y > 0.1")), "");
}

TEST(PointsAttachment, HeldNodesAreThoseOfCellsWithPoints)
{
  GeneratedPoint<2> point{};
  point.record.location = {.3, -.2}; // in the cell from (0, -.5) to (.5, 0)
  NodeConditionParameters<2> bottom;
  bottom.name = "bottom";
  bottom.side = 2; // y = -1: a cell further down
  NodeConditionParameters<2> left;
  left.name = "left";
  const auto held =
    count_held_nodes<2>({condition("far", "x > 0.6"), bottom, left, condition("near", "x > 0.4")},
                        {},
                        GridLevels<2>(four_by_two_cells()),
                        {PointOrigin<2>(point), PointOrigin<2>(point)});
  // of the cell's four nodes two stand at x = 0 and two at x = 0.5
  EXPECT_EQ(held, (std::vector<std::size_t>{0, 0, 2, 2}));
}
