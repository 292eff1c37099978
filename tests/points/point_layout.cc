// What a cloud stores of its points.
#include <kedge/points/point_layout.h>

#include <gtest/gtest.h>

#include <numeric>

using namespace kedge;

namespace
{
  /** A state each of whose numbers is another one. */
  template <int dim>
  PointState<dim>
  numbered()
  {
    PointState<dim> state;
    auto           *values = reinterpret_cast<double *>(&state);
    std::iota(values, values + n_state_values<dim>, 1.);
    return state;
  }

  template <int dim>
  PointState<dim>
  stored(const PointLayout<dim> &layout)
  {
    std::vector<double> values(layout.n_values());
    layout.store(numbered<dim>(), values.data());
    PointState<dim> result{};
    layout.load(values.data(), result);
    return result;
  }
} // namespace

TEST(PointsPointLayout, StoresEverythingIfNothingIsSaid)
{
  const auto  all = numbered<3>(), back = stored<3>({});
  const auto *expected = reinterpret_cast<const double *>(&all),
             *values   = reinterpret_cast<const double *>(&back);
  for (unsigned int i = 0; i < n_state_values<3>; ++i)
    EXPECT_EQ(values[i], expected[i]);
}

TEST(PointsPointLayout, WhatAnElasticPointDoesNotUseTakesNoMemory)
{
  // counted by hand: 4 scalars, 5 vectors, F and B, tau, 3 of plane strain's and the energy
  EXPECT_EQ(PointLayout<2>({}, false, false, false, false).n_values(), 4 + 10 + 8 + 3 + 3);
  EXPECT_EQ(PointLayout<3>({}, false, false, false, false).n_values(), 4 + 15 + 18 + 6 + 3);
  // energies of hardening and dissipation; a column; five scalars and a vector of the pores
  EXPECT_EQ(PointLayout<3>({2}, true, true, false, true).n_values(), 46 + 3 + 1 + 2 + 5 + 3);
}

TEST(PointsPointLayout, OnlyWhatIsUsedComesBack)
{
  const auto all  = numbered<2>();
  const auto some = stored<2>({{0, 3}, false, true, false, false});
  EXPECT_EQ(some.body, all.body);
  EXPECT_EQ(some.strain_energy, all.strain_energy);
  EXPECT_EQ(some.memory[0], all.memory[0]);
  EXPECT_EQ(some.memory[3], all.memory[3]);
  EXPECT_EQ(some.pore_pressure, all.pore_pressure);
  EXPECT_EQ(some.darcy_velocity, all.darcy_velocity);
  EXPECT_EQ(some.memory[1], 0.);
  EXPECT_EQ(some.acceleration.norm(), 0.);
  EXPECT_EQ(some.hardening_energy, 0.);
  EXPECT_EQ(some.plastic_dissipation, 0.);
}
