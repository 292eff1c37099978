#ifndef kedge_solvers_gathered_backend_h
#define kedge_solvers_gathered_backend_h

#include "backend.h"

namespace kedge
{
  /**
   * Base of the direct methods: brings the whole system, scaled from both
   * sides (see scale_by_diagonal()), to rank 0, where the derived class
   * solves it, and deals the solution out again.
   */
  class GatheredBackend : public LinearSolver::Backend
  {
  public:
    LinearStatus
    factorise(const SparseSystem &system, const bool new_pattern, const double shift) final;

    LinearStatus
    solve(const std::vector<double> &b,
          std::vector<double>       &x,
          const double               tolerance,
          const unsigned int         max_iterations) final;

  protected:
    /**
     * A pivot of the scaled matrix (diagonal 1, or 0 for multipliers) below this is taken for
     * zero: the solution would have no correct digit.
     */
    static constexpr double smallest_pivot = 1e-15;

    /** Entries of the scaled matrix that differ by less are the same but for round-off. */
    static constexpr double symmetry_tolerance = 1e-13;

    /** The gathered, scaled matrix; filled on rank 0 only. */
    struct Matrix
    {
      int                 n = 0;
      std::vector<int>    row_start;
      std::vector<int>    column;
      std::vector<double> value;
    };

    /** True if the matrix equals its transpose to within round-off. */
    static bool
    is_symmetric(const Matrix &matrix);

    virtual LinearStatus
    factorise_gathered(const Matrix &matrix, const bool new_pattern) = 0;

    /** Overwrites @p x, the right-hand side on entry, with the solution. */
    virtual LinearStatus
    solve_gathered(std::vector<double> &x) = 0;

  private:
    void
    gather_pattern(const SparseSystem &system);

    MPI_Comm            communicator = MPI_COMM_SELF;
    int                 rank = 0, n_ranks = 1;
    std::vector<int>    rows_of_rank, first_row_of_rank, entries_of_rank, first_entry_of_rank;
    Matrix              matrix;
    std::vector<double> scaling;
  };
} // namespace kedge

#endif
