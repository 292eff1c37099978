#ifndef kedge_solvers_incomplete_lu_h
#define kedge_solvers_incomplete_lu_h

#include "distributed_matrix.h"

#include <memory>

namespace kedge
{
  /**
   * ILU(0) of a scaled matrix in blocks of the rows of a node, without the
   * small ones: of the many couplings of wide stencils (375 per row in 3D
   * GIMP) few matter. Computed with doubles, kept as floats. On several ranks
   * a restricted additive Schwarz method (Cai and Sarkis 1999): each factorises
   * its rows and those they are coupled with, and uses the solution in its own.
   */
  class IncompleteLu
  {
  public:
    virtual ~IncompleteLu() = default;

    /** Takes a new pattern (collective). */
    virtual void
    reinit(const DistributedMatrix &matrix) = 0;

    /** Takes new values of the same pattern (collective). */
    virtual void
    factorise(const DistributedMatrix &matrix) = 0;

    /** y = (L U)^-1 x for this rank's rows (collective). */
    virtual void
    multiply(const DistributedMatrix &matrix, const double *x, double *y) = 0;
  };

  /**
   * @param block_size rows that nodes have: 2 or 3; not all need as many
   * @param damping    is added to the diagonal of what is factorised, 1 otherwise
   */
  std::unique_ptr<IncompleteLu>
  make_incomplete_lu(const int block_size, const double damping = 0.);
} // namespace kedge

#endif
