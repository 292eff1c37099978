#include <kedge/base/exceptions.h>
#include <kedge/geometry/surface_checks.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace kedge
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;
    using Places = std::vector<dealii::Point<3>>;

    std::string
    at(const dealii::Point<3> &x)
    {
      std::ostringstream text;
      text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
      return text.str();
    }

    /** Where the plane's side changes along the segment from @p a to @p b, if within it. */
    std::optional<dealii::Point<3>>
    meets_plane(const dealii::Point<3> &a,
                const dealii::Point<3> &b,
                const double            height_a,
                const double            height_b)
    {
      if (height_a * height_b > 0.)
        return std::nullopt;
      return a + height_a / (height_a - height_b) * (b - a);
    }

    /** How far @p x, in the plane of the triangle, lies within it at least [m]; negative outside.
     */
    double
    depth_within(const dealii::Point<3>                        &x,
                 const std::array<const dealii::Point<3> *, 3> &triangle,
                 const Vector                                  &normal)
    {
      double depth = std::numeric_limits<double>::max();
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Vector edge = *triangle[(i + 1) % 3] - *triangle[i];
          depth =
            std::min(depth, cross_product_3d(normal, edge) * (x - *triangle[i]) / edge.norm());
        }
      return depth;
    }

    /** Whether two segments in one plane cross within both. */
    bool
    segments_cross(const dealii::Point<3> &a,
                   const dealii::Point<3> &b,
                   const dealii::Point<3> &c,
                   const dealii::Point<3> &d,
                   const Vector           &normal,
                   const double            tolerance)
    {
      const auto side = [&](const dealii::Point<3> &from, const dealii::Point<3> &to) {
        const Vector across = cross_product_3d(normal, to - from) / (to - from).norm();
        return [across, from](const dealii::Point<3> &x) {
          return across * (x - from);
        };
      };
      const auto of_ab = side(a, b), of_cd = side(c, d);
      const auto apart = [&](const double one, const double other) {
        return (one > tolerance && other < -tolerance) || (one < -tolerance && other > tolerance);
      };
      return apart(of_ab(c), of_ab(d)) && apart(of_cd(a), of_cd(b));
    }

    /** A triangle with its plane and which of its corners another one shares. */
    struct Sheet
    {
      std::array<const dealii::Point<3> *, 3> corners;
      std::array<bool, 3>                     shared;
      Vector                                  normal;

      Sheet(const Places                      &places,
            const std::array<unsigned int, 3> &facet,
            const std::array<unsigned int, 3> &other)
      {
        for (unsigned int i = 0; i < 3; ++i)
          {
            corners[i] = &places[facet[i]];
            shared[i]  = std::find(other.begin(), other.end(), facet[i]) != other.end();
          }
        normal = cross_product_3d(*corners[1] - *corners[0], *corners[2] - *corners[0]);
        normal /= normal.norm();
      }

      double
      height(const dealii::Point<3> &x) const
      {
        return normal * (x - *corners[0]);
      }
    };

    /** Whether an edge of @p a without a shared corner meets @p b. */
    bool
    an_edge_meets(const Sheet &a, const Sheet &b, const double tolerance)
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3;
          if (a.shared[i] || a.shared[j])
            continue;
          const double height_i = b.height(*a.corners[i]), height_j = b.height(*a.corners[j]);
          if (std::abs(height_i) <= tolerance && std::abs(height_j) <= tolerance)
            continue; // in the plane: seen by the edges of b, or below
          const auto x = meets_plane(*a.corners[i], *a.corners[j], height_i, height_j);
          if (x && depth_within(*x, b.corners, b.normal) > -tolerance)
            {
              // a touch at a corner that both share is none
              bool is_shared = false;
              for (unsigned int k = 0; k < 3; ++k)
                is_shared = is_shared || (b.shared[k] && x->distance(*b.corners[k]) <= tolerance);
              if (!is_shared)
                return true;
            }
        }
      return false;
    }

    bool
    overlap_in_plane(const Sheet &a, const Sheet &b, const double tolerance)
    {
      for (const auto &corner : a.corners)
        if (std::abs(b.height(*corner)) > tolerance)
          return false;
      dealii::Point<3> middle_a, middle_b;
      for (unsigned int i = 0; i < 3; ++i)
        {
          if (!a.shared[i] && depth_within(*a.corners[i], b.corners, b.normal) > tolerance)
            return true;
          if (!b.shared[i] && depth_within(*b.corners[i], a.corners, a.normal) > tolerance)
            return true;
          for (unsigned int j = 0; j < 3; ++j)
            if (segments_cross(*a.corners[i],
                               *a.corners[(i + 1) % 3],
                               *b.corners[j],
                               *b.corners[(j + 1) % 3],
                               a.normal,
                               tolerance))
              return true;
          middle_a += *a.corners[i] / 3.;
          middle_b += *b.corners[i] / 3.;
        }
      // one on the other, with common corners
      return depth_within(middle_a, b.corners, b.normal) > tolerance ||
             depth_within(middle_b, a.corners, a.normal) > tolerance;
    }
  } // namespace



  void
  check_areas(const Places &vertices, const Facets &facets)
  {
    for (std::size_t i = 0; i < facets.size(); ++i)
      {
        const auto &a = vertices[facets[i][0]], &b = vertices[facets[i][1]],
                   &c = vertices[facets[i][2]];
        const double longest =
          std::max({(b - a).norm_square(), (c - b).norm_square(), (a - c).norm_square()});
        if (!(cross_product_3d(b - a, c - a).norm() > 1e-12 * longest))
          throw UserError("Facet " + std::to_string(i + 1) + " of the surface, with a corner at " +
                          at(a) + ", is degenerate: its corners lie on a line.");
      }
  }



  Facets
  find_neighbours(const Places &vertices, const Facets &facets)
  {
    struct Side
    {
      unsigned int facet, edge;
      bool         forward;
    };
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Side>> sides;
    for (unsigned int f = 0; f < facets.size(); ++f)
      for (unsigned int e = 0; e < 3; ++e)
        {
          const unsigned int a = facets[f][e], b = facets[f][(e + 1) % 3];
          sides[std::minmax(a, b)].push_back({f, e, a < b});
        }
    Facets neighbours(facets.size());
    for (const auto &[edge, of_edge] : sides)
      {
        const std::string place =
          " at the edge from " + at(vertices[edge.first]) + " to " + at(vertices[edge.second]);
        const auto name = [&of_edge = of_edge](const std::size_t i) {
          return std::to_string(of_edge[i].facet + 1);
        };
        if (of_edge.size() == 1)
          throw UserError("The surface is open: facet " + name(0) + " has no neighbour" + place +
                          ".");
        if (of_edge.size() > 2)
          throw UserError("Facets " + name(0) + ", " + name(1) + " and " + name(2) +
                          " of the surface meet" + place + ", which must belong to two.");
        if (of_edge[0].forward == of_edge[1].forward)
          throw UserError("Facets " + name(0) + " and " + name(1) +
                          " of the surface are turned against each other" + place +
                          ": one has its outside where the other has its inside.");
        neighbours[of_edge[0].facet][of_edge[0].edge] = of_edge[1].facet;
        neighbours[of_edge[1].facet][of_edge[1].edge] = of_edge[0].facet;
      }
    return neighbours;
  }



  bool
  intersect(const Places                      &vertices,
            const std::array<unsigned int, 3> &a,
            const std::array<unsigned int, 3> &b,
            const double                       tolerance)
  {
    const Sheet first(vertices, a, b), second(vertices, b, a);
    return an_edge_meets(first, second, tolerance) || an_edge_meets(second, first, tolerance) ||
           overlap_in_plane(first, second, tolerance);
  }
} // namespace kedge
