#ifndef kedge_solvers_multigrid_h
#define kedge_solvers_multigrid_h

#include "distributed_matrix.h"

#include <Epetra_CrsMatrix.h>
#include <ml_MultiLevelPreconditioner.h>

#include <memory>

namespace kedge
{
  /**
   * Smoothed aggregation (ML) that keeps given vectors, which the matrix nearly
   * maps to zero, on all levels. Owns the matrix.
   */
  class Multigrid
  {
  public:
    /**
     * @param n_per_node   consecutive rows that are aggregated together
     * @param near_kernel  vectors one after the other, n_vectors of them
     */
    void
    reinit(std::unique_ptr<Epetra_CrsMatrix> matrix,
           const int                         n_per_node,
           std::vector<double>               near_kernel,
           const int                         n_vectors);

    /** One W-cycle; this rank's rows (collective). */
    void
    multiply(const std::vector<double> &x, std::vector<double> &y) const;

    /** Gives up the matrix and all levels. */
    void
    clear();

  private:
    std::vector<double>                                  near_kernel;
    std::unique_ptr<Epetra_CrsMatrix>                    matrix;
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> levels;
  };
} // namespace kedge

#endif
