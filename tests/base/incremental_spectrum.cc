#include <kedge/base/incremental_spectrum.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

using namespace kedge;

namespace
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;

  template <typename Dimension>
  class BaseSpectrum : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** Eigenvalues of diag(base) + P in ascending order, to 113 bits: textbook Jacobi. */
  template <int dim>
  std::vector<Quad>
  reference_eigenvalues(const double (&base)[dim], const double (&P)[dim][dim])
  {
    Quad a[dim][dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        a[i][j] = Quad(P[i][j]) + (i == j ? Quad(base[i]) : Quad(0));
    for (int sweep = 0; sweep < 20; ++sweep)
      for (int p = 0; p < dim - 1; ++p)
        for (int q = p + 1; q < dim; ++q)
          {
            if (a[p][q] == 0)
              continue;
            const Quad theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const Quad t     = (theta < 0 ? -1 : 1) / (abs(theta) + sqrt(theta * theta + 1));
            const Quad c = 1 / sqrt(t * t + 1), s = t * c;
            for (int k = 0; k < dim; ++k) // a <- a R
              {
                const Quad kp = a[k][p], kq = a[k][q];
                a[k][p] = c * kp - s * kq;
                a[k][q] = s * kp + c * kq;
              }
            for (int k = 0; k < dim; ++k) // a <- R^T a
              {
                const Quad pk = a[p][k], qk = a[q][k];
                a[p][k] = c * pk - s * qk;
                a[q][k] = s * pk + c * qk;
              }
          }
    std::vector<Quad> values;
    for (int i = 0; i < dim; ++i)
      values.push_back(a[i][i]);
    std::sort(values.begin(), values.end());
    return values;
  }

  template <int dim>
  void
  check(const double (&base)[dim], const double (&P)[dim][dim], const double size)
  {
    double work[dim][dim], increment[dim], W[dim][dim];
    std::copy(&P[0][0], &P[0][0] + dim * dim, &work[0][0]);
    incremental_spectrum<dim>(base, work, increment, W);

    std::vector<Quad> values;
    for (int i = 0; i < dim; ++i)
      values.push_back(Quad(base[i]) + Quad(increment[i]));
    std::sort(values.begin(), values.end());
    const auto expected = reference_eigenvalues<dim>(base, P);
    for (int i = 0; i < dim; ++i) // a few roundings of |P|, whatever the base
      EXPECT_LT(static_cast<double>(abs(values[i] - expected[i])), 2e-15 * size);

    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          double product = 0., residual = -(base[i] + increment[i]) * W[j][i];
          for (int k = 0; k < dim; ++k)
            {
              product += W[k][i] * W[k][j];
              residual += (P[j][k] + (j == k ? base[k] : 0.)) * W[k][i];
            }
          EXPECT_NEAR(product, i == j ? 1. : 0., 3e-15);
          EXPECT_NEAR(residual, 0., 1e-14); // column i belongs to value i; bases of order 1
        }
  }
} // namespace

TYPED_TEST_SUITE(BaseSpectrum, Dimensions);

TYPED_TEST(BaseSpectrum, IncrementsAreExactToThePerturbation)
{
  constexpr int                          dim = TypeParam::value;
  std::mt19937                           generator(dim);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // how far the bases are apart: distinct, nearly equal at all scales, equal
  for (const double spread : {0.5, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.})
    for (double size = 1e-1; size > 5e-15; size *= 0.1)
      for (int repeat = 0; repeat < 10; ++repeat)
        {
          SCOPED_TRACE("bases " + std::to_string(std::log10(spread)) + ", P " +
                       std::to_string(std::log10(size)));
          double base[dim], P[dim][dim];
          for (int i = 0; i < dim; ++i)
            {
              base[i] = 1. + spread * uniform(generator);
              for (int j = i; j < dim; ++j)
                P[i][j] = P[j][i] = size * uniform(generator);
            }
          if (dim == 3 && repeat % 2 == 1)
            base[2] = base[0]; // two equal, one apart
          check<dim>(base, P, size);
        }
}

TYPED_TEST(BaseSpectrum, NothingDiagonalAndRankOne)
{
  constexpr int dim = TypeParam::value;
  double        base[dim], nothing[dim][dim] = {}, diagonal[dim][dim] = {}, one[dim][dim];
  for (int i = 0; i < dim; ++i)
    {
      base[i]        = 1.3;
      diagonal[i][i] = 1e-9 * (i + 1);
      for (int j = 0; j < dim; ++j)
        one[i][j] = 1e-9; // one eigenvalue dim*1e-9, the rest zero
    }
  double increment[dim], W[dim][dim];
  incremental_spectrum<dim>(base, nothing, increment, W);
  for (int i = 0; i < dim; ++i)
    EXPECT_EQ(increment[i], 0.);
  incremental_spectrum<dim>(base, diagonal, increment, W);
  for (int i = 0; i < dim; ++i)
    EXPECT_EQ(increment[i], 1e-9 * (i + 1));
  check<dim>(base, one, 1e-9);
}
