#include "force_checks.h"

#include <kedge/solid/group_dilatation.h>
#include <kedge/solid/point_update.h>
#include <kedge/stress/mean_dilatation.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidGroupDilatation : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  const std::vector<MaterialKind> all_kinds = {MaterialKind::hencky, MaterialKind::von_mises};

  /** Linear, GIMP, a third body whose points keep their own volumes, splines. */
  const std::vector<std::vector<BasisKind>> all_bases     = {{BasisKind::linear},
                                                             {BasisKind::gimp},
                                                             {BasisKind::gimp,
                                                              BasisKind::linear,
                                                              BasisKind::gimp},
                                                             {BasisKind::spline}};
  const std::vector<bool>                   shared_volume = {true, true, false};

  constexpr double yield_stress = 0.1, hardening_modulus = 0.4;

  /** The elasticity in which the cloud's states are, with or without plasticity. */
  template <int dim>
  std::vector<Material>
  make_materials(const MaterialKind kind)
  {
    std::vector<Material> materials;
    for (unsigned int body = 0; body < 3; ++body)
      {
        const Hencky       elastic = Cloud<dim>::material(body);
        const double       K = elastic.bulk_modulus, G = elastic.shear_modulus;
        MaterialParameters parameters;
        parameters.kind              = kind;
        parameters.young_modulus     = 9. * K * G / (3. * K + G);
        parameters.poisson_ratio     = (3. * K - 2. * G) / (6. * K + 2. * G);
        parameters.yield_stress      = yield_stress;
        parameters.hardening_modulus = hardening_modulus;
        materials.push_back(make_material(parameters));
      }
    return materials;
  }

  /** Forms the groups, and hardens all points so that they are about to yield. */
  template <int dim>
  void
  prepare(const std::vector<BasisKind> &bases, Cloud<dim> &cloud)
  {
    MaterialParameters metal;
    metal.kind         = MaterialKind::von_mises;
    const auto columns = memory_indices(make_material(metal));
    cloud.step.reinit(cloud.grid, cloud.points, bases, {columns, columns, columns}, shared_volume);
    for (const auto &batch : cloud.step.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          const auto  &strain = cloud.step.stress_state[slot].strain;
          const double mean   = (strain[0] + strain[1] + strain[2]) / 3.;
          double       square = 0.;
          for (const double value : strain)
            square += (value - mean) * (value - mean);
          const double uniaxial =
            2. * Cloud<dim>::material(batch.body).shear_modulus * std::sqrt(1.5 * square);
          write_history<VonMises>({std::max(0., (uniaxial - yield_stress) / hardening_modulus),
                                   yield_stress},
                                  &cloud.step.history[slot * cloud.step.n_history]);
        }
  }

  /** Calls check(cloud, materials) for all bases and materials, with groups in the cloud. */
  template <int dim, typename Check>
  void
  for_all(const Check &check)
  {
    for (unsigned int b = 0; b < all_bases.size(); ++b)
      {
        Cloud<dim> cloud(all_bases[b], 2, 31 + b);
        for (const MaterialKind kind : all_kinds)
          {
            prepare<dim>(all_bases[b], cloud);
            SCOPED_TRACE("basis " + std::to_string(b) + ", material " +
                         std::to_string(static_cast<int>(kind)));
            check(cloud, make_materials<dim>(kind));
          }
      }
  }

  /** Calls visit(slot, material, A) for all points, A the displacement gradient. */
  template <int dim, typename Visit>
  void
  for_each_gradient(const Cloud<dim>            &cloud,
                    const std::vector<Material> &materials,
                    const std::vector<double>   &u,
                    const Visit                 &visit)
  {
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(cloud.patch, u, gradients);
    for (const auto &batch : cloud.step.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        {
          double A[dim][dim];
          gradients[slot].unroll(&A[0][0], &A[0][0] + dim * dim);
          visit(slot, materials[batch.body], A);
        }
  }

  /** ln det(I + A) straightforwardly. */
  template <int dim>
  double
  volume_strain(const double (&A)[dim][dim])
  {
    return std::log(relative_determinant<dim>(A));
  }

  /**
   * Work stored and dissipated in the step to u, from increments: the
   * material's own answer to the strain increments of each point, their
   * volume part replaced by the mean over the points of its cell.
   */
  template <int dim>
  double
  work_of_materials(const Cloud<dim>            &cloud,
                    const std::vector<Material> &materials,
                    const std::vector<double>   &u)
  {
    GroupDilatation groups;
    evaluate_group_dilatation(cloud.patch, u, 1., groups);
    double work = 0.;
    for_each_gradient(cloud, materials, u, [&](const auto slot, const auto &material, auto &A) {
      double E[n_symmetric<dim>];
      relative_strain<dim>(A, E);
      std::visit(
        [&](const auto &m) {
          const auto  &state     = cloud.step.stress_state[slot];
          const auto   relative  = evaluate_relative_stress<dim>(m, state, E);
          const auto  &increment = relative.increment;
          const auto   group     = cloud.step.group[slot];
          const double trace     = increment[0] + increment[1] + increment[2];
          double       assumed[3];
          for (int i = 0; i < 3; ++i)
            assumed[i] =
              increment[i] +
              (group == StepPoints<dim>::no_group ? 0. : (groups.increment[group] - trace) / 3.);
          work += cloud.step.volume[slot] *
                  m.respond(state.strain,
                            assumed,
                            cloud.step.template history_of<std::decay_t<decltype(m)>>(slot))
                    .work_increment;
        },
        material);
    });
    return work;
  }

  template <int dim>
  std::vector<PointUpdate<dim>>
  update_points(const Cloud<dim>            &cloud,
                const std::vector<Material> &materials,
                const std::vector<double>   &u)
  {
    std::vector<PointUpdate<dim>> updates;
    EXPECT_EQ(evaluate_point_updates(materials, cloud.patch, u, updates), PointStatus::none);
    return updates;
  }
} // namespace

