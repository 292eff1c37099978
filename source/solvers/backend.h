#ifndef kedge_solvers_backend_h
#define kedge_solvers_backend_h

#include <kedge/solvers/linear_solver.h>

namespace kedge
{
  /** One way to solve linear systems; see LinearSolver for the contract. */
  class LinearSolver::Backend
  {
  public:
    virtual ~Backend() = default;

    virtual LinearStatus
    factorise(const SparseSystem &system, const bool new_pattern, const double shift) = 0;

    /** Direct methods have no use for a tolerance and a number of iterations. */
    virtual LinearStatus
    solve(const std::vector<double> &b,
          std::vector<double>       &x,
          const double               tolerance,
          const unsigned int         max_iterations) = 0;

    /** Whatever is kept of earlier matrices must not be used for the next. */
    virtual void
    forget()
    {}
  };

  std::unique_ptr<LinearSolver::Backend>
  make_banded_backend();

  std::unique_ptr<LinearSolver::Backend>
  make_umfpack_backend();

  std::unique_ptr<LinearSolver::Backend>
  make_krylov_backend(const MatrixTraits &traits, const bool multigrid);

  /** @p blocks must last as long as the backend; their matrices may change with each system. */
  std::unique_ptr<LinearSolver::Backend>
  make_mixed_backend(const MixedBlocks &blocks);

  /**
   * Multigrid for displacements, whose nodes @p blocks knows: on their lattice if one rank
   * has all equations, algebraic otherwise. @p blocks must last as long as the backend.
   */
  std::unique_ptr<LinearSolver::Backend>
  make_lattice_backend(const MixedBlocks &blocks);
} // namespace kedge

#endif
