// Ghost terms of saturated bodies: slopes, what they leave alone, what they take, on one rank
// and on two.
#include "../equations/term_cloud.h"

#include <kedge/porous/porous_ghost_term.h>
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

  TimeParameters
  time_of(const SchemeKind kind)
  {
    TimeParameters parameters;
    parameters.scheme     = kind;
    parameters.pore_theta = 0.6;
    return parameters;
  }

  /** Pressures of the points by place [Pa]. */
  template <int dim, typename Field>
  void
  give_pressures(Cloud<dim> &cloud, const Field &field)
  {
    cloud.points.update_each(
      [&](const unsigned int, dealii::Point<dim> &x, PointState<dim> &point) {
        point.pore_pressure = field(x);
      });
  }

  /**
   * A step of a saturated cloud whose cells are all badly filled, with ghost terms of one
   * size each.
   */
  template <int dim>
  struct Step : EquationsOfTerms<dim>
  {
    Step(const Cloud<dim> &cloud, const SchemeKind kind, const double factor)
      : EquationsOfTerms<dim>(cloud, time_of(kind), true)
      , loads(no_body_force(), {false}, {}, {})
    {
      PoreFluidParameters parameters;
      parameters.fluid_bulk_modulus = bulk_modulus;
      parameters.fluid_density = parameters.hydraulic_conductivity = parameters.reference_gravity =
        1.;
      StabilisationParameters ghosts;
      ghosts.ghost_mass_factor = ghosts.ghost_stiffness_factor = factor;
      ghosts.ghost_conductivity_factor = 0.1 * factor; // over 1 kg/m^3 times 1 m/s^2
      ghosts.ghost_storage_factor      = 0.3 * factor * bulk_modulus;
      auto soil                        = std::make_unique<PorousTerm<dim>>(
        0,
        this->patch,
        SoilBodies{{Material(Cloud<dim>::material(0))}, {some_soil()}, {"a"}, {"0"}, {}},
        loads,
        SurfacePressures<dim>({}, {}),
        SurfaceFluxes<dim>({}, {}),
        PorousParameters(),
        this->scheme,
        PoreScheme(time_of(kind)),
        2);
      auto solid = std::make_unique<GhostTerm<dim>>(0,
                                                    this->patch,
                                                    ghosts,
                                                    std::vector<double>{2.6},
                                                    this->scheme);
      auto fluid_ghosts =
        std::make_unique<PorousGhostTerm<dim>>(0, this->patch, *solid, *soil, ghosts, parameters);
      porous_ghosts = fluid_ghosts.get();
      this->terms.push_back(std::move(soil));
      if (this->scheme.dynamic)
        this->terms.push_back(
          std::make_unique<GhostInertiaTerm<dim>>(0, this->patch, *solid, ghosts, this->scheme));
      this->terms.push_back(std::move(solid));
      this->terms.push_back(std::move(fluid_ghosts));
      this->start(0.1);
    }

    static std::array<std::string, dim>
    no_body_force()
    {
      std::array<std::string, dim> zeros;
      zeros.fill("0");
      return zeros;
    }

    ExternalLoads<dim>    loads;
    PorousGhostTerm<dim> *porous_ghosts = nullptr;
  };

  /** The faces of a cloud and matrices on them. */
  template <int dim>
  struct Faces
  {
    Faces(const BasisKind basis, const double factor)
      : cloud({basis}, 2, 23, 2, 0., dim + 1)
    {
      auto reached = cloud.step.reached_nodes(cloud.window());
      ghosts.find(cloud.patch, {2.6}, reached);
      cloud.nodes.reinit(cloud.grid, reached); // faces reach nodes of the other rank's points
      cloud.prescribe(NodeConditions<dim>({}, {}));
      for (NodeMatrix<dim> *matrix : {&conductance, &storage})
        {
          matrix->reinit(cloud.nodes.n_local(), 1, 3);
          matrix->set_zero();
        }
      ghosts.add_gradient_penalty(cloud.patch, 0.1 * factor, conductance);
      ghosts.add_value_penalty(cloud.patch, 0.3 * factor, storage);
    }

    Cloud<dim>        cloud;
    GhostPenalty<dim> ghosts;
    NodeMatrix<dim>   conductance, storage;
  };

  const std::vector<SchemeKind> schemes = {SchemeKind::quasi_static,
                                           SchemeKind::trapezoidal,
                                           SchemeKind::midpoint};
} // namespace

TYPED_TEST_SUITE(PorousGhostsMpi, Dimensions);

TYPED_TEST(PorousGhostsMpi, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  Cloud<dim>    cloud({BasisKind::gimp}, 2, 23);
  give_pressures(cloud, [](const dealii::Point<dim> &x) {
    return 0.5 * std::sin(7. * x[0] + 3. * x[1]);
  });
  // without inertia the tangent of a free cloud has no inverse
  for (const SchemeKind kind : {SchemeKind::trapezoidal, SchemeKind::midpoint})
    for (const double factor : {1e-3, 10.}) // small, and one that outweighs the rest
      {
        Step<dim> step(cloud, kind, factor);
        step.change_unknowns(0.02);
        expect_slope_of_residual(*step.equations);
      }
}

