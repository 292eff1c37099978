#ifndef kedge_solvers_incomplete_lu_h
#define kedge_solvers_incomplete_lu_h

#include "distributed_matrix.h"

namespace kedge
{
  /**
   * ILU(0) of this rank's diagonal block of a scaled matrix, without its small
   * entries: of the many couplings of wide stencils (375 per row in 3D GIMP)
   * few matter. With a threshold of 0.01 the factors hold a sixth of the
   * entries and take a thirtieth of the time, for twice the iterations.
   */
  class IncompleteLu
  {
  public:
    void
    factorise(const DistributedMatrix &matrix);

    /** Overwrites x with (L U)^-1 x. */
    void
    solve(double *x) const;

  private:
    void
    copy_large_entries(const DistributedMatrix &matrix);

    std::vector<std::int64_t> row_start, diagonal;
    std::vector<int>          column;
    std::vector<double>       value; ///< L without its diagonal of ones; U, its pivots inverted
    std::vector<std::int64_t> place; ///< of a column in the present row, or -1
  };
} // namespace kedge

#endif
