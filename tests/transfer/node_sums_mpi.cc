// Sums over points to nodes and back against dense direct evaluations, on
// one rank and on two.
#include "dense.h"

#include <kedge/equations/equation_system.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class TransferMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Calls check(cloud, dense) for linear, GIMP, and both in one cloud. */
  template <int dim, typename Check>
  void
  for_all_bases(const Check &check)
  {
    const std::vector<std::vector<BasisKind>> all_bases = {{BasisKind::linear},
                                                           {BasisKind::gimp},
                                                           {BasisKind::gimp, BasisKind::linear},
                                                           {BasisKind::spline},
                                                           {BasisKind::spline, BasisKind::gimp}};
    for (unsigned int b = 0; b < all_bases.size(); ++b)
      {
        SCOPED_TRACE("basis " + std::to_string(b));
        const Cloud<dim> cloud(all_bases[b], 2, 11 + b);
        check(cloud, DenseCloud<dim>(cloud, all_bases[b]));
      }
  }

  template <int dim>
  NodeMatrix<dim>
  effective_mass(const Cloud<dim> &cloud, const double epsilon)
  {
    NodeMatrix<dim> mass;
    mass.reinit(cloud.nodes.n_local(), 1, 3);
    assemble_mass(cloud.patch, mass);
    blend_mass(epsilon, mass, cloud.nodes.n_local());
    return mass;
  }
} // namespace

TYPED_TEST_SUITE(TransferMpi, Dimensions);

TYPED_TEST(TransferMpi, NodesAreThoseThatPointsReach)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense) {
    std::vector<double> ones(cloud.nodes.n_local(), 1.);
    const auto          active = by_window(cloud, ones, 1);
    std::uint64_t       n      = 0;
    for (std::size_t A = 0; A < dense.n_nodes; ++A)
      {
        double reached = 0.;
        for (std::size_t p = 0; p < dense.n_points; ++p)
          reached += dense.N(A, p);
        EXPECT_EQ(active[A], reached > 0. ? 1. : 0.) << "node " << A; // 2: owned twice
        n += reached > 0.;
      }
    EXPECT_EQ(cloud.nodes.n_global(), n);
    EXPECT_EQ(cloud.points.n_global(), dense.n_points);
    EXPECT_GT(cloud.step.size(), 0u); // each rank has its share, or two ranks test nothing
  });
}

TYPED_TEST(TransferMpi, MassTimesAFieldIsTheDenseProduct)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense) {
    for (const double epsilon : {0., 0.4, 1.})
      {
        const auto          x = cloud.random_nodal(1., 4);
        std::vector<double> y(x.size());
        multiply(effective_mass(cloud, epsilon), cloud.patch, dim, x, y);
        cloud.nodes.add_to_owners(y, dim);
        const auto all_x = by_window(cloud, x, dim), all_y = by_window(cloud, y, dim);
        for (std::size_t A = 0; A < dense.n_nodes; ++A)
          {
            double expected[dim] = {};
            for (std::size_t B = 0; B < dense.n_nodes; ++B)
              if (all_x[B * dim] != 0.)
                {
                  const double M = dense.effective_mass(epsilon, A, B);
                  for (int d = 0; d < dim; ++d)
                    expected[d] += M * all_x[B * dim + d];
                }
            for (int d = 0; d < dim; ++d) // sums of some tens of terms of order 1
              EXPECT_NEAR(all_y[A * dim + d], expected[d], 2e-13);
          }
      }
  });
}

TYPED_TEST(TransferMpi, SumsToNodesAndBackAreTheDenseOnes)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense) {
    std::vector<double> momentum(cloud.nodes.n_local() * dim, 0.),
      lumped(cloud.nodes.n_local(), 0.);
    add_to_nodes(cloud.patch, cloud.step.mass, cloud.step.velocity, momentum);
    add_scalars_to_nodes(cloud.patch, cloud.step.mass, 1, lumped);
    cloud.nodes.add_to_owners(momentum, dim);
    cloud.nodes.add_to_owners(lumped, 1);
    const auto all_momentum = by_window(cloud, momentum, dim);
    const auto all_lumped   = by_window(cloud, lumped, 1);
    for (std::size_t A = 0; A < dense.n_nodes; ++A)
      {
        double                 sum = 0.;
        dealii::Tensor<1, dim> expected;
        for (std::size_t p = 0; p < dense.n_points; ++p)
          {
            sum += dense.mass[p] * dense.N(A, p);
            expected += dense.mass[p] * dense.N(A, p) * cloud.records[p].state.velocity;
          }
        EXPECT_NEAR(all_lumped[A], sum, 1e-13);
        for (int d = 0; d < dim; ++d)
          EXPECT_NEAR(all_momentum[A * dim + d], expected[d], 1e-13);
      }

    // back: ghosts get their owners' values before
    auto nodal = cloud.random_nodal(1., 5);
    for (unsigned int i = cloud.nodes.n_owned() * dim; i < nodal.size(); ++i)
      nodal[i] = std::numeric_limits<double>::quiet_NaN();
    cloud.nodes.update_ghosts(nodal, dim);
    const auto                          all = by_window(cloud, nodal, dim);
    std::vector<dealii::Tensor<1, dim>> at_points;
    interpolate_to_points(cloud.patch, nodal, at_points);
    for (unsigned int slot = 0; slot < cloud.step.size(); ++slot)
      for (int d = 0; d < dim; ++d)
        {
          double expected = 0.;
          for (std::size_t A = 0; A < dense.n_nodes; ++A)
            expected += dense.N(A, cloud.step.id[slot]) * all[A * dim + d];
          EXPECT_NEAR(at_points[slot][d], expected, 1e-13);
        }
  });
}

