#include <kedge/rigid/rotation.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

namespace kedge
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;

    Vector3
    vector(const double x, const double y, const double z)
    {
      Vector3 result;
      result[0] = x;
      result[1] = y;
      result[2] = z;
      return result;
    }

    TEST(Rotation, CayleyTurnsByTwiceTheArcTangentOfHalfTheVector)
    {
      const double   angle = 0.7;
      const Matrix33 turn  = cayley(cayley_vector(vector(0, 0, 1), angle));
      EXPECT_NEAR((turn * vector(1, 0, 0) - vector(std::cos(angle), std::sin(angle), 0)).norm(),
                  0.,
                  1e-15);
    }

    TEST(Rotation, CayleyIsARotationAboutItsVector)
    {
      const Vector3  theta = vector(0.3, -2., 1.1);
      const Matrix33 turn  = cayley(theta);
      EXPECT_NEAR((turn * theta - theta).norm(), 0., 1e-14);
      EXPECT_NEAR((transpose(turn) * turn - dealii::unit_symmetric_tensor<3>()).norm(), 0., 1e-14);
    }

    TEST(Rotation, StepOfAPlaceIsTheCrossProductWithItsMean)
    {
      const Vector3  theta = vector(0.3, -2., 1.1), r = vector(1., 2., 3.);
      const Matrix33 turn = cayley(theta);
      EXPECT_NEAR((turn * r - r - 0.5 * cross_product_3d(theta, r + turn * r)).norm(), 0., 1e-14);
    }

    TEST(Rotation, AttitudesFollowTheirMatrices)
    {
      Attitude attitude = {{1., 0., 0., 0.}};
      Matrix33 matrix   = matrix_of(attitude);
      for (unsigned int k = 0; k < 5; ++k)
        {
          const Vector3 theta = vector(0.1 * k, 0.5, -0.3 * k);
          attitude            = turned_by(attitude, theta);
          matrix              = cayley(theta) * matrix;
        }
      EXPECT_NEAR((matrix_of(attitude) - matrix).norm(), 0., 1e-14);
    }

    TEST(Rotation, VectorCountsWholeTurns)
    {
      Attitude attitude = {{1., 0., 0., 0.}};
      Vector3  rotation;
      for (unsigned int k = 0; k < 100; ++k)
        {
          attitude = turned_by(attitude, cayley_vector(vector(0, 0, -1), 0.1 * pi));
          rotation = rotation_vector(attitude, rotation);
        }
      EXPECT_NEAR(rotation[2], -10. * pi, 1e-12);
    }

    TEST(Rotation, InverseOfTheCayleyMapsFirstFactor)
    {
      const Vector3  theta = vector(0.3, -2., 1.1);
      const Matrix33 factor =
        Matrix33(dealii::unit_symmetric_tensor<3>()) - 0.5 * cross_matrix(theta);
      EXPECT_NEAR((cayley_inverse(theta) * factor - dealii::unit_symmetric_tensor<3>()).norm(),
                  0.,
                  1e-14);
    }
  } // namespace
} // namespace kedge
