// Ties of badly filled nodes against a dense C, on one rank and on two.
#include "../transfer/dense.h"

#include <kedge/equations/equation_system.h>

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
    for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
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
    mass.reinit(cloud.nodes.n_local(), 1, 3);
    assemble_mass(cloud.patch, mass);

    std::vector<NodalStatus> status(cloud.nodes.n_local(), NodalStatus::free);
    for (unsigned int i = 0; i < status.size(); ++i)
      if (cloud.nodes.window_node(i) % 7 == 0)
        status[i] = NodalStatus::prescribed;
      else if (cloud.ties.tie_of(i) >= 0)
        status[i] = NodalStatus::tied;
    EquationSystem<dim> equations;
    equations.reinit(cloud.patch, status, mass);
    equations.fill(cloud.patch, mass);

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

// A has blocks f_pm M_ij, f_pm = 1 + p + 3 m, and single components are prescribed.
TYPED_TEST(TransferTiesMpi, EquationsOfVectorsAreTheDenseProduct)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense, const double) {
    const auto      ties = all_ties(cloud);
    NodeMatrix<dim> mass, matrix;
    mass.reinit(cloud.nodes.n_local(), 1, 3);
    assemble_mass(cloud.patch, mass);
    matrix.reinit(cloud.nodes.n_local(), dim, 3);
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      for (int p = 0; p < dim; ++p)
        for (unsigned int slot = 0; slot < matrix.n_slots(); ++slot)
          for (int m = 0; m < dim; ++m)
            matrix.row(i, p)[slot * dim + m] = (1 + p + 3 * m) * mass.row(i, 0)[slot];

    const auto prescribed = [](const std::size_t window_node, const std::size_t component) {
      return (window_node + 2 * component) % 5 == 0;
    };
    std::vector<NodalStatus> status(cloud.nodes.n_local() * dim, NodalStatus::free);
    for (unsigned int i = 0; i < status.size(); ++i)
      if (prescribed(cloud.nodes.window_node(i / dim), i % dim))
        status[i] = NodalStatus::prescribed;
      else if (cloud.ties.tie_of(i / dim) >= 0)
        status[i] = NodalStatus::tied;
    EquationSystem<dim> equations;
    equations.reinit(cloud.patch, status, matrix);
    equations.fill(cloud.patch, matrix);

    const SparseSystem      &system = equations.system();
    std::vector<std::size_t> mine, index_of; // window number * dim + component
    for (unsigned int e = 0; e < system.n_rows(); ++e)
      mine.push_back(cloud.nodes.window_node(equations.nodal_index(e) / dim) * dim +
                     equations.nodal_index(e) % dim);
    for (const auto &share : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      index_of.insert(index_of.end(), share.begin(), share.end());

    std::map<std::size_t, Weights> moved_by; // columns of C
    for (const std::size_t index : index_of)
      moved_by[index][index] = 1.;
    for (const auto &[node, weights] : ties)
      for (int c = 0; c < dim; ++c)
        if (!prescribed(node, c))
          for (const auto &[root, weight] : weights)
            if (moved_by.count(root * dim + c) > 0)
              moved_by[root * dim + c][node * dim + c] = weight;

    for (unsigned int e = 0; e < system.n_rows(); ++e)
      {
        std::vector<double> row(index_of.size(), 0.);
        for (std::int64_t k = system.row_start[e]; k < system.row_start[e + 1]; ++k)
          {
            EXPECT_TRUE(k == system.row_start[e] || system.column[k] > system.column[k - 1]);
            row[system.column[k]] = system.value[k];
          }
        const double row_factor = 1 + mine[e] % dim;
        for (std::size_t c = 0; c < row.size(); ++c)
          {
            double expected = 0.; // (C^T A C)_ec
            for (const auto &[A, weight_A] : moved_by[mine[e]])
              for (const auto &[B, weight_B] : moved_by[index_of[c]])
                expected += weight_A * weight_B * (row_factor + 3 * (index_of[c] % dim)) *
                            dense.effective_mass(0., A / dim, B / dim);
            EXPECT_NEAR(row[c], expected, 1e-11);
          }
      }
  });
}

// Two bodies with a gap between them: a node that only one reaches hangs on
// cells of that body, although cells of the other are nearer.
TEST(TransferTiesOfBodiesMpi, PreferTheirOwnCells)
{
  constexpr int       dim = 2;
  BackgroundGrid<dim> grid(some_grid<dim>({{12, 10}}), MPI_COMM_WORLD);
  LatticeWindow<dim>  covered;
  covered.low     = {{1, 1}};
  covered.n_cells = {{8, 3}};
  grid.cover(covered, std::vector<unsigned int>(covered.n_cells_total(), 1));

  // body 0 fills [1, 3.5) x [1, 4), body 1 [5, 9) x [1, 4), each point 1/4 of a cell: the nodes
  // at x = 4 have 1/8 of a cell, of body 0 alone
  std::vector<PointRecord<dim>> records;
  const auto                    h   = grid.lattice().h;
  const auto                    add = [&](const double x, const double y, const int body) {
    PointRecord<dim> record;
    record.id = records.size();
    record.location =
      dealii::Point<dim>(grid.lattice().origin[0] + x * h[0], grid.lattice().origin[1] + y * h[1]);
    record.state.body             = body;
    record.state.mass             = 1.;
    record.state.reference_volume = 0.25 * h[0] * h[1];
    for (int d = 0; d < dim; ++d)
      record.state.deformation_gradient[d][d] = 1.;
    records.push_back(record);
  };
  for (double y = 1.25; y < 4.; y += 0.5)
    {
      for (double x = 1.25; x < 3.5; x += 0.5)
        add(x, y, 0);
      for (double x = 5.25; x < 9.; x += 0.5)
        add(x, y, 1);
    }
  MaterialPoints<dim> points;
  const bool          first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  points.distribute(grid, first ? records : std::vector<PointRecord<dim>>());
  StepPoints<dim> step;
  step.reinit(grid, points, {BasisKind::linear, BasisKind::linear});
  auto          reached = step.reached_nodes(grid.window());
  NodeTies<dim> ties;
  ties.find(grid, step, 0.3, reached);
  ActiveNodes<dim> nodes;
  nodes.reinit(grid, reached);
  NodeConditions<dim> conditions({}, {});
  conditions.reinit(grid, nodes);
  ties.localise(nodes, conditions);

  // both [2, 3] of body 0 and [5, 6] of body 1 are well filled and 1.5 cells away
  unsigned int n_checked = 0;
  for (const auto &tie : ties.ties())
    {
      const auto node = grid.window().node_index(nodes.window_node(tie.node));
      if (node[0] != 4)
        continue;
      ++n_checked;
      for (const unsigned int root : tie.roots)
        EXPECT_LT(grid.window().node_index(nodes.window_node(root))[0], 4);
    }
  EXPECT_GE(dealii::Utilities::MPI::sum(n_checked, MPI_COMM_WORLD), 1u);
}
