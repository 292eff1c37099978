// The stresses and the update of a point that yields, against 113-bit
// evaluations of the same law on another way (quad_reference.h).
#include "quad_reference.h"
#include "random_states.h"

#include <kedge/stress/point_update.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::reference;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class StressPlastic : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Where the state at the start of a step is. */
  enum class Start
  {
    far_inside, ///< the step stays elastic
    on_surface, ///< it yields from its beginning, or unloads
    inside      ///< it may cross the surface on its way
  };

  struct Steps
  {
    std::vector<double> sizes;
    std::vector<Start>  starts;
    int                 n_repeats;
  };

  /** One step of a material point. */
  template <int dim>
  struct Step
  {
    PointState<dim> point;
    VonMises        material;
    double          A[dim][dim];
    double          size;
    Start           start;

    VonMises::History<double>
    history() const
    {
      return remembered(material, point);
    }
  };

  /**
   * Calls check(step) for states of all spectra, with and without hardening;
   * @return how many of them were elastic, and how many plastic.
   */
  template <int dim, typename Check>
  std::array<int, 2>
  for_many_steps(const Steps &steps, const Check &check)
  {
    MaterialParameters elasticity;
    elasticity.young_modulus = 2.6; // so that G = 1: stresses are of the size of strains
    elasticity.poisson_ratio = 0.3;

    std::array<int, 2> n_steps{};
    RandomStates<dim>  random(29 + dim);
    for (const Spectrum spectrum : all_spectra)
      for (const double size : steps.sizes)
        for (const Start start : steps.starts)
          for (const double hardening : {0., 0.4})
            for (int repeat = 0; repeat < steps.n_repeats; ++repeat)
              {
                SCOPED_TRACE(name(spectrum) + " eigenvalues, step of 1e" +
                             std::to_string(std::log10(size)) + ", start " +
                             std::to_string(static_cast<int>(start)) + ", hardening " +
                             std::to_string(hardening));
                PointState<dim> point = random.point(spectrum, Hencky(elasticity));
                // a virgin material yields a little later than at once
                const double   gap      = start == Start::far_inside ? 10.
                                          : start == Start::inside   ? size * random.uniform(0., 1.)
                                          : spectrum == Spectrum::apart ? 0.
                                                                        : 1e-3 * size;
                const VonMises material = random.material_about(point, elasticity, hardening, gap);
                Step<dim>      step{point, material, {}, size, start};
                random.step(size, step.A);
                check(step);
                PointUpdate<dim> update;
                EXPECT_TRUE(update_point<dim>(material,
                                              make_stress_state(point),
                                              step.history(),
                                              step.A,
                                              update));
                ++n_steps[update.dissipation > 0. ? 1 : 0];
              }
    return n_steps;
  }

  template <int dim, StressRule rule, bool with_tangent = false>
  ForceStress<dim>
  evaluate(const Step<dim> &step, const double alpha)
  {
    return evaluate_force_stress<dim, with_tangent, rule>(step.material,
                                                          make_stress_state(step.point),
                                                          step.A,
                                                          alpha,
                                                          step.history());
  }

  const std::vector<double> decades =
    {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};

  void
  expect_both_kinds(const std::array<int, 2> &n_steps)
  {
    EXPECT_GT(n_steps[0], 0.2 * (n_steps[0] + n_steps[1]));
    EXPECT_GT(n_steps[1], 0.2 * (n_steps[0] + n_steps[1]));
  }

  template <int dim, StressRule rule>
  void
  check_stress(const double alpha)
  {
    const auto n_steps = for_many_steps<dim>(
      {{1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
       {Start::far_inside, Start::on_surface, Start::inside},
       2},
      [&](const Step<dim> &step) {
        const auto result = evaluate<dim, rule>(step, alpha);
        ASSERT_TRUE(result.valid);
        const Force expected = force(rule,
                                     step.material,
                                     reference_state<dim>(step.point),
                                     to_matrix<dim>(step.A),
                                     alpha);
        // strains of order 1 (G = 1) carry round-off of a few 1e-16
        EXPECT_LT(largest_difference<dim>(result.stress, expected.stress), 1e-14);
        EXPECT_NEAR(result.work_increment, static_cast<double>(expected.work), 1e-14 * step.size);
      });
    expect_both_kinds(n_steps);
  }

  /**
   * Steps that cross the surface are kept above 1e-4: q is of the order of G in
   * them, and its slope, which loses digits as 1e-16/size and is left out below
   * 1e-8, with it.
   */
  template <int dim, StressRule rule>
  void
  check_tangent(const double alpha, const Steps &steps)
  {
    const auto n_steps = for_many_steps<dim>(steps, [&](const Step<dim> &step) {
      const auto result = evaluate<dim, rule, true>(step, alpha);
      ASSERT_TRUE(result.valid);
      // the stress bends on the scale of the step: the differences err by 1e-12
      const double largest = tangent_error(result,
                                           rule,
                                           step.material,
                                           reference_state<dim>(step.point),
                                           step.A,
                                           alpha,
                                           1e-6 * step.size);
      EXPECT_LT(largest, 1e-8);
    });
    expect_both_kinds(n_steps);
  }

  template <int dim, StressRule rule>
  void
  check_tangent(const double alpha)
  {
    check_tangent<dim, rule>(alpha,
                             {{1e-1, 1e-2, 1e-3, 1e-4},
                              {Start::far_inside, Start::on_surface, Start::inside},
                              2});
    check_tangent<dim, rule>(alpha,
                             {{1e-5, 1e-6, 1e-7}, {Start::far_inside, Start::on_surface}, 2});
  }
} // namespace

