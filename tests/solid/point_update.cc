// How the domains of points follow a deformation.
#include <kedge/solid/point_update.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace kedge;

namespace
{
  template <typename Dimension>
  class SolidDomains : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  template <int dim>
  dealii::Tensor<1, dim>
  edges(const dealii::Tensor<2, dim> &F)
  {
    return stretches_along_axes<dim>({F}).front();
  }

  /** Stretches 1.3, 0.8 (, 1.1) along the axes. */
  template <int dim>
  dealii::Tensor<2, dim>
  stretched()
  {
    dealii::Tensor<2, dim> F;
    const double           along[3] = {1.3, 0.8, 1.1};
    for (int d = 0; d < dim; ++d)
      F[d][d] = along[d];
    return F;
  }

  template <int dim>
  dealii::Tensor<2, dim>
  turned(const double angle)
  {
    dealii::Tensor<2, dim> R;
    R[dim - 1][dim - 1] = 1.;
    R[0][0] = R[1][1] = std::cos(angle);
    R[0][1]           = -std::sin(angle);
    R[1][0]           = std::sin(angle);
    return R;
  }
} // namespace

TYPED_TEST_SUITE(SolidDomains, Dimensions);

// rows of boxes slide along each other: their edges do not change, in any plane and direction
TYPED_TEST(SolidDomains, ShearAlongAnAxisLeavesTheEdges)
{
  constexpr int dim = TypeParam::value;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (const double shear : {1e-9, 1e-4, 0.1, -2.})
        {
          auto F = stretched<dim>();
          if (i != j)
            F[i][j] += shear;
          const auto edge = edges(F);
          for (int d = 0; d < dim; ++d)
            EXPECT_NEAR(edge[d], stretched<dim>()[d][d], 1e-14) << i << j << " " << shear;
        }
}

TYPED_TEST(SolidDomains, TurnsLeaveTheEdgesOfACube)
{
  constexpr int dim = TypeParam::value;
  for (const double angle : {0.1, 0.8, 3.})
    {
      const auto edge = edges(0.9 * turned<dim>(angle));
      for (int d = 0; d < dim; ++d)
        EXPECT_NEAR(edge[d], 0.9, 1e-14);
    }
}

TYPED_TEST(SolidDomains, VolumeIsThatOfTheDeformation)
{
  constexpr int dim = TypeParam::value;
  for (const double angle : {0., 0.3, 1.2})
    {
      auto F = stretched<dim>() * turned<dim>(angle);
      F[0][dim - 1] += 0.4;
      F[1][0] -= 0.3;
      double product = 1.;
      for (int d = 0; d < dim; ++d)
        product *= edges(F)[d];
      EXPECT_NEAR(product, determinant(F), 1e-14);
    }
}
