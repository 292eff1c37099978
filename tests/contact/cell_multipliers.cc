// Uzawa's step at rest: pressures follow the mean gap of their cell.
#include <kedge/contact/cell_multipliers.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  Lattice<2>
  lattice_of_two_cells()
  {
    GridParameters<2> grid;
    grid.extent[0] = 2.;
    grid.extent[1] = 1.;
    grid.n_cells   = {{2, 1}};
    return Lattice<2>(grid);
  }

  ContactLaw
  law_at_rest()
  {
    ContactLaw law;
    law.normal_stiffness = 10.;
    law.at_rest          = true;
    law.conserving       = false;
    return law;
  }

  const dealii::Tensor<1, 2> up({0., 1.});

  ContactResponse<2>
  pressed_by(const double pressure)
  {
    ContactResponse<2> response;
    response.pressure = pressure;
    return response;
  }
} // namespace

/** Worked by hand: gaps (lambda - p)/eps of the first cell -0.2, 0.1 with areas 1, 2, mean 0. */
TEST(CellMultipliers, TakeTheMeanGapOfTheirCell)
{
  const Lattice<2>                    lattice = lattice_of_two_cells();
  const ContactLaw                    law     = law_at_rest();
  CellMultipliers<2>                  cells(lattice);
  std::array<double, 4>               pressures = {{3., 3., 4., 1.}};
  std::array<dealii::Tensor<1, 2>, 4> slips;
  slips[2][0] = 0.1;
  cells.add({0.2, 0.5}, 1., up, law, pressures[0], slips[0], pressed_by(5.));
  cells.add({0.8, 0.5}, 2., up, law, pressures[1], slips[1], pressed_by(2.));
  cells.add({0.5, 0.5}, 5., up, law, pressures[2], slips[2], pressed_by(0.)); // has parted
  cells.add({1.5, 0.5}, 1., up, law, pressures[3], slips[3], pressed_by(1.5));
  EXPECT_NEAR(cells.largest_gap(), 0.05, 1e-14);
  cells.update();
  EXPECT_NEAR(pressures[0], 3., 1e-14);
  EXPECT_NEAR(pressures[1], 3., 1e-14);
  EXPECT_EQ(pressures[2], 0.);
  EXPECT_NEAR(pressures[3], 1.5, 1e-14); // alone in its cell: Uzawa's own step
  EXPECT_EQ(slips[2][0], 0.1);           // it may press again in this step
}

/** Those of two faces of a corner in one cell are kept apart. */
TEST(CellMultipliers, DoNotMixSides)
{
  const Lattice<2>      lattice = lattice_of_two_cells();
  CellMultipliers<2>    cells(lattice);
  std::array<double, 2> pressures = {{3., 3.}};
  dealii::Tensor<1, 2>  slip, aside({1., 0.2});
  cells.add({0.2, 0.5}, 1., up, law_at_rest(), pressures[0], slip, pressed_by(5.));
  cells.add({0.3, 0.5}, 1., aside, law_at_rest(), pressures[1], slip, pressed_by(1.));
  EXPECT_NEAR(cells.largest_gap(), 0.2, 1e-14);
  cells.update();
  EXPECT_NEAR(pressures[0], 5., 1e-14);
  EXPECT_NEAR(pressures[1], 1., 1e-14);
}

/**
 * Worked by hand: N of the places 0.25, 1.5 at the nodes x = 0, 1, 2 are 3/4 1/4 0 and 0 1/2 1/2;
 * with areas 1, 2 and creeps 0.3, 0.6 the nodes have areas 3/4, 5/4, 1, sums of creep 0.225,
 * 0.675, 0.6, means 0.3, 0.54, 0.6; what counts as the creep is the largest sum over the largest
 * area. What slides takes the slip that its force has.
 */
TEST(CellMultipliers, SlipsFollowTheMeanCreepOfNodes)
{
  const Lattice<2>                    lattice = lattice_of_two_cells();
  CellMultipliers<2>                  cells(lattice);
  std::array<dealii::Tensor<1, 2>, 3> slips;
  std::array<double, 3>               pressures = {{2., 2., 2.}};
  slips[0][0]                                   = 0.4;
  ContactResponse<2> response                   = pressed_by(2.);
  response.sticks                               = true;
  response.slip_end[0]                          = 0.7;
  // at y = 0 the nodes above have no part
  cells.add({0.25, 0.}, 1., up, law_at_rest(), pressures[0], slips[0], response);
  response.slip_end[0] = 0.6;
  cells.add({1.5, 0.}, 2., up, law_at_rest(), pressures[1], slips[1], response);
  response.sticks      = false;
  response.slip_end[0] = 0.9;
  cells.add({1.5, 0.}, 2., up, law_at_rest(), pressures[2], slips[2], response);
  EXPECT_NEAR(cells.largest_creep(), 0.675 / 1.25, 1e-15);
  cells.update();
  EXPECT_NEAR(slips[0][0], 0.4 + 0.75 * 0.3 + 0.25 * 0.54, 1e-15);
  EXPECT_NEAR(slips[1][0], 0.5 * 0.54 + 0.5 * 0.6, 1e-15);
  EXPECT_NEAR(slips[2][0], 0.9, 1e-15);
}
