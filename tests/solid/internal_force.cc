#include "force_checks.h"

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidInternalForce : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Linear, GIMP, and both at once in two bodies. */
  const std::vector<std::vector<BasisKind>> all_bases = {{BasisKind::linear},
                                                         {BasisKind::gimp},
                                                         {BasisKind::gimp, BasisKind::linear}};

  template <int dim>
  InternalForce<dim>
  make_force(const StressRule rule, const double alpha)
  {
    return InternalForce<dim>({Material(Cloud<dim>::material(0)),
                               Material(Cloud<dim>::material(1))},
                              rule,
                              alpha);
  }

  /** Energy stored in the step to u: sum of V0 dPsi, point by point. */
  template <int dim>
  double
  stored(const Cloud<dim> &cloud, const InternalForce<dim> &internal, const std::vector<double> &u)
  {
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(cloud.step, cloud.window(), cloud.nodes, u, gradients);
    double sum = 0.;
    for (const auto &batch : cloud.step.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          double A[dim][dim];
          gradients[slot].unroll(&A[0][0], &A[0][0] + dim * dim);
          sum += cloud.step.volume[slot] *
                 evaluate_force_stress<dim, false, StressRule::at_configuration>(
                   std::get<Hencky>(internal.material_of_body(batch.body)),
                   cloud.step.stress_state[slot],
                   A,
                   1.)
                   .work_increment;
        }
    return sum;
  }

  /** Calls check(cloud) for all bases. */
  template <int dim, typename Check>
  void
  for_all_bases(const Check &check)
  {
    for (unsigned int b = 0; b < all_bases.size(); ++b)
      {
        SCOPED_TRACE("basis " + std::to_string(b));
        const Cloud<dim> cloud(all_bases[b], 2, 31 + b);
        check(cloud);
      }
  }
} // namespace

TYPED_TEST_SUITE(SolidInternalForce, Dimensions);

TYPED_TEST(SolidInternalForce, IsTheSlopeOfTheStoredEnergy)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud) {
    const auto                internal = make_force<dim>(StressRule::at_configuration, 1.);
    const std::vector<double> u        = cloud.random_nodal(0.03, 1);
    const std::vector<double> force    = force_at(cloud, internal, u);
    const double              h        = 1e-5;
    for (unsigned int j = 0; j < u.size(); ++j)
      {
        std::vector<double> plus = u, minus = u;
        plus[j] += h;
        minus[j] -= h;
        // forces are of the order 1e-2; energies of 0.1 with round-off 1e-17 over 2h
        EXPECT_NEAR(force[j],
                    (stored(cloud, internal, plus) - stored(cloud, internal, minus)) / (2. * h),
                    1e-10);
      }
    EXPECT_GT(norm(force), 0.05);
  });
}

TYPED_TEST(SolidInternalForce, StiffnessIsTheForcesSlope)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud) {
    check_stiffness(cloud, make_force<dim>(StressRule::at_configuration, 1.), 2);
    check_stiffness(cloud, make_force<dim>(StressRule::at_configuration, 0.55), 2);
    check_stiffness(cloud, make_force<dim>(StressRule::conserving, 0.5), 2);
  });
}

TYPED_TEST(SolidInternalForce, ConservingForceWorksWhatIsStoredAndTurnsNothing)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const Cloud<dim> &cloud) {
    const auto internal = make_force<dim>(StressRule::conserving, 0.5);
    for (const double size : {3e-2, 1e-5, 1e-10})
      {
        const std::vector<double> u     = cloud.random_nodal(size, 2);
        const std::vector<double> force = force_at(cloud, internal, u);
        // round-off of some hundred terms of size 1e-16 |f| |u|
        EXPECT_NEAR(dot(force, u), stored(cloud, internal, u), 1e-14 * norm(force) * size);
        check_balance(cloud, u, force);
      }
  });
}

TYPED_TEST(SolidInternalForce, NamesThePointThatTurnsInsideOut)
{
  constexpr int    dim = TypeParam::value;
  const Cloud<dim> cloud({BasisKind::linear}, 1, 3);
  const auto       internal = make_force<dim>(StressRule::conserving, 0.5);
  // u_x = -1.5 x at the nodes of one cell's point: det(I + A) = -0.5 there
  const unsigned int  slot = cloud.step.size() / 2;
  std::vector<double> u(cloud.nodes.n_local() * dim, 0.), force = u;
  for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
    if (std::abs(cloud.node_position(i)[0] - cloud.step.location[slot][0]) < 0.7)
      u[i * dim] = -1.5 * cloud.node_position(i)[0];
  const auto status = internal.add_force(cloud.step, cloud.window(), cloud.nodes, u, force);
  ASSERT_FALSE(status.ok());
  std::vector<dealii::Tensor<2, dim>> gradients;
  gradients_at_points(cloud.step, cloud.window(), cloud.nodes, u, gradients);
  EXPECT_LE(determinant(dealii::unit_symmetric_tensor<dim>() + gradients[status.failed_slot]), 0.);
}
