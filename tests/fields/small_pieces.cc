// Pieces of material too small to fill a cell: who belongs together, and what their nodes follow.
#include "../transfer/cloud.h"

#include <kedge/fields/small_pieces.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class FieldsSmallPieces : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Single GIMP points of 0.2 cells' half-length at the given places in cells along x. */
  template <int dim>
  struct Points
  {
    Points(const std::vector<double> &places, const double y)
      : grid(some_grid<dim>(cells()), MPI_COMM_SELF)
      , patch(grid, parameters(), {{}, {}})
    {
      std::vector<PointRecord<dim>> records;
      for (const double place : places)
        {
          PointRecord<dim> record{};
          record.id                     = records.size();
          record.state.reference_volume = 1.;
          for (int d = 0; d < dim; ++d)
            {
              const double h               = grid.lattice().h[d];
              record.location[d]           = grid.lattice().origin[d] + (d == 0 ? place : y) * h;
              record.state.half_lengths[d] = 0.2 * h;
              record.state.deformation_gradient[d][d] = record.state.elastic_frame[d][d] = 1.;
              record.state.reference_volume *= 0.4 * h;
            }
          record.state.out_of_plane_elastic_stretch = 1.;
          record.state.mass                         = 1.;
          records.push_back(record);
        }
      LatticeWindow<dim> all;
      for (int d = 0; d < dim; ++d)
        {
          all.low[d]     = 0;
          all.n_cells[d] = static_cast<int>(cells()[d]);
        }
      grid.cover(all, std::vector<unsigned int>(all.n_cells_total(), 1));
      cloud.distribute(grid, records);
      patch.reinit(cloud, [](std::vector<unsigned char> &) {});
    }

    static PatchParameters
    parameters()
    {
      PatchParameters result;
      result.basis_of_body    = {BasisKind::gimp};
      result.n_components     = dim;
      result.smallest_filling = 0.5; // in cells: no cell is well filled
      return result;
    }

    static std::array<unsigned int, dim>
    cells()
    {
      std::array<unsigned int, dim> n_cells;
      n_cells.fill(6);
      n_cells[0] = 12;
      return n_cells;
    }

    BackgroundGrid<dim> grid;
    MaterialPoints<dim> cloud;
    Patch<dim>          patch;
  };
} // namespace

TYPED_TEST_SUITE(FieldsSmallPieces, Dimensions);

// points in the same cell, in cells that meet at nodes, and one cell apart
TYPED_TEST(FieldsSmallPieces, BelongTogetherThroughSharedNodes)
{
  constexpr int     dim = TypeParam::value;
  const Points<dim> points({1.4, 1.6, 2.5, 4.5, 8.5, 8.9}, 2.5);
  const Pieces      pieces = find_pieces(points.grid, points.patch.points);
  ASSERT_EQ(pieces.n_points, (std::vector<unsigned int>{3, 1, 2}));
  const auto piece_at = [&](const int i) {
    LatticeIndex<dim> node;
    node.fill(2);
    node[0] = i;
    return pieces.of_node[points.grid.window().node_number(node)];
  };
  for (const int i : {1, 2, 3})
    EXPECT_EQ(piece_at(i), 0u);
  for (const int i : {4, 5})
    EXPECT_EQ(piece_at(i), 1u);
  for (const int i : {8, 9, 10}) // the point at 8.9 reaches over the line at 9
    EXPECT_EQ(piece_at(i), 2u);
  for (const int i : {0, 6, 7, 11})
    EXPECT_EQ(piece_at(i), Pieces::none);
}

// A point across a grid line in each direction reaches 3^dim nodes; it moves as one affine
// body: dim + 1 nodes are free, all others follow linear fields exactly, of their own piece alone.
TYPED_TEST(FieldsSmallPieces, NodesFollowOneCell)
{
  constexpr int     dim = TypeParam::value;
  const Points<dim> points({2.1, 7.1}, 3.05);
  const auto       &ties   = points.patch.ties;
  const auto       &nodes  = points.patch.nodes;
  const Pieces      pieces = find_pieces(points.grid, points.patch.points);
  unsigned int      n_free = 0;
  for (unsigned int i = 0; i < nodes.n_local(); ++i)
    {
      n_free += !ties.is_tied(i, 0);
      if (!ties.is_tied(i, 0))
        continue;
      const auto            &tie = ties.ties()[ties.tie_of(i)];
      dealii::Tensor<1, dim> place;
      double                 sum = 0.;
      for (unsigned int k = 0; k < tie.roots.size(); ++k)
        {
          EXPECT_FALSE(ties.is_tied(tie.roots[k], 0));
          EXPECT_EQ(pieces.of_node[nodes.window_node(tie.roots[k])],
                    pieces.of_node[nodes.window_node(i)]);
          sum += tie.weights[k];
          place += tie.weights[k] * points.patch.node_position(tie.roots[k]);
        }
      EXPECT_NEAR(sum, 1., 1e-15);
      EXPECT_NEAR((place - points.patch.node_position(i)).norm(), 0., 1e-14);
    }
  EXPECT_EQ(nodes.n_local(), 2 * static_cast<unsigned int>(std::pow(3, dim) + 0.5));
  EXPECT_EQ(n_free, 2u * (dim + 1));
}
