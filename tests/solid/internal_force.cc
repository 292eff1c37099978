#include "force_checks.h"

#include <kedge/stress/point_update.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidInternalForce : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Linear, GIMP, both at once in two bodies, and splines. */
  const std::vector<std::vector<BasisKind>> all_bases = {{BasisKind::linear},
                                                         {BasisKind::gimp},
                                                         {BasisKind::gimp, BasisKind::linear},
                                                         {BasisKind::spline},
                                                         {BasisKind::spline, BasisKind::gimp}};

  template <int dim>
  InternalForce<dim>
  make_force(const StressRule rule, const double alpha)
  {
    return InternalForce<dim>({Material(Cloud<dim>::material(0)),
                               Material(Cloud<dim>::material(1))},
                              rule,
                              alpha);
  }

  constexpr double yield_stress = 0.02;

  /** Both bodies yield and harden. */
  template <int dim>
  InternalForce<dim>
  make_plastic_force(const StressRule rule, const double alpha)
  {
    std::vector<Material> materials;
    for (const unsigned int body : {0, 1})
      {
        MaterialParameters parameters;
        parameters.young_modulus     = body == 0 ? 2.6 : 5.;
        parameters.poisson_ratio     = body == 0 ? 0.3 : 0.;
        parameters.yield_stress      = yield_stress;
        parameters.hardening_modulus = body == 0 ? 0.5 : 2.;
        materials.emplace_back(VonMises(parameters));
      }
    return InternalForce<dim>(materials, rule, alpha);
  }

  /**
   * Plastic strains that put each second point on its yield surface, the
   * others somewhat inside.
   */
  template <int dim>
  void
  give_history(const InternalForce<dim> &internal, StepPoints<dim> &points)
  {
    points.n_history = n_columns<VonMises>;
    points.history.resize(points.size() * points.n_history);
    for (const auto &batch : points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          const auto &material = std::get<VonMises>(internal.material_of_body(batch.body));
          const auto  response =
            material.elastic.respond(points.stress_state[slot].strain, {0., 0., 0.});
          const auto &tau    = response.kirchhoff_stress;
          double      square = 0.;
          for (const double principal : tau)
            square += std::pow(principal - (tau[0] + tau[1] + tau[2]) / 3., 2);
          const double gap = points.id[slot] % 2 == 0 ? 0. : 0.1;
          write_history<VonMises>({(std::sqrt(1.5 * square) + gap - yield_stress) /
                                     material.hardening_modulus,
                                   yield_stress},
                                  &points.history[slot * points.n_history]);
        }
  }

  /**
   * Energy stored and dissipated in the step to u: sum of V0 (dPsi + dD),
   * point by point; @p n_plastic counts the points that yield.
   */
  template <int dim>
  double
  stored(const Cloud<dim>          &cloud,
         const InternalForce<dim>  &internal,
         const std::vector<double> &u,
         unsigned int              *n_plastic = nullptr)
  {
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(cloud.patch, u, gradients);
    double sum = 0.;
    for (const auto &batch : cloud.step.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          double A[dim][dim];
          gradients[slot].unroll(&A[0][0], &A[0][0] + dim * dim);
          std::visit(
            [&](const auto &material) {
              using Law = std::decay_t<decltype(material)>;
              PointUpdate<dim> update{};
              const auto       history = cloud.step.template history_of<Law>(slot);
              const auto      &state   = cloud.step.stress_state[slot];
              EXPECT_TRUE(update_point<dim>(material, state, history, A, update));
              sum += cloud.step.volume[slot] *
                     evaluate_force_stress<dim, false, StressRule::at_configuration>(material,
                                                                                     state,
                                                                                     A,
                                                                                     1.,
                                                                                     history)
                       .work_increment;
              if (n_plastic != nullptr && update.dissipation > 0.)
                ++*n_plastic;
            },
            internal.material_of_body(batch.body));
        }
    return sum;
  }

  /** Calls check(cloud) for all bases. */
  template <int dim, typename Check>
  void
  for_all_bases(const Check &check, const bool plastic = false)
  {
    for (unsigned int b = 0; b < all_bases.size(); ++b)
      {
        SCOPED_TRACE("basis " + std::to_string(b));
        Cloud<dim> cloud(all_bases[b], 2, 31 + b);
        if (plastic)
          give_history(make_plastic_force<dim>(StressRule::conserving, 0.5), cloud.step);
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
    check_stiffness(cloud, make_force<dim>(StressRule::at_configuration, 1.), 3);
    check_stiffness(cloud, make_force<dim>(StressRule::at_configuration, 0.55), 3);
    check_stiffness(cloud, make_force<dim>(StressRule::conserving, 0.5), 3);
  });
}

