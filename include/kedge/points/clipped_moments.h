#ifndef kedge_points_clipped_moments_h
#define kedge_points_clipped_moments_h

#include <kedge/points/geometry.h>

namespace kedge
{
  /**
   * Volume, first and second moments, about the box's centre, of the part of
   * @p geometry within @p box.
   *
   * In closed form where the geometry has one. Otherwise by lines: along the axis
   * that crosses the surface most, the stretches inside are integrated exactly;
   * across, by adaptive Gauss-Kronrod quadrature in one (2D) or two nested
   * directions (3D). Each starts from pieces cut where the surface meets the edges
   * of the box, between which the integrand is smooth; edges of the body that
   * remain are found by bisection. A box whose corners all lie on one side is cut into
   * parts first, so that bulges through its sides are seen. The moments are good to about 1e-7 of
   * the box's.
   */
  template <int dim>
  VolumeMoments<dim>
  clipped_moments(const Geometry<dim> &geometry, const dealii::BoundingBox<dim> &box);
} // namespace kedge

#endif
