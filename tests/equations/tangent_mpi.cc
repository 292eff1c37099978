// Two fields on one grid, coupled by springs and by an unknown that belongs to no node.
#include "../transfer/cloud.h"

#include <kedge/equations/step_equations.h>
#include <kedge/solid/inertia_term.h>
#include <kedge/solid/solid_term.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class EquationsTangentMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /**
   * Springs f = d + 5 d^3 between the x components of two fields at their common nodes,
   * d = u_0 - u_1, and a handle q: sum of (q - u_0) at the same nodes + q = 1/2.
   */
  template <int dim>
  class Springs : public Term<dim>
  {
  public:
    Springs(const Patch<dim> &first, const Patch<dim> &second)
      : first(first)
      , second(second)
    {}

    std::string
    name() const override
    {
      return "springs";
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override
    {
      handle = unknowns.add_others(1);
    }

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override
    {
      const double q = trial.unknowns.others[handle];
      if (is_first_rank())
        residual.others()[handle] += q - 0.5;
      for_nodes([&](const unsigned int i, const unsigned int j) {
        const double u = trial.displacement(0)[i * dim], d = u - trial.displacement(1)[j * dim];
        residual.partial(0)[i * dim] += d + 5. * d * d * d + u - q;
        residual.partial(1)[j * dim] -= d + 5. * d * d * d;
        residual.others()[handle] += q - u;
      });
      return {};
    }

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override
    {
      const UnknownIndex q = UnknownIndex::other(handle);
      if (is_first_rank())
        tangent.add(q, q, 1.);
      for_nodes([&](const unsigned int i, const unsigned int j) {
        const double       d = trial.displacement(0)[i * dim] - trial.displacement(1)[j * dim];
        const double       k = 1. + 15. * d * d;
        const UnknownIndex a{0, i, 0}, b{1, j, 0};
        tangent.add(a, a, k + 1.);
        tangent.add(a, b, -k);
        tangent.add(b, a, -k);
        tangent.add(b, b, k);
        tangent.add(a, q, -1.);
        tangent.add(q, a, -1.);
        tangent.add(q, q, 1.);
      });
    }

  private:
    static bool
    is_first_rank()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    /** Common nodes that this rank owns. */
    template <typename Visit>
    void
    for_nodes(const Visit &visit) const
    {
      for (unsigned int i = 0; i < first.nodes.n_owned(); ++i)
        {
          const int j = second.nodes.local(first.nodes.window_node(i));
          if (j >= 0)
            visit(i, static_cast<unsigned int>(j));
        }
    }

    const Patch<dim> &first, &second;
    unsigned int      handle = 0;
  };

  /** A step of two fields, with ties of badly filled nodes in each. */
  template <int dim>
  struct TwoFields
  {
    explicit TwoFields(const bool coupled)
      : cloud({BasisKind::linear, BasisKind::gimp}, 3, 23, 3)
      , scheme(TimeParameters())
    {
      const std::vector<Material> materials = {Material(Cloud<dim>::material(0)),
                                               Material(Cloud<dim>::material(1))};
      for (unsigned int f = 0; f < 2; ++f)
        {
          PatchParameters parameters;
          parameters.body_names       = {"a", "b"};
          parameters.holds_body       = {f == 0, f == 1};
          parameters.basis_of_body    = cloud.basis_of_body;
          parameters.smallest_filling = 0.05;
          parameters.n_components     = dim;
          patches[f] =
            std::make_unique<Patch<dim>>(cloud.grid, parameters, NodeConditions<dim>({}, {}));
          patches[f]->reinit(cloud.points, [](std::vector<unsigned char> &) {});
          mass[f].reinit(patches[f]->nodes.n_local(), 1, 2);
          assemble_mass(*patches[f], mass[f]);
          terms.push_back(std::make_unique<SolidTerm<dim>>(f, *patches[f], materials, scheme));
          terms.push_back(std::make_unique<InertiaTerm<dim>>(f, *patches[f], mass[f], scheme));
        }
      if (coupled)
        terms.push_back(std::make_unique<Springs<dim>>(*patches[0], *patches[1]));
      unknowns.fields.resize(2);
      for (auto &term : terms)
        term->declare_unknowns(unknowns);
      equations =
        std::make_unique<StepEquations<dim>>(std::vector<const Patch<dim> *>{patches[0].get(),
                                                                             patches[1].get()},
                                             unknowns,
                                             terms,
                                             scheme,
                                             LinearSolverParameters());
      equations->reinit({2, 2});
      trial.begin({0., 0.3}, unknowns, {patches[0]->nodes.n_local(), patches[1]->nodes.n_local()});
      for (unsigned int f = 0; f < 2; ++f)
        {
          const std::size_t n = std::size_t(patches[f]->nodes.n_local()) * dim;
          trial.motion[f].velocity_n.resize(n);
          trial.motion[f].acceleration_n.assign(n, 0.);
          for (std::size_t k = 0; k < n; ++k)
            trial.motion[f].velocity_n[k] =
              0.1 * std::sin(3. * f + patches[f]->nodes.window_node(k / dim) + k % dim);
        }
      equations->start(trial, 0.);
    }

    Cloud<dim>                          cloud;
    const Scheme                        scheme;
    std::unique_ptr<Patch<dim>>         patches[2];
    NodeMatrix<dim>                     mass[2];
    Terms<dim>                          terms;
    Unknowns<dim>                       unknowns;
    Trial<dim>                          trial;
    std::unique_ptr<StepEquations<dim>> equations;
  };
} // namespace

