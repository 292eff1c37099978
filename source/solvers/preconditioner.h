#ifndef kedge_source_solvers_preconditioner_h
#define kedge_source_solvers_preconditioner_h

#include "distributed_matrix.h"

namespace kedge
{
  /** An approximate inverse of a scaled matrix that may serve for later matrices too. */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    /** Takes a new pattern (collective). */
    virtual void
    analyse(const SparseSystem &system) = 0;

    /** Takes new values (collective); may throw. */
    virtual void
    factorise(const DistributedMatrix &matrix) = 0;

    /** Takes new values that those factorised serve for (collective). */
    virtual void
    follow(const DistributedMatrix &)
    {}

    /** y = P^-1 x; @p matrix is the present one (collective). */
    virtual void
    multiply(const DistributedMatrix &matrix, const double *x, double *y) = 0;
  };
} // namespace kedge

#endif