TYPED_TEST_SUITE(StressPlastic, Dimensions);

TYPED_TEST(StressPlastic, IsTheReturnedStress)
{
  check_stress<TypeParam::value, StressRule::at_configuration>(1.);
  check_stress<TypeParam::value, StressRule::at_configuration>(0.5);
}

TYPED_TEST(StressPlastic, IsTheConservingStress)
{
  check_stress<TypeParam::value, StressRule::conserving>(0.5);
}

TYPED_TEST(StressPlastic, TangentOfTheReturnedStress)
{
  check_tangent<TypeParam::value, StressRule::at_configuration>(1.);
  check_tangent<TypeParam::value, StressRule::at_configuration>(0.5);
}

TYPED_TEST(StressPlastic, TangentOfTheConservingStress)
{
  check_tangent<TypeParam::value, StressRule::conserving>(0.5);
}

TYPED_TEST(StressPlastic, ConservingStressWorksWhatIsStoredAndDissipated)
{
  // the discrete Clausius-Planck identity S : dC/2 = P : A = dPsi_1 + dPsi_2 + dD
  constexpr int dim = TypeParam::value;
  const auto    n_steps =
    for_many_steps<dim>({decades, {Start::far_inside, Start::on_surface, Start::inside}, 10},
                        [](const Step<dim> &step) {
                          const auto result = evaluate<dim, StressRule::conserving>(step, 0.5);
                          ASSERT_TRUE(result.valid);
                          const Matrix F =
                            combine(1, Matrix::identity(), 1, to_matrix<dim>(step.A));
                          const State  state  = reference_state<dim>(step.point);
                          const Answer begin  = committed(step.material, state),
                                       end    = after_step(step.material, state, F);
                          const Quad expected = end.work_since(begin);
                          double     work = 0., scale = 0.;
                          for (int i = 0; i < dim; ++i)
                            for (int j = 0; j < dim; ++j)
                              {
                                work += result.stress[i][j] * step.A[i][j];
                                scale += std::abs(result.stress[i][j] * step.A[i][j]);
                              }
                          EXPECT_GE(end.dissipation, 0);
                          // No term of the sum P : A errs by more than a few roundings of P; for
                          // the reference the stress of a strained state is known to its round-off
                          // only.
                          const bool strained = step.point.kirchhoff_stress.norm() > 0.;
                          EXPECT_NEAR(work, result.work_increment, 1e-13 * scale);
                          EXPECT_NEAR(work,
                                      static_cast<double>(expected),
                                      1e-13 * scale + (strained ? 2e-16 * step.size : 0.));
                        });
  expect_both_kinds(n_steps);
}

TYPED_TEST(StressPlastic, UpdateCommitsTheReferencesEnd)
{
  constexpr int dim     = TypeParam::value;
  const auto    n_steps = for_many_steps<dim>(
    {{1e-1, 1e-2, 1e-4, 1e-8, 1e-12}, {Start::far_inside, Start::on_surface, Start::inside}, 2},
    [](const Step<dim> &step) {
      PointUpdate<dim> update;
      ASSERT_TRUE(update_point<dim>(step.material,
                                    make_stress_state(step.point),
                                    step.history(),
                                    step.A,
                                    update));
      const Matrix F   = combine(1, Matrix::identity(), 1, to_matrix<dim>(step.A));
      const Answer end = after_step(step.material, reference_state<dim>(step.point), F);
      // stresses, strains and energies are of order 1 or less; the plastic strain,
      // a difference of stresses, has their round-off in the smallest step too
      const double tolerance = 2e-15;
      EXPECT_NEAR(update.strain_energy, static_cast<double>(end.elastic_energy), tolerance);
      EXPECT_NEAR(update.hardening_energy, static_cast<double>(end.hardening_energy), tolerance);
      EXPECT_NEAR(update.dissipation, static_cast<double>(end.dissipation), tolerance);
      EXPECT_NEAR(read_history<VonMises>(update.history).equivalent_plastic_strain,
                  static_cast<double>(end.equivalent_plastic_strain),
                  tolerance);
      EXPECT_NEAR(update.out_of_plane_stress,
                  dim == 2 ? static_cast<double>(end.kirchhoff_stress[2][2]) : 0.,
                  tolerance);
      // the frame that is left is that of the elastic strain
      Matrix B = Matrix::identity(), tau;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            B[i][j]   = update.elastic_frame[i][j];
            tau[i][j] = update.kirchhoff_stress[symmetric_index<dim>(i, j)];
          }
      if (dim == 2)
        {
          B[2][2] =
            step.point.out_of_plane_elastic_stretch * Quad(update.out_of_plane_stretch_factor);
          tau[2][2] = update.out_of_plane_stress;
        }
      const Matrix off_strain = combine(0.5, logarithm(B * transpose(B)), -1, end.elastic_strain);
      const Matrix off_stress = combine(1, tau, -1, end.kirchhoff_stress);
      EXPECT_LT(sqrt(contract(off_strain, off_strain)), tolerance);
      EXPECT_LT(sqrt(contract(off_stress, off_stress)), 5. * tolerance);
    });
  expect_both_kinds(n_steps);
}
