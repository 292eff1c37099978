// A field of random material points with terms, as a step sees them.
#ifndef kedge_tests_equations_term_cloud_h
#define kedge_tests_equations_term_cloud_h

#include "../transfer/cloud.h"

#include <kedge/equations/step_equations.h>

#include <gtest/gtest.h>

namespace kedge::test
{
  /** Terms on one field, in a step that has been started. */
  template <int dim>
  struct EquationsOfTerms
  {
    EquationsOfTerms(const Cloud<dim> &cloud, const TimeParameters &time, const bool has_pores)
      : cloud(cloud)
      , scheme(time)
      , patch(cloud.grid, parameters(cloud, has_pores), NodeConditions<dim>({}, {}))
    {
      unknowns.fields.resize(1);
      unknowns.traits.space_dimension = dim;
    }

    static PatchParameters
    parameters(const Cloud<dim> &cloud, const bool has_pores)
    {
      PatchParameters result;
      result.body_names    = {"a", "b"};
      result.basis_of_body = cloud.basis_of_body;
      result.n_components  = has_pores ? dim + 1 : dim;
      return result;
    }

    /** Finds the nodes and starts a step of 0.3 s with random velocities at the nodes. */
    void
    start(const double size_of_velocity = 1.)
    {
      for (auto &term : terms)
        term->declare_unknowns(unknowns);
      for (auto &term : terms)
        term->declare_books(ledger);
      LinearSolverParameters direct; // corrections that are exact but for round-off
      direct.kind = LinearSolverKind::direct;
      equations   = std::make_unique<StepEquations<dim>>(std::vector<const Patch<dim> *>{&patch},
                                                       unknowns,
                                                       terms,
                                                       scheme,
                                                       direct);
      patch.reinit(cloud.points, [&](std::vector<unsigned char> &reached) {
        for (auto &term : terms)
          term->reach(0, reached);
      });
      equations->reinit({3}); // splines reach furthest
      for (auto &term : terms)
        term->activate(cloud.points);
      trial.begin({0., 0.3}, unknowns, {patch.nodes.n_local()});
      if (scheme.dynamic)
        {
          trial.motion[0].velocity_n     = random_nodal(size_of_velocity, 1);
          trial.motion[0].acceleration_n = random_nodal(0., 2);
        }
      for (auto &term : terms)
        term->start(trial);
      equations->start(trial, 0.3);
    }

    /** Changes all unknowns by random numbers. */
    void
    change_unknowns(const double size)
    {
      const auto change = random_nodal(size, 4, patch.n_components());
      for (std::size_t k = 0; k < change.size(); ++k)
        trial.unknowns.fields[0][k] += change[k];
      trial.follow(scheme);
    }

    /** A value for each local node and component; the same on all ranks. */
    std::vector<double>
    random_nodal(const double size, const unsigned int kind, const unsigned int width = dim) const
    {
      std::vector<double> result(std::size_t(patch.nodes.n_local()) * width);
      for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
        {
          std::mt19937 generator(1000 * kind + patch.nodes.window_node(i));
          for (unsigned int c = 0; c < width; ++c)
            result[std::size_t(i) * width + c] =
              size * std::uniform_real_distribution<double>(-1, 1)(generator);
        }
      return result;
    }

    const Cloud<dim>                   &cloud;
    const Scheme                        scheme;
    Patch<dim>                          patch;
    Unknowns<dim>                       unknowns;
    Ledger                              ledger;
    Terms<dim>                          terms;
    Trial<dim>                          trial;
    std::unique_ptr<StepEquations<dim>> equations;
  };

  /**
   * Expects that along J^-1 (-r) the residual falls as |r(x + e dx)| = (1 - e) |r| + O(e^2): by
   * central differences of e = 1e-5, whose error is e^2 times a curvature of order 100, and
   * round-off 1e-14/e.
   */
  template <int dim>
  void
  expect_slope_of_residual(StepEquations<dim> &equations)
  {
    const double before = equations.evaluate().residual_norm;
    double       norm   = 0.;
    ASSERT_TRUE(equations.solve_correction(norm, false).success);
    const double e = 1e-5;
    equations.retract(e);
    const double plus = equations.evaluate().residual_norm;
    equations.retract(-e);
    const double minus = equations.evaluate().residual_norm;
    EXPECT_NEAR((plus - minus) / (2. * e), -before, 1e-6 * before);
    equations.retract(0.);
    EXPECT_EQ(equations.evaluate().residual_norm, before); // bit for bit where it was
  }
} // namespace kedge::test

#endif
