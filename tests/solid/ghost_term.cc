// Residual and tangent of a step with ghost stabilisation.
#include "../equations/term_cloud.h"

#include <kedge/solid/ghost_term.h>
#include <kedge/solid/inertia_term.h>
#include <kedge/solid/solid_term.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidGhostTerm : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
} // namespace

TYPED_TEST_SUITE(SolidGhostTerm, Dimensions);

TYPED_TEST(SolidGhostTerm, TangentIsTheSlopeOfTheResidual)
{
  constexpr int               dim = TypeParam::value;
  const Cloud<dim>            cloud({BasisKind::linear, BasisKind::gimp}, 2, 23);
  const std::vector<Material> materials = {Material(Cloud<dim>::material(0)),
                                           Material(Cloud<dim>::material(1))};
  for (const SchemeKind kind : {SchemeKind::clc_midpoint, SchemeKind::trapezoidal})
    for (const double factor : {1e-6, 10.}) // the default, and one that outweighs the rest
      {
        TimeParameters time;
        time.scheme = kind;
        StabilisationParameters ghosts;
        ghosts.ghost_mass_factor = ghosts.ghost_stiffness_factor = factor;
        EquationsOfTerms<dim> step(cloud, time, false);
        NodeMatrix<dim>       mass;
        step.terms.push_back(
          std::make_unique<SolidTerm<dim>>(0, step.patch, materials, step.scheme));
        step.terms.push_back(std::make_unique<InertiaTerm<dim>>(0, step.patch, mass, step.scheme));
        auto ghost_term = std::make_unique<GhostTerm<dim>>(0,
                                                           step.patch,
                                                           ghosts,
                                                           std::vector<double>{2.6, 5.},
                                                           step.scheme);
        auto ghost_inertia =
          std::make_unique<GhostInertiaTerm<dim>>(0, step.patch, *ghost_term, ghosts, step.scheme);
        step.terms.push_back(std::move(ghost_term));
        step.terms.push_back(std::move(ghost_inertia));
        step.start();
        mass.reinit(step.patch.nodes.n_local(), 1, 3);
        assemble_mass(step.patch, mass);
        step.change_unknowns(0.03);
        expect_slope_of_residual(*step.equations);
      }
}
