// The stress that makes the internal force, against 113-bit evaluations of
// the same law on another way (quad_reference.h).
#include "quad_reference.h"
#include "random_states.h"

#include <kedge/stress/force_stress.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::reference;
using namespace kedge::test;

namespace
{
  Hencky
  material()
  {
    MaterialParameters parameters;
    parameters.young_modulus = 2.6; // so that G = 1: stresses are of the size of strains
    parameters.poisson_ratio = 0.3;
    return Hencky(parameters);
  }

  template <typename Dimension>
  class StressForce : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  template <int dim, StressRule rule, bool with_tangent = false>
  ForceStress<dim>
  evaluate(const StressState<dim> &state, const double (&A)[dim][dim], const double alpha)
  {
    return evaluate_force_stress<dim, with_tangent, rule>(material(), state, A, alpha);
  }

  /** Sum of P_ij A_ij. */
  template <int dim>
  double
  contract(const double (&P)[dim][dim], const double (&A)[dim][dim])
  {
    double sum = 0.;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        sum += P[i][j] * A[i][j];
    return sum;
  }

  /** Calls check(point, size) for states of all spectra and steps of many sizes. */
  template <int dim, typename Check>
  void
  for_many_states(const std::vector<double> &sizes, const int n_repeats, const Check &check)
  {
    RandomStates<dim> random(17 + dim);
    for (const Spectrum spectrum : all_spectra)
      for (const double size : sizes)
        for (int repeat = 0; repeat < n_repeats; ++repeat)
          {
            SCOPED_TRACE(name(spectrum) + " eigenvalues, step of " + std::to_string(size) +
                         " = 1e" + std::to_string(std::log10(size)));
            const PointState<dim> point = random.point(spectrum, material());
            double                A[dim][dim];
            random.step(size, A);
            check(point, A, size);
          }
  }

  template <int dim, StressRule rule>
  void
  check_stress(const double alpha)
  {
    for_many_states<dim>(
      {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
      3,
      [&](const PointState<dim> &point, const double(&A)[dim][dim], const double size) {
        const auto result = evaluate<dim, rule>(make_stress_state(point), A, alpha);
        ASSERT_TRUE(result.valid);
        const Force expected =
          force(rule, material(), reference_state<dim>(point), to_matrix<dim>(A), alpha);
        // strains of order 1 (G = 1) carry round-off of a few 1e-16
        EXPECT_LT(largest_difference<dim>(result.stress, expected.stress), 1e-14);
        // ... and their work over the step in proportion to the step
        EXPECT_NEAR(result.work_increment, static_cast<double>(expected.work), 1e-14 * size);
      });
  }

  /** dP/dA of the reference by central differences; 113 bits leave 1e-16 of them. */
  template <int dim, StressRule rule>
  void
  check_tangent(const double alpha)
  {
    for_many_states<dim>(
      {1e-1, 1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9},
      1,
      [&](const PointState<dim> &point, const double(&A)[dim][dim], const double size) {
        const auto result = evaluate<dim, rule, true>(make_stress_state(point), A, alpha);
        ASSERT_TRUE(result.valid);
        // the CLC stress bends on the scale of the step itself
        const double largest = tangent_error(result,
                                             rule,
                                             material(),
                                             reference_state<dim>(point),
                                             A,
                                             alpha,
                                             1e-5 * size);
        // Entries are of order 1. The differences err by (h/size)^2 = 1e-10; the
        // slope of q loses digits to 1e-16/size, and is left out below 1e-8 where
        // it is of the order of the step.
        EXPECT_LT(largest,
                  1e-9 + (rule == StressRule::conserving
                            ? 4e-15 / size + (size < 2e-8 ? 10. * size : 0.)
                            : 0.));
      });
  }
} // namespace

TYPED_TEST_SUITE(StressForce, Dimensions);

TYPED_TEST(StressForce, IsTheLogarithmsAtTheEnd)
{
  check_stress<TypeParam::value, StressRule::at_configuration>(1.);
}

TYPED_TEST(StressForce, IsTheLogarithmsInTheMiddle)
{
  check_stress<TypeParam::value, StressRule::at_configuration>(0.5);
}

TYPED_TEST(StressForce, IsTheConservingStressAtAllSteps)
{
  check_stress<TypeParam::value, StressRule::conserving>(0.5);
}

TYPED_TEST(StressForce, TangentAtTheEnd)
{
  check_tangent<TypeParam::value, StressRule::at_configuration>(1.);
}

TYPED_TEST(StressForce, TangentInTheMiddle)
{
  check_tangent<TypeParam::value, StressRule::at_configuration>(0.5);
}

TYPED_TEST(StressForce, TangentOfTheConservingStress)
{
  check_tangent<TypeParam::value, StressRule::conserving>(0.5);
}

TYPED_TEST(StressForce, ConservingStressWorksWhatIsStored)
{
  constexpr int dim = TypeParam::value;
  for_many_states<dim>(
    {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12},
    20,
    [&](const PointState<dim> &point, const double(&A)[dim][dim], const double size) {
      const auto result = evaluate<dim, StressRule::conserving>(make_stress_state(point), A, 0.5);
      // P : A = S : dC/2 must be dPsi; G = 1 and |dC| is about 2 size
      EXPECT_NEAR(contract<dim>(result.stress, A), result.work_increment, 1e-15 * 2. * size);
    });
}

TYPED_TEST(StressForce, ConservingStressTendsToTheMeanOfBothEnds)
{
  constexpr int dim = TypeParam::value;
  for_many_states<dim>(
    {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12},
    5,
    [&](const PointState<dim> &point, const double(&A)[dim][dim], const double size) {
      const StressState<dim> state  = make_stress_state(point);
      const auto             result = evaluate<dim, StressRule::conserving>(state, A, 0.5);
      const auto             end    = evaluate<dim, StressRule::at_configuration>(state, A, 1.);
      // (I + A/2)(tau_n + S_{n+1})/2 with S_{n+1} = (I + A)^{-1} P_{n+1}
      Matrix P_end, tau_n;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            P_end[i][j] = end.stress[i][j];
            tau_n[i][j] = point.kirchhoff_stress[i][j];
          }
      const Matrix one = Matrix::identity(), step = to_matrix<dim>(A);
      const Matrix mean = combine(1, one, 0.5, step) *
                          combine(0.5, tau_n, 0.5, inverse(combine(1, one, 1, step)) * P_end);
      // the rest is O(G |dC|^2), errata of the CLC stress; below that round-off
      EXPECT_LT(largest_difference<dim>(result.stress, mean), 30. * size * size + 1e-14);
      if (size == 1e-2)
        {
          EXPECT_GT(largest_difference<dim>(result.stress, mean), 1e-8); // q is not left out
        }
    });
}

