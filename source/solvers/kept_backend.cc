#include "backend.h"
#include "bordered_preconditioner.h"
#include "gmres.h"
#include "lattice_multigrid.h"
#include "mixed_preconditioner.h"

#include <algorithm>
#include <functional>

namespace kedge
{
  namespace
  {
    /** Iterations per digit above this multiple of those when it was new ask for a new one. */
    constexpr double worn = 1.5;

    /** Makes the preconditioner of a new pattern. */
    using Choice = std::function<std::unique_ptr<Preconditioner>(const SparseSystem &)>;

    /** GMRES with a preconditioner that is kept within a step as long as it serves. */
    class KeptBackend : public LinearSolver::Backend
    {
    public:
      explicit KeptBackend(const Choice &choose)
        : choose(choose)
      {}

      LinearStatus
      factorise(const SparseSystem &system, const bool new_pattern, const double) override
      {
        communicator = system.communicator;
        if (new_pattern)
          {
            matrix.reinit(system);
            preconditioner = choose(system);
            preconditioner->analyse(system);
            is_worn = true;
          }
        matrix.set_values(system);
        is_fresh = false;
        if (is_worn)
          return set_up();
        preconditioner->follow(matrix);
        return {};
      }

      LinearStatus
      solve(const std::vector<double> &b,
            std::vector<double>       &x,
            const double               tolerance,
            const unsigned int         max_iterations) override
      {
        const LinearStatus status = iterate(b, x, tolerance, max_iterations);
        if (status.success || is_fresh)
          return status;
        const LinearStatus renewed = set_up();
        return renewed.success ? iterate(b, x, tolerance, max_iterations) : renewed;
      }

      void
      forget() override
      {
        is_worn = true;
      }

    private:
      LinearStatus
      set_up()
      {
        try
          {
            preconditioner->factorise(matrix);
          }
        catch (const std::exception &exception)
          {
            return LinearStatus::failure(std::string("preconditioner: ") + exception.what());
          }
        is_worn            = false;
        is_fresh           = true;
        iterations_of_best = 0.;
        return {};
      }

      LinearStatus
      iterate(const std::vector<double> &b,
              std::vector<double>       &x,
              const double               tolerance,
              const unsigned int         max_iterations)
      {
        const std::vector<double> &scale = matrix.scaling();
        std::vector<double>        scaled(b.size());
        for (std::size_t i = 0; i < b.size(); ++i)
          scaled[i] = scale[i] * b[i];
        const auto multiply = [&](const double *from, double *to) {
          matrix.multiply(from, to);
        };
        const auto precondition = [&](const double *from, double *to) {
          preconditioner->multiply(matrix, from, to);
        };
        const GmresResult result =
          solve_gmres(multiply, precondition, scaled, x, tolerance, max_iterations, communicator);
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] *= scale[i];
        const double per_digit = (result.iterations + 1.) / std::max(1., -std::log10(tolerance));
        if (is_fresh)
          iterations_of_best = std::max(iterations_of_best, per_digit);
        is_worn = !result.success || per_digit > worn * iterations_of_best;
        LinearStatus status;
        if (!result.success)
          status = LinearStatus::failure("the iterative solver did not reach its tolerance");
        status.iterations = result.iterations;
        return status;
      }

      const Choice                    choose;
      MPI_Comm                        communicator = MPI_COMM_SELF;
      DistributedMatrix               matrix;
      std::unique_ptr<Preconditioner> preconditioner;
      bool                            is_worn = true, is_fresh = false;
      double                          iterations_of_best = 0.;
    };
  } // namespace

  std::unique_ptr<LinearSolver::Backend>
  make_mixed_backend(const MixedBlocks &blocks)
  {
    return std::make_unique<KeptBackend>([&blocks](const SparseSystem &) {
      return std::make_unique<MixedPreconditioner>(blocks);
    });
  }

  std::unique_ptr<LinearSolver::Backend>
  make_lattice_backend(const MixedBlocks &blocks)
  {
    return std::make_unique<KeptBackend>(
      [&blocks](const SparseSystem &system) -> std::unique_ptr<Preconditioner> {
        std::unique_ptr<Preconditioner> of_nodes;
        int                             n_ranks = 1;
        MPI_Comm_size(system.communicator, &n_ranks);
        if (n_ranks == 1)
          if (auto lattice = find_lattice(blocks))
            of_nodes = std::make_unique<LatticeMultigrid>(std::move(*lattice));
        if (!of_nodes)
          of_nodes = std::make_unique<MixedPreconditioner>(blocks);
        if (blocks.n_others == 0)
          return of_nodes;
        return std::make_unique<BorderedPreconditioner>(std::move(of_nodes), blocks.n_others);
      });
  }
} // namespace kedge
