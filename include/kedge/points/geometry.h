#ifndef kedge_points_geometry_h
#define kedge_points_geometry_h

#include <kedge/geometry/moments.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kedge
{
  /** How much of a box a region holds; cut also stands for "not known". */
  enum class Filling
  {
    empty,
    cut,
    full
  };

  /** Stretches of a line [begin, end), ascending and apart. */
  using Stretches = std::vector<std::pair<double, double>>;

  /** A region of space. */
  template <int dim>
  class Geometry
  {
  public:
    virtual ~Geometry() = default;

    /** True if @p x lies inside the region or on its surface. */
    bool
    contains(const dealii::Point<dim> &x) const
    {
      return level(x) <= surface_tolerance;
    }

    /**
     * Negative inside, zero on the surface, positive outside, in sizes of the
     * shape. Union and difference are minimum and maximum of it, so that
     * surfaces stay part of the region.
     */
    virtual double
    level(const dealii::Point<dim> &x) const = 0;

    /**
     * A box that holds the whole region; an implicit function, which knows no
     * bounds, returns @p domain (the background grid's box).
     */
    virtual dealii::BoundingBox<dim>
    bounding_box(const dealii::BoundingBox<dim> &domain) const = 0;

    /**
     * Whether the region holds all or nothing of @p box. Implicit functions are
     * sampled in and around the box: they may hide details smaller than it.
     */
    virtual Filling
    filling(const dealii::BoundingBox<dim> &box) const = 0;

    /**
     * The parts of the segment from @p start to start + @p length along an axis
     * that lie in the region, as distances from the start [m].
     */
    virtual Stretches
    inside(const dealii::Point<dim> &start,
           const unsigned int        direction,
           const double              length) const = 0;

    /**
     * The moments of the region's part within @p box about the box's centre, if
     * they are known in closed form.
     */
    virtual std::optional<VolumeMoments<dim>>
    exact_moments(const dealii::BoundingBox<dim> &box) const
    {
      (void)box;
      return std::nullopt;
    }

  private:
    /** How far outside a surface still counts as on it, in sizes of the shape. */
    static constexpr double surface_tolerance = 1e-12;
  };

  /**
   * Builds a geometry from its description: terms joined by + (union) and -
   * (difference), read from left to right, each one of
   *   box(x0, y0[, z0]; x1, y1[, z1]), ball(xc, yc[, zc]; r),
   *   cylinder(xa, ya, za; xb, yb, zb; r) (3D),
   *   polygon(x0, y0; x1, y1; ...) (2D),
   *   stl(file[; scale[; x, y, z[; a, b, c]]]) (3D): the inside of a closed
   *   surface, scaled, turned by a, b, c degrees about x, y and z, moved,
   *   implicit(phi), inside where the muParser expression phi(x, y, z) < 0,
   *   below(f), above(f): y < f and y > f, where f(x[, z]) is an expression.
   * All numbers may be expressions of the user's @p constants.
   *
   * @param folder where files with a relative name are searched; without it
   *               none is read, and the geometry says only if the text is right.
   * @throws UserError with the offending term.
   */
  template <int dim>
  std::shared_ptr<Geometry<dim>>
  parse_geometry(const std::string                          &description,
                 const std::map<std::string, double>        &constants,
                 const std::optional<std::filesystem::path> &folder = std::nullopt);

  /**
   * The same as parts that do not touch, in the order of their first terms: what is joined by +
   * is one part if it has a place in common, and - takes from all that stand before it. Places in
   * common are sought on a lattice over the box that both may fill: an overlap narrower than a
   * 64th of it is found only if it is a common side along the axes.
   *
   * @param domain where implicit functions, which know no bounds, are looked at
   */
  template <int dim>
  std::vector<std::shared_ptr<Geometry<dim>>>
  parse_pieces(const std::string                          &description,
               const dealii::BoundingBox<dim>             &domain,
               const std::map<std::string, double>        &constants,
               const std::optional<std::filesystem::path> &folder = std::nullopt);
} // namespace kedge

#endif
