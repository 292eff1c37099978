#ifndef kedge_geometry_surface_mesh_h
#define kedge_geometry_surface_mesh_h

#include <kedge/geometry/triangle_surface.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace kedge
{
  /**
   * The surface of a body as vertices and flat facets between them: in 2D lines that have the
   * body on their left, in 3D triangles that run counter-clockwise seen from outside.
   */
  template <int dim>
  struct SurfaceMesh
  {
    std::vector<dealii::Point<dim>>            vertices;
    std::vector<std::array<unsigned int, dim>> facets;
    /** Of each facet, whether it has left the grid with its material; empty if none has. Those
     * that have keep their number and are where they were last, but touch nothing any more. */
    std::vector<bool> left;

    bool
    has_left(const unsigned int facet) const
    {
      return !left.empty() && left[facet];
    }

    std::array<dealii::Point<dim>, dim>
    corners(const unsigned int facet) const;

    /** Adds another surface, whose vertices stay its own. */
    void
    append(const SurfaceMesh &other);
  };

  /** Outward normal of a facet times its area (length in 2D) [m^2; m]. */
  template <int dim>
  dealii::Tensor<1, dim>
  area_vector(const std::array<dealii::Point<dim>, dim> &corners);

  // Surfaces of simple bodies, with facets of edges of at most (polygon, box, triangles) or about
  // the given spacing [m]. Vertices lie on the surface; corners and edges of the body are kept.

  /** Of a closed line through @p corners, counter-clockwise. */
  SurfaceMesh<2>
  mesh_of_polygon(const std::vector<dealii::Point<2>> &corners, const double spacing);

  template <int dim>
  SurfaceMesh<dim>
  mesh_of_box(const dealii::Point<dim> &lower,
              const dealii::Point<dim> &upper,
              const double              spacing);

  /** Of a disc: a regular polygon; of a ball: an icosahedron divided evenly. */
  template <int dim>
  SurfaceMesh<dim>
  mesh_of_ball(const dealii::Point<dim> &centre, const double radius, const double spacing);

  /** Of a straight circular cylinder between the centres of its end faces. */
  SurfaceMesh<3>
  mesh_of_cylinder(const dealii::Point<3> &begin,
                   const dealii::Point<3> &end,
                   const double            radius,
                   const double            spacing);

  /** Of a closed surface: its triangles, divided where edges are longer than @p spacing. */
  SurfaceMesh<3>
  mesh_of_triangles(const TriangleSurface &surface, const double spacing);
} // namespace kedge

#endif
