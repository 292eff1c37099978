// Pressures that follow faces: their tangent, and that a closed surface feels no force.
#include "../equations/term_cloud.h"

#include <kedge/solid/follower_term.h>
#include <kedge/solid/inertia_term.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidFollower : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** A ball within the cells of a cloud as body "a". */
  template <int dim>
  BodyParameters<dim>
  ball_in(const Cloud<dim> &cloud)
  {
    std::ostringstream text;
    for (int d = 0; d < dim; ++d)
      text << (d == 0 ? "ball(" : ", ")
           << cloud.grid.lattice().origin[d] + 4.1 * cloud.grid.lattice().h[d];
    BodyParameters<dim> body;
    body.name     = "a";
    body.geometry = parse_geometry<dim>(text.str() + "; 0.4)", {});
    return body;
  }

  /**
   * Random points, all of which have faces on all sides, with inertia to hold them. Pressures act
   * on these faces or on facets of a ball among the points.
   */
  template <int dim>
  struct Pressed : EquationsOfTerms<dim>
  {
    Pressed(Cloud<dim>        &cloud,
            const SchemeKind   kind,
            const std::string &pressure,
            const bool         on_facets = false)
      : EquationsOfTerms<dim>(cloud, time_of(kind), false)
      , ball(ball_in(cloud), 0, 0, this->patch, 0.1, false, {2 * dim})
    {
      std::vector<GeneratedPoint<dim>> generated;
      for (const auto &record : cloud.records)
        generated.push_back({record, (1u << (2 * dim)) - 1});
      for (auto &point : generated)
        {
          point.record.state.reference_volume = 1.;
          for (int d = 0; d < dim; ++d)
            point.record.state.reference_half_lengths[d] = 0.1 * (d + 1);
          for (int d = 0; d < dim; ++d)
            point.record.state.reference_volume *= 0.2 * (d + 1);
        }
      std::vector<TractionParameters<dim>> parameters;
      for (unsigned int side = on_facets ? 2 * dim : 0; side < 2u * dim + (on_facets ? 1u : 0u);
           ++side)
        {
          TractionParameters<dim> traction;
          traction.name      = "side" + std::to_string(side);
          traction.body      = "a";
          traction.side      = side;
          traction.pressure  = pressure;
          traction.resultant = true;
          parameters.push_back(traction);
        }
      if (on_facets)
        ball.attach(generated);
      auto follower =
        std::make_unique<FollowerTerm<dim>>(0,
                                            this->patch,
                                            FollowerPressures<dim>(parameters, {}, {}, {&ball}),
                                            std::vector<std::string>{"a"},
                                            this->scheme);
      follower->attach(generated);
      cloud.points.update_each(
        [&](const unsigned int, dealii::Point<dim> &, PointState<dim> &state) {
          state.loaded = 1.;
        });
      this->terms.push_back(std::move(follower));
      this->terms.push_back(std::make_unique<InertiaTerm<dim>>(0, this->patch, mass, this->scheme));
      this->start();
      mass.reinit(this->patch.nodes.n_local(), 1, 3);
      assemble_mass(this->patch, mass);
      blend_mass(0.5, mass, this->patch.nodes.n_local()); // well conditioned whatever the points
      this->change_unknowns(0.02);
    }

    static TimeParameters
    time_of(const SchemeKind kind)
    {
      TimeParameters parameters;
      parameters.scheme = kind;
      return parameters;
    }

    SurfaceTerm<dim> ball;
    NodeMatrix<dim>  mass;
  };
} // namespace

TYPED_TEST_SUITE(SolidFollower, Dimensions);

// pressures that depend on place and time, at the end of the step and in its middle
TYPED_TEST(SolidFollower, TangentIsTheSlope)
{
  constexpr int dim = TypeParam::value;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
    for (const SchemeKind kind : {SchemeKind::clc_midpoint, SchemeKind::newmark})
      {
        Cloud<dim>   cloud({basis}, 2, 29);
        Pressed<dim> step(cloud, kind, "5*t + x*y - 2*x^2 + 0.3*z*x");
        expect_slope_of_residual(*step.equations);
        Pressed<dim> on_facets(cloud, kind, "5*t + x*y - 2*x^2 + 0.3*z*x", true);
        expect_slope_of_residual(*on_facets.equations);
      }
}

// what acts on the facets of a closed surface has no resultant, and does act
TYPED_TEST(SolidFollower, AClosedSurfaceOfFacetsFeelsNoForce)
{
  constexpr int dim = TypeParam::value;
  Cloud<dim>    cloud({BasisKind::gimp}, 2, 29);
  Pressed<dim>  step(cloud, SchemeKind::clc_midpoint, "3", true);
  step.equations->evaluate();
  step.ledger.open();
  step.terms.front()->book(step.trial, step.equations->last_residual(), step.ledger);
  step.ledger.close(MPI_COMM_WORLD);
  for (int d = 0; d < dim; ++d)
    EXPECT_NEAR(step.ledger.value("load_side" + std::to_string(2 * dim) + "_" + "xyz"[d]),
                0.,
                1e-13);
  EXPECT_GT(std::abs(step.ledger.value("external_work")), 1e-5); // p times the change of volume
}

// Faces of a box in one affine motion: p cof(F) times areas that sum up to zero. Here every
// point is such a box of its own, with a gradient of its own.
TYPED_TEST(SolidFollower, AClosedSurfaceFeelsNoForce)
{
  constexpr int dim = TypeParam::value;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
    {
      Cloud<dim>   cloud({basis}, 2, 29);
      Pressed<dim> step(cloud, SchemeKind::clc_midpoint, "3");
      step.equations->evaluate();
      step.ledger.open();
      step.terms.front()->book(step.trial, step.equations->last_residual(), step.ledger);
      step.ledger.close(MPI_COMM_WORLD);
      for (int d = 0; d < dim; ++d)
        {
          double sum = 0., size = 0.;
          for (unsigned int side = 0; side < 2 * dim; ++side)
            {
              const double force =
                step.ledger.value("load_side" + std::to_string(side) + "_" + "xyz"[d]);
              sum += force;
              size += std::abs(force);
            }
          EXPECT_GT(size, 0.1);
          EXPECT_NEAR(sum, 0., 1e-14 * size);
        }
    }
}
