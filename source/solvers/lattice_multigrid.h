#ifndef kedge_source_solvers_lattice_multigrid_h
#define kedge_source_solvers_lattice_multigrid_h

#include "incomplete_lu.h"
#include "lattice_levels.h"
#include "preconditioner.h"

#include <kedge/solvers/linear_solver.h>

namespace kedge
{
  /**
   * Geometric multigrid on the background lattice, on one rank. From level to level the spacing
   * doubles; the matrices of coarse levels are P^T A P (LatticeTransfer). A cycle goes down and up
   * once: a sweep with incomplete factors of each node's blocks (IncompleteLu) before and after the
   * coarse correction, a direct solution on the smallest level. The sweeps need no bounds of
   * eigenvalues and stand slivers, contrasts and unsymmetric matrices. The finest level
   * multiplies with the present matrix, even if the others are of an earlier one.
   */
  class LatticeMultigrid : public Preconditioner
  {
  public:
    explicit LatticeMultigrid(LatticeLevel finest);
    ~LatticeMultigrid() override;

    void
    analyse(const SparseSystem &system) override;

    void
    factorise(const DistributedMatrix &matrix) override;

    void
    multiply(const DistributedMatrix &matrix, const double *x, double *y) override;

  private:
    struct Level
    {
      LatticeLevel                   nodes;
      std::optional<LatticeTransfer> to_coarser; ///< none on the smallest level
      SparseSystem                   system;     ///< of coarse levels
      DistributedMatrix              matrix;     ///< of coarse levels
      std::unique_ptr<IncompleteLu>  smoother;
      std::vector<double>            scaling;
      std::vector<double>            x, b, residual, change; ///< scaled
    };

    static void
    set_up_smoother(Level &level, const DistributedMatrix &matrix);
    static double
    largest_eigenvalue(Level &level, const DistributedMatrix &matrix);
    static void
    smooth(Level &level, const DistributedMatrix &matrix);
    static void
    find_residual(Level &level, const DistributedMatrix &matrix);
    void
    solve_smallest(Level &level);
    void
    cycle(const std::size_t l, const DistributedMatrix &matrix);

    std::vector<Level>                     levels;
    std::unique_ptr<LinearSolver::Backend> smallest;
  };
} // namespace kedge

#endif
