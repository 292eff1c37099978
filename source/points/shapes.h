#ifndef kedge_source_points_shapes_h
#define kedge_source_points_shapes_h

#include <kedge/base/expression.h>
#include <kedge/geometry/triangle_surface.h>
#include <kedge/points/geometry.h>

namespace kedge
{
  // The shapes that a description is made of. Each throws a UserError that says
  // what is wrong with its numbers.

  template <int dim>
  using Shape = std::shared_ptr<Geometry<dim>>;

  template <int dim>
  Shape<dim>
  make_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper);

  template <int dim>
  Shape<dim>
  make_ball(const dealii::Point<dim> &centre, const double radius);

  /** A straight circular cylinder between the centres of its two end faces. */
  template <int dim>
  Shape<dim>
  make_cylinder(const dealii::Point<dim> &begin,
                const dealii::Point<dim> &end,
                const double              radius);

  /** The inside of a closed line through @p corners, in either sense of rotation. */
  Shape<2>
  make_polygon(const std::vector<dealii::Point<2>> &corners);

  /** The inside of a closed surface. */
  Shape<3>
  make_enclosed(const std::shared_ptr<const TriangleSurface> &surface);

  /** Inside where @p phi of the coordinates is negative. */
  template <int dim>
  Shape<dim>
  make_implicit(const Expression &phi);

  template <int dim>
  Shape<dim>
  make_union(const Shape<dim> &a, const Shape<dim> &b);

  template <int dim>
  Shape<dim>
  make_difference(const Shape<dim> &a, const Shape<dim> &b);
} // namespace kedge

#endif