TYPED_TEST(TransferMpi, GradientsOfLinearFieldsAreExact)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &) {
    // v_i = sum_j (1 + i + 3 j) x_j
    std::vector<double> nodal(cloud.nodes.n_local() * dim, 0.);
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      for (int c = 0; c < dim; ++c)
        for (int j = 0; j < dim; ++j)
          nodal[i * dim + c] += (1 + c + 3 * j) * cloud.node_position(i)[j];
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(cloud.patch, nodal, gradients);
    for (const auto &gradient : gradients)
      for (int c = 0; c < dim; ++c)
        for (int j = 0; j < dim; ++j) // values of 50 over cells of 0.5
          EXPECT_NEAR(gradient[c][j], 1 + c + 3 * j, 5e-13);
  });
}

TYPED_TEST(TransferMpi, EquationsAreTheDenseMatrixOfTheFreeNodes)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense) {
    NodeMatrix<dim>          mass = effective_mass(cloud, 0.4);
    std::vector<NodalStatus> status(cloud.nodes.n_local(), NodalStatus::free);
    for (unsigned int i = 0; i < status.size(); ++i)
      if (cloud.nodes.window_node(i) % 5 == 0)
        status[i] = NodalStatus::prescribed;
    EquationSystem<dim> equations;
    equations.reinit(cloud.patch, status, mass);
    equations.fill(cloud.patch, mass);

    // window numbers of all equations, rank after rank
    const SparseSystem       &system = equations.system();
    std::vector<unsigned int> mine;
    for (unsigned int e = 0; e < system.n_rows(); ++e)
      mine.push_back(cloud.nodes.window_node(equations.nodal_index(e)));
    std::vector<unsigned int> node_of;
    for (const auto &share : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      node_of.insert(node_of.end(), share.begin(), share.end());
    ASSERT_EQ(static_cast<std::size_t>(system.n_global), node_of.size());

    for (unsigned int e = 0; e < system.n_rows(); ++e)
      {
        std::vector<double> row(node_of.size(), 0.);
        for (std::int64_t k = system.row_start[e]; k < system.row_start[e + 1]; ++k)
          row[system.column[k]] = system.value[k];
        EXPECT_EQ(node_of[system.first_row + e], mine[e]);
        EXPECT_NE(mine[e] % 5, 0u);
        for (std::size_t c = 0; c < row.size(); ++c)
          EXPECT_NEAR(row[c], dense.effective_mass(0.4, mine[e], node_of[c]), 1e-13);
      }

    // gather and scatter are each other's inverse on free nodes; the rest is zero
    const auto          nodal = cloud.random_nodal(1., 6, 1);
    std::vector<double> packed, unpacked;
    equations.gather(nodal, packed);
    equations.scatter(packed, unpacked);
    for (unsigned int i = 0; i < cloud.nodes.n_owned(); ++i)
      EXPECT_EQ(unpacked[i], status[i] == NodalStatus::free ? nodal[i] : 0.);
  });
}

TYPED_TEST(TransferMpi, PointsOfOneBatchAndStencilStandTogether)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &) {
    unsigned int covered = 0;
    for (const auto &batch : cloud.step.batches)
      {
        EXPECT_EQ(batch.begin, covered);
        covered = batch.end;
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const auto &record = cloud.records[cloud.step.id[slot]];
            EXPECT_EQ(record.state.body, batch.body);
            EXPECT_EQ(cloud.step.stencil[slot].pattern, batch.pattern);
            EXPECT_EQ(cloud.step.mass[slot], record.state.mass);
            EXPECT_EQ(cloud.step.location[slot], record.location);
            if (slot > batch.begin)
              {
                EXPECT_LE(cloud.step.stencil[slot - 1].first_node,
                          cloud.step.stencil[slot].first_node);
              }
          }
      }
    EXPECT_EQ(covered, cloud.step.size());
  });
}