TYPED_TEST(PorousGhostsMpi, TheirWorkIsCountedAndTheyMoveNoMass)
{
  constexpr int dim = TypeParam::value;
  Cloud<dim>    cloud({BasisKind::gimp}, 2, 23);
  give_pressures(cloud, [](const dealii::Point<dim> &) {
    return 0.4;
  });
  for (const SchemeKind kind : schemes)
    for (const bool is_even : {true, false}) // rigid motion and constant pressure, or neither
      {
        double              work = 0.;
        std::vector<double> forces[2], change;
        unsigned int        n_owned = 0;
        for (const bool has_ghosts : {false, true})
          {
            Step<dim> step(cloud, kind, has_ghosts ? 0.5 : 0.);
            change = step.random_nodal(0.02, 5, dim + 1);
            if (is_even)
              {
                change.assign(change.size(), 0.03);
                auto &velocity = step.trial.motion[0].velocity_n;
                velocity.assign(velocity.size(), 0.1);
              }
            for (std::size_t k = 0; k < change.size(); ++k)
              step.trial.unknowns.fields[0][k] += change[k];
            step.trial.follow(step.scheme);
            EXPECT_TRUE(step.equations->evaluate().ok);
            forces[has_ghosts] = step.equations->last_residual().of_field(0);
            step.ledger.open();
            step.porous_ghosts->book(step.trial, step.equations->last_residual(), step.ledger);
            step.ledger.close(MPI_COMM_WORLD);
            work    = step.ledger.value("stabilisation_energy");
            n_owned = step.patch.nodes.n_owned();
          }
        // the pressures were 0.4 everywhere before the change
        double sums[dim + 2] = {}, largest = 0.;
        for (std::size_t k = 0; k < std::size_t(n_owned) * (dim + 1); ++k)
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

TYPED_TEST(PorousGhostsMpi, TermsHaveTheSizeOfTheirIntegrals)
{
  constexpr int    dim    = TypeParam::value;
  const double     factor = 0.5;
  const Faces<dim> step(BasisKind::gimp, factor);
  const auto      &h = step.cloud.grid.lattice().h;
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
        multiply(matrix, step.cloud.patch, 1, field, product);
        double sum = 0.;
        for (unsigned int i = 0; i < field.size(); ++i)
          sum += field[i] * product[i];
        return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      };
      // h^3/3 times jump^2 times area, per face
      const double jumps =
        dealii::Utilities::MPI::sum(n_faces, MPI_COMM_WORLD) * std::pow(h[d], 4) * volume / 3.;
      EXPECT_NEAR(energy(step.storage), 0.3 * factor * jumps, 1e-12 * jumps);
      EXPECT_NEAR(energy(step.conductance), 0.1 * factor * jumps / (h[d] * h[d]), 1e-12 * jumps);
    }
}

TYPED_TEST(PorousGhostsMpi, ProjectionOfPressures)
{
  constexpr int dim = TypeParam::value;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp})
    {
      Faces<dim> step(basis, 0.1);
      const auto project = [&](const auto &field, const NodeMatrix<dim> &storage) {
        give_pressures(step.cloud, field);
        PorePoints<dim> pores;
        pores.reinit(step.cloud.points,
                     step.cloud.step,
                     PoreScheme(time_of(SchemeKind::quasi_static)));
        std::vector<double> nodal(std::size_t(step.cloud.nodes.n_local()) * (dim + 1), 0.);
        project_pressure(step.cloud.patch, pores.pressure, bulk_modulus, storage, nodal);
        std::vector<double> pressure;
        for (std::size_t k = dim; k < nodal.size(); k += dim + 1)
          pressure.push_back(nodal[k]);
        return pressure;
      };
      const auto jumps_of = [&](const std::vector<double> &pressure) {
        std::vector<double> product(pressure.size());
        multiply(step.storage, step.cloud.patch, 1, pressure, product);
        double sum = 0.;
        for (unsigned int i = 0; i < pressure.size(); ++i)
          sum += pressure[i] * product[i];
        return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      };
      // linear fields: exact; the iteration stops at 1e-9 of a matrix with eigenvalues above 1e-4
      const auto linear = [](const dealii::Point<dim> &x) {
        return 0.3 + 0.5 * x[0] - 0.2 * x[1];
      };
      const auto exact = project(linear, step.storage);
      for (unsigned int i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(exact[i], linear(step.cloud.node_position(i)), 1e-5);

      // other fields: their mean stays, their jumps become smaller
      NodeMatrix<dim> little;
      little.reinit(step.cloud.nodes.n_local(), 1, 3);
      little.set_zero();
      step.ghosts.add_value_penalty(step.cloud.patch, 0.003, little);
      const auto wave = [](const dealii::Point<dim> &x) {
        return std::sin(9. * x[0] + 5. * x[1]);
      };
      const auto with   = project(wave, step.storage);
      const auto hardly = project(wave, little);
      EXPECT_LT(jumps_of(with), 0.9 * jumps_of(hardly));
      std::vector<double> weights(step.cloud.step.size()), sums(with.size(), 0.);
      double              means[2] = {0., 0.};
      for (unsigned int slot = 0; slot < weights.size(); ++slot)
        {
          weights[slot] = step.cloud.step.volume[slot] * step.cloud.step.determinant[slot];
          means[0] += weights[slot] * wave(step.cloud.step.location[slot]);
        }
      add_scalars_to_nodes(step.cloud.patch, weights, 1, sums);
      for (unsigned int i = 0; i < sums.size(); ++i)
        means[1] += sums[i] * with[i];
      MPI_Allreduce(MPI_IN_PLACE, means, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_NEAR(means[0], means[1], 1e-8);
    }
}
