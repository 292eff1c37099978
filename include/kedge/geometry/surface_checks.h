#ifndef kedge_geometry_surface_checks_h
#define kedge_geometry_surface_checks_h

#include <kedge/geometry/triangle_surface.h>

#include <functional>

namespace kedge
{
  // Whether triangles bound a body. Facets are counted from 1 in messages.

  using Facets = std::vector<std::array<unsigned int, 3>>;

  /** @throws UserError if a facet has no area: less than 1e-12 of its longest edge squared. */
  void
  check_areas(const std::vector<dealii::Point<3>> &vertices, const Facets &facets);

  /**
   * The facets beyond each edge, from a facet's corner to its next.
   *
   * @throws UserError if an edge belongs to one facet or to more than two, or if its two
   *         facets run through it in the same direction.
   */
  Facets
  find_neighbours(const std::vector<dealii::Point<3>> &vertices, const Facets &facets);

  /**
   * True if two triangles have more in common than the corners that they share: they cross,
   * touch or overlap.
   *
   * @param tolerance of distances [m]
   */
  bool
  intersect(const std::vector<dealii::Point<3>> &vertices,
            const std::array<unsigned int, 3>   &a,
            const std::array<unsigned int, 3>   &b,
            const double                         tolerance);
} // namespace kedge

#endif
