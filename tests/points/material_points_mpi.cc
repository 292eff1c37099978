// Points that move between cells, within a rank and across ranks.
#include "../transfer/cloud.h"

#include <gtest/gtest.h>

#include <functional>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class PointsCloudMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /**
   * Shifts the points for which @p moves(location) holds by a cell along each
   * axis and relocates; then every point must stand once, where it should,
   * with its state, on the rank that owns its cell.
   */
  template <int dim>
  void
  check_move(Cloud<dim> &cloud, const std::function<bool(const dealii::Point<dim> &)> &moves)
  {
    const auto h = cloud.grid.lattice().h;
    cloud.points.update_each(
      [&](const unsigned int, dealii::Point<dim> &location, PointState<dim> &) {
        if (moves(location))
          location += h;
      });
    EXPECT_EQ(cloud.points.relocate(cloud.grid), 0u);

    std::vector<double> found(cloud.records.size(), 0.);
    const unsigned int  rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    cloud.points.for_each([&](const unsigned int,
                              const std::uint64_t       id,
                              const dealii::Point<dim> &location,
                              const PointState<dim>    &state) {
      auto &record = cloud.records[id];
      found[id] += 1.;
      EXPECT_EQ(state.mass, record.state.mass);
      EXPECT_EQ(location, moves(record.location) ? record.location + h : record.location);
      EXPECT_EQ(cloud.grid.cell_owner(cloud.grid.lattice().cell_of(location)), rank);
    });
    dealii::Utilities::MPI::sum(found, MPI_COMM_WORLD, found);
    for (const double times : found)
      EXPECT_EQ(times, 1.);
    for (auto &record : cloud.records)
      if (moves(record.location))
        record.location += h;
  }
} // namespace

TYPED_TEST_SUITE(PointsCloudMpi, Dimensions);

TYPED_TEST(PointsCloudMpi, PointsOfOneRankMoveAlone)
{
  constexpr int dim = TypeParam::value;
  for (const unsigned int mover : {0u, 1u})
    {
      Cloud<dim> cloud({BasisKind::gimp}, 2, 3);
      check_move<dim>(cloud, [&](const dealii::Point<dim> &x) {
        return cloud.grid.cell_owner(cloud.grid.lattice().cell_of(x)) == mover;
      });
    }
}

TYPED_TEST(PointsCloudMpi, NobodyAllAndHalfMove)
{
  constexpr int dim = TypeParam::value;
  Cloud<dim>    cloud({BasisKind::linear}, 3, 4);
  check_move<dim>(cloud, [](const dealii::Point<dim> &) {
    return false;
  });
  check_move<dim>(cloud, [](const dealii::Point<dim> &) {
    return true;
  });
  const double middle = cloud.records.front().location[1];
  check_move<dim>(cloud, [&](const dealii::Point<dim> &x) {
    return x[1] > middle;
  });
}
