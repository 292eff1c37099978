#ifndef kedge_simulation_wall_plane_h
#define kedge_simulation_wall_plane_h

#include <kedge/contact/wall_term.h>

namespace kedge
{
  /** The plane of a contact with a wall. */
  template <int dim>
  WallPlane<dim>
  plane_of(const ContactParameters &contact, const Lattice<dim> &lattice)
  {
    WallPlane<dim> plane;
    for (int d = 0; d < dim; ++d)
      plane.point[d] =
        contact.wall_side % 2 == 1 ? lattice.upper(d) : lattice.origin[d]; // a corner of the side
    plane.normal[contact.wall_side / 2] = contact.wall_side % 2 == 1 ? -1. : 1.;
    for (std::size_t d = 0; d < contact.wall_point.size(); ++d)
      plane.point[d] = contact.wall_point[d];
    for (std::size_t d = 0; d < contact.wall_normal.size(); ++d)
      plane.normal[d] = contact.wall_normal[d];
    plane.normal /= plane.normal.norm();
    return plane;
  }
} // namespace kedge

#endif
