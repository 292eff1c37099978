#include "backend.h"
#include "gmres.h"
#include "incomplete_lu.h"

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <ml_utils.h>

namespace kedge
{
  namespace
  {
    using namespace dealii;

    /** Algebraic multigrid from ML. */
    class TrilinosMultigrid
    {
    public:
      /** Copies the rows into an Epetra matrix and coarsens it; may throw. */
      void
      factorise(const DistributedMatrix &from, const bool positive_definite)
      {
        const SparseSystem &system       = from.values();
        const auto         &scale        = from.scaling();
        const MPI_Comm      communicator = system.communicator;
        const int           n            = static_cast<int>(system.n_rows());
        Epetra_MpiComm      epetra_communicator(communicator);
        const Epetra_Map    map(static_cast<int>(system.n_global), n, 0, epetra_communicator);
        std::vector<int>    lengths(n);
        for (int i = 0; i < n; ++i)
          lengths[i] = static_cast<int>(system.row_start[i + 1] - system.row_start[i]);
        Epetra_CrsMatrix    epetra(Copy, map, lengths.data(), true);
        std::vector<double> row;
        for (int i = 0; i < n; ++i)
          {
            const std::int64_t begin = system.row_start[i];
            row.assign(system.value.begin() + begin, system.value.begin() + begin + lengths[i]);
            for (int k = 0; k < lengths[i]; ++k)
              row[k] *= scale[i] * scale[from.columns()[begin + k]];
            epetra.InsertGlobalValues(static_cast<int>(system.first_row) + i,
                                      lengths[i],
                                      row.data(),
                                      system.column.data() + begin);
          }
        epetra.FillComplete();
        preconditioner.clear();
        matrix.reinit(epetra, true);
        TrilinosWrappers::PreconditionAMG::AdditionalData data;
        data.elliptic              = positive_definite;
        data.aggregation_threshold = 0.02;
        ML_set_random_seed(1); // of the start of its eigen-analysis
        preconditioner.initialize(matrix, data);
        source.reinit(matrix.locally_owned_range_indices(), communicator);
        result.reinit(source);
      }

      void
      multiply(const double *x, double *y)
      {
        const int n = source.trilinos_vector().MyLength();
        std::copy(x, x + n, source.trilinos_vector()[0]);
        preconditioner.vmult(result, source);
        std::copy(result.trilinos_vector()[0], result.trilinos_vector()[0] + n, y);
      }

    private:
      TrilinosWrappers::SparseMatrix    matrix;
      TrilinosWrappers::PreconditionAMG preconditioner;
      TrilinosWrappers::MPI::Vector     source, result;
    };



    /** GMRES with incomplete factors of each rank's block, or with multigrid. */
    class KrylovBackend : public LinearSolver::Backend
    {
    public:
      KrylovBackend(const MatrixTraits &traits, const bool with_multigrid)
        : traits(traits)
        , with_multigrid(with_multigrid)
        , incomplete_lu(make_incomplete_lu(traits.space_dimension))
      {}

      LinearStatus
      factorise(const SparseSystem &system, const bool new_pattern, const double) override
      {
        communicator = system.communicator;
        if (new_pattern)
          {
            matrix.reinit(system);
            if (!with_multigrid)
              incomplete_lu->reinit(matrix);
          }
        matrix.set_values(system);
        if (!with_multigrid)
          {
            incomplete_lu->factorise(matrix);
            return {};
          }
        try
          {
            multigrid.factorise(matrix, traits.positive_definite);
          }
        catch (const std::exception &exception)
          {
            return LinearStatus::failure(std::string("preconditioner: ") + exception.what());
          }
        return {};
      }

      LinearStatus
      solve(const std::vector<double> &b,
            std::vector<double>       &x,
            const double               tolerance,
            const unsigned int         max_iterations) override
      {
        const std::vector<double> &scale = matrix.scaling();
        std::vector<double>        scaled(b.size());
        for (std::size_t i = 0; i < b.size(); ++i)
          scaled[i] = scale[i] * b[i];
        const auto multiply = [&](const double *from, double *to) {
          matrix.multiply(from, to);
        };
        const auto precondition = [&](const double *from, double *to) {
          if (with_multigrid)
            {
              multigrid.multiply(from, to);
              return;
            }
          incomplete_lu->multiply(matrix, from, to);
        };
        const GmresResult result =
          solve_gmres(multiply, precondition, scaled, x, tolerance, max_iterations, communicator);
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] *= scale[i];
        LinearStatus status;
        if (!result.success)
          status = LinearStatus::failure("the iterative solver did not reach its tolerance");
        status.iterations = result.iterations;
        return status;
      }

    private:
      const MatrixTraits            traits;
      const bool                    with_multigrid;
      MPI_Comm                      communicator = MPI_COMM_SELF;
      DistributedMatrix             matrix;
      std::unique_ptr<IncompleteLu> incomplete_lu;
      TrilinosMultigrid             multigrid;
    };
  } // namespace

  std::unique_ptr<LinearSolver::Backend>
  make_krylov_backend(const MatrixTraits &traits, const bool multigrid)
  {
    return std::make_unique<KrylovBackend>(traits, multigrid);
  }
} // namespace kedge
