#ifndef kedge_surfaces_facet_part_h
#define kedge_surfaces_facet_part_h

#include <kedge/base/expression.h>
#include <kedge/geometry/surface_mesh.h>
#include <kedge/grid/lattice.h>

namespace kedge
{
  /** A part of a facet: a line (2D) or a triangle (3D) on it. */
  template <int dim>
  struct FacetPart
  {
    /** Weights of the facet's corners at a place on it; their sum is one. */
    using Weights = std::array<double, dim>;

    std::array<Weights, dim> corners;

    /** The facet as a whole. */
    static FacetPart
    whole();

    /** Of the facet's area; what runs against the facet is negative. */
    double
    fraction() const;

    /** The place with the weights @p own of this part's corners, as weights of the facet's. */
    Weights
    place(const Weights &own) const;
  };

  /** A place on a part of a facet, and its share of the area. */
  template <int dim>
  struct FacetQuadraturePoint
  {
    typename FacetPart<dim>::Weights place; ///< weights of the part's corners
    double                           weight;
  };

  /**
   * Gauss points exact for polynomials of degree 5 on a line, 3 on a triangle (Gauss points of
   * two lines, one drawn together to a corner; Stroud 1971): the product of a cell's functions on
   * a plane.
   */
  template <int dim>
  const std::vector<FacetQuadraturePoint<dim>> &
  facet_quadrature();

  /** Where weights lead on a facet with the given corners [m]. */
  template <int dim>
  dealii::Point<dim>
  place_on_facet(const std::array<dealii::Point<dim>, dim> &corners,
                 const typename FacetPart<dim>::Weights    &weights);

  /**
   * The parts of a facet where @p where, of x, y, z and the outward unit normal nx, ny, nz, is
   * true. Its edge is found by bisection, to round-off in 2D; in 3D it is straight within a quarter
   * of the facet. What is smaller than a quarter of the facet may be missed.
   */
  template <int dim>
  std::vector<FacetPart<dim>>
  parts_where(const Expression &where, const std::array<dealii::Point<dim>, dim> &corners);

  /** A part of a facet with these corners cut along the grid's lines (planes): each of the
   * result lies in one cell. */
  template <int dim>
  std::vector<FacetPart<dim>>
  cut_to_cells(const Lattice<dim>                        &lattice,
               const std::array<dealii::Point<dim>, dim> &corners,
               const FacetPart<dim>                      &part);
} // namespace kedge

#endif
