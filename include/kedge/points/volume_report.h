#ifndef kedge_points_volume_report_h
#define kedge_points_volume_report_h

#include <kedge/points/generation.h>

#include <ostream>

namespace kedge
{
  /**
   * The moments of a body's geometry about the origin, by clipping it to the cells of the
   * grid: a sum of its own, which knows nothing of material points.
   */
  template <int dim>
  VolumeMoments<dim>
  geometry_moments(const Geometry<dim> &geometry, const Lattice<dim> &lattice);

  /** The moments of the material points of a body about the origin, each a box of its half-lengths.
   */
  template <int dim>
  VolumeMoments<dim>
  points_moments(const std::vector<PointOrigin<dim>> &points, const unsigned int body);

  /**
   * Writes volume and centre of each body, and how far its material points are from both,
   * and from its polar moment of inertia about the centre.
   */
  template <int dim>
  void
  write_volumes(std::ostream                           &out,
                const std::vector<BodyParameters<dim>> &bodies,
                const Lattice<dim>                     &lattice,
                const std::vector<PointOrigin<dim>>    &points);
} // namespace kedge

#endif
