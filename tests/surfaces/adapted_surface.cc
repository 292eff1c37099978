// Surfaces whose facets are divided as they grow and united as they shrink.
#include <kedge/surfaces/adapted_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

using namespace kedge;

namespace
{
  constexpr double spacing = 0.25;

  template <typename Dimension>
  class SurfacesAdapted : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  template <int dim>
  CarriedSurface<dim>
  carried(const SurfaceMesh<dim> &mesh)
  {
    CarriedSurface<dim> result{mesh, mesh.vertices, {}};
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      result.reference_areas.push_back(area_vector<dim>(mesh.corners(f)).norm());
    return result;
  }

  template <int dim>
  CarriedSurface<dim>
  carried_box()
  {
    dealii::Point<dim> low, high;
    for (int d = 0; d < dim; ++d)
      high[d] = 1. + 0.25 * d;
    return carried(mesh_of_box<dim>(low, high, spacing));
  }

  template <int dim>
  void
  stretch(CarriedSurface<dim> &surface, const double factor)
  {
    for (auto &x : surface.mesh.vertices)
      x[0] *= factor;
  }

  /** Enclosed by a surface: by the divergence theorem sum of x.a/dim, a the facets' areas. */
  template <int dim>
  double
  volume(const SurfaceMesh<dim> &mesh)
  {
    double sum = 0.;
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      sum += mesh.corners(f)[0] * area_vector<dim>(mesh.corners(f)) / dim;
    return sum;
  }

  template <int dim>
  double
  reference_area(const CarriedSurface<dim> &surface)
  {
    return std::accumulate(surface.reference_areas.begin(), surface.reference_areas.end(), 0.);
  }

  /** Of each edge (vertex in 2D) how many facets begin and how many end there: once each on a
   * closed surface. */
  template <int dim>
  bool
  is_closed(const SurfaceMesh<dim> &mesh)
  {
    std::map<std::array<unsigned int, dim>, int> n_of;
    for (const auto &facet : mesh.facets)
      for (int i = 0; i < dim; ++i)
        if constexpr (dim == 2)
          {
            n_of[{{facet[i], 0}}] += i == 0 ? 1 : -1;
          }
        else
          {
            const unsigned int a = facet[i], b = facet[(i + 1) % 3];
            n_of[{{std::min(a, b), std::max(a, b), 0}}] += a < b ? 1 : -1;
          }
    return std::all_of(n_of.begin(), n_of.end(), [](const auto &n) {
      return n.second == 0;
    });
  }

  template <int dim>
  std::pair<double, double>
  lengths(const SurfaceMesh<dim> &mesh)
  {
    std::pair<double, double> result{1e9, 0.};
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < i; ++j)
          {
            const double length = mesh.corners(f)[i].distance(mesh.corners(f)[j]);
            result              = {std::min(result.first, length), std::max(result.second, length)};
          }
    return result;
  }
} // namespace

TYPED_TEST_SUITE(SurfacesAdapted, Dimensions);

// a surface that has kept its size is let be
TYPED_TEST(SurfacesAdapted, LetsAGoodSurfaceBe)
{
  constexpr int dim     = TypeParam::value;
  auto          surface = carried_box<dim>();
  const auto    before  = surface.mesh.facets;
  EXPECT_TRUE(adapt<dim>(surface, EdgeLengths::around(spacing)).empty());
  EXPECT_EQ(surface.mesh.facets, before);
}

