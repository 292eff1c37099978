#ifndef kedge_surfaces_surface_facets_h
#define kedge_surfaces_surface_facets_h

#include <kedge/surfaces/body_surface.h>
#include <kedge/surfaces/facet_part.h>
#include <kedge/surfaces/parameters.h>
#include <kedge/surfaces/surface_point.h>

namespace kedge
{
  /** A place on a body's surface, and the part of its area that it stands for. */
  template <int dim>
  struct PlaceOfSurface
  {
    dealii::Point<dim> place; ///< [m]
    double             area;  ///< [m^2; m in 2D]
  };

  /**
   * The facets of surfaces that bodies carry on which something is prescribed, as points of a
   * quadrature. In each configuration the facets are cut along the lines of the grid, so that
   * each part lies in one cell, whose own functions serve there: over the surface of a
   * body they integrate to what their gradients do over its volume, and
   *   int_Gamma N_A sigma n da = int_Omega sigma grad N_A dv
   * holds node by node for a uniform stress. As these functions are continuous from cell to cell, a
   * closed surface stays closed in all that a step tries, and a uniform pressure on it has no
   * resultant and no moment. A cell without material has the functions of the cell of the nearest
   * material point, continued: nodes that nothing belongs to bear nothing.
   */
  template <int dim>
  class SurfaceFacets
  {
  public:
    /**
     * Takes the facets of a surface as it was seeded, or the parts of them, that look to the side
     * of @p parameters and where @p where is true (of x, y, z and the normal nx, ny, nz).
     *
     * @param number of the surface in what is prescribed
     * @return points of a quadrature on them, at the start of the run
     */
    std::vector<PlaceOfSurface<dim>>
    choose(const unsigned int       number,
           const SurfaceParameters &parameters,
           const Expression        &where,
           const BodySurface<dim>  &surface);

    /**
     * Adds the points of the facets on bodies of a field as they are at the start of a step: on
     * several ranks each where material lies in its cell, or else where the nearest point is
     * (collective). Where a surface has other facets than before, they are chosen anew, as they
     * were at the start.
     */
    void
    add_points(const Patch<dim> &patch, std::vector<SurfacePoint<dim>> &points);

  private:
    struct Part
    {
      unsigned int   facet;
      double         area; ///< undeformed, of the whole facet [m^2]
      FacetPart<dim> covered;
    };

    struct Chosen
    {
      unsigned int            number;
      unsigned int            side;
      Expression              where;
      const BodySurface<dim> *surface;
      unsigned int            generation = 0; ///< of the surface's facets
      std::vector<Part>       parts;
    };

    /** A quadrature point on a facet, whose functions are to be found. */
    struct Candidate
    {
      SurfacePoint<dim> point;
      LatticeIndex<dim> cell; ///< of the window that it belongs to: below the facet
    };

    static void
    choose_parts(Chosen &chosen);
    static std::vector<Candidate>
    candidates_on(const Chosen &here, const GridLevels<dim> &levels);

    std::vector<Chosen> chosen;
  };
} // namespace kedge

#endif
