// Ghost terms of saturated bodies: slopes, what they leave alone, what they take, on one rank
// and on two.
#include "../transfer/cloud.h"

#include <kedge/porous/porous_problem.h>
#include <kedge/porous/pressure_projection.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class PorousGhostsMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  constexpr double bulk_modulus = 3.;

  Soil
  some_soil()
  {
    PoreFluidParameters parameters;
    parameters.initial_porosity       = 0.8;
    parameters.fluid_density          = 1.1;
    parameters.fluid_bulk_modulus     = bulk_modulus;
    parameters.hydraulic_conductivity = 0.4;
    parameters.reference_gravity      = 9.;
    return {PoreFluid(parameters), 2.4, 0.7, false};
  }

  /** The balance with its parts in the open. */
  template <int dim>
  struct OpenProblem : PorousProblem<dim>
  {
    using PorousProblem<dim>::PorousProblem;

    const std::vector<double> &
    residual_of_balance() const
    {
      return this->Balance<dim>::residual;
    }

    void
    change_unknowns(const std::vector<double> &change)
    {
      this->Balance<dim>::correction = change;
      this->apply_correction(1.);
    }
  };

  /** A cloud whose cells are all badly filled, in a step; ghost terms of one size each. */
  template <int dim>
  struct Step
  {
    Step(const SchemeKind kind, const double factor, const BasisKind basis = BasisKind::gimp)
      : cloud({basis}, 2, 23)
      , loads(no_body_force(), {false}, {}, {}, {})
      , surfaces({}, {})
      , fluxes({}, {})
      , parameters(time(kind))
      , scheme(parameters)
    {
      auto reached = cloud.step.reached_nodes(cloud.window());
      ghosts.find(cloud.grid, cloud.step, {2.6}, reached);
      cloud.nodes.reinit(cloud.grid, reached); // faces reach nodes of the other rank's points
      cloud.prescribe(NodeConditions<dim>({}, {}));
      for (NodeMatrix<dim> *matrix :
           {&terms.stiffness, &terms.mass, &terms.conductance, &terms.storage})
        {
          matrix->reinit(cloud.nodes.n_local(), 1, 2);
          matrix->set_zero();
        }
      ghosts.add_stiffness(cloud.grid, cloud.nodes, factor, terms.stiffness);
      ghosts.add_mass(cloud.grid, cloud.nodes, factor, terms.mass);
      ghosts.add_gradient_penalty(cloud.grid, cloud.nodes, 0.1 * factor, terms.conductance);
      ghosts.add_value_penalty(cloud.grid, cloud.nodes, 0.3 * factor, terms.storage);
      terms.has_storage = true;
      give_pressures([](const dealii::Point<dim> &x) {
        return 0.5 * std::sin(7. * x[0] + 3. * x[1]);
      });
      state.velocity_n     = cloud.random_nodal(0.1, 1);
      state.acceleration_n = cloud.random_nodal(0.1, 2);
      state.external_force = cloud.random_nodal(0.1, 3);
    }

    static std::array<std::string, dim>
    no_body_force()
    {
      std::array<std::string, dim> zeros;
      zeros.fill("0");
      return zeros;
    }

    static TimeParameters
    time(const SchemeKind kind)
    {
      TimeParameters parameters;
      parameters.scheme     = kind;
      parameters.pore_theta = 0.6;
      return parameters;
    }

    template <typename Field>
    void
    give_pressures(const Field &field)
    {
      cloud.points.update_each(
        [&](const unsigned int, dealii::Point<dim> &x, PointState<dim> &point) {
          point.pore_pressure = field(x);
        });
    }

    /** A balance that starts the step, with or without ghosts. */
    std::unique_ptr<OpenProblem<dim>>
    problem(const bool with_ghosts)
    {
      auto result =
        std::make_unique<OpenProblem<dim>>(PorousForce<dim>({Material(Cloud<dim>::material(0))},
                                                            {some_soil()},
                                                            scheme.alpha_f,
                                                            PoreScheme(parameters)),
                                           loads,
                                           surfaces,
                                           fluxes,
                                           PorousParameters(),
                                           scheme,
                                           LinearSolverParameters(),
                                           std::vector<double>{2.6},
                                           std::vector<std::string>{"a"});
      result->reinit(cloud.grid,
                     cloud.nodes,
                     cloud.conditions,
                     cloud.ties,
                     cloud.step,
                     terms.mass,
                     with_ghosts ? &terms : nullptr,
                     2,
                     true);
      result->read_pores(cloud.points);
      state.displacement = cloud.random_nodal(0.02, 4);
      result->start(state, 0., 0.3);
      return result;
    }

    Cloud<dim>            cloud;
    ExternalLoads<dim>    loads;
    SurfacePressures<dim> surfaces;
    SurfaceFluxes<dim>    fluxes;
    const TimeParameters  parameters;
    const Scheme          scheme;
    GhostPenalty<dim>     ghosts;
    GhostMatrices<dim>    terms;
    NodalState            state;
  };

  const std::vector<SchemeKind> schemes = {SchemeKind::quasi_static,
                                           SchemeKind::trapezoidal,
                                           SchemeKind::midpoint};
} // namespace

