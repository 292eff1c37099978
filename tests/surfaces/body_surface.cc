// Surfaces that bodies carry: how they are found, follow, and are met.
#include "../transfer/cloud.h"

#include <kedge/surfaces/body_surface.h>
#include <kedge/surfaces/facet_search.h>
#include <kedge/surfaces/seed_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SurfacesBodySurface : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  template <int dim>
  struct CarriedBox
  {
    explicit CarriedBox(const OpenSides<dim> &open_sides = OpenSides<dim>())
      : cloud({BasisKind::gimp}, 3, 5, 4)
      , patch(cloud.grid, parameters(cloud), NodeConditions<dim>({}, {}))
      , surface("a", 0, 0, patch, open_sides)
    {
      // the cloud's volumes fill a cell by about a tenth: well-filled ones are made by hand
      patch.reinit(cloud.points, [](std::vector<unsigned char> &) {});
      dealii::Point<dim> low, high;
      const auto        &lattice = cloud.grid.lattice();
      for (int d = 0; d < dim; ++d)
        {
          low[d]  = lattice.origin[d] + 3.2 * lattice.h[d];
          high[d] = lattice.origin[d] + 6.7 * lattice.h[d];
        }
      surface.seed(mesh_of_box<dim>(low, high, 0.2), EdgeLengths{1e3, 0.});
      surface.find_roots();
    }

    static PatchParameters
    parameters(const Cloud<dim> &cloud)
    {
      PatchParameters result;
      result.body_names    = {"a"};
      result.basis_of_body = cloud.basis_of_body;
      result.n_components  = dim;
      return result;
    }

    Cloud<dim>       cloud;
    Patch<dim>       patch;
    BodySurface<dim> surface;
  };
} // namespace

TYPED_TEST_SUITE(SurfacesBodySurface, Dimensions);

TYPED_TEST(SurfacesBodySurface, VerticesFollowLinearMotionsAndSumToOne)
{
  constexpr int          dim = TypeParam::value;
  const CarriedBox<dim>  box;
  dealii::Tensor<2, dim> A;
  dealii::Tensor<1, dim> b;
  std::vector<double>    nodal(std::size_t(box.patch.nodes.n_local()) * dim);
  for (int i = 0; i < dim; ++i)
    {
      b[i] = 0.3 - i;
      for (int j = 0; j < dim; ++j)
        A[i][j] = std::sin(1. + 2 * i + 5 * j);
    }
  for (unsigned int i = 0; i < box.patch.nodes.n_local(); ++i)
    for (int d = 0; d < dim; ++d)
      nodal[i * dim + d] = b[d] + A[d] * box.patch.node_position(i);
  std::vector<dealii::Tensor<1, dim>> u;
  box.surface.interpolate(nodal, u);
  for (unsigned int v = 0; v < box.surface.n_vertices(); ++v)
    {
      double                 sum = 0.;
      dealii::Tensor<1, dim> centre;
      box.surface.for_nodes(v, [&](const unsigned int node, const double N) {
        sum += N;
        centre += N * box.patch.node_position(node);
      });
      const auto &x = box.surface.mesh().vertices[v];
      EXPECT_NEAR(sum, 1., 1e-14); // partition of unity, to round-off
      EXPECT_NEAR((centre - x).norm(), 0., 1e-13);
      EXPECT_NEAR((u[v] - b - A * x).norm(), 0., 1e-13);
    }
}

TYPED_TEST(SurfacesBodySurface, ASavedSurfaceIsTheSameBitForBit)
{
  constexpr int                       dim = TypeParam::value;
  CarriedBox<dim>                     box, other;
  std::vector<dealii::Tensor<1, dim>> u(box.surface.n_vertices());
  for (std::size_t v = 0; v < u.size(); ++v)
    u[v][v % dim] = 1. / (3. + v);
  box.surface.move(u);
  box.surface.commit();
  other.surface.restore(box.surface.save());
  EXPECT_EQ(other.surface.save(), box.surface.save());
  EXPECT_EQ(other.surface.mesh().vertices, box.surface.mesh().vertices);
  EXPECT_EQ(other.surface.reference_area(3), box.surface.reference_area(3));
}

