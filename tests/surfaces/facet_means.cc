// Means over facets: how the load of a facet comes to the nodes of the grid.
#include "../transfer/cloud.h"

#include <kedge/surfaces/facet_means.h>
#include <kedge/surfaces/seed_surface.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SurfacesFacetMeans : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** The surface of a ball in a cloud that fills its cells, facets half a cell long. */
  template <int dim>
  struct Ball
  {
    Ball()
      : cloud({BasisKind::gimp}, 3, 5, 2)
      , surface("a", 0, 0, cloud.patch)
    {
      dealii::Point<dim> centre;
      for (int d = 0; d < dim; ++d)
        centre[d] = cloud.grid.lattice().origin[d] + 4.1 * cloud.grid.lattice().h[d];
      surface.seed(mesh_of_ball<dim>(centre, 0.4, 0.1), EdgeLengths::around(0.1));
      surface.find_roots();
      means.reset(surface);
    }

    Cloud<dim>       cloud;
    BodySurface<dim> surface;
    FacetMeans<dim>  means;
  };
} // namespace

TYPED_TEST_SUITE(SurfacesFacetMeans, Dimensions);

/** The functions of every cell are 1 and x in sum, and so are their means, to round-off. */
TYPED_TEST(SurfacesFacetMeans, KeepResultantAndMoment)
{
  constexpr int   dim = TypeParam::value;
  const Ball<dim> ball;
  for (unsigned int f = 0; f < ball.surface.n_facets(); ++f)
    {
      double             sum = 0.;
      dealii::Point<dim> place, middle;
      for (const MeanFunction &of : ball.means.of(f))
        {
          sum += of.all;
          place += of.all * ball.cloud.patch.node_position(of.node);
          EXPECT_EQ(of.own, of.all); // there is one rank
        }
      for (const auto &corner : ball.surface.mesh().corners(f))
        middle += corner / dim;
      EXPECT_NEAR(sum, 1., 1e-13);
      EXPECT_NEAR(place.distance(middle), 0., 1e-12);
    }
}

/**
 * A hat function is the product of kinked lines: its mean over a facet by a fine midpoint rule,
 * which at a kink is right to the square of its spacing.
 */
TYPED_TEST(SurfacesFacetMeans, IntegrateOverTheLinesOfTheGrid)
{
  constexpr int   dim = TypeParam::value;
  const Ball<dim> ball;
  const auto     &lattice = ball.cloud.grid.lattice();
  unsigned int    n_cut   = 0;
  for (unsigned int f = 0; f < ball.surface.n_facets(); ++f)
    {
      const auto corners = ball.surface.mesh().corners(f);
      n_cut += lattice.cell_of(corners[0]) != lattice.cell_of(corners[1]);
      constexpr int n = dim == 2 ? 4000 : 150;
      for (const MeanFunction &of : ball.means.of(f))
        {
          const auto node = ball.cloud.patch.node_position(of.node);
          double     sum = 0., count = 0.;
          for (int i = 0; i < n; ++i)
            for (int j = 0; j < (dim == 2 ? 1 : n - i); ++j)
              for (int flipped = 0; flipped < (dim == 2 || i + j == n - 1 ? 1 : 2); ++flipped)
                {
                  const double s       = (i + (dim == 2 ? 0.5 : (1. + flipped) / 3.)) / n,
                               t       = dim == 2 ? 0. : (j + (1. + flipped) / 3.) / n;
                  dealii::Point<dim> x = corners[0] + s * (corners[1] - corners[0]) +
                                         t * (corners[dim - 1] - corners[0]);
                  double N = 1.;
                  for (int d = 0; d < dim; ++d)
                    N *= std::max(0., 1. - std::abs(x[d] - node[d]) / lattice.h[d]);
                  sum += N;
                  ++count;
                }
          EXPECT_NEAR(of.all, sum / count, dim == 2 ? 1e-7 : 2e-5);
        }
    }
  EXPECT_GT(n_cut, 3u);
}
