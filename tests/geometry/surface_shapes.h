#ifndef tests_geometry_surface_shapes_h
#define tests_geometry_surface_shapes_h

#include <kedge/base/exceptions.h>
#include <kedge/geometry/triangle_surface.h>

#include <deal.II/base/numbers.h>

#include <cmath>

// Surfaces that tests make for themselves.
namespace surface_tests
{
  using namespace kedge;
  using dealii::Point;
  using dealii::Tensor;

  /** A box between two corners: two facets on each side, those of x- first. */
  inline std::vector<Triangle>
  box(const Point<3> &lower, const Point<3> &upper)
  {
    const auto at = [&](const unsigned int corner) {
      Point<3> x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = ((corner >> d) & 1u) != 0 ? upper[d] : lower[d];
      return x;
    };
    std::vector<Triangle> result;
    for (const auto &q : {std::array<unsigned int, 4>{{0, 4, 6, 2}},
                          std::array<unsigned int, 4>{{1, 3, 7, 5}},
                          std::array<unsigned int, 4>{{0, 1, 5, 4}},
                          std::array<unsigned int, 4>{{2, 6, 7, 3}},
                          std::array<unsigned int, 4>{{0, 2, 3, 1}},
                          std::array<unsigned int, 4>{{4, 5, 7, 6}}})
      {
        result.push_back({{at(q[0]), at(q[1]), at(q[2])}});
        result.push_back({{at(q[0]), at(q[2]), at(q[3])}});
      }
    return result;
  }

  /** The surface of a torus about the axis z by n x n quadrilaterals. */
  inline std::vector<Triangle>
  torus(const double R, const double r, const unsigned int n)
  {
    const auto at = [&](const unsigned int i, const unsigned int j) {
      const double a = 2 * dealii::numbers::PI * (i % n) / n,
                   b = 2 * dealii::numbers::PI * (j % n) / n;
      return Point<3>((R + r * std::cos(b)) * std::cos(a),
                      (R + r * std::cos(b)) * std::sin(a),
                      r * std::sin(b));
    };
    std::vector<Triangle> result;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          result.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
          result.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
        }
    return result;
  }

  inline std::string
  message_of(const std::vector<Triangle> &triangles)
  {
    try
      {
        TriangleSurface surface(triangles);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace surface_tests

#endif