// A surface that is pushed over the open side x high: facets whose middle is beyond it have left,
// for good, their own vertices stay where they are, and a checkpoint knows.
TYPED_TEST(SurfacesBodySurface, FacetsLeaveThroughOpenSidesForGood)
{
  constexpr int        dim = TypeParam::value;
  const OpenSides<dim> open({1});
  CarriedBox<dim>      box(open);
  BodySurface<dim>    &surface = box.surface;
  const Lattice<dim>  &lattice = box.cloud.grid.lattice();
  const auto           middle  = [&](const unsigned int f) {
    dealii::Point<dim> x;
    for (const auto &corner : surface.mesh().corners(f))
      x += corner / dim;
    return x;
  };
  EXPECT_TRUE(surface.mesh().left.empty());
  dealii::Tensor<1, dim> push;
  push[0] = lattice.upper(0) - lattice.origin[0] - 4.9 * lattice.h[0];
  surface.move(std::vector<dealii::Tensor<1, dim>>(surface.n_vertices(), push));
  surface.commit();
  surface.find_roots();
  std::set<unsigned int> kept_vertices;
  unsigned int           n_left = 0;
  for (unsigned int f = 0; f < surface.n_facets(); ++f)
    {
      EXPECT_EQ(surface.mesh().has_left(f), middle(f)[0] > lattice.upper(0)) << f;
      n_left += surface.mesh().has_left(f);
      if (!surface.mesh().has_left(f))
        kept_vertices.insert(surface.mesh().facets[f].begin(), surface.mesh().facets[f].end());
    }
  EXPECT_GT(n_left, 0u);
  EXPECT_LT(n_left, surface.n_facets());

  std::vector<dealii::Tensor<1, dim>> u;
  const std::vector<double>           nodal(std::size_t(box.patch.nodes.n_local()) * dim, 0.3);
  surface.interpolate(nodal, u);
  for (unsigned int v = 0; v < surface.n_vertices(); ++v)
    EXPECT_NEAR(u[v][0], kept_vertices.count(v) > 0 ? 0.3 : 0., 1e-13) << v;

  // pushed back into the grid, what has left does not come back; nor does it in a resumed run
  surface.move(std::vector<dealii::Tensor<1, dim>>(surface.n_vertices(), -push));
  surface.commit();
  surface.find_roots();
  EXPECT_EQ(std::count(surface.mesh().left.begin(), surface.mesh().left.end(), true), n_left);
  CarriedBox<dim> other(open);
  other.surface.restore(surface.save());
  EXPECT_EQ(other.surface.mesh().left, surface.mesh().left);
}



TEST(SurfacesSeed, ShapesAreKnownAndOthersAreCutOut)
{
  const dealii::BoundingBox<3> domain({{-2., -2., -2.}, {2., 2., 2.}});
  const auto                   volume = [](const SurfaceMesh<3> &mesh) {
    double sum = 0.;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      sum += mesh.corners(f)[0] * area_vector<3>(mesh.corners(f)) / 3.;
    return sum;
  };
  const auto known = [&](const std::string &text) {
    return volume(seed_surface(*parse_geometry<3>(text, {}), 0.2, domain));
  };
  EXPECT_NEAR(known("box(0, 0, 0; 1, 1.5, 0.5)"), 0.75, 1e-13);
  EXPECT_NEAR(known("box(0, 0, 0; 1, 1, 1) + box(-2, 0, 0; -1, 1, 0.5)"), 1.5, 1e-13);
  // where parts meet the lattice cuts: corners are cut off, of order 0.2^2 at edges of 22 m
  EXPECT_NEAR(known("box(0, 0, 0; 1, 1, 1) + box(0.5, 0, 0; 2, 1, 1)"), 2., 0.15);

  const auto ball = parse_geometry<3>("implicit(x^2 + y^2 + z^2 - 1)", {});
  const auto cut  = seed_surface(*ball, 0.1, domain);
  for (const auto &x : cut.vertices)
    EXPECT_NEAR(x.norm(), 1., 1e-12); // on the surface by bisection, to round-off
  // inscribed: less than the ball by a part of order s^2
  EXPECT_NEAR(volume(cut), 4. / 3. * dealii::numbers::PI, 0.03);
  EXPECT_LT(volume(cut), 4. / 3. * dealii::numbers::PI);
  const auto half = seed_surface(*parse_geometry<2>("below(0.3*x)", {}),
                                 0.1,
                                 dealii::BoundingBox<2>({{0., 0.}, {2., 1.}}));
  double     area = 0.;
  for (unsigned int f = 0; f < half.facets.size(); ++f)
    area += half.corners(f)[0] * area_vector<2>(half.corners(f)) / 2.;
  EXPECT_NEAR(area, 0.6, 0.03); // 2 * 0.6 / 2, the pointed end is cut off
}

