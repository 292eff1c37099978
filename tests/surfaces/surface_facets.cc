// Facets of a surface as points of a quadrature: cut along the lines of the grid, and where a
// condition holds; over a closed surface they see no uniform pressure.
#include "../transfer/cloud.h"

#include <kedge/surfaces/seed_surface.h>
#include <kedge/surfaces/surface_facets.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SurfacesFacets : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** A facet askew to the grid of some_grid(), three cells long. */
  template <int dim>
  std::array<dealii::Point<dim>, dim>
  facet_askew()
  {
    std::array<dealii::Point<dim>, dim> corners;
    for (int i = 0; i < dim; ++i)
      for (int d = 0; d < dim; ++d)
        corners[i][d] = 2. + (i == d ? 1.7 : 0.11 * i);
    return corners;
  }

  /** The surface of a ball in a cloud that fills its cells. */
  template <int dim>
  struct Ball
  {
    Ball()
      : cloud({BasisKind::gimp}, 3, 5, 2)
      , surface("a", 0, 0, cloud.patch)
    {
      for (int d = 0; d < dim; ++d)
        centre[d] = cloud.grid.lattice().origin[d] + 4.1 * cloud.grid.lattice().h[d];
      surface.seed(mesh_of_ball<dim>(centre, 0.4, 0.1), EdgeLengths::around(0.1));
    }

    /** The points of the facets with a normal to a side (2 dim: all) and where a condition holds.
     */
    std::vector<SurfacePoint<dim>>
    points(const unsigned int side, const std::string &where) const
    {
      SurfaceParameters parameters;
      parameters.side = side;
      SurfaceFacets<dim> facets;
      facets.choose(0,
                    parameters,
                    Expression(where, {"x", "y", "z", "nx", "ny", "nz"}, {}),
                    surface);
      std::vector<SurfacePoint<dim>> result;
      facets.add_points(cloud.patch, result);
      return result;
    }

    Cloud<dim>         cloud;
    BodySurface<dim>   surface;
    dealii::Point<dim> centre;
  };
} // namespace

TYPED_TEST_SUITE(SurfacesFacets, Dimensions);

// the parts make up the whole, with its centre, and none of them reaches into a second cell
TYPED_TEST(SurfacesFacets, AreCutToCells)
{
  constexpr int             dim = TypeParam::value;
  const BackgroundGrid<dim> grid(some_grid<dim>([] {
                                   std::array<unsigned int, dim> n;
                                   n.fill(12);
                                   return n;
                                 }()),
                                 MPI_COMM_SELF);
  const auto                corners = facet_askew<dim>();
  const auto parts = cut_to_cells<dim>(grid.lattice(), corners, FacetPart<dim>::whole());
  EXPECT_GT(parts.size(), 4u);
  double                  sum = 0.;
  std::array<double, dim> centre{};
  for (const auto &part : parts)
    {
      EXPECT_GT(part.fraction(), 0.);
      sum += part.fraction();
      for (int d = 0; d < dim; ++d)
        {
          double low = 1e9, high = -1e9;
          for (const auto &corner : part.corners)
            {
              const double s = grid.lattice().scaled(place_on_facet<dim>(corners, corner)[d], d);
              low            = std::min(low, s);
              high           = std::max(high, s);
              centre[d] += part.fraction() * corner[d] / dim;
            }
          EXPECT_LE(high, std::floor(low + 1e-9) + 1. + 1e-9);
        }
    }
  EXPECT_NEAR(sum, 1., 1e-13);
  for (const double c : centre)
    EXPECT_NEAR(c, 1. / dim, 1e-13);
}