TYPED_TEST(SolidInternalForce, StiffnessIsTheForcesSlopeWhereItYields)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>(
    [](const Cloud<dim> &cloud) {
      unsigned int n_plastic = 0;
      stored(cloud,
             make_plastic_force<dim>(StressRule::conserving, 0.5),
             cloud.random_nodal(0.03, 1),
             &n_plastic);
      EXPECT_GT(n_plastic, 0.2 * cloud.step.size());
      EXPECT_LT(n_plastic, 0.8 * cloud.step.size());
      check_stiffness(cloud, make_plastic_force<dim>(StressRule::at_configuration, 1.), 3);
      check_stiffness(cloud, make_plastic_force<dim>(StressRule::at_configuration, 0.55), 3);
      check_stiffness(cloud, make_plastic_force<dim>(StressRule::conserving, 0.5), 3);
    },
    true);
}

TYPED_TEST(SolidInternalForce, ForceIsTheSlopeOfStoredAndDissipatedWork)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>(
    [](const Cloud<dim> &cloud) {
      const auto internal         = make_plastic_force<dim>(StressRule::at_configuration, 1.);
      const std::vector<double> u = cloud.random_nodal(0.03, 1), f = force_at(cloud, internal, u);
      const double              h = 1e-5;
      for (unsigned int j = 0; j < u.size(); ++j)
        {
          std::vector<double> plus = u, minus = u;
          plus[j] += h;
          minus[j] -= h;
          // as in the elastic test
          EXPECT_NEAR(f[j],
                      (stored(cloud, internal, plus) - stored(cloud, internal, minus)) / (2. * h),
                      1e-10);
        }
    },
    true);
}

TYPED_TEST(SolidInternalForce, NewtonIsOfSecondOrderWhileYielding)
{
  // f(u) + c u = f(u*) + c u*: c, like inertia, holds what no force does
  constexpr int    dim = TypeParam::value;
  constexpr double c   = 0.02;
  for_all_bases<dim>(
    [](const Cloud<dim> &cloud) {
      for (const StressRule rule : {StressRule::at_configuration, StressRule::conserving})
        {
          const auto                internal = make_plastic_force<dim>(rule, 1.);
          const std::vector<double> solution = cloud.random_nodal(0.01, 1),
                                    wanted   = force_at(cloud, internal, solution);
          unsigned int n_plastic             = 0;
          stored(cloud, internal, solution, &n_plastic);
          EXPECT_GT(n_plastic, 0.2 * cloud.step.size());

          // not from rest, where half of the points lie on their yield surfaces and round-off
          // decides between the two tangents
          std::vector<double> u = solution, errors;
          for (double &value : u)
            value *= 0.1;
          for (int iteration = 0; iteration < 12; ++iteration)
            {
              std::vector<double> error = u;
              for (unsigned int i = 0; i < u.size(); ++i)
                error[i] -= solution[i];
              errors.push_back(norm(error));
              if (errors.back() < 1e-12)
                break;
              auto                   tangent = stiffness_at(cloud, internal, u, 3);
              const auto             force   = force_at(cloud, internal, u);
              dealii::Vector<double> residual(u.size()), correction(u.size());
              for (unsigned int i = 0; i < u.size(); ++i)
                {
                  tangent(i, i) += c;
                  residual(i) = wanted[i] - force[i] - c * error[i];
                }
              tangent.gauss_jordan();
              tangent.vmult(correction, residual);
              for (unsigned int i = 0; i < u.size(); ++i)
                u[i] += correction(i);
            }
          ASSERT_LT(errors.back(), 1e-12);
          // near the solution, where no further point changes between elastic and
          // plastic, e' = C e^2 with C = |K^-1 dK/du| / 2, 3 to 8 per metre here
          unsigned int n_near = 0;
          for (std::size_t k = 1; k < errors.size(); ++k)
            if (errors[k - 1] < 2e-4)
              {
                ++n_near;
                EXPECT_LT(errors[k], 20. * errors[k - 1] * errors[k - 1] + 2e-14)
                  << testing::PrintToString(errors);
              }
          EXPECT_GE(n_near, 1u);
        }
    },
    true);
}

TYPED_TEST(SolidInternalForce, ConservingForceWorksWhatIsStoredAndDissipated)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>(
    [](const Cloud<dim> &cloud) {
      const auto internal = make_plastic_force<dim>(StressRule::conserving, 0.5);
      for (const double size : {3e-2, 1e-5, 1e-10})
        {
          const std::vector<double> u     = cloud.random_nodal(size, 2);
          const std::vector<double> force = force_at(cloud, internal, u);
          double                    work  = 0.;
          for (unsigned int i = 0; i < u.size(); ++i)
            work += force[i] * u[i];
          // as in the elastic test
          EXPECT_NEAR(work, stored(cloud, internal, u), 1e-14 * norm(force) * size);
        }
    },
    true);
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
  const auto status = internal.add_force(cloud.patch, u, force);
  ASSERT_FALSE(status.ok());
  std::vector<dealii::Tensor<2, dim>> gradients;
  gradients_at_points(cloud.patch, u, gradients);
  EXPECT_LE(determinant(dealii::unit_symmetric_tensor<dim>() + gradients[status.failed_slot]), 0.);
}
