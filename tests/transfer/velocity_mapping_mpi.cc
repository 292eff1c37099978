// Velocities from points to nodes and back, and what that conserves: Tables
// 3.1 and 3.2 of the thesis, on one rank and on two.
#include "dense.h"

#include <kedge/transfer/audit.h>
#include <kedge/transfer/velocity_mapping.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class TransferVelocityMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Point-to-grid of a cloud's velocities. */
  template <int dim>
  struct Mapped
  {
    Mapped(const Cloud<dim> &cloud, const double epsilon, const double prescribed = 0.)
      : momentum(cloud.nodes.n_local() * dim, 0.)
      , v(momentum)
    {
      mass.reinit(cloud.nodes.n_local(), 1, 3);
      assemble_mass(cloud.patch, mass);
      blend_mass(epsilon, mass, cloud.nodes.n_local());
      add_to_nodes(cloud.patch, cloud.step.mass, cloud.step.velocity, momentum);
      cloud.ties.restrict_sums(momentum);
      cloud.nodes.add_to_owners(momentum, dim);
      for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
        for (int d = 0; d < dim; ++d)
          if (cloud.conditions.prescribed(i, d))
            v[i * dim + d] = prescribed;
      mapping.reinit(cloud.patch, mass);
      status = mapping.solve(momentum, v);
    }

    /** C^T M~ v - momentum at the owned nodes. */
    std::vector<double>
    defect(const Cloud<dim> &cloud) const
    {
      std::vector<double> result(v.size());
      multiply(mass, cloud.patch, dim, v, result);
      cloud.ties.restrict_sums(result);
      cloud.nodes.add_to_owners(result, dim);
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] -= momentum[i];
      return result;
    }

    VelocityMapping<dim> mapping;
    NodeMatrix<dim>      mass;
    std::vector<double>  momentum, v;
    LinearStatus         status;
  };

  /** New velocities of the points: they keep a part, 1 in (3.172), 0 in (3.173). */
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  grid_to_point(const Cloud<dim>          &cloud,
                const double               kept,
                const std::vector<double> &v_n,
                const std::vector<double> &v_np1)
  {
    std::vector<dealii::Tensor<1, dim>> old, result;
    interpolate_to_points(cloud.patch, v_n, old);
    interpolate_to_points(cloud.patch, v_np1, result);
    for (unsigned int p = 0; p < result.size(); ++p)
      result[p] += kept * (cloud.step.velocity[p] - old[p]);
    return result;
  }

  /** The closed expressions of the tables from dense matrices: angular momentum and energy. */
  template <int dim>
  struct Closed
  {
    dealii::Tensor<1, 3> angular; ///< sum x_{n+1} x (D w)
    double               energy = 0.;

    /** w D w / 2 and x x (D w), D = lumped - consistent. */
    Closed(const Cloud<dim>          &cloud,
           const DenseCloud<dim>     &dense,
           const std::vector<double> &u,
           const std::vector<double> &w)
    {
      const auto all_w = by_window(cloud, w, dim), all_u = by_window(cloud, u, dim);
      for (std::size_t A = 0; A < dense.n_nodes; ++A)
        {
          double Dw[3] = {}, x[3] = {};
          for (std::size_t B = 0; B < dense.n_nodes; ++B)
            {
              const double D = dense.effective_mass(1., A, B) - dense.effective_mass(0., A, B);
              for (int d = 0; d < dim; ++d)
                Dw[d] += D * all_w[B * dim + d];
            }
          const auto position = cloud.grid.lattice().node_position(cloud.window().node_index(A));
          for (int d = 0; d < dim; ++d)
            {
              x[d] = position[d] + all_u[A * dim + d];
              energy += 0.5 * all_w[A * dim + d] * Dw[d];
            }
          for (int c = 0; c < 3; ++c)
            angular[c] += x[(c + 1) % 3] * Dw[(c + 2) % 3] - x[(c + 2) % 3] * Dw[(c + 1) % 3];
        }
    }
  };

  /**
   * Calls check(cloud, dense) for both bases, without and with ties of badly
   * filled nodes; three points per direction make M regular.
   */
  template <int dim, typename Check>
  void
  for_both_bases(const Check &check)
  {
    for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
      for (const double threshold : {0., dim == 2 ? 0.15 : 0.36})
        {
          SCOPED_TRACE(std::string(basis == BasisKind::linear ? "linear" : "gimp") +
                       (threshold > 0. ? ", tied" : ""));
          const Cloud<dim> cloud({basis}, 3, 23, threshold > 0. ? 3 : 2, threshold);
          EXPECT_EQ(dealii::Utilities::MPI::logical_or(!cloud.ties.empty(), MPI_COMM_WORLD),
                    threshold > 0.);
          check(cloud, DenseCloud<dim>(cloud, {basis}));
        }
  }

  template <int dim>
  void
  expect_equal(const MotionTotals<dim> &a, const MotionTotals<dim> &b, const double tolerance)
  {
    EXPECT_LT((a.linear_momentum - b.linear_momentum).norm(), tolerance);
    EXPECT_LT((a.angular_momentum - b.angular_momentum).norm(), tolerance);
    EXPECT_NEAR(a.kinetic_energy, b.kinetic_energy, tolerance);
  }
} // namespace

