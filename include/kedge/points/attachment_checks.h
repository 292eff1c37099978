#ifndef kedge_points_attachment_checks_h
#define kedge_points_attachment_checks_h

#include <kedge/points/generation.h>

namespace kedge
{
  // Whether what a scene attaches to material points and nodes finds any.

  /**
   * Holds what is to act or be looked at at @p place to the material point nearest to it:
   * it may be as far from its centre as two of its domains reach, so that places on the
   * body's surface and its corners are near.
   *
   * @param what  for the message: "Point load 'tip'"
   * @throws UserError that says how far away the body is.
   */
  template <int dim>
  void
  check_nearness(const std::string            &what,
                 const dealii::Point<dim>     &place,
                 const dealii::Point<dim>     &nearest,
                 const dealii::Tensor<1, dim> &half_lengths);

  /**
   * Whether the face of a point's domain on a side lies elsewhere than the body's surface: in the
   * middle of the face, the surface is not where the domain ends.
   */
  template <int dim>
  bool
  lies_off_the_surface(const PointOrigin<dim> &point,
                       const unsigned int      side,
                       const Geometry<dim>    &geometry);

  /** @throws UserError if the Where of a node condition is true at no node of the grid. */
  template <int dim>
  void
  check_node_conditions(const std::vector<NodeConditionParameters<dim>> &conditions,
                        const std::map<std::string, double>             &constants,
                        const Lattice<dim>                              &lattice);

  /**
   * How many nodes of cells with material points each node condition holds. One that
   * holds none does nothing until a body comes to it, or is at the wrong place.
   */
  template <int dim>
  std::vector<std::size_t>
  count_held_nodes(const std::vector<NodeConditionParameters<dim>> &conditions,
                   const std::map<std::string, double>             &constants,
                   const GridLevels<dim>                           &levels,
                   const std::vector<PointOrigin<dim>>             &points);
} // namespace kedge

#endif
