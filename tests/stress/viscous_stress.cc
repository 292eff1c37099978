// The dashpot beside a material: its work over a step, its tangent, and that turns do not feel it.
#include <kedge/stress/viscous_stress.h>

#include <gtest/gtest.h>

#include <random>

using namespace kedge;

namespace
{
  template <typename Dimension>
  class StressViscous : public testing::Test
  {
  public:
    static constexpr int    dim = Dimension::value;
    static constexpr double c   = 3.7; // [Pa]
    std::mt19937            generator{5};

    void
    random_gradient(const double size, double (&A)[dim][dim])
    {
      std::uniform_real_distribution<double> number(-size, size);
      for (auto &row : A)
        for (double &a : row)
          a = number(generator);
    }

    static ForceStress<dim>
    evaluate(const double (&A)[dim][dim])
    {
      ForceStress<dim> result{};
      add_viscous_stress<dim, double>(A, c, true, result);
      return result;
    }
  };
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
} // namespace

TYPED_TEST_SUITE(StressViscous, Dimensions);

TYPED_TEST(StressViscous, DissipatesByTheSquareOfTheStrainOfTheStep)
{
  constexpr int dim = TestFixture::dim;
  for (const double size : {1e-6, 0.1, 1.5})
    for (int repeat = 0; repeat < 100; ++repeat)
      {
        double A[dim][dim], work = 0., expected = 0.;
        this->random_gradient(size, A);
        const auto result = this->evaluate(A);
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              work += result.stress[i][j] * A[i][j];
              // 2 E = C - I from its definition, C = (I + A)^T (I + A)
              double twice = 0.;
              for (int k = 0; k < dim; ++k)
                twice += ((k == i) + A[k][i]) * ((k == j) + A[k][j]);
              twice -= (i == j);
              expected += TestFixture::c * 0.25 * twice * twice;
            }
        // C - I loses some 1e-16, times c and strains of the order of the size
        EXPECT_NEAR(work, expected, 1e-12 * expected + 1e-14 * size);
        EXPECT_GE(work, 0.);
      }
}

TYPED_TEST(StressViscous, TangentIsTheDerivative)
{
  constexpr int dim = TestFixture::dim;
  double        A[dim][dim];
  this->random_gradient(0.7, A);
  const auto   at = this->evaluate(A);
  const double h  = 1e-3;
  for (int m = 0; m < dim; ++m)
    for (int S = 0; S < dim; ++S)
      {
        double low[dim][dim], high[dim][dim], lower[dim][dim], higher[dim][dim];
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            low[i][j] = high[i][j] = lower[i][j] = higher[i][j] = A[i][j];
        low[m][S] -= h;
        high[m][S] += h;
        lower[m][S] -= 2. * h;
        higher[m][S] += 2. * h;
        const auto a = this->evaluate(lower), b = this->evaluate(low), c = this->evaluate(high),
                   d = this->evaluate(higher);
        for (int p = 0; p < dim; ++p)
          for (int R = 0; R < dim; ++R)
            // the stress is cubic in A: five points are exact, up to round-off of 1e-15/h
            EXPECT_NEAR((8. * (c.stress[p][R] - b.stress[p][R]) -
                         (d.stress[p][R] - a.stress[p][R])) /
                          (12. * h),
                        at.tangent[p][R][m][S],
                        2e-11);
      }
}

TYPED_TEST(StressViscous, TurnsDoNotFeelIt)
{
  constexpr int dim         = TestFixture::dim;
  const double  turn        = 0.8;
  double        A[dim][dim] = {};
  A[0][0] = A[1][1] = std::cos(turn) - 1.;
  A[1][0]           = std::sin(turn);
  A[0][1]           = -A[1][0];
  const auto result = this->evaluate(A);
  for (const auto &row : result.stress)
    for (const double stress : row)
      EXPECT_NEAR(stress, 0., 1e-15); // roundings of cos and sin
}