TEST(SurfacesFacetSearch, RegionsOfATriangle)
{
  using Region                             = FacetPoint<3>::Region;
  const std::array<dealii::Point<3>, 3> t  = {{{0., 0., 0.}, {4., 0., 0.}, {0., 3., 0.}}};
  const auto                            at = [&](const dealii::Point<3> &x) {
    return closest_on_facet<3>(t, x);
  };
  EXPECT_EQ(at({1., 1., 2.}).region, Region::face);
  EXPECT_NEAR(at({1., 1., 2.}).distance, 2., 1e-15);
  EXPECT_NEAR(at({1., 1., 2.}).weights[1], 0.25, 1e-15);
  EXPECT_EQ(at({2., -1., 0.}).region, Region::edge);
  EXPECT_NEAR(at({2., -1., 0.}).distance, 1., 1e-15);
  EXPECT_EQ(at({-1., -1., 1.}).region, Region::vertex);
  EXPECT_NEAR(at({-1., -1., 1.}).distance, std::sqrt(3.), 1e-15);
  EXPECT_EQ(at({6., -1., 0.}).region, Region::vertex);
  EXPECT_EQ(at({-1., 5., 0.}).region, Region::vertex);
  EXPECT_EQ(at({-1., 1., 0.}).region, Region::edge);
  // the slanted edge 3 x + 4 y = 12, a distance of (3*4 + 4*3 - 12)/5 away
  EXPECT_EQ(at({4., 3., 0.}).region, Region::edge);
  EXPECT_NEAR(at({4., 3., 0.}).distance, 2.4, 1e-14);

  // against many points of the triangle
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> number(-2., 5.);
  for (unsigned int k = 0; k < 50; ++k)
    {
      const dealii::Point<3> x(number(generator), number(generator), number(generator));
      double                 least = 1e9;
      for (int i = 0; i <= 200; ++i)
        for (int j = 0; i + j <= 200; ++j)
          least =
            std::min(least, x.distance(t[0] + i / 200. * (t[1] - t[0]) + j / 200. * (t[2] - t[0])));
      EXPECT_NEAR(at(x).distance, least, 2e-2);
      EXPECT_LE(at(x).distance, least + 1e-12);
    }
}

TEST(SurfacesFacetSearch, FindsTheSideAndLooksTowardsIt)
{
  const auto                 box = mesh_of_box<2>({0., 0.}, {2., 1.}, 0.1);
  const FacetSearch<2>       search(box, dealii::BoundingBox<2>({{-1., -1.}, {3., 2.}}));
  FacetSearch<2>::Partner    partner;
  const dealii::Tensor<1, 2> down = dealii::Point<2>(0., -1.), up = dealii::Point<2>(0., 1.);
  ASSERT_TRUE(search.find({1.03, 1.2}, down, 0.5, search.no_facet, partner));
  EXPECT_NEAR(partner.gap, 0.2, 1e-14);
  EXPECT_NEAR((partner.normal - up).norm(), 0., 1e-14);
  ASSERT_TRUE(search.find({1.03, 0.95}, down, 0.5, search.no_facet, partner));
  EXPECT_NEAR(partner.gap, -0.05, 1e-14);
  EXPECT_FALSE(search.find({1.03, 1.2}, up, 0.5, search.no_facet, partner));   // looks away
  EXPECT_FALSE(search.find({1.03, 1.6}, down, 0.5, search.no_facet, partner)); // too far
  EXPECT_FALSE(search.find({2.1, 1.1}, down, 0.5, search.no_facet, partner));  // beyond the corner
  // a side of another body that passes outside of a disc sees, through the disc, the facets that
  // look towards it; nearer ones have it outside: no overlap. Within the disc there is one.
  std::vector<dealii::Point<2>> circle;
  for (int k = 0; k < 60; ++k)
    circle.emplace_back(0.5 * std::cos(k * M_PI / 30.), 0.5 * std::sin(k * M_PI / 30.));
  const auto           disc_mesh = mesh_of_polygon(circle, 0.1);
  const FacetSearch<2> disc(disc_mesh, dealii::BoundingBox<2>({{-1., -1.}, {1., 1.}}));
  for (const double x : {0.47, 0.48, 0.49, 0.495})
    EXPECT_FALSE(disc.find({x, -0.3}, down, 0.4, search.no_facet, partner) && partner.gap < 0.)
      << x;
  ASSERT_TRUE(disc.find({0.47, 0.}, dealii::Point<2>(-1., 0.), 0.4, search.no_facet, partner));
  EXPECT_NEAR(partner.gap, -0.03, 1e-3); // the polygon lies within .0007 of the circle
  // beyond a blunt one the normal points to it
  const auto tip = mesh_of_polygon({{0., 0.}, {2., 0.}, {2., 1.}, {1., 1.2}, {0., 1.}}, 0.1);
  const FacetSearch<2> blunt(tip, dealii::BoundingBox<2>({{-1., -1.}, {3., 2.}}));
  ASSERT_TRUE(blunt.find({1.01, 1.3}, down, 0.5, search.no_facet, partner));
  EXPECT_NEAR(partner.gap, std::sqrt(0.01 * 0.01 + 0.1 * 0.1), 1e-14);
  EXPECT_NEAR((partner.normal - dealii::Point<2>(0.01, 0.1) / partner.gap).norm(), 0., 1e-13);
  // inside the bend the last partner is kept on the border to the next
  ASSERT_TRUE(blunt.find({0.999, 1.1}, down, 0.5, search.no_facet, partner));
  const unsigned int first = partner.facet;
  ASSERT_TRUE(blunt.find({1.001, 1.1}, down, 0.5, search.no_facet, partner));
  EXPECT_NE(partner.facet, first);
  ASSERT_TRUE(blunt.find({1.001, 1.1}, down, 0.5, first, partner));
  EXPECT_EQ(partner.facet, first);
}
