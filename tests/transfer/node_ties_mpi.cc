// Ties of badly filled nodes against a dense C, on one rank and on two.
#include "dense.h"

#include <kedge/transfer/equation_system.h>

#include <gtest/gtest.h>

#include <map>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class TransferTiesMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  using Weights = std::map<std::size_t, double>; ///< by window number of the root

  /** Ties of all ranks by window number of the tied node; ranks must agree. */
  template <int dim>
  std::map<std::size_t, Weights>
  all_ties(const Cloud<dim> &cloud)
  {
    std::vector<double> flat;
    for (const auto &tie : cloud.ties.ties())
      for (unsigned int k = 0; k < tie.roots.size(); ++k)
        flat.insert(flat.end(),
                    {double(cloud.nodes.window_node(tie.node)),
                     double(cloud.nodes.window_node(tie.roots[k])),
                     tie.weights[k]});
    std::map<std::size_t, Weights> result;
    for (const auto &share : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, flat))
      for (std::size_t i = 0; i < share.size(); i += 3)
        {
          const auto node = static_cast<std::size_t>(share[i]);
          const auto root = static_cast<std::size_t>(share[i + 1]);
          if (result[node].count(root) > 0)
            {
              EXPECT_EQ(result[node][root], share[i + 2]);
            }
          result[node][root] = share[i + 2];
        }
    return result;
  }

  /** Volume of material at each node, in cells. */
  template <int dim>
  std::vector<double>
  filling(const Cloud<dim> &cloud, const DenseCloud<dim> &dense)
  {
    std::vector<double> result(dense.n_nodes, 0.);
    double              cell = 1.;
    for (int d = 0; d < dim; ++d)
      cell *= cloud.grid.lattice().h[d];
    for (std::size_t p = 0; p < dense.n_points; ++p)
      {
        const auto &state = cloud.records[p].state;
        for (std::size_t A = 0; A < dense.n_nodes; ++A)
          result[A] +=
            dense.N(A, p) * state.reference_volume * determinant(state.deformation_gradient) / cell;
      }
    return result;
  }

  /** Calls check(cloud, dense, threshold) for both bases. */
  template <int dim, typename Check>
  void
  for_both_bases(const Check &check)
  {
    const double threshold = dim == 2 ? 0.065 : 0.1;
    for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp})
      {
        const Cloud<dim> cloud({basis}, 2, 41, 3, threshold);
        check(cloud, DenseCloud<dim>(cloud, {basis}), threshold);
      }
  }
} // namespace

TYPED_TEST_SUITE(TransferTiesMpi, Dimensions);

TYPED_TEST(TransferTiesMpi, ExtrapolateFromWellFilledNodes)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>(
    [](const Cloud<dim> &cloud, const DenseCloud<dim> &dense, const double threshold) {
      const auto ties = all_ties(cloud);
      const auto full = filling(cloud, dense);
      EXPECT_GE(ties.size(), 3u);
      for (std::size_t A = 0; A < dense.n_nodes; ++A)
        EXPECT_EQ(ties.count(A) > 0, full[A] > 0. && full[A] < threshold) << "node " << A;
      for (const auto &[node, weights] : ties)
        {
          double             one = 0.;
          dealii::Point<dim> x;
          for (const auto &[root, weight] : weights)
            {
              EXPECT_GE(full[root], threshold);
              one += weight;
              x += weight * cloud.grid.lattice().node_position(cloud.window().node_index(root));
            }
          // linear fields survive; weights are small whole numbers
          EXPECT_NEAR(one, 1., 1e-14);
          EXPECT_LT(x.distance(cloud.grid.lattice().node_position(cloud.window().node_index(node))),
                    1e-13);
        }
    });
}

TYPED_TEST(TransferTiesMpi, ProlongAndRestrictAreTransposed)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &, const double) {
    auto                v = cloud.random_nodal(1., 1);
    std::vector<double> r = cloud.random_nodal(1., 2), restricted = r, prolonged = v;
    cloud.ties.prolong(prolonged);
    cloud.ties.restrict_sums(restricted);
    double left = 0., right = 0.; // (C v) . r = v . (C^T r), of this rank's share of r
    for (std::size_t i = 0; i < v.size(); ++i)
      {
        left += prolonged[i] * r[i];
        right += v[i] * restricted[i];
      }
    EXPECT_NEAR(left, right, 1e-12);
    for (const auto &tie : cloud.ties.ties())
      EXPECT_EQ(restricted[tie.node * dim], 0.);
    // all ranks see the same values
    const auto owned = by_window(cloud, prolonged, dim);
    for (unsigned int i = 0; i < cloud.nodes.n_local() * dim; ++i)
      EXPECT_EQ(prolonged[i], owned[cloud.nodes.window_node(i / dim) * dim + i % dim]);
  });
}

TYPED_TEST(TransferTiesMpi, EquationsAreTheDenseProduct)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense, const double) {
    const auto      ties = all_ties(cloud);
    NodeMatrix<dim> mass;
    mass.reinit(cloud.nodes.n_local(), 1, 2);
    assemble_mass(cloud.step, cloud.window(), cloud.nodes, mass);

    std::vector<NodalStatus> status(cloud.nodes.n_local(), NodalStatus::free);
    for (unsigned int i = 0; i < status.size(); ++i)
      if (cloud.nodes.window_node(i) % 7 == 0)
        status[i] = NodalStatus::prescribed;
      else if (cloud.ties.tie_of(i) >= 0)
        status[i] = NodalStatus::tied;
    EquationSystem<dim> equations;
    equations.reinit(cloud.grid, cloud.nodes, cloud.ties, status, mass);
    equations.fill(cloud.nodes, mass);

    const SparseSystem      &system = equations.system();
    std::vector<std::size_t> mine, node_of;
    for (unsigned int e = 0; e < system.n_rows(); ++e)
      mine.push_back(cloud.nodes.window_node(equations.nodal_index(e)));
    for (const auto &share : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      node_of.insert(node_of.end(), share.begin(), share.end());

    // columns of C: a free node itself and what is tied to it
    std::map<std::size_t, Weights> moved_by;
    for (const std::size_t node : node_of)
      {
        EXPECT_EQ(ties.count(node), 0u) << "a tied node has an equation";
        moved_by[node][node] = 1.;
      }
    for (const auto &[node, weights] : ties)
      if (node % 7 != 0)
        for (const auto &[root, weight] : weights)
          if (moved_by.count(root) > 0)
            moved_by[root][node] = weight;

    for (unsigned int e = 0; e < system.n_rows(); ++e)
      {
        std::vector<double> row(node_of.size(), 0.);
        for (std::int64_t k = system.row_start[e]; k < system.row_start[e + 1]; ++k)
          row[system.column[k]] = system.value[k];
        for (std::size_t c = 0; c < row.size(); ++c)
          {
            double expected = 0.; // (C^T M C)_ec
            for (const auto &[A, weight_A] : moved_by[mine[e]])
              for (const auto &[B, weight_B] : moved_by[node_of[c]])
                expected += weight_A * weight_B * dense.effective_mass(0., A, B);
            EXPECT_NEAR(row[c], expected, 1e-12);
          }
      }
  });
}