TYPED_TEST_SUITE(TransferVelocityMpi, Dimensions);

TYPED_TEST(TransferVelocityMpi, SolvesForTheMomentumOfThePoints)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &) {
    for (const double epsilon : {0., 0.4, 1.})
      {
        const Mapped<dim> mapped(cloud, epsilon);
        ASSERT_TRUE(mapped.status.success) << mapped.status.cause;
        const auto defect = mapped.defect(cloud);
        // nodal momenta of order 1; nodes of next to no mass have velocities of up
        // to 1e8 in 3D, whose parts in the momenta of other nodes cancel
        for (unsigned int i = 0; i < cloud.nodes.n_owned() * dim; ++i)
          EXPECT_NEAR(defect[i], 0., 1e-12);
      }
  });
}

TYPED_TEST(TransferVelocityMpi, KeepsPrescribedVelocities)
{
  constexpr int                dim = TypeParam::value;
  NodeConditionParameters<dim> fixed;
  fixed.on_side            = false;
  fixed.where              = "x < 2";
  fixed.components[0].kind = ConditionKind::fixed;
  const NodeConditions<dim> conditions({fixed}, {});
  for (const double threshold : {0., dim == 2 ? 0.15 : 0.36})
    {
      Cloud<dim> cloud({BasisKind::gimp}, 3, 23, threshold > 0. ? 3 : 2, threshold);
      cloud.prescribe(conditions);
      const Mapped<dim> mapped(cloud, 0.4, 0.7);
      ASSERT_TRUE(mapped.status.success) << mapped.status.cause;
      const auto   defect  = mapped.defect(cloud);
      unsigned int n_fixed = 0;
      for (unsigned int i = 0; i < cloud.nodes.n_owned(); ++i)
        for (int d = 0; d < dim; ++d)
          if (d == 0 && cloud.node_position(i)[0] < 2.)
            {
              EXPECT_EQ(mapped.v[i * dim], 0.7);
              ++n_fixed;
            }
          else // the other components are in balance as without conditions
            EXPECT_NEAR(defect[i * dim + d], 0., 1e-13);
      EXPECT_GT(dealii::Utilities::MPI::sum(n_fixed, MPI_COMM_WORLD), 0u);
    }
}

TYPED_TEST(TransferVelocityMpi, BearsASingularMass)
{
  constexpr int dim = TypeParam::value;
  // one point per cell cannot tell the velocities of 2^dim nodes apart
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
    {
      const Cloud<dim>  cloud({basis}, 1, 5);
      const Mapped<dim> mapped(cloud, 0.);
      ASSERT_TRUE(mapped.status.success) << mapped.status.cause;
      const auto defect = mapped.defect(cloud);
      for (unsigned int i = 0; i < cloud.nodes.n_owned() * dim; ++i)
        {
          EXPECT_NEAR(defect[i], 0., 1e-12);     // momentum is exact all the same
          EXPECT_LT(std::abs(mapped.v[i]), 1e3); // and what is undetermined stays small
        }
      // so many unknowns can follow every point: nothing is filtered out
      std::vector<dealii::Tensor<1, dim>> at_points;
      interpolate_to_points(cloud.patch, mapped.v, at_points);
      for (unsigned int p = 0; p < cloud.step.size(); ++p)
        EXPECT_LT((at_points[p] - cloud.step.velocity[p]).norm(), 1e-6);
    }
}