// a division changes no place: volume and areas are the same to round-off, and all edges as short
// as they shall be
TYPED_TEST(SurfacesAdapted, DividesWhatHasGrown)
{
  constexpr int dim      = TypeParam::value;
  auto          surface  = carried_box<dim>();
  const double  area     = reference_area(surface);
  const auto    n_before = surface.mesh.facets.size();
  stretch(surface, 8.);
  const double now      = volume<dim>(surface.mesh);
  const auto   heritage = adapt<dim>(surface, EdgeLengths::around(spacing));
  EXPECT_GT(surface.mesh.facets.size(), 2 * n_before);
  EXPECT_TRUE(is_closed<dim>(surface.mesh));
  EXPECT_NEAR(volume<dim>(surface.mesh), now, 1e-13 * now);
  EXPECT_NEAR(reference_area(surface), area, 1e-13 * area);
  EXPECT_LE(lengths<dim>(surface.mesh).second, 2. * spacing * (1. + 1e-12));
  ASSERT_EQ(heritage.parts.size(), surface.mesh.facets.size());
  ASSERT_EQ(heritage.heirs.size(), n_before);
  for (unsigned int f = 0; f < surface.mesh.facets.size(); ++f)
    {
      // it was straight at the start: the carried area is that of the corners there
      EXPECT_NEAR(surface.reference_areas[f],
                  area_vector<dim>(surface.corners_at_start(f)).norm(),
                  1e-14);
      EXPECT_NEAR(heritage.area(f), surface.reference_areas[f], 1e-15);
    }
}

// a box that is squeezed flat keeps its corners and edges, and with them its volume; once it has
// grown again it has about as many facets as at the start
TYPED_TEST(SurfacesAdapted, UnitesWhatHasShrunk)
{
  constexpr int dim             = TypeParam::value;
  auto          surface         = carried_box<dim>();
  const double  area            = reference_area(surface);
  const auto    n_first         = surface.mesh.facets.size();
  const auto    lengths_allowed = EdgeLengths::around(spacing);
  stretch(surface, 0.1);
  const double now = volume<dim>(surface.mesh);
  EXPECT_FALSE(adapt<dim>(surface, lengths_allowed).empty());
  EXPECT_LT(surface.mesh.facets.size(), n_first);
  EXPECT_TRUE(is_closed<dim>(surface.mesh));
  EXPECT_NEAR(volume<dim>(surface.mesh), now, 1e-13 * now);
  EXPECT_NEAR(reference_area(surface), area, 1e-13 * area);
  for (int corner = 0; corner < (1 << dim); ++corner)
    {
      dealii::Point<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = ((corner >> d) & 1) * (1. + 0.25 * d) * (d == 0 ? 0.1 : 1.);
      EXPECT_TRUE(
        std::any_of(surface.mesh.vertices.begin(), surface.mesh.vertices.end(), [&](const auto &v) {
          return v.distance(x) < 1e-12;
        }));
    }
  stretch(surface, 10.);
  adapt<dim>(surface, lengths_allowed);
  EXPECT_LT(surface.mesh.facets.size(), 1.5 * n_first);
  EXPECT_LE(lengths<dim>(surface.mesh).second, lengths_allowed.longest);
  EXPECT_NEAR(volume<dim>(surface.mesh), 10. * now, 1e-12 * now);
}

// what facets remember per area keeps its sum, whatever becomes of them
TYPED_TEST(SurfacesAdapted, HandsOnWhatFacetsRemember)
{
  constexpr int dim = TypeParam::value;
  for (const double factor : {5., 0.1})
    {
      auto                           surface = carried_box<dim>();
      const auto                     areas   = surface.reference_areas;
      std::map<unsigned int, double> memory;
      double                         before = 0., after = 0.;
      for (unsigned int f = 0; f < areas.size(); f += 2) // every second one remembers something
        {
          memory[f] = 1. + std::sin(3. * f);
          before += areas[f] * memory[f];
        }
      stretch(surface, factor);
      const auto heritage  = adapt<dim>(surface, EdgeLengths::around(spacing));
      const auto handed_on = heritage.hand_on(memory, [](const auto &parts) {
        double mean = 0.;
        for (const auto &[value, share] : parts)
          mean += share * *value;
        return mean;
      });
      for (const auto &[f, value] : handed_on)
        after += surface.reference_areas[f] * value;
      EXPECT_NEAR(after, before, 1e-13 * before);
      for (const auto &[f, value] : memory)
        EXPECT_TRUE(handed_on.count(heritage.heirs[f]));
    }
}

