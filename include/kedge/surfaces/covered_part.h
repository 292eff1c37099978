#ifndef kedge_surfaces_covered_part_h
#define kedge_surfaces_covered_part_h

#include <kedge/base/expression.h>

#include <deal.II/base/point.h>

namespace kedge
{
  /** The part of a face where a condition holds. */
  template <int dim>
  struct CoveredPart
  {
    double                 fraction = 0.; ///< of the face's area
    dealii::Tensor<1, dim> offset;        ///< of its centre from the face's [m]
  };

  /**
   * Area and centre of the part of a face, an interval or a rectangle that looks to @p side,
   * 2*direction + (0: low, 1: high), where @p where (of x, y, z and the normal nx, ny, nz) is
   * true. Edges are found by bisection, to
   * round-off in 2D and where they are straight along an axis in 3D; others to a
   * thousandth of the face. What is smaller than an eighth of the face may be missed.
   */
  template <int dim>
  CoveredPart<dim>
  covered_part(const Expression             &where,
               const dealii::Point<dim>     &centre,
               const unsigned int            side,
               const dealii::Tensor<1, dim> &half_lengths);
} // namespace kedge

#endif
