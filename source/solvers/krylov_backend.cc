#include "backend.h"

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>

namespace kedge
{
  namespace
  {
    using namespace dealii;

    /** GMRES (CG if the matrix is positive definite) with ILU(0) or multigrid. */
    class KrylovBackend : public LinearSolver::Backend
    {
    public:
      KrylovBackend(const LinearSolverParameters &parameters,
                    const MatrixTraits           &traits,
                    const bool                    multigrid)
        : parameters(parameters)
        , traits(traits)
        , multigrid(multigrid)
      {}

      LinearStatus
      factorise(const SparseSystem &system, const bool, const double) override
      {
        build_matrix(system);
        try
          {
            if (multigrid)
              {
                auto amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
                TrilinosWrappers::PreconditionAMG::AdditionalData data;
                data.elliptic              = traits.positive_definite;
                data.aggregation_threshold = 0.02;
                amg->initialize(matrix, data);
                preconditioner = std::move(amg);
              }
            else
              {
                auto ilu = std::make_unique<TrilinosWrappers::PreconditionILU>();
                ilu->initialize(matrix);
                preconditioner = std::move(ilu);
              }
          }
        catch (const std::exception &exception)
          {
            return LinearStatus::failure(std::string("preconditioner: ") + exception.what());
          }
        return {};
      }

      LinearStatus
      solve(const std::vector<double> &b, std::vector<double> &x) override
      {
        const IndexSet                rows = matrix.locally_owned_range_indices();
        TrilinosWrappers::MPI::Vector solution(rows, communicator), right_side(rows, communicator);
        double                       *values = right_side.trilinos_vector()[0];
        double                       *scale  = scaling->Values();
        for (unsigned int i = 0; i < b.size(); ++i)
          values[i] = b[i] * scale[i];

        LinearStatus  status;
        const double  norm = right_side.l2_norm();
        SolverControl control(parameters.max_iterations, parameters.tolerance * norm);
        try
          {
            if (norm > 0.)
              {
                if (traits.positive_definite)
                  TrilinosWrappers::SolverCG(control).solve(matrix,
                                                            solution,
                                                            right_side,
                                                            *preconditioner);
                else
                  TrilinosWrappers::SolverGMRES(control,
                                                TrilinosWrappers::SolverGMRES::AdditionalData(false,
                                                                                              60))
                    .solve(matrix, solution, right_side, *preconditioner);
              }
          }
        catch (const std::exception &)
          {
            status = LinearStatus::failure("the iterative solver did not reach its tolerance");
          }
        status.iterations =
          control.last_step() == numbers::invalid_unsigned_int ? 0 : control.last_step();
        x.resize(b.size());
        values = solution.trilinos_vector()[0];
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] = values[i] * scale[i];
        return status;
      }

    private:
      /** Copies the rows, scaled from both sides, into an Epetra matrix. */
      void
      build_matrix(const SparseSystem &system)
      {
        communicator       = system.communicator;
        const int        n = static_cast<int>(system.n_rows());
        Epetra_MpiComm   epetra_communicator(communicator);
        const Epetra_Map map(static_cast<int>(system.n_global), n, 0, epetra_communicator);
        std::vector<int> lengths(n);
        for (int i = 0; i < n; ++i)
          lengths[i] = static_cast<int>(system.row_start[i + 1] - system.row_start[i]);
        Epetra_CrsMatrix epetra(Copy, map, lengths.data(), true);
        scaling = std::make_unique<Epetra_Vector>(map);
        for (int i = 0; i < n; ++i)
          {
            const std::int64_t begin = system.row_start[i];
            const int          row   = static_cast<int>(system.first_row) + i;
            epetra.InsertGlobalValues(row,
                                      lengths[i],
                                      system.value.data() + begin,
                                      system.column.data() + begin);
            (*scaling)[i] = 1.;
            for (std::int64_t k = begin; k < system.row_start[i + 1]; ++k)
              if (system.column[k] == row && system.value[k] != 0.)
                (*scaling)[i] = 1. / std::sqrt(std::abs(system.value[k]));
          }
        epetra.FillComplete();
        epetra.LeftScale(*scaling);
        epetra.RightScale(*scaling);
        preconditioner.reset();
        matrix.reinit(epetra, true);
      }

      const LinearSolverParameters                        parameters;
      const MatrixTraits                                  traits;
      const bool                                          multigrid;
      MPI_Comm                                            communicator = MPI_COMM_SELF;
      TrilinosWrappers::SparseMatrix                      matrix;
      std::unique_ptr<Epetra_Vector>                      scaling;
      std::unique_ptr<TrilinosWrappers::PreconditionBase> preconditioner;
    };
  } // namespace

  std::unique_ptr<LinearSolver::Backend>
  make_krylov_backend(const LinearSolverParameters &parameters,
                      const MatrixTraits           &traits,
                      const bool                    multigrid)
  {
    return std::make_unique<KrylovBackend>(parameters, traits, multigrid);
  }
} // namespace kedge
