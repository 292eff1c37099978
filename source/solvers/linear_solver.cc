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
     * Seconds that a band LU and UMFPACK take on one core of 2020's make;
     * only their ratio matters. Fitted to measurements from 200 to 2e5
     * unknowns.
     */
    double
    banded_time(const double n, const double width)
    {
      return n * (4. * width * width / 1e10 + 2e-8 * width + 1e-7);
    }

    double
    umfpack_time(const double n, const double entries_per_row, const int space_dimension)
    {
      if (space_dimension == 2)
        return 7e-6 * n * std::pow(std::max(n, 1e3) / 1e4, 0.3);
      // a wider stencil than that of trilinear elements costs more
      const double width = std::max(entries_per_row / 81., 1.);
      return 1e-4 * n * std::pow(std::max(n, 1e2) / 1.5e4, 1.1) * width;
    }

    /** Above these sizes iterative methods win. */
    constexpr std::int64_t largest_direct_2d = 120000, largest_direct_3d = 9000;
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
        const double n      = static_cast<double>(system.n_global);
        const double banded = banded_time(n, static_cast<double>(bandwidth(system))) *
                              (traits.positive_definite ? 0.3 : 1.);
        double entries = static_cast<double>(system.column.size());
        MPI_Allreduce(MPI_IN_PLACE, &entries, 1, MPI_DOUBLE, MPI_SUM, system.communicator);
        const bool large =
          system.n_global > (traits.space_dimension == 2 ? largest_direct_2d : largest_direct_3d);
        if (banded < umfpack_time(n, entries / std::max(n, 1.), traits.space_dimension))
          kind = LinearSolverKind::banded;
        else if (!large)
          kind = LinearSolverKind::direct;
        else
          kind = traits.dominated_by_inertia ? LinearSolverKind::krylov_ilu
                                             : LinearSolverKind::krylov_amg;
      }
    if (backend && kind == chosen)
      return;
    chosen = kind;
    switch (kind)
      {
        case LinearSolverKind::banded:
          backend = make_banded_backend(traits);
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
