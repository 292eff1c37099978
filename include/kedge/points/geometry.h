#ifndef kedge_points_geometry_h
#define kedge_points_geometry_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <map>
#include <memory>
#include <string>

namespace kedge
{
  /** A region of space that can say whether it contains a point. */
  template <int dim>
  class Geometry
  {
  public:
    virtual ~Geometry() = default;

    /** True if @p x lies inside the region or on its surface. */
    virtual bool
    contains(const dealii::Point<dim> &x) const = 0;

    /**
     * A box that holds the whole region; an implicit function, which knows no
     * bounds, returns @p domain (the background grid's box).
     */
    virtual dealii::BoundingBox<dim>
    bounding_box(const dealii::BoundingBox<dim> &domain) const = 0;
  };

  /**
   * Builds a geometry from its description: terms joined by + (union) and -
   * (difference), read from left to right, each one of
   *   box(x0, y0[, z0]; x1, y1[, z1]), ball(xc, yc[, zc]; r),
   *   cylinder(xa, ya, za; xb, yb, zb; r) (3D), implicit(phi), inside where
   *   the muParser expression phi(x, y, z) < 0.
   * All numbers may be expressions of the user's @p constants.
   *
   * @throws UserError with the offending term.
   */
  template <int dim>
  std::shared_ptr<Geometry<dim>>
  parse_geometry(const std::string &description, const std::map<std::string, double> &constants);
} // namespace kedge

#endif
