// Bodies that start under stress.
#include "../materials/soils.h"

#include <kedge/base/exceptions.h>
#include <kedge/solid/initial_stress.h>
#include <kedge/stress/point_update.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidInitialStress : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(SolidInitialStress, Dimensions);

  template <int dim>
  GeneratedPoint<dim>
  point_at_rest(const double x)
  {
    GeneratedPoint<dim> point;
    point.record.location    = dealii::Point<dim>();
    point.record.location[0] = x;
    PointState<dim> &state   = point.record.state;
    std::fill_n(reinterpret_cast<double *>(&state), n_state_values<dim>, 0.);
    for (int d = 0; d < dim; ++d)
      state.deformation_gradient[d][d] = state.elastic_frame[d][d] = 1.;
    state.out_of_plane_elastic_stretch = 1.;
    return point;
  }

  /** The stress, Pa, is that of the given expressions at x = 2. */
  template <int dim>
  std::vector<GeneratedPoint<dim>>
  start(const Material &material, const std::vector<std::string> &stress, std::string &notes)
  {
    std::vector<BodyParameters<dim>> bodies(1);
    bodies[0].name                          = "soil";
    bodies[0].initial_stress                = stress;
    std::vector<GeneratedPoint<dim>> points = {point_at_rest<dim>(2.)};
    for (const std::string &note : set_initial_stress(bodies, {material}, {}, points))
      notes += note;
    return points;
  }
} // namespace

TYPED_TEST(SolidInitialStress, StaysWhereNothingMoves)
{
  // a step without displacement answers the stress given, whatever its axes: round-off
  constexpr int                  dim   = TypeParam::value;
  const std::vector<std::string> given = {"-4e4*x", "-9e4", "-7e4", "1e4*x", "5e3", "-8e3"};
  const std::vector<std::string> in_plane(given.begin(), given.begin() + 4);
  const double                   expected[6] = {-8e4, -9e4, -7e4, 2e4, 5e3, -8e3};
  for (const Material &material : std::vector<Material>{Hencky(soil()),
                                                        ImprovedHencky(soil()),
                                                        CriticalState<ImprovedHencky>(soil())})
    {
      std::string notes;
      const auto  points = start<dim>(material, dim == 2 ? in_plane : given, notes);
      EXPECT_EQ(notes, "");
      const auto      &state             = points[0].record.state;
      const auto       stress            = make_stress_state<dim>(state.elastic_frame,
                                                 state.out_of_plane_elastic_stretch,
                                                 state.kirchhoff_stress);
      const double     at_rest[dim][dim] = {};
      PointUpdate<dim> update;
      ASSERT_TRUE(std::visit(
        [&](const auto &law) {
          return bool(update_point<dim>(law, stress, {}, at_rest, update));
        },
        material));
      for (int s = 0; s < n_symmetric<dim>; ++s)
        {
          const int    i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
          const double value = i == j ? expected[i] : expected[i + j + 2];
          EXPECT_NEAR(update.kirchhoff_stress[s], value, 1e-6);
          EXPECT_NEAR(state.kirchhoff_stress[i][j], value, 1e-9);
        }
      EXPECT_NEAR(update.out_of_plane_stress, dim == 2 ? expected[2] : 0., 1e-6);
      EXPECT_NEAR(update.strain_energy / state.strain_energy, 1., 1e-12);
    }
}

TYPED_TEST(SolidInitialStress, IsReturnedToTheYieldSurface)
{
  // Tresca, s_u = 1e5, and principal stresses of -4e5 and 0 in turned axes: 45 degrees in x, y.
  // The middle one is their mean: the mean stays, the difference becomes 2e5.
  constexpr int      dim = TypeParam::value;
  MaterialParameters parameters;
  parameters.young_modulus        = 2.5e8;
  parameters.poisson_ratio        = 0.25;
  parameters.undrained_strength   = 1e5;
  std::vector<std::string> stress = {"-x*1e5", "-2e5", "-2e5", "2e5", "0", "0"};
  stress.resize(dim == 2 ? 4 : 6);
  std::vector<BodyParameters<dim>> bodies(1);
  bodies[0].name                          = "soil";
  bodies[0].initial_stress                = stress;
  std::vector<GeneratedPoint<dim>> points = {point_at_rest<dim>(2.), point_at_rest<dim>(2.)};
  const unsigned int               s_u    = memory_index("undrained_strength");
  points[0].record.state.memory[s_u]      = 1e5;
  points[1].record.state.memory[s_u]      = 1e6;
  const auto notes = set_initial_stress(bodies, {Tresca(parameters)}, {}, points);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("1 of 2 material points (50 %)"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("up to 25 %"), std::string::npos) << notes[0];
  const auto &tau = points[0].record.state.kirchhoff_stress;
  EXPECT_NEAR(tau[0][1], 1e5, 1e-9 * 1e5);
  EXPECT_NEAR(tau[0][0], -2e5, 1e-9 * 1e5);
  EXPECT_NEAR(tau[1][1], -2e5, 1e-9 * 1e5);
  EXPECT_NEAR(points[1].record.state.kirchhoff_stress[0][1], 2e5, 1e-9 * 1e5);
}

TYPED_TEST(SolidInitialStress, IsRefusedWhereThereIsNoReturn)
{
  // the improved law cannot bear a tension of K_0/(2 c)
  constexpr int            dim    = TypeParam::value;
  std::vector<std::string> stress = {"x*1e7", "2e7", "2e7", "0", "0", "0"};
  stress.resize(dim == 2 ? 4 : 6);
  try
    {
      std::string notes;
      start<dim>(CriticalState<ImprovedHencky>(soil()), stress, notes);
      FAIL();
    }
  catch (const UserError &error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("Bodies/soil/Initial stress at (2 0"), std::string::npos) << message;
      EXPECT_NE(message.find("beyond what the improved Hencky law"), std::string::npos) << message;
    }
}