TYPED_TEST_SUITE(PorousGhostsMpi, Dimensions);

TYPED_TEST(PorousGhostsMpi, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  // without inertia the tangent of a free cloud has no inverse
  for (const SchemeKind kind : {SchemeKind::trapezoidal, SchemeKind::midpoint})
    for (const double factor : {1e-3, 10.}) // small, and one that outweighs the rest
      {
        Step<dim>    step(kind, factor);
        const auto   problem = step.problem(true);
        const double before  = problem->evaluate().residual_norm;
        double       norm;
        ASSERT_TRUE(problem->solve_correction(norm, false).success);
        // along J^-1 (-r) the residual falls as |r(x + e dx)| = (1 - e) |r| + O(e^2)
        const double e = 1e-5;
        problem->apply_correction(e);
        const double plus = problem->evaluate().residual_norm;
        problem->apply_correction(-2. * e);
        const double minus = problem->evaluate().residual_norm;
        // central differences: e^2 times a curvature of order 100, and round-off 1e-14/e
        EXPECT_NEAR((plus - minus) / (2. * e), -before, 1e-6 * before);
      }
}

TYPED_TEST(PorousGhostsMpi, TheirWorkIsCountedAndTheyMoveNoMass)
{
  constexpr int dim = TypeParam::value;
  for (const SchemeKind kind : schemes)
    {
      Step<dim> step(kind, 0.5);
      step.give_pressures([](const dealii::Point<dim> &) {
        return 0.4;
      });
      auto change = step.cloud.random_nodal(0.02, 5, dim + 1);
      for (const bool is_even : {true, false}) // rigid motion and constant pressure, or neither
        {
          if (is_even)
            {
              step.state.velocity_n.assign(step.state.velocity_n.size(), 0.1);
              for (std::size_t k = 0; k < change.size(); ++k)
                change[k] = 0.03;
            }
          else
            {
              step.state.velocity_n = step.cloud.random_nodal(0.1, 1);
              change                = step.cloud.random_nodal(0.02, 5, dim + 1);
            }
          step.state.acceleration_n.assign(step.state.velocity_n.size(), 0.);

          double              work = 0.;
          std::vector<double> forces[2];
          for (const bool with_ghosts : {false, true})
            {
              const auto problem = step.problem(with_ghosts);
              problem->change_unknowns(change);
              EXPECT_TRUE(problem->evaluate().ok);
              forces[with_ghosts] = problem->residual_of_balance();
              if (with_ghosts)
                work = problem->work_against_ghosts();
            }
          // the pressures were 0.4 everywhere before the change
          double sums[dim + 2] = {}, largest = 0.;
          for (std::size_t k = 0; k < std::size_t(step.cloud.nodes.n_owned()) * (dim + 1); ++k)
            {
              const double   ghost     = forces[1][k] - forces[0][k];
              const unsigned component = k % (dim + 1);
              sums[component] += ghost;
              sums[dim + 1] += component == dim ? (0.4 + change[k]) * ghost : 0.;
              largest = std::max(largest, std::abs(ghost));
            }
          MPI_Allreduce(MPI_IN_PLACE, sums, dim + 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
          largest = dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
          // round-off of some hundred forces of order one and less
          if (is_even)
            EXPECT_LT(largest, 1e-13);
          else
            EXPECT_GT(largest, 1e-4);
          for (int c = 0; c <= dim; ++c)
            EXPECT_NEAR(sums[c], 0., 1e-12);
          EXPECT_NEAR(work, sums[dim + 1], 1e-12);
          EXPECT_TRUE(is_even || work > 1e-6);
        }
    }
}

TYPED_TEST(PorousGhostsMpi, TermsHaveTheSizeOfTheirIntegrals)
{
  constexpr int   dim    = TypeParam::value;
  const double    factor = 0.5;
  const Step<dim> step(SchemeKind::quasi_static, factor);
  const auto     &h = step.cloud.grid.lattice().h;
  for (unsigned int d = 0; d < dim; ++d)
    {
      // x_d^2/2 at the nodes: its slope jumps by h_d across every face with normal d
      double volume = 1.;
      for (int e = 0; e < dim; ++e)
        volume *= h[e];
      unsigned int n_faces = 0;
      for (const GhostFace &face : step.ghosts.faces())
        n_faces += face.direction == d;
      std::vector<double> field(step.cloud.nodes.n_local()), product(field);
      for (unsigned int i = 0; i < field.size(); ++i)
        field[i] = 0.5 * std::pow(step.cloud.node_position(i)[d], 2);
      const auto energy = [&](const NodeMatrix<dim> &matrix) {
        multiply(matrix, step.cloud.window(), step.cloud.nodes, 1, field, product);
        double sum = 0.;
        for (unsigned int i = 0; i < field.size(); ++i)
          sum += field[i] * product[i];
        return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      };
      // h^3/3 times jump^2 times area, per face
      const double jumps =
        dealii::Utilities::MPI::sum(n_faces, MPI_COMM_WORLD) * std::pow(h[d], 4) * volume / 3.;
      EXPECT_NEAR(energy(step.terms.storage), 0.3 * factor * jumps, 1e-12 * jumps);
      EXPECT_NEAR(energy(step.terms.conductance),
                  0.1 * factor * jumps / (h[d] * h[d]),
                  1e-12 * jumps);
    }
}

TYPED_TEST(PorousGhostsMpi, ProjectionOfPressures)
{
  constexpr int dim = TypeParam::value;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp})
    {
      Step<dim>  step(SchemeKind::quasi_static, 0.1, basis);
      const auto project = [&](const auto &field, const NodeMatrix<dim> &storage) {
        step.give_pressures(field);
        PorePoints<dim> pores;
        pores.reinit(step.cloud.points,
                     step.cloud.step,
                     PoreScheme(Step<dim>::time(SchemeKind::quasi_static)));
        const std::vector<NodalStatus> status(std::size_t(step.cloud.nodes.n_local()) * (dim + 1),
                                              NodalStatus::free);
        std::vector<double>            nodal(status.size(), 0.);
        project_pressure(step.cloud.grid,
                         step.cloud.nodes,
                         step.cloud.ties,
                         step.cloud.step,
                         pores.pressure,
                         bulk_modulus,
                         status,
                         storage,
                         nodal);
        std::vector<double> pressure;
        for (std::size_t k = dim; k < nodal.size(); k += dim + 1)
          pressure.push_back(nodal[k]);
        return pressure;
      };
      const auto jumps_of = [&](const std::vector<double> &pressure) {
        std::vector<double> product(pressure.size());
        multiply(step.terms.storage, step.cloud.window(), step.cloud.nodes, 1, pressure, product);
        double sum = 0.;
        for (unsigned int i = 0; i < pressure.size(); ++i)
          sum += pressure[i] * product[i];
        return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      };
      // linear fields: exact; the iteration stops at 1e-9 of a matrix with eigenvalues above 1e-4
      const auto linear = [](const dealii::Point<dim> &x) {
        return 0.3 + 0.5 * x[0] - 0.2 * x[1];
      };
      const auto exact = project(linear, step.terms.storage);
      for (unsigned int i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(exact[i], linear(step.cloud.node_position(i)), 1e-5);

      // other fields: their mean stays, their jumps become smaller
      NodeMatrix<dim> little;
      little.reinit(step.cloud.nodes.n_local(), 1, 2);
      little.set_zero();
      step.ghosts.add_value_penalty(step.cloud.grid, step.cloud.nodes, 0.003, little);
      const auto wave = [](const dealii::Point<dim> &x) {
        return std::sin(9. * x[0] + 5. * x[1]);
      };
      const auto with   = project(wave, step.terms.storage);
      const auto hardly = project(wave, little);
      EXPECT_LT(jumps_of(with), 0.9 * jumps_of(hardly));
      std::vector<double> weights(step.cloud.step.size()), sums(with.size(), 0.);
      double              means[2] = {0., 0.};
      for (unsigned int slot = 0; slot < weights.size(); ++slot)
        {
          weights[slot] = step.cloud.step.volume[slot] * step.cloud.step.determinant[slot];
          means[0] += weights[slot] * wave(step.cloud.step.location[slot]);
        }
      add_scalars_to_nodes(step.cloud.step,
                           step.cloud.window(),
                           step.cloud.nodes,
                           weights,
                           1,
                           sums);
      for (unsigned int i = 0; i < sums.size(); ++i)
        means[1] += sums[i] * with[i];
      MPI_Allreduce(MPI_IN_PLACE, means, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_NEAR(means[0], means[1], 1e-8);
    }
}
