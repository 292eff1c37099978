#include <kedge/solvers/linear_solver.h>

#include "backend.h"

#include <algorithm>
#include <cmath>

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

    bool
    is_on_one_rank(const SparseSystem &system)
    {
      int n_ranks = 1;
      MPI_Comm_size(system.communicator, &n_ranks);
      return n_ranks == 1;
    }

    /** Entries on all ranks. */
    double
    n_entries(const SparseSystem &system)
    {
      double entries = static_cast<double>(system.column.size());
      MPI_Allreduce(MPI_IN_PLACE, &entries, 1, MPI_DOUBLE, MPI_SUM, system.communicator);
      return entries;
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

    /** One iteration: a product with the matrix, the preconditioner, a new direction. */
    double
    iteration_time(const double n, const double n_entries, const bool multigrid)
    {
      return multigrid ? 6e-9 * n_entries + 2e-7 * n : 8e-10 * n_entries + 6e-8 * n;
    }

    /**
     * A correction by multigrid on the lattice takes this part of that. Measured were 4 to 9
     * iterations of half the length, set-up included; twice as much stands here, for a direct
     * method does not fail.
     */
    constexpr double lattice_factor = 0.4;

    /**
     * With blocks a correction takes about 12 iterations and multigrid is set up
     * once in a step: fitted to single runs of a 2D strip of saturated soil; in space,
     * where direct methods are dearer, prm/footing_flexible.prm gains from 5000 unknowns on.
     */
    constexpr double mixed_factor = 0.3;

    /** Iterations for a correction, preconditioner included; they depend little on the size. */
    constexpr double usual_iterations = 40.;

    /** A direct method that takes longer, in seconds, is no substitute: memory would not do. */
    constexpr double longest_substitute = 100.;
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
    to_choose   = true;
  }



  void
  LinearSolver::set_blocks(const MixedBlocks &blocks)
  {
    if (!this->blocks)
      backend.reset(); // one that knows more may serve better
    this->blocks = &blocks;
    if (backend)
      backend->forget();
  }



  double
  LinearSolver::direct_time(const SparseSystem &system) const
  {
    const double n = static_cast<double>(system.n_global);
    return std::min(banded_time(n, static_cast<double>(bandwidth(system))),
                    umfpack_time(n, n_entries(system), traits.space_dimension));
  }



  /** Whether what belongs to no node stands behind the nodes, so that multigrid takes it too. */
  bool
  LinearSolver::has_border() const
  {
    return blocks && blocks->n_others > 0 && !traits.mixed;
  }



  LinearSolverKind
  LinearSolver::cheapest(const SparseSystem &system)
  {
    const double n          = static_cast<double>(system.n_global);
    const double entries    = n_entries(system);
    const bool   multigrid  = !traits.dominated_by_inertia || traits.multipliers;
    const bool   on_lattice = blocks && is_on_one_rank(system);
    const double banded     = banded_time(n, static_cast<double>(bandwidth(system)));
    const double umfpack    = umfpack_time(n, entries, traits.space_dimension);
    const double iteration =
      iteration_time(n, entries, multigrid) *
      (traits.mixed ? mixed_factor : (multigrid && on_lattice ? lattice_factor : 1.));

    const double exact = std::min(banded, umfpack);
    substitute         = banded < umfpack ? LinearSolverKind::banded : LinearSolverKind::direct;
    if ((traits.multipliers && !has_border()) || exact <= usual_iterations * iteration)
      return substitute;
    if (exact > longest_substitute)
      substitute = LinearSolverKind::automatic;
    else
      max_iterations =
        std::min(max_iterations, static_cast<unsigned int>(usual_iterations + exact / iteration));
    if (traits.mixed)
      return LinearSolverKind::krylov_blocks;
    return multigrid ? LinearSolverKind::krylov_amg : LinearSolverKind::krylov_ilu;
  }



  std::unique_ptr<LinearSolver::Backend>
  LinearSolver::make_backend(const LinearSolverKind kind) const
  {
    switch (kind)
      {
        case LinearSolverKind::banded:
          return make_banded_backend();
        case LinearSolverKind::krylov_ilu:
          return make_krylov_backend(traits, false);
        case LinearSolverKind::krylov_amg:
          if (blocks && !traits.mixed) // of displacements alone
            return make_lattice_backend(*blocks);
          return make_krylov_backend(traits, true);
        case LinearSolverKind::krylov_blocks:
          if (blocks)
            return make_mixed_backend(*blocks);
          return make_krylov_backend(traits, true);
        default:
          return make_umfpack_backend();
      }
  }



  LinearSolverKind
  LinearSolver::choose(const SparseSystem &system)
  {
    if (to_choose)
      {
        substitute     = LinearSolverKind::automatic;
        max_iterations = parameters.max_iterations;
        const LinearSolverKind kind =
          parameters.kind == LinearSolverKind::automatic ? cheapest(system) : parameters.kind;
        if (kind != chosen)
          backend.reset();
        chosen = kind;
      }
    to_choose = false;
    return chosen;
  }



  LinearStatus
  LinearSolver::factorise(const SparseSystem &system, const double shift)
  {
    this->system = &system;
    this->shift  = shift;
    direct.reset();
    const bool analyse = new_pattern;
    choose(system);
    if (traits.multipliers && chosen != LinearSolverKind::banded &&
        chosen != LinearSolverKind::direct &&
        !(has_border() && chosen == LinearSolverKind::krylov_amg))
      return LinearStatus::failure("the iterative method " + method() +
                                   " cannot solve for multipliers; take a direct one");
    if (!backend)
      backend = make_backend(chosen);
    new_pattern = false;
    return backend->factorise(system, analyse, shift);
  }



  LinearStatus
  LinearSolver::solve(const std::vector<double> &b, std::vector<double> &x, const double tolerance)
  {
    const double sufficient = std::max(tolerance, parameters.tolerance);
    if (direct)
      return direct->solve(b, x, sufficient, max_iterations);
    const LinearStatus status = backend->solve(b, x, sufficient, max_iterations);
    if (status.success || substitute == LinearSolverKind::automatic || substitute == chosen)
      return status;
    direct                        = make_backend(substitute);
    const LinearStatus factorised = direct->factorise(*system, true, shift);
    return factorised.success ? direct->solve(b, x, sufficient, max_iterations) : factorised;
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
        case LinearSolverKind::krylov_blocks:
          return "krylov-blocks";
        case LinearSolverKind::direct:
          return "direct";
        default:
          return "none";
      }
  }
} // namespace kedge