// facets that have left the grid stay as they are
TYPED_TEST(SurfacesAdapted, LeavesFacetsThatAreGone)
{
  constexpr int dim     = TypeParam::value;
  auto          surface = carried_box<dim>();
  surface.mesh.left.assign(surface.mesh.facets.size(), true);
  stretch(surface, 8.);
  EXPECT_TRUE(adapt<dim>(surface, EdgeLengths::around(spacing)).empty());
}

// A disc in a vortex that turns back (Rider and Kothe 1998; LeVeque 1996) is drawn out to a spiral
// and returns: velocity 2 cos(pi t/T) (-sin^2(pi x) sin(pi y) cos(pi y), ..). Its area never
// changes. With facets as long as at the start the spiral is lost; divided facets follow it.
namespace
{
  dealii::Tensor<1, 2>
  vortex(const dealii::Point<2> &x, const double t, const double duration)
  {
    constexpr double     pi = 3.14159265358979323846;
    const double         s = std::sin(pi * x[0]), r = std::sin(pi * x[1]);
    dealii::Tensor<1, 2> v;
    v[0] = -2. * s * s * r * std::cos(pi * x[1]);
    v[1] = 2. * r * r * s * std::cos(pi * x[0]);
    return std::cos(pi * t / duration) * v;
  }

  struct DiscInVortex
  {
    double      area_when_stretched, area_at_end, farthest_at_end;
    std::size_t n_when_stretched, n_at_end;
  };

  DiscInVortex
  turn_disc(const EdgeLengths &allowed)
  {
    const double           duration = 4.;
    const int              n        = 800;
    const dealii::Point<2> centre(0.5, 0.75);
    auto                   surface = carried(mesh_of_ball<2>(centre, 0.15, 0.02));
    DiscInVortex           result{};
    for (int k = 0; k < n; ++k)
      {
        const double t = k * duration / n, dt = duration / n;
        for (auto &x : surface.mesh.vertices)
          {
            const auto a = vortex(x, t, duration),
                       b = vortex(x + 0.5 * dt * a, t + 0.5 * dt, duration),
                       c = vortex(x + 0.5 * dt * b, t + 0.5 * dt, duration),
                       d = vortex(x + dt * c, t + dt, duration);
            x += dt / 6. * (a + 2. * b + 2. * c + d);
          }
        adapt<2>(surface, allowed);
        if (2 * (k + 1) == n)
          {
            result.area_when_stretched = volume<2>(surface.mesh);
            result.n_when_stretched    = surface.mesh.facets.size();
          }
      }
    result.area_at_end = volume<2>(surface.mesh);
    result.n_at_end    = surface.mesh.facets.size();
    for (const auto &x : surface.mesh.vertices)
      result.farthest_at_end =
        std::max(result.farthest_at_end, std::abs(x.distance(centre) - 0.15));
    return result;
  }
} // namespace

TEST(SurfacesAdaptedTest, ADiscDrawnOutByAVortexComesBack)
{
  const double       pi = 3.14159265358979323846, area = pi * 0.15 * 0.15;
  const DiscInVortex adapted   = turn_disc(EdgeLengths::around(0.02)),
                     as_seeded = turn_disc({1e9, 0.});
  // a polygon of 48 sides has .3 % less than the circle
  EXPECT_NEAR(adapted.area_when_stretched, area, 0.01 * area);
  EXPECT_GT(std::abs(as_seeded.area_when_stretched - area), 0.03 * area);
  EXPECT_GT(adapted.n_when_stretched, 2 * as_seeded.n_when_stretched);
  EXPECT_NEAR(adapted.area_at_end, area, 0.01 * area);
  // divided ones are as long as at the start again, and stay
  EXPECT_LE(adapted.n_at_end, adapted.n_when_stretched);
  EXPECT_LT(adapted.farthest_at_end, 0.02); // a facet
}
