#include "gathered_backend.h"

#include <umfpack.h>

namespace kedge
{
  namespace
  {
    /** From here on it is worth knowing which unknown is the weakest. */
    constexpr double badly_conditioned = 1e10;

    /** Sparse LU from UMFPACK; the symbolic analysis is kept while the pattern lasts. */
    class UmfpackBackend : public GatheredBackend
    {
    public:
      UmfpackBackend()
      {
        umfpack_di_defaults(control);
        control[UMFPACK_IRSTEP] = 1;
      }

      ~UmfpackBackend() override
      {
        umfpack_di_free_numeric(&numeric);
        umfpack_di_free_symbolic(&symbolic);
      }

    protected:
      LinearStatus
      factorise_gathered(const Matrix &matrix, const bool new_pattern) override
      {
        this->matrix = &matrix;
        double info[UMFPACK_INFO];
        umfpack_di_free_numeric(&numeric);
        if (matrix.n == 0)
          return {};
        // rows are handed over as columns: UMFPACK factorises the transpose
        if (new_pattern || symbolic == nullptr)
          {
            umfpack_di_free_symbolic(&symbolic);
            const int status = umfpack_di_symbolic(matrix.n,
                                                   matrix.n,
                                                   matrix.row_start.data(),
                                                   matrix.column.data(),
                                                   matrix.value.data(),
                                                   &symbolic,
                                                   control,
                                                   info);
            if (status < 0)
              return LinearStatus::failure("UMFPACK could not analyse the matrix (status " +
                                           std::to_string(status) + ")");
          }
        const int status = umfpack_di_numeric(matrix.row_start.data(),
                                              matrix.column.data(),
                                              matrix.value.data(),
                                              symbolic,
                                              &numeric,
                                              control,
                                              info);
        if (status == UMFPACK_WARNING_singular_matrix)
          return LinearStatus::failure("singular matrix", weakest_unknown());
        if (status != UMFPACK_OK)
          return LinearStatus::failure("UMFPACK could not factorise the matrix (status " +
                                       std::to_string(status) + ")");
        if (info[UMFPACK_RCOND] < smallest_pivot)
          return LinearStatus::failure("matrix singular to working precision", weakest_unknown());
        LinearStatus result;
        result.condition_estimate = 1. / info[UMFPACK_RCOND];
        if (result.condition_estimate > badly_conditioned)
          result.weakest_equation = weakest_unknown();
        return result;
      }

      LinearStatus
      solve_gathered(std::vector<double> &x) override
      {
        if (matrix->n == 0)
          return {};
        std::vector<double> solution(x.size());
        double              info[UMFPACK_INFO];
        const int           status = umfpack_di_solve(UMFPACK_At,
                                            matrix->row_start.data(),
                                            matrix->column.data(),
                                            matrix->value.data(),
                                            solution.data(),
                                            x.data(),
                                            numeric,
                                            control,
                                            info);
        if (status != UMFPACK_OK)
          return LinearStatus::failure("UMFPACK could not solve (status " + std::to_string(status) +
                                       ")");
        x.swap(solution);
        return {};
      }

    private:
      /** The equation (row of the matrix) with the smallest pivot. */
      std::int64_t
      weakest_unknown() const
      {
        const int           n = matrix->n;
        std::vector<double> diagonal(n);
        std::vector<int>    column_order(n);
        int                 reciprocal;
        umfpack_di_get_numeric(nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               column_order.data(),
                               diagonal.data(),
                               &reciprocal,
                               nullptr,
                               numeric);
        int weakest = 0;
        for (int i = 1; i < n; ++i)
          if (std::abs(diagonal[i]) < std::abs(diagonal[weakest]))
            weakest = i;
        return column_order[weakest];
      }

      double        control[UMFPACK_CONTROL];
      void         *symbolic = nullptr;
      void         *numeric  = nullptr;
      const Matrix *matrix   = nullptr;
    };
  } // namespace

  std::unique_ptr<LinearSolver::Backend>
  make_umfpack_backend()
  {
    return std::make_unique<UmfpackBackend>();
  }
} // namespace kedge
