// Residual and tangent of a step with ghost stabilisation.
#include "../transfer/cloud.h"

#include <kedge/solid/solid_problem.h>
#include <kedge/transfer/ghost_penalty.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidProblemGhost : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** A step of a cloud, at a random displacement. */
  template <int dim>
  struct Step
  {
    Step(const SchemeKind kind, const double factor)
      : cloud({BasisKind::linear, BasisKind::gimp}, 2, 23)
    {
      TimeParameters time;
      time.scheme               = kind;
      auto              reached = cloud.step.reached_nodes(cloud.window());
      GhostPenalty<dim> ghosts;
      ghosts.find(cloud.grid, cloud.step, {2.6, 5.}, reached);
      mass.reinit(cloud.nodes.n_local(), 1, 2);
      assemble_mass(cloud.step, cloud.window(), cloud.nodes, mass);
      ghosts.add_mass(cloud.grid, cloud.nodes, factor, mass);
      terms.stiffness.reinit(cloud.nodes.n_local(), 1, 2);
      terms.stiffness.set_zero();
      ghosts.add_stiffness(cloud.grid, cloud.nodes, factor, terms.stiffness);

      const Scheme scheme(time);
      problem = std::make_unique<SolidProblem<dim>>(
        InternalForce<dim>({Material(Cloud<dim>::material(0)), Material(Cloud<dim>::material(1))},
                           scheme.conserving_stress ? StressRule::conserving
                                                    : StressRule::at_configuration,
                           scheme.alpha_f),
        scheme,
        LinearSolverParameters(),
        std::vector<std::string>{"a", "b"});
      problem->reinit(cloud.grid,
                      cloud.nodes,
                      cloud.conditions,
                      cloud.ties,
                      cloud.step,
                      mass,
                      &terms,
                      2,
                      true);
      state.velocity_n     = cloud.random_nodal(1., 1);
      state.acceleration_n = cloud.random_nodal(0., 2);
      state.external_force = cloud.random_nodal(0.1, 3);
      state.displacement   = cloud.random_nodal(0.03, 4);
      problem->start(state, 0., 0.3);
    }

    Cloud<dim>                         cloud;
    NodeMatrix<dim>                    mass;
    GhostMatrices<dim>                 terms;
    NodalState                         state;
    std::unique_ptr<SolidProblem<dim>> problem;
  };
} // namespace

TYPED_TEST_SUITE(SolidProblemGhost, Dimensions);

TYPED_TEST(SolidProblemGhost, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const SchemeKind kind : {SchemeKind::clc_midpoint, SchemeKind::trapezoidal})
    for (const double factor : {1e-6, 10.}) // the default, and one that outweighs the rest
      {
        Step<dim>    step(kind, factor);
        const double before = step.problem->evaluate().residual_norm;
        double       norm;
        ASSERT_TRUE(step.problem->solve_correction(norm, false).success);
        // along J^-1 (-r) the residual falls as |r(u + e du)| = (1 - e) |r| + O(e^2)
        const double e = 1e-5;
        step.problem->apply_correction(e);
        const double plus = step.problem->evaluate().residual_norm;
        step.problem->apply_correction(-2. * e);
        const double minus = step.problem->evaluate().residual_norm;
        // central differences: e^2 times a curvature of order 100, and round-off 1e-14/e
        EXPECT_NEAR((plus - minus) / (2. * e), -before, 1e-6 * before);
      }
}
