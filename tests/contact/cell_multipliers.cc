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
  cells.add({0.2, 0.5}, 1., law, pressures[0], slips[0], pressed_by(5.));
  cells.add({0.8, 0.5}, 2., law, pressures[1], slips[1], pressed_by(2.));
  cells.add({0.5, 0.5}, 5., law, pressures[2], slips[2], pressed_by(0.)); // has parted
  cells.add({1.5, 0.5}, 1., law, pressures[3], slips[3], pressed_by(1.5));
  EXPECT_NEAR(cells.largest_violation(), 0.05, 1e-14);
  cells.update();
  EXPECT_NEAR(pressures[0], 3., 1e-14);
  EXPECT_NEAR(pressures[1], 3., 1e-14);
  EXPECT_EQ(pressures[2], 0.);
  EXPECT_NEAR(pressures[3], 1.5, 1e-14); // alone in its cell: Uzawa's own step
  EXPECT_EQ(slips[2][0], 0.1);           // it may press again in this step
}

TEST(CellMultipliers, WhatSticksMustNotCreep)
{
  const Lattice<2>   lattice = lattice_of_two_cells();
  CellMultipliers<2> cells(lattice);
  ContactResponse<2> response = pressed_by(2.);
  response.sticks             = true;
  response.slip_end[0]        = 0.7;
  dealii::Tensor<1, 2> slip_n;
  slip_n[0]       = 0.4;
  double pressure = 2.;
  cells.add({0.2, 0.5}, 1., law_at_rest(), pressure, slip_n, response);
  EXPECT_NEAR(cells.largest_violation(), 0.3, 1e-15);
  cells.update();
  EXPECT_EQ(slip_n[0], 0.7);
}
