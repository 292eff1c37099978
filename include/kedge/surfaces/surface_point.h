#ifndef kedge_surfaces_surface_point_h
#define kedge_surfaces_surface_point_h

#include <kedge/basis/stencil.h>

namespace kedge
{
  /**
   * A place on a body's surface that stands for a part of it, in configuration n: the outer face
   * of a material point, or a quadrature point on a facet.
   */
  template <int dim>
  struct SurfacePoint
  {
    unsigned int       slot;            ///< of the point whose face it is, or of the nearest one
    unsigned int       surface;         ///< number of the surface
    double             offset[dim];     ///< from the point to the place [m]
    double             area[dim];       ///< outward normal times area [m^2]
    double             reference_area;  ///< undeformed [m^2]
    dealii::Point<dim> reference_place; ///< at the start of the run [m]
    Stencil<dim>       functions;       ///< of the nodes at the place: where forces go
    /** Of the same nodes: their gradients say how the area stretches and turns. */
    Stencil<dim>           gradients{};
    dealii::Tensor<1, dim> reference_normal; ///< outward unit vector at the start of the run
    dealii::Point<dim>     place{};          ///< in configuration n [m]
  };
} // namespace kedge

#endif