// A motion that is rigid leaves strains of round-off: the tangent must be that of rest. Expected:
// it differs by O(|A|); tolerance: far less than the stiffness, 1, and far more than |A|.
TYPED_TEST(StressForce, StrainsOfRoundOffChangeNoTangent)
{
  constexpr int dim = TypeParam::value;
  for_many_states<dim>(
    {1e-16, 1e-18, 1e-20, 1e-33},
    5,
    [&](const PointState<dim> &point, const double(&A)[dim][dim], const double) {
      const StressState<dim> state          = make_stress_state(point);
      const double           rest[dim][dim] = {};
      const auto             moved = evaluate<dim, StressRule::conserving, true>(state, A, 0.5);
      const auto             here  = evaluate<dim, StressRule::conserving, true>(state, rest, 0.5);
      for (int i = 0; i < dim; ++i)
        for (int R = 0; R < dim; ++R)
          for (int m = 0; m < dim; ++m)
            for (int S = 0; S < dim; ++S)
              EXPECT_NEAR(moved.tangent[i][R][m][S], here.tangent[i][R][m][S], 1e-6);
    });
}

TYPED_TEST(StressForce, RotationsDoNoWorkAndTurnTheStress)
{
  constexpr int     dim = TypeParam::value;
  RandomStates<dim> random(5);
  for (int repeat = 0; repeat < 20; ++repeat)
    {
      const PointState<dim>  point = random.point(Spectrum::apart, material());
      const StressState<dim> state = make_stress_state(point);
      const auto             R     = random.rotation();
      double                 A[dim][dim], turned[dim][dim], pure[dim][dim];
      random.step(0.1, A);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            pure[i][j]   = R[i][j] - (i == j);
            turned[i][j] = R[i][j] - (i == j);
            for (int k = 0; k < dim; ++k)
              turned[i][j] += R[i][k] * A[k][j];
          }
      const auto plain    = evaluate<dim, StressRule::at_configuration>(state, A, 1.);
      const auto rotated  = evaluate<dim, StressRule::at_configuration>(state, turned, 1.);
      const auto at_rest  = evaluate<dim, StressRule::at_configuration>(state, pure, 1.);
      const auto clc_rest = evaluate<dim, StressRule::conserving>(state, pure, 0.5);
      // R has round-off of 1e-16 in its columns' lengths; G = 1, strains below 1
      EXPECT_NEAR(rotated.work_increment, plain.work_increment, 1e-15);
      EXPECT_NEAR(at_rest.work_increment, 0., 1e-15);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            double R_P = 0., R_tau = 0., mid_tau = 0.;
            for (int k = 0; k < dim; ++k)
              {
                R_P += R[i][k] * plain.stress[k][j];
                R_tau += R[i][k] * point.kirchhoff_stress[k][j];
                mid_tau += 0.5 * ((i == k) + R[i][k]) * point.kirchhoff_stress[k][j];
              }
            EXPECT_NEAR(rotated.stress[i][j], R_P, 5e-15);   // P' = R P
            EXPECT_NEAR(at_rest.stress[i][j], R_tau, 5e-15); // tau' = R tau R^T
            // the CLC stress of a rotation is tau_n, seen from the middle
            EXPECT_NEAR(clc_rest.stress[i][j], mid_tau, 5e-15);
          }
    }
}

TYPED_TEST(StressForce, RefusesInvertedPoints)
{
  constexpr int          dim = TypeParam::value;
  RandomStates<dim>      random(7);
  const StressState<dim> state       = make_stress_state(random.point(Spectrum::apart, material()));
  double                 A[dim][dim] = {};
  A[0][0]                            = -1.5; // det(I + A) = -1/2, yet C is positive definite
  EXPECT_FALSE((evaluate<dim, StressRule::at_configuration>(state, A, 1.).valid));
  EXPECT_FALSE((evaluate<dim, StressRule::conserving>(state, A, 0.5).valid));
  A[0][0] = -1.; // flat: an eigenvalue of zero
  EXPECT_FALSE((evaluate<dim, StressRule::at_configuration>(state, A, 1.).valid));
  EXPECT_FALSE((evaluate<dim, StressRule::conserving>(state, A, 0.5).valid));
  // inverted at the end, but equilibrium is stated half-way, where all is well
  A[0][0] = -1.5;
  EXPECT_TRUE((evaluate<dim, StressRule::at_configuration>(state, A, 0.5).valid));
}