TYPED_TEST_SUITE(EquationsTangentMpi, Dimensions);

TYPED_TEST(EquationsTangentMpi, EntriesBetweenFieldsAndOtherUnknownsAreTheSlope)
{
  TwoFields<TypeParam::value> step(true);
  const double                before = step.equations->evaluate().residual_norm;
  double                      norm   = 0.;
  ASSERT_TRUE(step.equations->solve_correction(norm, false).success);
  // along J^-1 (-r) the residual falls as |r(x + e dx)| = (1 - e) |r| + O(e^2)
  const double e = 1e-5;
  step.equations->retract(e);
  const double plus = step.equations->evaluate().residual_norm;
  step.equations->retract(-e);
  const double minus = step.equations->evaluate().residual_norm;
  // central differences: e^2 times a curvature of order 100, and round-off 1e-14/e
  EXPECT_NEAR((plus - minus) / (2. * e), -before, 1e-6 * before);
}

TYPED_TEST(EquationsTangentMpi, NewtonFindsTheBalanceOfAll)
{
  constexpr int  dim = TypeParam::value;
  TwoFields<dim> step(true);
  const auto     report = solve_newton(*step.equations, NewtonParameters());
  ASSERT_TRUE(report.converged) << report.cause;
  // the handle's own equation, summed by hand: (n + 1) q = 1/2 + sum u_0 over common nodes
  double      sums[2] = {0., 0.}; // of displacements, and their number
  const auto &nodes   = step.patches[0]->nodes;
  for (unsigned int i = 0; i < nodes.n_owned(); ++i)
    if (step.patches[1]->nodes.local(nodes.window_node(i)) >= 0)
      {
        sums[0] += step.trial.displacement(0)[i * dim];
        sums[1] += 1.;
      }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  // Newton's tolerance leaves 1e-12 of forces of order one
  EXPECT_NEAR(step.trial.unknowns.others[0] * (sums[1] + 1.), 0.5 + sums[0], 1e-10);
}

TYPED_TEST(EquationsTangentMpi, FieldsWithoutCouplingDoNotKnowEachOther)
{
  TwoFields<TypeParam::value> step(false);
  const double                before = step.equations->evaluate().residual_norm;
  double                      norm   = 0.;
  ASSERT_TRUE(step.equations->solve_correction(norm, false).success);
  step.equations->retract(1e-5);
  const double plus = step.equations->evaluate().residual_norm;
  EXPECT_NEAR((plus - before) / 1e-5, -before, 1e-3 * before); // one-sided: curvature times 1e-5
  // what moves in one field leaves the residual of the other bit for bit
  step.equations->retract(0.);
  step.equations->evaluate();
  const auto other = step.equations->last_residual().of_field(1);
  for (double &u : step.trial.unknowns.fields[0])
    u *= 1.1;
  step.trial.follow(step.scheme);
  step.equations->evaluate();
  EXPECT_EQ(step.equations->last_residual().of_field(1), other);
}
