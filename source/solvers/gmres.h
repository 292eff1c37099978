#ifndef kedge_solvers_gmres_h
#define kedge_solvers_gmres_h

#include <mpi.h>

#include <functional>
#include <vector>

namespace kedge
{
  /** y = A x, or y = P^-1 x, of distributed vectors. */
  using LinearMap = std::function<void(const double *x, double *y)>;

  struct GmresResult
  {
    bool         success    = false;
    unsigned int iterations = 0;
  };

  /**
   * Restarted GMRES with the preconditioner on the right, so that the residual
   * it minimises is that of A x = b itself. Starts from x = 0 and ends when
   * the true residual is below tolerance |b| (collective).
   */
  GmresResult
  solve_gmres(const LinearMap           &matrix,
              const LinearMap           &preconditioner,
              const std::vector<double> &b,
              std::vector<double>       &x,
              const double               tolerance,
              const unsigned int         max_iterations,
              const MPI_Comm             communicator);
} // namespace kedge

#endif
