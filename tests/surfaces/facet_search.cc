// The search of partners on a surface: against all facets one by one, and wherever it begins.
#include <kedge/surfaces/facet_search.h>

#include <gtest/gtest.h>

#include <random>

using namespace kedge;

namespace
{
  template <typename Dimension>
  class FacetSearchTest : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
} // namespace

TYPED_TEST_SUITE(FacetSearchTest, Dimensions);

TYPED_TEST(FacetSearchTest, FindsTheNearestWhateverTheGuess)
{
  constexpr int          dim  = TypeParam::value;
  const SurfaceMesh<dim> ball = mesh_of_ball<dim>(dealii::Point<dim>(), 1., 0.12);
  dealii::Point<dim>     lower, upper;
  for (int d = 0; d < dim; ++d)
    {
      lower[d] = -2.;
      upper[d] = 2.;
    }
  const FacetSearch<dim>                 search(ball, dealii::BoundingBox<dim>({lower, upper}));
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> place(-1.6, 1.6);
  std::uniform_int_distribution<unsigned int> any(0, ball.facets.size() - 1);
  unsigned int                                n_found = 0;
  for (unsigned int trial = 0; trial < 400; ++trial)
    {
      dealii::Point<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = place(generator);
      const dealii::Tensor<1, dim> outward  = -x / x.norm();
      const double                 reach    = 0.4;
      const unsigned int           previous = trial % 3 == 0 ? any(generator) : search.no_facet;
      typename FacetSearch<dim>::Partner alone, guided;
      const bool                         found = search.find(x, outward, reach, previous, alone);
      ASSERT_EQ(found, search.find(x, outward, reach, previous, guided, any(generator)));
      double least = reach; // of all facets that look towards x
      for (unsigned int f = 0; f < ball.facets.size(); ++f)
        {
          const auto normal = area_vector<dim>(ball.corners(f));
          if (normal * outward < -0.05 * normal.norm())
            least = std::min(least, closest_on_facet<dim>(ball.corners(f), x).distance);
        }
      if (!found)
        {
          EXPECT_EQ(least, reach);
          continue;
        }
      ++n_found;
      EXPECT_EQ(alone.facet, guided.facet);
      EXPECT_EQ(alone.gap, guided.gap);
      EXPECT_EQ(alone.normal, guided.normal);
      EXPECT_NEAR(std::abs(alone.gap), least, search.hysteresis * 0.15);
      if (previous == search.no_facet)
        {
          EXPECT_EQ(std::abs(alone.gap), least);
        }
    }
  EXPECT_GT(n_found, 60u);
}

// Of a convex body the depth of a place is its distance from the nearest plane of a facet if it is
// on the inner side of all, else 0. To round-off.
TYPED_TEST(FacetSearchTest, DepthIsThatUnderTheNearestPlane)
{
  constexpr int          dim  = TypeParam::value;
  const SurfaceMesh<dim> ball = mesh_of_ball<dim>(dealii::Point<dim>(), 1., 0.3);
  dealii::Point<dim>     lower, upper;
  for (int d = 0; d < dim; ++d)
    {
      lower[d] = -2.;
      upper[d] = 2.;
    }
  const FacetSearch<dim>                 search(ball, dealii::BoundingBox<dim>({lower, upper}));
  std::mt19937                           generator(11);
  std::uniform_real_distribution<double> place(-1.1, 1.1);
  unsigned int                           n_inside = 0;
  for (unsigned int trial = 0; trial < 300; ++trial)
    {
      dealii::Point<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = place(generator);
      double depth = 2.;
      for (unsigned int f = 0; f < ball.facets.size(); ++f)
        {
          const auto corners = ball.corners(f);
          const auto normal  = area_vector<dim>(corners);
          depth              = std::min(depth, normal * (corners[0] - x) / normal.norm());
        }
      n_inside += depth > 0.;
      EXPECT_NEAR(search.depth(x, trial % 2 == 0 ? 0.01 : 5.), std::max(depth, 0.), 1e-12);
    }
  EXPECT_GT(n_inside, 50u);
}

// Beyond the tip of a wedge, where the nearest place is its vertex, and beside and in it.
TEST(FacetSearch, DepthAtASharpTip)
{
  SurfaceMesh<2> wedge;
  wedge.vertices = {{0., 0.}, {1., 4.}, {-1., 4.}};
  wedge.facets   = {{{0, 1}}, {{1, 2}}, {{2, 0}}};
  const FacetSearch<2> search(wedge, dealii::BoundingBox<2>({{-2., -1.}, {2., 5.}}));
  EXPECT_EQ(search.depth({0., -0.01}, 0.1), 0.);
  EXPECT_EQ(search.depth({0.02, -0.01}, 0.1), 0.);
  EXPECT_EQ(search.depth({0.1, 0.2}, 0.1), 0.);
  // under the side through 0 with the slope of 4: 0.4 (4, -1)/sqrt(17) off (0, 0.4)
  EXPECT_NEAR(search.depth({0., 0.4}, 0.01), 0.4 / std::sqrt(17.), 1e-14);
}
