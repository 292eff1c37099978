#include "surface_shapes.h"

#include <gtest/gtest.h>

#include <random>

using namespace surface_tests;

namespace
{
  bool
  has(const std::string &message, const std::string &part)
  {
    return message.find(part) != std::string::npos;
  }

  constexpr double rounding = 1e-13; // of sums of tens of numbers of order 1
} // namespace

TEST(GeometryTriangles, MassPropertiesOfABox)
{
  const TriangleSurface surface(box({1., 2., 3.}, {2., 4., 6.}));
  EXPECT_EQ(surface.n_facets(), 12u);
  EXPECT_EQ(surface.vertices().size(), 8u);
  const auto moments = surface.moments();
  EXPECT_NEAR(moments.volume, 6., rounding);
  EXPECT_LT(moments.first.norm(), rounding); // its centre is that of the bounding box
  const double edges[3] = {1, 2, 3};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      EXPECT_NEAR(moments.second[i][j], i == j ? 6 * edges[i] * edges[i] / 12 : 0., rounding);
  EXPECT_LT((surface.normal(0) - Tensor<1, 3>({-1., 0., 0.})).norm(), rounding);
}

TEST(GeometryTriangles, MassPropertiesOfATetrahedronAnywhere)
{
  // second moments of a simplex about its centre: V/20 sum (x_i - c)(x_i - c)^T
  const Point<3> x[4] = {{.1, .2, -.1}, {1.3, .1, .2}, {.4, 1.2, .3}, {.3, .5, 1.6}};
  const auto     face = [&](const int i, const int j, const int k) {
    return Triangle{{x[i], x[j], x[k]}};
  };
  const TriangleSurface surface({face(0, 2, 1), face(0, 1, 3), face(1, 2, 3), face(2, 0, 3)});
  const double          volume = cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) / 6;
  Point<3>              centre;
  for (const auto &corner : x)
    centre += corner / 4.;
  auto moments = surface.moments();
  EXPECT_NEAR(moments.volume, volume, rounding);
  const Tensor<1, 3> place = centre - surface.bounding_box().center();
  EXPECT_LT((moments.centre() - place).norm(), rounding);
  moments = moments.about(place);
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        double second = 0;
        for (const auto &corner : x)
          second += volume / 20 * (corner[i] - centre[i]) * (corner[j] - centre[j]);
        EXPECT_NEAR(moments.second[i][j], second, rounding);
      }
}

TEST(GeometryTriangles, PartsOfATorusAddUpToItsVolume)
{
  // Pappus: 2 pi^2 R r^2, approached from within with n^-2: the inscribed polygons have the
  // areas (n/2) sin(2 pi/n) / pi of the circles, to leading order both ways
  const double R = 1, r = .4;
  const double exact = 2 * std::pow(dealii::numbers::PI, 2) * R * r * r;
  double       errors[2];
  for (const unsigned int k : {0u, 1u})
    errors[k] = TriangleSurface(torus(R, r, 24u << k)).moments().volume / exact - 1;
  EXPECT_LT(errors[0], 0.);
  EXPECT_NEAR(errors[0] / errors[1], 4., .1);

  const TriangleSurface surface(torus(R, r, 24));
  const auto            whole = surface.moments();
  VolumeMoments<3>      sum;
  const auto [lower, upper] = surface.bounding_box().get_boundary_points();
  const unsigned int n      = 5;
  for (unsigned int i = 0; i < n * n * n; ++i)
    {
      const unsigned int index[3] = {i % n, i / n % n, i / n / n};
      Point<3>           low, high;
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = lower[d] + index[d] * (upper[d] - lower[d]) / n;
          high[d] = lower[d] + (index[d] + 1) * (upper[d] - lower[d]) / n;
        }
      const dealii::BoundingBox<3> part({low, high});
      const auto                   moments = surface.moments_within(part);
      EXPECT_GE(moments.volume, -1e-14);
      EXPECT_LE(moments.volume, part.volume() * (1 + 1e-12));
      sum.add(moments.about(surface.bounding_box().center() - part.center()));
    }
  EXPECT_NEAR(sum.volume, whole.volume, rounding);
  EXPECT_LT((sum.first - whole.first).norm(), rounding);
  EXPECT_LT((sum.second - whole.second).norm(), rounding);
}