TYPED_TEST_SUITE(SolidGroupDilatation, Dimensions);

TYPED_TEST(SolidGroupDilatation, GroupsArePointsOfABodyInACell)
{
  constexpr int    dim   = TypeParam::value;
  const auto      &bases = all_bases[2];
  Cloud<dim>       cloud(bases, 2, 7);
  StepPoints<dim> &step = cloud.step;
  EXPECT_TRUE(step.group.empty()); // nobody asked for groups
  step.reinit(cloud.grid, cloud.points, bases, {}, shared_volume);
  const auto &lattice = cloud.grid.lattice();

  ASSERT_EQ(step.group.size(), step.size());
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> groups; // by body, cell
  for (const auto &batch : step.batches)
    for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
      {
        EXPECT_EQ(step.is_grouped(batch), shared_volume[batch.body]);
        if (!shared_volume[batch.body])
          {
            EXPECT_EQ(step.group[slot], StepPoints<dim>::no_group);
            continue;
          }
        const unsigned int cell = cloud.window().cell_number(lattice.cell_of(step.location[slot]));
        ASSERT_LT(step.group[slot], step.group_cell.size());
        EXPECT_EQ(step.group_cell[step.group[slot]], cell);
        const auto place = groups.emplace(std::make_pair(batch.body, cell), step.group[slot]).first;
        EXPECT_EQ(place->second, step.group[slot]);
      }
  EXPECT_EQ(groups.size(), step.group_cell.size());
}

TYPED_TEST(SolidGroupDilatation, ConservingForceWorksWhatIsStoredAndDissipatedAndTurnsNothing)
{
  constexpr int dim = TypeParam::value;
  for_all<dim>([](const Cloud<dim> &cloud, const std::vector<Material> &materials) {
    const InternalForce<dim> internal(materials, StressRule::conserving, 0.5);
    for (const double size : {3e-2, 1e-5, 1e-10})
      {
        const std::vector<double> u     = cloud.random_nodal(size, 2);
        const std::vector<double> force = force_at(cloud, internal, u);
        // round-off of some hundred terms of size 1e-16 |f| |u|, more where stresses cancel
        const double tolerance = 3e-14 * norm(force) * size;
        EXPECT_NEAR(dot(force, u), work_of_materials(cloud, materials, u), tolerance);
        check_balance(cloud, u, force);
      }
  });
}

TYPED_TEST(SolidGroupDilatation, BooksOfPointsGrowByTheWorkOfTheForce)
{
  constexpr int dim = TypeParam::value;
  for_all<dim>([](const Cloud<dim> &cloud, const std::vector<Material> &materials) {
    const InternalForce<dim>  internal(materials, StressRule::conserving, 0.5);
    const std::vector<double> u       = cloud.random_nodal(0.03, 3);
    const auto                updates = update_points(cloud, materials, u);
    double                    growth = 0., scale = 0., dissipation = 0.;
    for_each_gradient(cloud, materials, u, [&](const auto slot, const auto &material, auto &) {
      std::visit(
        [&](const auto &m) {
          using Law          = std::decay_t<decltype(m)>;
          const auto history = cloud.step.template history_of<Law>(slot);
          double     energy  = m.energy(cloud.step.stress_state[slot].strain, history);
          if constexpr (Law::yields)
            energy += m.hardening_energy(history);
          const auto &end = updates[slot];
          growth += cloud.step.volume[slot] *
                    (end.strain_energy + end.hardening_energy + end.dissipation - energy);
          scale += cloud.step.volume[slot] * energy;
          dissipation += cloud.step.volume[slot] * end.dissipation;
        },
        material);
    });
    // round-off of the sum of all energies
    EXPECT_NEAR(dot(force_at(cloud, internal, u), u), growth, 1e-14 * scale);
    EXPECT_GT(std::abs(growth), 1e-4 * scale); // splines are smooth: 3e-4 in space
    EXPECT_EQ(dissipation > 1e-4 * scale, has_history(materials[0]));
  });
}

