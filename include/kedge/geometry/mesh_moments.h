#ifndef kedge_geometry_mesh_moments_h
#define kedge_geometry_mesh_moments_h

#include <kedge/geometry/moments.h>
#include <kedge/geometry/surface_mesh.h>

namespace kedge
{
  /**
   * Volume, first and second moments about @p place of what a closed surface encloses, by the
   * divergence theorem: the sum over its facets of the moments of the simplices between them and
   * the place, signed by the side on which they lie (exact to round-off).
   */
  template <int dim>
  VolumeMoments<dim>
  moments_of(const SurfaceMesh<dim> &mesh, const dealii::Point<dim> &place);
} // namespace kedge

#endif