TEST(GeometryTriangles, ClosestPointOfABox)
{
  // against the distance of a box in closed form; points near edges and corners included
  const TriangleSurface            surface(box({-1., -1., -1.}, {1., 1., 1.}));
  std::mt19937                     random(1);
  std::uniform_real_distribution<> place(-2., 2.);
  for (unsigned int k = 0; k < 2000; ++k)
    {
      Point<3>     x;
      Tensor<1, 3> beyond;
      double       inside = -2;
      for (unsigned int d = 0; d < 3; ++d)
        {
          x[d]      = k % 5 == 0 ? std::round(2 * place(random)) / 2 : place(random); // ties too
          beyond[d] = std::max(0., std::abs(x[d]) - 1);
          inside    = std::max(inside, std::abs(x[d]) - 1);
        }
      const double distance = inside < 0 ? inside : beyond.norm();
      const auto   closest  = surface.closest_point(x);
      EXPECT_NEAR(closest.distance, distance, 1e-14);
      EXPECT_NEAR(closest.location.distance(x), std::abs(distance), 1e-14);
      EXPECT_NEAR(closest.normal.norm(), 1., 1e-14);
    }
  // at a corner the angles of the three sides weigh alike, however they are cut to facets
  const auto corner = surface.closest_point({2., 2., 2.});
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(corner.normal[d], 1 / std::sqrt(3.), 1e-14);
  const auto edge = surface.closest_point({2., 2., .3});
  EXPECT_LT((edge.normal - Tensor<1, 3>({1 / std::sqrt(2.), 1 / std::sqrt(2.), 0.})).norm(), 1e-14);
}

TEST(GeometryTriangles, PlacementScalesTurnsAndMoves)
{
  // 1000 x 2000 x 3000 mm; a quarter about x takes y to z and z to -y, then one about z x to y
  Placement placement;
  placement.scale  = 1e-3;
  placement.angles = Tensor<1, 3>({90., 0., 90.});
  placement.shift  = Tensor<1, 3>({10., 0., 0.});
  const TriangleSurface surface(placed(box({0., 0., 0.}, {1000., 2000., 3000.}), placement));
  const auto [lower, upper] = surface.bounding_box().get_boundary_points();
  EXPECT_LT(lower.distance({10., 0., 0.}), 1e-14);
  EXPECT_LT(upper.distance({13., 1., 2.}), 1e-14);
  EXPECT_NEAR(surface.moments().volume, 6., rounding);
}

TEST(GeometryTriangles, WhatBoundsNoBodyIsRefused)
{
  const auto cube = box({0., 0., 0.}, {1., 1., 1.});
  EXPECT_EQ(message_of(cube), "");
  EXPECT_TRUE(has(message_of({}), "no facet"));

  auto open = cube;
  open.erase(open.begin() + 4);
  EXPECT_TRUE(has(message_of(open), "open: facet"));

  auto turned = cube;
  std::swap(turned[6][0], turned[6][1]);
  EXPECT_TRUE(has(message_of(turned), "turned against each other"));
  EXPECT_TRUE(has(message_of(turned), "7"));

  auto flipped = cube;
  for (auto &triangle : flipped)
    std::swap(triangle[0], triangle[1]);
  EXPECT_TRUE(has(message_of(flipped), "inside out"));

  auto degenerate = cube;
  degenerate.push_back({{Point<3>(0., 0., 0.), Point<3>(.5, .5, .5), Point<3>(1., 1., 1.)}});
  EXPECT_TRUE(has(message_of(degenerate), "Facet 13"));
  EXPECT_TRUE(has(message_of(degenerate), "degenerate"));

  auto doubled = cube;
  doubled.push_back(cube[2]);
  EXPECT_TRUE(has(message_of(doubled), "must belong to two"));

  const auto with = [&](const std::vector<Triangle> &other) {
    auto both = cube;
    both.insert(both.end(), other.begin(), other.end());
    return message_of(both);
  };
  EXPECT_EQ(with(box({2., 0., 0.}, {3., 1., 1.})), ""); // two bodies apart
  auto cavity = box({.3, .3, .3}, {.7, .7, .7});
  for (auto &triangle : cavity)
    std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(with(cavity), "");
  EXPECT_TRUE(has(with(box({.5, .5, .5}, {2., 2., 2.})), "cuts itself: facets"));
  EXPECT_TRUE(has(with(box({.5, .2, .2}, {2., .7, .7})), "cuts itself")); // through one side
  EXPECT_TRUE(has(with(box({1., .2, .2}, {2., .7, .7})), "cuts itself")); // lies on one side
  // a corner pulled through the opposite side
  auto pulled = cube;
  for (auto &triangle : pulled)
    for (auto &corner : triangle)
      if (corner.distance({1., 1., 1.}) < 1e-12)
        corner = Point<3>(.2, .3, -.5);
  EXPECT_TRUE(has(message_of(pulled), "cuts itself"));
}
