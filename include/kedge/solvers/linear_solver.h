#ifndef kedge_solvers_linear_solver_h
#define kedge_solvers_linear_solver_h

#include <kedge/solvers/mixed_blocks.h>
#include <kedge/solvers/parameters.h>
#include <kedge/solvers/sparse_system.h>

#include <memory>
#include <string>

namespace kedge
{
  /** How a factorisation or a solve ended. */
  struct LinearStatus
  {
    bool         success    = true;
    unsigned int iterations = 0;  ///< of Krylov methods; 0 for direct ones
    std::int64_t equation   = -1; ///< global equation that looks singular, if known
    std::string  cause;           ///< empty on success
    /**
     * Largest over smallest pivot of the scaled matrix, at least the size of
     * its condition number in most cases; 0 where the method gives none.
     */
    double       condition_estimate = 0.;
    std::int64_t weakest_equation   = -1; ///< of the smallest pivot, if known

    static LinearStatus
    failure(const std::string &cause, const std::int64_t equation = -1)
    {
      LinearStatus status;
      status.success  = false;
      status.cause    = cause;
      status.equation = equation;
      return status;
    }
  };

  /** What is known of a matrix beforehand; steers the choice of `automatic`. */
  struct MatrixTraits
  {
    int  space_dimension      = 2;
    bool positive_definite    = false; ///< symmetric positive definite
    bool dominated_by_inertia = false; ///< well conditioned: ILU will do
    bool mixed                = false; ///< displacements and pressures
    bool multipliers          = false; ///< some rows have no diagonal: direct methods only
  };

  /**
   * Solves sparse systems, choosing the method by what it is expected to cost:
   * band Cholesky or band LU for narrow matrices, UMFPACK for others, GMRES
   * with ILU(0) or algebraic multigrid (ML) for large ones, by blocks if they
   * mix displacements and pressures. GMRES works on all ranks. Rows and columns are scaled by
   * 1/sqrt|diagonal| first, so that nodes of little mass do no harm; those of multipliers, which
   * have none, by what their couplings are then, and only direct methods take them. Direct
   * methods gather the system on rank 0. Chosen by `automatic`, an iterative
   * method that costs more than a direct one leaves the system to that.
   */
  class LinearSolver
  {
  public:
    LinearSolver(const LinearSolverParameters &parameters, const MatrixTraits &traits);
    ~LinearSolver();
    LinearSolver(LinearSolver &&) noexcept;
    LinearSolver &
    operator=(LinearSolver &&) noexcept;

    /** Announces a new pattern; the next factorise() analyses it. */
    void
    pattern_changed();

    /**
     * The method for systems of this pattern (collective). Of `krylov_blocks`,
     * which needs set_blocks() before factorise(), callers should know.
     */
    LinearSolverKind
    choose(const SparseSystem &system);

    /**
     * Says what the equations mean; refers to @p blocks, whose components and
     * positions change with the pattern only. A preconditioner that was kept
     * of earlier matrices is given up: to be called at the start of a step.
     */
    void
    set_blocks(const MixedBlocks &blocks);

    /**
     * Prepares the solution with the values of @p system (collective), which
     * must last until the last solve() with them.
     *
     * @param shift is added to the diagonal of the scaled matrix (whose
     *              diagonal is 1 otherwise) by direct methods: it makes a
     *              singular matrix soluble and leaves what it cannot determine
     *              small
     */
    LinearStatus
    factorise(const SparseSystem &system, const double shift = 0.);

    /**
     * Solves A x = b for this rank's rows (collective).
     *
     * @param tolerance relative residual that suffices; iterative methods stop
     *                  at it, or at that of the parameters if that is larger
     */
    LinearStatus
    solve(const std::vector<double> &b, std::vector<double> &x, const double tolerance = 0.);

    /** What a direct factorisation of such a system is expected to take [s] (collective). */
    double
    direct_time(const SparseSystem &system) const;

    /** The method in use, for the log. */
    std::string
    method() const;

    class Backend;

  private:
    LinearSolverParameters   parameters;
    MatrixTraits             traits;
    LinearSolverKind         chosen      = LinearSolverKind::automatic;
    bool                     new_pattern = true; ///< not yet seen by the backend
    bool                     to_choose   = true;
    const MixedBlocks       *blocks      = nullptr;
    std::unique_ptr<Backend> backend;

    const SparseSystem      *system         = nullptr; ///< of the last factorise()
    double                   shift          = 0.;
    unsigned int             max_iterations = 0;
    LinearSolverKind         substitute     = LinearSolverKind::automatic; ///< direct, if any
    std::unique_ptr<Backend> direct; ///< of the substitute, for this matrix only

    bool
    has_border() const;
    LinearSolverKind
    cheapest(const SparseSystem &system);
    std::unique_ptr<Backend>
    make_backend(const LinearSolverKind kind) const;
  };
} // namespace kedge

#endif
