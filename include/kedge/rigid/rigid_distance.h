#ifndef kedge_rigid_rigid_distance_h
#define kedge_rigid_rigid_distance_h

#include <kedge/rigid/rigid_bodies.h>

namespace kedge
{
  /**
   * How far each place is from the nearest surface of the rigid bodies as they stand, within a body
   * too [m]; the largest number there is if none of them has a shape.
   */
  template <int dim>
  std::vector<double>
  distances_to_surfaces(const RigidBodies<dim>                &bodies,
                        const std::vector<dealii::Point<dim>> &places);
} // namespace kedge

#endif
