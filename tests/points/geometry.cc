#include <kedge/base/exceptions.h>
#include <kedge/points/geometry.h>

#include <gtest/gtest.h>

#include <limits>

using namespace kedge;
using dealii::Point;

namespace
{
  template <int dim>
  std::string
  message_of(const std::string &description)
  {
    try
      {
        parse_geometry<dim>(description, {});
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }

  template <int dim>
  void
  expect_box(const Geometry<dim> &geometry, const Point<dim> &lower, const Point<dim> &upper)
  {
    const dealii::BoundingBox<dim> domain({Point<dim>(), Point<dim>()});
    const auto [low, high] = geometry.bounding_box(domain).get_boundary_points();
    // a few operations on numbers of order 1
    EXPECT_LT(low.distance(lower), 1e-14);
    EXPECT_LT(high.distance(upper), 1e-14);
  }
} // namespace

TEST(PointsGeometry, BoxHoldsItsSurfaceWithinRounding)
{
  const auto box = parse_geometry<2>("box(0, 0; L, 0.1*3)", {{"L", 2.}});
  EXPECT_TRUE(box->contains({1., .1}));
  EXPECT_TRUE(box->contains({0., 0.}));
  EXPECT_TRUE(box->contains({2., .3}));         // 0.1*3 > 0.3 in binary
  EXPECT_TRUE(box->contains({2. + 1e-12, .1})); // tolerance: 1e-12 of the size 2
  EXPECT_FALSE(box->contains({2. + 1e-11, .1}));
  EXPECT_FALSE(box->contains({1., -1e-11}));
  expect_box<2>(*box, {0., 0.}, {2., .3});
}

TEST(PointsGeometry, BallHoldsItsSurface)
{
  const auto ball = parse_geometry<3>("ball(1, 2, 3; 5)", {});
  EXPECT_TRUE(ball->contains({1. + 3., 2. + 4., 3.})); // 3-4-5 triangle
  EXPECT_FALSE(ball->contains({1. + 3., 2. + 4., 3.1}));
  expect_box<3>(*ball, {-4., -3., -2.}, {6., 7., 8.});
}

TEST(PointsGeometry, CylinderHasFlatEndsAndATightBox)
{
  const auto cylinder = parse_geometry<3>("cylinder(0, 0, 1; 0, 0, 3; 2)", {});
  EXPECT_TRUE(cylinder->contains({2., 0., 1.}));
  EXPECT_TRUE(cylinder->contains({0., -2., 3.}));
  EXPECT_FALSE(cylinder->contains({0., 0., 3.001}));
  EXPECT_FALSE(cylinder->contains({0., 0., .999}));
  EXPECT_FALSE(cylinder->contains({2., 2., 2.}));
  expect_box<3>(*cylinder, {-2., -2., 1.}, {2., 2., 3.});

  // axis along the diagonal of x and y: the end discs reach r/sqrt(2) there
  const double reach = 1 / std::sqrt(2.);
  expect_box<3>(*parse_geometry<3>("cylinder(0, 0, 0; 4, 4, 0; 1)", {}),
                {-reach, -reach, -1.},
                {4 + reach, 4 + reach, 1.});
}

TEST(PointsGeometry, ImplicitFunctionIsInsideWhereNegative)
{
  const auto ellipse = parse_geometry<2>("implicit((x/a)^2 + y^2 - 1)", {{"a", 2.}});
  const dealii::BoundingBox<2> domain({Point<2>(-5., -6.), Point<2>(7., 8.)});
  EXPECT_TRUE(ellipse->contains({1.9, 0.}));
  EXPECT_TRUE(ellipse->contains({2., 0.})); // on the surface
  EXPECT_FALSE(ellipse->contains({2.001, 0.}));
  // it knows no bounds
  EXPECT_EQ(ellipse->bounding_box(domain).get_boundary_points(), domain.get_boundary_points());
  // a value that is not a number is not inside
  EXPECT_FALSE(parse_geometry<2>("implicit(sqrt(x) - 1)", {})->contains({-1., 0.}));
}

TEST(PointsGeometry, UnionAndDifferenceAreReadFromLeftToRight)
{
  const auto plate = parse_geometry<2>("box(0, 0; 4, 4) - ball(2, 2; 1) + ball(2, 2; 0.5)", {});
  EXPECT_TRUE(plate->contains({.5, .5}));
  EXPECT_FALSE(plate->contains({2.75, 2.})); // in the hole
  EXPECT_TRUE(plate->contains({2.25, 2.}));  // on the island
  EXPECT_TRUE(plate->contains({3., 2.}));    // the hole's edge belongs to the plate

  const auto order = parse_geometry<2>("ball(2, 2; 0.5) + box(0, 0; 4, 4) - ball(2, 2; 1)", {});
  EXPECT_FALSE(order->contains({2.25, 2.}));

  expect_box<2>(*parse_geometry<2>("box(0, 0; 1, 1) + ball(3, 0; 1)", {}), {0., -1.}, {4., 1.});
  expect_box<2>(*parse_geometry<2>("box(0, 0; 1, 1) - ball(3, 0; 1)", {}), {0., 0.}, {1., 1.});
  // signs within a shape do not split
  EXPECT_TRUE(parse_geometry<2>("box(-1, 0 - 1; 1 + 1, 1)", {})->contains({-1., -1.}));
}

TEST(PointsGeometry, ErrorsNameTheTermAndTheRemedy)
{
  const auto has = [](const std::string &message, const std::string &part) {
    return message.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(message_of<2>("box(0, 0; 1, 1) + bal(0, 0; 1)"), "'bal(0, 0; 1)'"));
  EXPECT_TRUE(has(message_of<2>("box(0, 0; 1, 1) + bal(0, 0; 1)"), "did you mean ball?"));
  EXPECT_TRUE(has(message_of<2>("box(0, 0; 1)"), "3 numbers instead of 4"));
  EXPECT_TRUE(has(message_of<2>("box(1, 0; 0, 1)"), "below the second"));
  EXPECT_TRUE(has(message_of<2>("ball(1, 0; -1)"), "greater than 0"));
  EXPECT_TRUE(has(message_of<2>("cylinder(0, 0; 1, 1; 1)"), "3D only"));
  EXPECT_TRUE(has(message_of<3>("cylinder(0, 0, 0; 0, 0, 0; 1)"), "must differ"));
  EXPECT_TRUE(has(message_of<2>("implicit(x + q)"), "\"q\""));
  EXPECT_TRUE(has(message_of<2>("implicit(z)"), "\"z\""));
  EXPECT_TRUE(has(message_of<2>("box(0, 0; 1, 1) +"), "beside"));
  EXPECT_TRUE(has(message_of<2>("box(0, 0; 1, 1"), "open"));
  EXPECT_TRUE(has(message_of<2>("box(0, 0; 1, 1))"), "too many"));
  EXPECT_TRUE(has(message_of<2>("box"), "name(numbers)"));
  EXPECT_TRUE(has(message_of<2>("  "), "empty"));
}

TEST(PointsGeometry, PiecesAreWhatDoesNotTouch)
{
  const auto n_pieces = [](const std::string &description) {
    return parse_pieces<2>(description, dealii::BoundingBox<2>({{-9., -9.}, {9., 9.}}), {}).size();
  };
  EXPECT_EQ(n_pieces("box(0, 0; 1, 1)"), 1u);
  EXPECT_EQ(n_pieces("box(0, 0; 1, 1) + box(1, 0; 2, 1)"), 1u); // a common side
  EXPECT_EQ(n_pieces("box(0, 0; 1, 1) + box(1.001, 0; 2, 1)"), 2u);
  EXPECT_EQ(n_pieces("box(0, 0; 1, 1) + box(1, 1; 2, 2)"), 1u); // a common corner
  EXPECT_EQ(n_pieces("ball(0, 0; 1) + ball(2, 0; 1)"), 1u);
  EXPECT_EQ(n_pieces("ball(0, 0; 1) + ball(1.5, 1.5; 1)"), 2u); // boxes that overlap
  // the third joins the first two
  EXPECT_EQ(n_pieces("box(0, 0; 1, 1) + box(2, 0; 3, 1) + box(0.5, 0.4; 2.5, 0.6)"), 1u);
  EXPECT_EQ(n_pieces("box(0, 0; 1, 1) + box(2, 0; 3, 1) + box(4, 0; 5, 1)"), 3u);
  EXPECT_EQ(n_pieces("implicit(x^2 + y^2 - 1) + implicit((x - 5)^2 + y^2 - 1)"), 2u);
  EXPECT_EQ(n_pieces("implicit(x^2 + y^2 - 1) + implicit((x - 1)^2 + y^2 - 1)"), 1u);
}

TEST(PointsGeometry, PiecesStandInTheirOrderAndLackWhatIsTakenFromAll)
{
  const dealii::BoundingBox<3> domain({{-9., -9., -9.}, {9., 9., 9.}});
  const auto                   pieces =
    parse_pieces<3>("box(4, 0, 0; 5, 1, 1) + ball(0, 0, 0; 1) - box(-9, 0.5, -9; 9, 9, 9)",
                    domain,
                    {});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_TRUE(pieces[0]->contains({4.5, .4, .5}));
  EXPECT_FALSE(pieces[0]->contains({4.5, .6, .5}));
  EXPECT_FALSE(pieces[0]->contains({0., 0., 0.}));
  EXPECT_TRUE(pieces[1]->contains({0., .4, 0.}));
  EXPECT_FALSE(pieces[1]->contains({0., .6, 0.}));
}