TYPED_TEST(SolidGroupDilatation, StiffnessIsTheForcesSlope)
{
  constexpr int dim = TypeParam::value;
  for_all<dim>([](const Cloud<dim> &cloud, const std::vector<Material> &materials) {
    for (const auto &[rule, alpha] :
         std::vector<std::pair<StressRule, double>>{{StressRule::at_configuration, 1.},
                                                    {StressRule::at_configuration, 0.55},
                                                    {StressRule::conserving, 0.5}})
      check_stiffness(cloud, InternalForce<dim>(materials, rule, alpha), 3);
  });
}

TYPED_TEST(SolidGroupDilatation, LinearFieldsGiveThePointwiseForce)
{
  constexpr int dim = TypeParam::value;
  for_all<dim>([](Cloud<dim> &cloud, const std::vector<Material> &materials) {
    // the same volume strain everywhere before, the same change of it in the step
    RandomStates<dim> random(5);
    const auto        before =
      make_stress_state(random.point(Spectrum::identity, Cloud<dim>::material(0)));
    std::fill(cloud.step.stress_state.begin(), cloud.step.stress_state.end(), before);
    double gradient[dim][dim];
    random.step(0.1, gradient);
    std::vector<double> u(cloud.nodes.n_local() * dim, 0.);
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        for (int e = 0; e < dim; ++e)
          u[i * dim + d] += gradient[d][e] * cloud.node_position(i)[e];
    for (const auto rule : {StressRule::at_configuration, StressRule::conserving})
      {
        const InternalForce<dim> internal(materials, rule, 1.);
        const auto               shared = force_at(cloud, internal, u);
        auto                     groups = cloud.step.group;
        std::swap(groups, cloud.step.group);
        const auto pointwise = force_at(cloud, internal, u);
        std::swap(groups, cloud.step.group);
        const double scale = norm(pointwise);
        EXPECT_GT(scale, 1e-3);
        for (unsigned int i = 0; i < u.size(); ++i)
          EXPECT_NEAR(shared[i], pointwise[i], 1e-14 * scale); // round-off of a sum
      }
  });
}

TYPED_TEST(SolidGroupDilatation, PointsKeepTheVolumeStrainThatTheirStressBelongsTo)
{
  constexpr int dim = TypeParam::value;
  for_all<dim>([](const Cloud<dim> &cloud, const std::vector<Material> &materials) {
    const std::vector<double> u       = cloud.random_nodal(0.03, 4);
    const auto                updates = update_points(cloud, materials, u);
    // in each group: volume, and the change of volume by the gradients and as stored
    std::vector<std::array<double, 3>> sums(cloud.step.group_cell.size(), {{0., 0., 0.}});
    for_each_gradient(cloud, materials, u, [&](const auto slot, const auto &material, auto &A) {
      PointState<dim> state;
      std::fill_n(reinterpret_cast<double *>(&state), n_state_values<dim>, 0.);
      const auto &before                 = cloud.step.stress_state[slot].strain;
      state.out_of_plane_elastic_stretch = std::exp(before[2]);
      state.deformation_gradient         = dealii::unit_symmetric_tensor<dim>();
      apply_point_update(updates[slot], memory_indices(material), state);

      const auto   stored = make_stress_state(state);
      const double theta  = stored.strain[0] + stored.strain[1] + stored.strain[2];
      EXPECT_NEAR(determinant(state.deformation_gradient), std::exp(volume_strain<dim>(A)), 1e-14);
      std::visit(
        [&](const auto &m) {
          const double pressure =
            trace(state.kirchhoff_stress) + state.out_of_plane_kirchhoff_stress;
          if constexpr (std::decay_t<decltype(m)>::decoupled_volume)
            EXPECT_NEAR(pressure, 3. * m.bulk_modulus * theta, 1e-13);
          else
            FAIL() << "no law for groups";
          EXPECT_NEAR(m.energy(stored.strain, HistoryOf<std::decay_t<decltype(m)>>{}),
                      updates[slot].strain_energy,
                      1e-13);
        },
        material);
      if (cloud.step.group[slot] == StepPoints<dim>::no_group)
        EXPECT_NEAR(theta - before[0] - before[1] - before[2], volume_strain<dim>(A), 1e-13);
      else
        {
          auto        &sum    = sums[cloud.step.group[slot]];
          const double volume = cloud.step.volume[slot];
          sum[0] += volume;
          sum[1] += volume * volume_strain<dim>(A);
          sum[2] = theta - before[0] - before[1] - before[2];
        }
    });
    // values of O(1) after a few operations
    for (const auto &[volume, mean, stored] : sums)
      EXPECT_NEAR(stored, mean / volume, 1e-13);
  });
}
