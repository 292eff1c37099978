#include <kedge/solvers/linear_solver.h>

#include "backend.h"

namespace kedge
{
  namespace
  {
    /** Largest |row - column| over all ranks. */
    std::int64_t
    bandwidth(const SparseSystem &system)
    {
      std::int64_t width = 0;
      for (unsigned int i = 0; i < system.n_rows(); ++i)
        if (system.row_start[i + 1] > system.row_start[i])
          {
            const std::int64_t row = system.first_row + i;
            width                  = std::max({width,
                                               row - system.column[system.row_start[i]],
                                               system.column[system.row_start[i + 1] - 1] - row});
          }
      MPI_Allreduce(MPI_IN_PLACE, &width, 1, MPI_INT64_T, MPI_MAX, system.communicator);
      return width;
    }

    /**
     * Seconds that each method takes on one core of 2020's make; only ratios
     * matter. Fitted to measurements from 100 to 1e5 unknowns: matrices of
     * bars, blocks and beds of clay, 36 to 290 entries per row.
     */
    double
    banded_time(const double n, const double width)
    {
      return n * (6e-11 * width * width + 1e-8 * width + 1e-7);
    }

    double
    umfpack_time(const double n, const double n_entries, const int space_dimension)
    {
      const double per_row = n_entries / std::max(n, 1.);
      if (space_dimension == 2)
        return 6e-6 * n * std::pow(std::max(n, 1e3) / 1e4, 0.2) * std::max(per_row / 48., 1.);
      return 1e-4 * n * std::pow(std::max(n, 1e2) / 1.5e4, 1.1) * std::max(per_row / 81., 1.);
    }

    double
    krylov_time(const double n_entries, const bool multigrid)
    {
      return n_entries * (multigrid ? 8e-7 : 3e-7);
    }
  } // namespace



  LinearSolver::LinearSolver(const LinearSolverParameters &parameters, const MatrixTraits &traits)
    : parameters(parameters)
    , traits(traits)
  {}

  LinearSolver::~LinearSolver() = default;

  LinearSolver::LinearSolver(LinearSolver &&) noexcept = default;

  LinearSolver &
  LinearSolver::operator=(LinearSolver &&) noexcept = default;



  void
  LinearSolver::pattern_changed()
  {
    new_pattern = true;
  }



  void
  LinearSolver::choose(const SparseSystem &system)
  {
    LinearSolverKind kind = parameters.kind;
    if (kind == LinearSolverKind::automatic)
      {
        const double n       = static_cast<double>(system.n_global);
        double       entries = static_cast<double>(system.column.size());
        MPI_Allreduce(MPI_IN_PLACE, &entries, 1, MPI_DOUBLE, MPI_SUM, system.communicator);
        const bool   multigrid = !traits.dominated_by_inertia;
        const double banded    = banded_time(n, static_cast<double>(bandwidth(system)));
        const double direct    = umfpack_time(n, entries, traits.space_dimension);
        const double krylov    = krylov_time(entries, multigrid);
        if (krylov < std::min(banded, direct))
          kind = multigrid ? LinearSolverKind::krylov_amg : LinearSolverKind::krylov_ilu;
        else
          kind = banded < direct ? LinearSolverKind::banded : LinearSolverKind::direct;
      }
    if (backend && kind == chosen)
      return;
    chosen = kind;
    switch (kind)
      {
        case LinearSolverKind::banded:
          backend = make_banded_backend();
          break;
        case LinearSolverKind::krylov_ilu:
        case LinearSolverKind::krylov_amg:
          backend = make_krylov_backend(parameters, traits, kind == LinearSolverKind::krylov_amg);
          break;
        default:
          backend = make_umfpack_backend();
      }
  }



  LinearStatus
  LinearSolver::factorise(const SparseSystem &system, const double shift)
  {
    if (new_pattern)
      choose(system);
    const bool analyse = new_pattern;
    new_pattern        = false;
    return backend->factorise(system, analyse, shift);
  }



  LinearStatus
  LinearSolver::solve(const std::vector<double> &b, std::vector<double> &x)
  {
    return backend->solve(b, x);
  }



  std::string
  LinearSolver::method() const
  {
    switch (chosen)
      {
        case LinearSolverKind::banded:
          return "banded";
        case LinearSolverKind::krylov_ilu:
          return "krylov-ilu";
        case LinearSolverKind::krylov_amg:
          return "krylov-amg";
        case LinearSolverKind::direct:
          return "direct";
        default:
          return "none";
      }
  }
} // namespace kedge