TYPED_TEST(TransferVelocityMpi, LosesWhatTable31Says)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense) {
    for (const double epsilon : {0., 0.4, 1.})
      {
        const Mapped<dim> mapped(cloud, epsilon);
        const auto        zero  = std::vector<double>(mapped.v.size(), 0.);
        const auto        audit = audit_transfer(cloud.patch,
                                          cloud.step.velocity,
                                          mapped.mass,
                                          epsilon,
                                          1.,
                                          mapped.v,
                                          mapped.v,
                                          zero);
        // independent sums over all points
        MotionTotals<dim> points;
        double            filtered = 0.;
        const auto        all_v    = by_window(cloud, mapped.v, dim);
        for (std::size_t p = 0; p < dense.n_points; ++p)
          {
            const auto            &record = cloud.records[p];
            const auto            &v      = record.state.velocity;
            dealii::Tensor<1, dim> grid_v;
            for (std::size_t A = 0; A < dense.n_nodes; ++A)
              for (int d = 0; d < dim; ++d)
                grid_v[d] += dense.N(A, p) * all_v[A * dim + d];
            points.linear_momentum += record.state.mass * v;
            points.kinetic_energy += 0.5 * record.state.mass * v.norm_square();
            points.angular_momentum[2] +=
              record.state.mass * (record.location[0] * v[1] - record.location[1] * v[0]);
            filtered += 0.5 * record.state.mass * (v - grid_v).norm_square();
          }
        // totals of some hundred points of order 1 and lever arms of 4 m
        EXPECT_LT((audit.points_n.linear_momentum - points.linear_momentum).norm(), 1e-12);
        EXPECT_NEAR(audit.points_n.angular_momentum[2], points.angular_momentum[2], 1e-11);
        EXPECT_NEAR(audit.points_n.kinetic_energy, points.kinetic_energy, 1e-11);

        // Table 3.1: momenta are kept; energy, some 100 J, loses (3.169). Nodes
        // of next to no mass have velocities of up to 1e8 that cancel at the points
        const Closed<dim> closed(cloud, dense, zero, mapped.v);
        const double      loss = filtered + epsilon * closed.energy;
        expect_equal(audit.measured_p2g(), {{}, {}, loss}, 1e-9);
        expect_equal(audit.measured_p2g(), audit.expected_p2g, 1e-9);
        EXPECT_GT(loss, 1.); // a filter it is
      }
  });
}

TYPED_TEST(TransferVelocityMpi, LosesWhatTable32Says)
{
  constexpr int dim = TypeParam::value;
  for_both_bases<dim>([](const Cloud<dim> &cloud, const DenseCloud<dim> &dense) {
    for (const double epsilon : {0., 0.4, 1.})
      for (const double kept : {1., 0.3, 0.}) // FLIP, a filter, PIC
        {
          const Mapped<dim>   mapped(cloud, epsilon);
          std::vector<double> u = cloud.random_nodal(0.1, 7), change = cloud.random_nodal(1., 8);
          std::vector<double> v_np1 = mapped.v;
          cloud.ties.prolong(u); // what the grid can do
          cloud.ties.prolong(change);
          for (std::size_t i = 0; i < v_np1.size(); ++i)
            v_np1[i] += change[i];
          const auto          audit = audit_transfer(cloud.patch,
                                            grid_to_point(cloud, kept, mapped.v, v_np1),
                                            mapped.mass,
                                            epsilon,
                                            kept,
                                            mapped.v,
                                            v_np1,
                                            u);
          std::vector<double> w     = v_np1;
          for (std::size_t i = 0; i < w.size(); ++i)
            w[i] -= kept * mapped.v[i];
          const Closed<dim> closed(cloud, dense, u, w);
          MotionTotals<dim> expected;
          expected.angular_momentum = -epsilon * closed.angular; // (3.177), (3.178)
          expected.kinetic_energy   = -epsilon * closed.energy;  // (3.182)
          // (3.180), its second line, of what is not kept
          expected.kinetic_energy -= (1. - kept * kept) * audit.measured_p2g().kinetic_energy;
          expect_equal(audit.measured_step(), expected, 1e-9);
          expect_equal(audit.measured_step(), audit.expected_step, 1e-9);
          if (epsilon > 0.)
            {
              EXPECT_GT(expected.angular_momentum.norm(), 1e-3);
              EXPECT_LT(expected.kinetic_energy, -1e-3);
            }
        }
  });
}