// a straight edge cuts off a part whose area is known: the corner with the weight w > 0.7
TYPED_TEST(SurfacesFacets, EndWhereAConditionDoes)
{
  constexpr int                       dim = TypeParam::value;
  std::array<dealii::Point<dim>, dim> corners; // of which x is the weight of the first
  for (int i = 0; i < dim; ++i)
    corners[i][i] = 1.;
  const auto area = [&](const std::string &where) {
    double sum = 0.;
    for (const auto &part :
         parts_where<dim>(Expression(where, {"x", "y", "z", "nx", "ny", "nz"}, {}), corners))
      sum += part.fraction();
    return sum;
  };
  EXPECT_NEAR(area("x > 0.7"), std::pow(0.3, dim - 1), 1e-13);
  EXPECT_NEAR(area("x < 0.7"), 1. - std::pow(0.3, dim - 1), 1e-13);
  EXPECT_EQ(area("1"), 1.);
  EXPECT_EQ(area("0"), 0.);
  EXPECT_EQ(area("nx > 0.5"), 1.); // the normal is (1, 1)/sqrt(2), (1, 1, 1)/sqrt(3)
  EXPECT_EQ(area("nx > 0.8"), 0.);
}

// areas add up to those of the polygon or the icosahedron, normals to nothing; a side has a quarter
// (a sixth) of them, up to facets that look as much to one side as to the other
TYPED_TEST(SurfacesFacets, MakeUpTheSurface)
{
  constexpr int   dim = TypeParam::value;
  const Ball<dim> ball;
  double          whole = 0., sum = 0.;
  for (unsigned int f = 0; f < ball.surface.n_facets(); ++f)
    whole += ball.surface.reference_area(f);
  dealii::Tensor<1, dim> normals;
  for (const auto &point : ball.points(2 * dim, "1"))
    {
      sum += point.reference_area;
      for (int d = 0; d < dim; ++d)
        normals[d] += point.area[d];
    }
  EXPECT_NEAR(sum, whole, 1e-12);
  EXPECT_NEAR(normals.norm(), 0., 1e-13);
  double of_sides = 0.;
  for (unsigned int side = 0; side < 2 * dim; ++side)
    {
      double of_side = 0.;
      for (const auto &point : ball.points(side, "1"))
        of_side += point.reference_area;
      EXPECT_NEAR(of_side, whole / (2 * dim), 0.1 * whole);
      of_sides += of_side;
    }
  EXPECT_NEAR(of_sides, whole, 1e-12);
}

// A uniform pressure in a state that the grid tries, with areas cof(I + A) a and places x + u: the
// functions are continuous from cell to cell and the quadrature is exact, so that the resultant
// vanishes, and in 2D the moment too.
TYPED_TEST(SurfacesFacets, OfAClosedSurfaceFeelNoPressure)
{
  constexpr int          dim = TypeParam::value;
  const Ball<dim>        ball;
  const auto            &patch = ball.cloud.patch;
  const auto             u     = ball.cloud.random_nodal(0.1, 7);
  const auto             nodes = node_offsets<dim, 0>(patch.window().node_strides());
  dealii::Tensor<1, dim> resultant;
  double                 moment = 0., size = 0.;
  for (const auto &point : ball.points(2 * dim, "1"))
    {
      ASSERT_EQ(point.functions.pattern, 0u);
      const auto             basis = expand<dim, 0>(point.functions);
      dealii::Tensor<2, dim> F     = dealii::unit_symmetric_tensor<dim>();
      dealii::Tensor<1, dim> area;
      dealii::Point<dim>     x = patch.points.location[point.slot];
      for (int i = 0; i < dim; ++i)
        {
          x[i] += point.offset[i];
          area[i] = point.area[i];
          for (int A = 0; A < stencil_size<dim>(0); ++A)
            {
              const int    node = patch.nodes.local(point.functions.first_node + nodes[A]);
              const double u_i  = u[std::size_t(node) * dim + i];
              x[i] += basis.value[A] * u_i;
              for (int j = 0; j < dim; ++j)
                F[i][j] += basis.gradient[j][A] * u_i;
            }
        }
      const dealii::Tensor<1, dim> force = determinant(F) * transpose(invert(F)) * area;
      resultant += force;
      moment += x[0] * force[1] - x[1] * force[0];
      size += force.norm();
    }
  EXPECT_GT(size, 1.);
  EXPECT_NEAR(resultant.norm(), 0., 1e-13);
  if (dim == 2)
    {
      EXPECT_NEAR(moment, 0., 1e-13);
    }
}
