// Parts of faces where a condition holds: areas and centres of intervals and rectangles in closed
// form.
#include <kedge/surfaces/covered_part.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace kedge;

namespace
{
  Expression
  where(const std::string &text)
  {
    return Expression(text, {"x", "y", "z", "nx", "ny", "nz"}, {});
  }
} // namespace

TEST(SurfacesCoveredPart, IntervalsIn2d)
{
  const dealii::Point<2> centre(1., 3.);
  dealii::Tensor<1, 2>   half;
  half[0]         = 0.5;
  half[1]         = 0.2; // across the face
  const auto part = [&](const std::string &text) {
    return covered_part<2>(where(text), centre, 3, half);
  };
  EXPECT_EQ(part("1").fraction, 1.);
  EXPECT_NEAR(part("1").offset.norm(), 0., 1e-15);
  EXPECT_EQ(part("0").fraction, 0.);
  EXPECT_EQ(part("y > 3.1").fraction, 0.);             // the face lies at y = 3
  EXPECT_EQ(part("ny > 0.5 && nx == 0").fraction, 1.); // and looks up
  // 0.5 < x < 0.83: bisection to round-off
  EXPECT_NEAR(part("x < 0.83").fraction, 0.33, 1e-14);
  EXPECT_NEAR(part("x < 0.83").offset[0], (0.5 + 0.83) / 2. - 1., 1e-14);
  EXPECT_EQ(part("x < 0.83").offset[1], 0.);
  // an edge before the first sample, and two parts
  EXPECT_NEAR(part("x > 0.51").fraction, 0.99, 1e-14);
  EXPECT_NEAR(part("x < 0.7 || x > 1.4").fraction, 0.3, 1e-14);
  EXPECT_NEAR(part("x < 0.7 || x > 1.4").offset[0], (0.2 * 0.6 + 0.1 * 1.45) / 0.3 - 1., 1e-13);
}

TEST(SurfacesCoveredPart, RectanglesIn3d)
{
  const dealii::Point<3> centre(1., 3., -2.);
  dealii::Tensor<1, 3>   half;
  half[0]         = 0.5;
  half[1]         = 0.2; // across the face
  half[2]         = 0.25;
  const auto part = [&](const std::string &text) {
    return covered_part<3>(where(text), centre, 3, half);
  };
  EXPECT_NEAR(part("1").fraction, 1., 1e-14);
  // edges along the axes: to round-off
  const auto corner = part("x < 0.83 && z > -1.87");
  EXPECT_NEAR(corner.fraction, 0.33 * 0.12 / 0.5, 1e-13);
  EXPECT_NEAR(corner.offset[0], (0.5 + 0.83) / 2. - 1., 1e-13);
  EXPECT_NEAR(corner.offset[2], (-1.87 - 1.75) / 2. + 2., 1e-13);
  // a quarter circle about a corner: area pi r^2/4, centre 4 r/(3 pi) from its sides
  const double r      = 0.4;
  const auto   circle = part("(x - 0.5)^2 + (z + 2.25)^2 < 0.16");
  EXPECT_NEAR(circle.fraction, M_PI * r * r / 4. / 0.5, 1e-3);
  EXPECT_NEAR(circle.offset[0], 0.5 + 4. * r / (3. * M_PI) - 1., 1e-3);
  EXPECT_NEAR(circle.offset[2], -2.25 + 4. * r / (3. * M_PI) + 2., 1e-3);
}
