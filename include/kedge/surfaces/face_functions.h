#ifndef kedge_surfaces_face_functions_h
#define kedge_surfaces_face_functions_h

#include <kedge/fields/patch.h>

#include <optional>

namespace kedge
{
  /**
   * The functions of a material point's nodes at a face of its domain: what acts on a
   * surface goes to the nodes by these and not by the point's own functions, which belong to the
   * middle of its domain. In the direction into which the face looks they are those
   * of the background grid at the face: for GIMP the functions whose mean slope over the domain
   * makes the internal force, so that the forces of a uniform stress and of
   * its traction cancel node by node, wherever the body ends within a cell. Along the face they
   * are the point's, continued linearly. They are a partition of unity and give linear
   * fields exactly: force and moment of a load are kept.
   *
   * @param slot   the point's
   * @param offset from the point to the face's centre, now [m]
   * @param area   normal times area, now [m^2]
   *
   * @return nodes and pattern of the point's stencil with other values; slopes are the point's
   */
  template <int dim>
  Stencil<dim>
  functions_at_face(const Patch<dim>  &patch,
                    const unsigned int slot,
                    const BasisKind    basis,
                    const double (&offset)[dim],
                    const double (&area)[dim]);

  /** The lattice between whose lines a body's functions are polynomials: splines have kinks in the
   * middle of the grid's cells. */
  template <int dim>
  inline Lattice<dim>
  lattice_of_polynomials(const Lattice<dim> &grid, const BasisKind basis)
  {
    Lattice<dim> result = grid;
    for (int d = 0; d < dim && basis == BasisKind::spline; ++d)
      {
        result.h[d] *= 0.5;
        result.n_cells[d] *= 2;
      }
    return result;
  }

  /**
   * The functions of the grid itself in a cell, at a place @p x in it or, continued, beyond it:
   * with their slopes. Of the quadratic basis those of the element that the cell belongs to, of
   * splines those of the half of the cell, per direction, that is nearer and has its nodes in use;
   * if none has, the linear ones.
   *
   * @return nothing if one of their nodes is not in use
   */
  template <int dim>
  std::optional<Stencil<dim>>
  functions_of_cell(const Patch<dim>         &patch,
                    const BasisKind           basis,
                    const LatticeIndex<dim>  &cell,
                    const dealii::Point<dim> &x);
} // namespace kedge

#endif
