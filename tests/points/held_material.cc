// What node conditions hold of the material: figures worked out by hand.
#include <kedge/points/held_material.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  /** Cells of 1 m from (0, 0) to (4, 2). */
  Lattice<2>
  metre_cells()
  {
    GridParameters<2> grid;
    grid.extent  = dealii::Tensor<1, 2>({4., 2.});
    grid.n_cells = {{4, 2}};
    return Lattice<2>(grid);
  }

  NodeRegion<2>
  region(const std::string &where)
  {
    NodeConditionParameters<2> condition;
    condition.on_side = false;
    condition.where   = where;
    return {condition, {{"a", .5}}};
  }

  /** Points in the middle of cells, each with these coordinates. */
  std::vector<PointOrigin<2>>
  points_at(const std::vector<dealii::Point<2>> &places)
  {
    std::vector<PointOrigin<2>> result;
    for (const auto &place : places)
      {
        GeneratedPoint<2> point{};
        point.record.location = place;
        result.emplace_back(point);
      }
    return result;
  }

  const std::vector<LatticeIndex<2>> all_nodes =
    nodes_of_cells_with_points<2>(GridLevels<2>(metre_cells()),
                                  points_at({{.5, .5}, {1.5, .5}, {2.5, .5}, {3.5, .5}}));

  /** What is left of what a condition held of two points of masses 3 and 1 that have moved. */
  double
  part_held(const NodeRegion<2> &where, const dealii::Tensor<1, 2> &u, const bool holds_body = true)
  {
    GridParameters<2> parameters;
    parameters.extent  = dealii::Tensor<1, 2>({4., 2.});
    parameters.n_cells = {{4, 2}};
    BackgroundGrid<2> grid(parameters, MPI_COMM_SELF);
    grid.cover({{{0, 0}}, {{4, 2}}}, std::vector<unsigned int>(8, 1));
    std::vector<PointRecord<2>> records(2);
    for (unsigned int i = 0; i < 2; ++i)
      {
        auto &record                    = records[i];
        record                          = PointRecord<2>{};
        record.id                       = i;
        record.state.mass               = i == 0 ? 3. : 1.;
        record.state.reference_position = dealii::Tensor<1, 2>({i == 0 ? 0.75 : 1.5, 0.5});
        record.location                 = dealii::Point<2>(record.state.reference_position + u);
      }
    MaterialPoints<2> cloud;
    cloud.distribute(grid, records);
    HeldMaterial<2> held({{where, {holds_body}}}, metre_cells());
    return held.parts(cloud, MPI_COMM_SELF)[0];
  }
} // namespace

TEST(PointsHeldMaterial, RegionsThatEndBetweenNodes)
{
  const auto beyond = [](const std::string &where) {
    return reach_beyond_nodes<2>(region(where), metre_cells(), all_nodes);
  };
  EXPECT_EQ(beyond("abs(x - 2) < 1e-6"), 0.); // a row of nodes
  EXPECT_EQ(beyond("x < 2.999"), 0.);         // all but those at 3, on purpose
  EXPECT_EQ(beyond("1"), 0.);
  EXPECT_NEAR(beyond("x < 2 + a"), .5, 1e-3); // of the bisection: 1e-4
  EXPECT_NEAR(beyond("x > 1.8"), .2, 1e-3);   // the node at 2 and 0.2 m more
  EXPECT_NEAR(beyond("x > 1.8 && x < 3.7"), .7, 1e-3);
  EXPECT_EQ(beyond("abs(x - 2) < 0.5"), 0.); // around a row of nodes
  EXPECT_EQ(beyond("y > 1.5"), 0.);          // no node of a cell with material
  EXPECT_EQ(beyond("y < 0.25"), 0.);         // the lowest row
}

TEST(PointsHeldMaterial, WhatTravelCarriesAway)
{
  const auto away = [](const std::string &where, const double x, const double y) {
    return part_carried_away<2>(region(where),
                                metre_cells(),
                                all_nodes,
                                dealii::Tensor<1, 2>({x, y}));
  };
  EXPECT_EQ(away("abs(x - 2) < 1e-6", 1.2, 0.), 1.);
  EXPECT_EQ(away("abs(x - 2) < 1e-6", .4, 0.), 0.);  // less than half a cell
  EXPECT_EQ(away("abs(x - 2) < 1e-6", 0., 1.2), 0.); // along the row
  EXPECT_EQ(away("x > 2 - 1e-6", 2., 0.), 0.);       // the region goes on, beyond the material too
  EXPECT_EQ(away("x < 2 + 1e-6", 2., 0.), 2. / 3.);  // of the rows 0, 1, 2 the last two
  EXPECT_EQ(away("y > 1.5", 0., 2.), 0.);            // holds nothing
  NodeConditionParameters<2> left;
  EXPECT_EQ(
    part_carried_away<2>({left, {}}, metre_cells(), all_nodes, dealii::Tensor<1, 2>({2., 0.})),
    1.);
}

TEST(PointsHeldMaterial, PartsThatAreStillHeld)
{
  // the row x = 1 holds 3/4 of the point at 0.75 (3 kg) and 1/2 of that at 1.5 (1 kg): 2.75 kg
  const auto row = region("abs(x - 1) < 1e-6");
  EXPECT_DOUBLE_EQ(part_held(row, {}), 1.);
  // on to 1 and 1.75: 1 and 1/4 of them. What the first has gained does not count
  EXPECT_DOUBLE_EQ(part_held(row, dealii::Tensor<1, 2>({.25, 0.})), 1. - .25 / 2.75);
  // to 1.75 and 2.5: 1/4 of the first is left
  EXPECT_DOUBLE_EQ(part_held(row, dealii::Tensor<1, 2>({1., 0.})), .75 / 2.75);
  EXPECT_NEAR(part_held(row, dealii::Tensor<1, 2>({1.5, 0.})), 0., 1e-15);
  EXPECT_DOUBLE_EQ(part_held(row, dealii::Tensor<1, 2>({0., 1.})), 1.);                // along it
  EXPECT_DOUBLE_EQ(part_held(row, dealii::Tensor<1, 2>({1.5, 0.}), false), 1.);        // another's
  EXPECT_DOUBLE_EQ(part_held(region("x > 3.5"), dealii::Tensor<1, 2>({1.5, 0.})), 1.); // nothing
}
