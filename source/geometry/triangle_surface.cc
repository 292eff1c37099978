#include <kedge/base/exceptions.h>
#include <kedge/geometry/surface_checks.h>
#include <kedge/geometry/triangle_surface.h>

#include <deal.II/base/numbers.h>

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace kedge
{
  namespace
  {
    namespace bg     = boost::geometry;
    using Vector     = dealii::Tensor<1, 3>;
    using TreePoint  = bg::model::point<double, 3, bg::cs::cartesian>;
    using TreeBox    = bg::model::box<TreePoint>;
    using TreeFacet  = std::pair<TreeBox, unsigned int>;
    using FacetsTree = bg::index::rtree<TreeFacet, bg::index::rstar<16>>;

    /** So close, in sizes of the surface, facets are said to touch. */
    constexpr double touch_tolerance = 1e-10;

    TreePoint
    tree_point(const dealii::Point<3> &x)
    {
      return {x[0], x[1], x[2]};
    }

    dealii::BoundingBox<3>
    box_of(const Triangle &triangle)
    {
      dealii::Point<3> lower = triangle[0], upper = triangle[0];
      for (const auto &corner : triangle)
        for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = std::min(lower[d], corner[d]);
            upper[d] = std::max(upper[d], corner[d]);
          }
      return dealii::BoundingBox<3>({lower, upper});
    }

    TreeBox
    tree_box(const dealii::BoundingBox<3> &box)
    {
      return {tree_point(box.get_boundary_points().first),
              tree_point(box.get_boundary_points().second)};
    }

    double
    square_of_distance(const dealii::Point<3> &x, const TreeBox &box)
    {
      const auto outside = [&x](const unsigned int d, const double low, const double high) {
        const double beyond = std::max({low - x[d], 0., x[d] - high});
        return beyond * beyond;
      };
      return outside(0, bg::get<0>(box.min_corner()), bg::get<0>(box.max_corner())) +
             outside(1, bg::get<1>(box.min_corner()), bg::get<1>(box.max_corner())) +
             outside(2, bg::get<2>(box.min_corner()), bg::get<2>(box.max_corner()));
    }

    /**
     * Barycentric coordinates of the point of a triangle closest to @p x: of the foot of
     * the perpendicular if it lies within, else on the nearest edge.
     */
    std::array<double, 3>
    closest_weights(const Triangle &t, const dealii::Point<3> &x)
    {
      const Vector          normal = cross_product_3d(t[1] - t[0], t[2] - t[0]);
      std::array<double, 3> weights;
      bool                  within = true;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          weights[i] = cross_product_3d(t[k] - t[j], x - t[j]) * normal / normal.norm_square();
          within     = within && weights[i] >= 0.;
        }
      if (within)
        return weights;
      double nearest = std::numeric_limits<double>::max();
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j        = (i + 1) % 3;
          const Vector       edge     = t[j] - t[i];
          const double       s        = std::clamp((x - t[i]) * edge / edge.norm_square(), 0., 1.);
          const double       distance = (t[i] + s * edge).distance_square(x);
          if (distance < nearest)
            {
              nearest    = distance;
              weights    = {};
              weights[i] = 1. - s;
              weights[j] = s;
            }
        }
      return weights;
    }

    dealii::Point<3>
    place_at(const Triangle &t, const std::array<double, 3> &weights)
    {
      dealii::Point<3> x;
      for (unsigned int i = 0; i < 3; ++i)
        x += weights[i] * t[i];
      return x;
    }



    using Corners = std::vector<Vector>;

    /** The part of a convex polygon where sign * x_d <= bound. */
    Corners
    clipped(const Corners &polygon, const unsigned int d, const double sign, const double bound)
    {
      Corners result;
      for (std::size_t i = 0; i < polygon.size(); ++i)
        {
          const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
          const double  of_a = sign * a[d] - bound, of_b = sign * b[d] - bound;
          if (of_a <= 0.)
            result.push_back(a);
          if ((of_a < 0. && of_b > 0.) || (of_a > 0. && of_b < 0.))
            {
              result.push_back(a + of_a / (of_a - of_b) * (b - a));
              result.back()[d] = sign * bound;
            }
        }
      return result;
    }

    /** Takes away what lies behind a piece of surface, along x up to @p end. */
    void
    take_behind(const Corners &polygon, const double end, VolumeMoments<3> &moments)
    {
      // exact for cubic polynomials: the centre and three points around it
      constexpr std::array<std::array<double, 4>, 4> rule = {{{{1 / 3., 1 / 3., 1 / 3., -27 / 48.}},
                                                              {{.6, .2, .2, 25 / 48.}},
                                                              {{.2, .6, .2, 25 / 48.}},
                                                              {{.2, .2, .6, 25 / 48.}}}};
      for (std::size_t i = 2; i < polygon.size(); ++i)
        {
          const Vector &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
          const double  area = 0.5 * cross_product_3d(b - a, c - a)[0]; // n_x dA
          for (const auto &node : rule)
            {
              const Vector x      = node[0] * a + node[1] * b + node[2] * c;
              const double weight = -area * node[3];
              // integrals of 1, x, x^2 along x
              const double powers[3] = {end - x[0],
                                        (end * end - x[0] * x[0]) / 2.,
                                        (end * end * end - x[0] * x[0] * x[0]) / 3.};
              moments.volume += weight * powers[0];
              for (unsigned int d = 0; d < 3; ++d)
                {
                  moments.first[d] += weight * (d == 0 ? powers[1] : x[d] * powers[0]);
                  for (unsigned int e = d; e < 3; ++e)
                    moments.second[d][e] += weight * powers[(d == 0) + (e == 0)] *
                                            (d == 0 ? 1. : x[d]) * (e == 0 ? 1. : x[e]);
                }
            }
        }
    }
  } // namespace



  class TriangleSurface::Tree
  {
  public:
    explicit Tree(const std::vector<TreeFacet> &facets)
      : tree(facets)
    {}

    FacetsTree tree;
  };



  TriangleSurface::TriangleSurface(const std::vector<Triangle> &triangles)
  {
    if (triangles.empty())
      throw UserError("The surface has no facet.");
    std::map<std::array<double, 3>, unsigned int> numbers;
    std::vector<TreeFacet>                        boxes;
    box = box_of(triangles[0]);
    for (const Triangle &triangle : triangles)
      {
        corners.emplace_back();
        for (unsigned int i = 0; i < 3; ++i)
          {
            const auto &x = triangle[i];
            const auto [entry, is_new] =
              numbers.insert({{{x[0] + 0., x[1] + 0., x[2] + 0.}}, // -0 is 0
                              static_cast<unsigned int>(places.size())});
            if (is_new)
              places.push_back(x);
            corners.back()[i] = entry->second;
          }
        const auto of_facet = box_of(triangle);
        box.merge_with(of_facet);
        boxes.emplace_back(tree_box(of_facet), static_cast<unsigned int>(boxes.size()));
      }
    check_areas(places, corners);
    neighbours = find_neighbours(places, corners);
    tree       = std::make_unique<Tree>(boxes);

    vertex_normals.resize(places.size());
    for (const auto &facet : corners)
      {
        normals.push_back(cross_product_3d(places[facet[1]] - places[facet[0]],
                                           places[facet[2]] - places[facet[0]]));
        normals.back() /= normals.back().norm();
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Vector a     = places[facet[(i + 1) % 3]] - places[facet[i]],
                         b     = places[facet[(i + 2) % 3]] - places[facet[i]];
            const double angle = std::atan2(cross_product_3d(a, b).norm(), a * b);
            vertex_normals[facet[i]] += angle * normals.back();
          }
      }
    const auto  &bounds = box.get_boundary_points();
    const double size   = bounds.first.distance(bounds.second);
    for (unsigned int f = 0; f < n_facets(); ++f)
      for (const unsigned int other : facets_near(box_of(triangle(f))))
        if (other > f && intersect(places, corners[f], corners[other], touch_tolerance * size))
          {
            std::ostringstream message;
            message << "The surface cuts itself: facets " << f + 1 << " and " << other + 1
                    << " have more in common than their corners, near (" << places[corners[f][0]]
                    << ").";
            throw UserError(message.str());
          }
    if (!(moments().volume > 0.))
      throw UserError("The surface is inside out: the normal of facet 1 and all others points into "
                      "the body. The corners of a facet run counter-clockwise seen from outside.");
  }



  TriangleSurface::~TriangleSurface() = default;



  Triangle
  TriangleSurface::triangle(const unsigned int number) const
  {
    return {{places[corners[number][0]], places[corners[number][1]], places[corners[number][2]]}};
  }



  std::vector<unsigned int>
  TriangleSurface::facets_near(const dealii::BoundingBox<3> &region) const
  {
    std::vector<unsigned int> result;
    for (auto found = tree->tree.qbegin(bg::index::intersects(tree_box(region)));
         found != tree->tree.qend();
         ++found)
      result.push_back(found->second);
    std::sort(result.begin(), result.end());
    return result;
  }



  dealii::Tensor<1, 3>
  TriangleSurface::normal_at(const unsigned int facet, const std::array<double, 3> &weights) const
  {
    constexpr double on_edge = 1e-12;
    for (unsigned int i = 0; i < 3; ++i)
      if (weights[i] >= 1. - on_edge)
        return vertex_normals[corners[facet][i]] / vertex_normals[corners[facet][i]].norm();
    for (unsigned int i = 0; i < 3; ++i)
      if (weights[(i + 2) % 3] <= on_edge) // on the edge from corner i to the next
        {
          const Vector sum = normals[facet] + normals[neighbours[facet][i]];
          return sum / sum.norm();
        }
    return normals[facet];
  }



  ClosestPoint
  TriangleSurface::closest_point(const dealii::Point<3> &x) const
  {
    double                nearest = std::numeric_limits<double>::max();
    ClosestPoint          result{};
    std::array<double, 3> weights = {};
    // facets by the distance of their boxes, until no box is near enough
    for (auto found = tree->tree.qbegin(
           bg::index::nearest(tree_point(x), static_cast<unsigned int>(tree->tree.size())));
         found != tree->tree.qend();
         ++found)
      {
        if (square_of_distance(x, found->first) > nearest)
          break;
        const Triangle t        = triangle(found->second);
        const auto     of_facet = closest_weights(t, x);
        const double   distance = place_at(t, of_facet).distance_square(x);
        if (distance < nearest || (distance == nearest && found->second < result.facet))
          {
            nearest      = distance;
            result.facet = found->second;
            weights      = of_facet;
          }
      }
    result.location = place_at(triangle(result.facet), weights);
    result.normal   = normal_at(result.facet, weights);
    result.distance = std::copysign(std::sqrt(nearest), (x - result.location) * result.normal);
    return result;
  }



  VolumeMoments<3>
  TriangleSurface::moments_within(const dealii::BoundingBox<3> &region) const
  {
    const auto centre           = region.center();
    auto [lower, upper]         = region.get_boundary_points();
    dealii::Point<3> beam_begin = lower;
    beam_begin[0]               = box.get_boundary_points().first[0];
    VolumeMoments<3> result;
    if (beam_begin[0] > upper[0])
      return result;
    for (const unsigned int f : facets_near(dealii::BoundingBox<3>({beam_begin, upper})))
      {
        Corners polygon;
        for (const unsigned int corner : corners[f])
          polygon.push_back(places[corner] - centre);
        for (unsigned int d = 1; d < 3; ++d)
          polygon =
            clipped(clipped(polygon, d, 1., upper[d] - centre[d]), d, -1., centre[d] - lower[d]);
        const double begin = lower[0] - centre[0], end = upper[0] - centre[0];
        take_behind(clipped(clipped(polygon, 0, 1., end), 0, -1., -begin), end, result);
        // what lies before the region has all of its length behind it
        if (std::none_of(polygon.begin(), polygon.end(), [&](const Vector &corner) {
              return corner[0] < begin;
            }))
          continue;
        Corners before = clipped(polygon, 0, 1., begin);
        for (auto &corner : before)
          corner[0] = begin;
        take_behind(before, end, result);
      }
    return result;
  }



  std::vector<Triangle>
  placed(std::vector<Triangle> triangles, const Placement &placement)
  {
    for (auto &triangle : triangles)
      for (auto &x : triangle)
        {
          x *= placement.scale;
          for (unsigned int axis = 0; axis < 3; ++axis)
            {
              // whole quarters turn without round-off
              const double angle   = std::remainder(placement.angles[axis], 360.);
              const double turn    = angle * dealii::numbers::PI / 180.;
              const bool   quarter = std::remainder(angle, 90.) == 0.;
              const double c       = quarter ? std::round(std::cos(turn)) : std::cos(turn),
                           s       = quarter ? std::round(std::sin(turn)) : std::sin(turn);
              const unsigned int i = (axis + 1) % 3, j = (axis + 2) % 3;
              const double       x_i = c * x[i] - s * x[j], x_j = s * x[i] + c * x[j];
              x[i] = x_i;
              x[j] = x_j;
            }
          x += placement.shift;
        }
    return triangles;
  }
} // namespace kedge
