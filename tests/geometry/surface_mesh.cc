#include "surface_shapes.h"

#include <kedge/geometry/surface_mesh.h>

#include <gtest/gtest.h>

#include <map>

using namespace kedge;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  /** Area, and volume by the divergence theorem: the sum of x . n dA over dim. */
  template <int dim>
  std::pair<double, double>
  area_and_volume(const SurfaceMesh<dim> &mesh)
  {
    double area = 0., volume = 0.;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        const auto corners = mesh.corners(f);
        const auto normal  = area_vector<dim>(corners);
        area += normal.norm();
        volume += corners[0] * normal / dim; // x . n is the same all over a flat facet
      }
    return {area, volume};
  }

  /** Every edge of two facets is run through once in each direction (in 2D every vertex). */
  template <int dim>
  void
  expect_closed(const SurfaceMesh<dim> &mesh)
  {
    std::map<std::pair<unsigned int, unsigned int>, int> count;
    for (const auto &facet : mesh.facets)
      for (unsigned int i = 0; i < dim; ++i)
        if (dim == 2)
          ++count[{facet[i], i}];
        else
          ++count[{facet[i], facet[(i + 1) % dim]}];
    for (const auto &[key, n] : count)
      {
        EXPECT_EQ(n, 1);
        EXPECT_EQ(
          (count[{dim == 2 ? key.first : key.second, dim == 2 ? 1 - key.second : key.first}]),
          1);
      }
    for (const auto &facet : mesh.facets)
      for (unsigned int i = 0; i < dim; ++i)
        EXPECT_LT(facet[i], mesh.vertices.size());
  }

  template <int dim>
  double
  longest_edge(const SurfaceMesh<dim> &mesh)
  {
    double longest = 0.;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      for (unsigned int i = 0; i < dim; ++i)
        longest = std::max(longest, mesh.corners(f)[i].distance(mesh.corners(f)[(i + 1) % dim]));
    return longest;
  }
} // namespace

TEST(GeometrySurfaceMesh, BoxesAndPolygonsAreExact)
{
  const auto plane = mesh_of_box<2>({-0.3, 0.2}, {0.8, 0.9}, 0.13);
  expect_closed(plane);
  EXPECT_NEAR(area_and_volume(plane).first, 2 * (1.1 + 0.7), 1e-14); // round-off
  EXPECT_NEAR(area_and_volume(plane).second, 1.1 * 0.7, 1e-14);
  EXPECT_LE(longest_edge(plane), 0.13);

  const auto triangle = mesh_of_polygon({{0., 0.}, {3., 0.}, {0., 4.}}, 0.25);
  expect_closed(triangle);
  EXPECT_EQ(triangle.facets.size(), 48u); // 3/0.25 + 5/0.25 + 4/0.25
  EXPECT_NEAR(area_and_volume(triangle).second, 6., 1e-13);

  const auto space = mesh_of_box<3>({-0.3, 0.2, 1.}, {0.8, 0.9, 1.5}, 0.2);
  expect_closed(space);
  EXPECT_NEAR(area_and_volume(space).first, 2 * (1.1 * 0.7 + 0.7 * 0.5 + 0.5 * 1.1), 1e-13);
  EXPECT_NEAR(area_and_volume(space).second, 1.1 * 0.7 * 0.5, 1e-13);
}

TEST(GeometrySurfaceMesh, RoundBodiesConvergeWithTheSquareOfTheSpacing)
{
  // inscribed facets of size s: what is missing is of order s^2, and of the right sign
  double missing[2][3];
  for (const int fine : {0, 1})
    {
      const double s    = fine == 1 ? 0.046 : 0.092;
      const auto   disc = mesh_of_ball<2>({1., 2.}, 0.7, s);
      const auto   ball = mesh_of_ball<3>({1., 2., 3.}, 0.7, s);
      const auto   tube = mesh_of_cylinder({0., 0., 0.}, {1., 2., 2.}, 0.5, s);
      expect_closed(disc);
      expect_closed(ball);
      expect_closed(tube);
      missing[fine][0] = 1. - area_and_volume(disc).second / (pi * 0.49);
      missing[fine][1] = 1. - area_and_volume(ball).second / (4. / 3. * pi * 0.343);
      missing[fine][2] = 1. - area_and_volume(tube).second / (pi * 0.25 * 3.);
      for (const auto &x : ball.vertices)
        EXPECT_NEAR(x.distance({1., 2., 3.}), 0.7, 1e-14);
    }
  for (const int k : {0, 1, 2})
    {
      EXPECT_GT(missing[1][k], 0.);
      EXPECT_LT(missing[0][k], 0.02);
      EXPECT_NEAR(missing[0][k] / missing[1][k], 4., 0.5); // counts of facets are whole numbers
    }
  // a regular polygon in closed form
  EXPECT_NEAR(1. - missing[0][0], std::sin(2 * pi / 48) / (2 * pi / 48), 1e-13);
}

TEST(GeometrySurfaceMesh, TrianglesAreDividedWithoutGaps)
{
  const TriangleSurface surface({{{{0., 0., 0.}, {0., 2., 0.}, {3., 0., 0.}}},
                                 {{{0., 0., 0.}, {3., 0., 0.}, {0., 0., 1.}}},
                                 {{{0., 0., 0.}, {0., 0., 1.}, {0., 2., 0.}}},
                                 {{{3., 0., 0.}, {0., 2., 0.}, {0., 0., 1.}}}});
  const auto            mesh = mesh_of_triangles(surface, 0.3);
  expect_closed(mesh);
  EXPECT_LE(longest_edge(mesh), 0.3);
  EXPECT_NEAR(area_and_volume(mesh).second, 1., 1e-13); // 3 * 2 * 1 / 6
}
