#ifndef kedge_surfaces_seed_surface_h
#define kedge_surfaces_seed_surface_h

#include <kedge/geometry/surface_mesh.h>
#include <kedge/points/geometry.h>

namespace kedge
{
  /**
   * The surface of a region, with facets of about @p spacing [m]: in closed form for boxes,
   * balls, cylinders, polygons and closed surfaces of triangles, and for such parts that lie
   * apart. Of any other region it is cut out of a lattice of simplices (marching triangles or
   * tetrahedra) of that width: vertices stand on the region's surface to round-off, corners and
   * edges of the region are cut off by up to the spacing.
   *
   * @param domain what is looked at of regions that know no bounds
   */
  template <int dim>
  SurfaceMesh<dim>
  seed_surface(const Geometry<dim>            &geometry,
               const double                    spacing,
               const dealii::BoundingBox<dim> &domain);

  /** The surface cut out of the lattice, whatever is known in closed form. */
  template <int dim>
  SurfaceMesh<dim>
  march_surface(const Geometry<dim>            &geometry,
                const double                    spacing,
                const dealii::BoundingBox<dim> &domain);
} // namespace kedge

#endif
