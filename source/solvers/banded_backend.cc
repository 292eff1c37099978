#include "band_cholesky.h"
#include "gathered_backend.h"

#include <limits>

extern "C"
{
  void
  dgbtrf_(const int *m,
          const int *n,
          const int *kl,
          const int *ku,
          double    *ab,
          const int *ldab,
          int       *ipiv,
          int       *info);
  void
  dgbtrs_(const char   *trans,
          const int    *n,
          const int    *kl,
          const int    *ku,
          const int    *nrhs,
          const double *ab,
          const int    *ldab,
          const int    *ipiv,
          double       *b,
          const int    *ldb,
          int          *info);
}

namespace kedge
{
  namespace
  {
    /**
     * Band Cholesky for matrices that are symmetric and positive definite, else
     * band LU with partial pivoting from LAPACK, which takes twice as long.
     */
    class BandedBackend : public GatheredBackend
    {
    protected:
      LinearStatus
      factorise_gathered(const Matrix &matrix, const bool new_pattern) override
      {
        n = matrix.n;
        if (new_pattern)
          {
            width = 0;
            for (int i = 0; i < n; ++i)
              for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
                width = std::max(width, std::abs(i - matrix.column[k]));
          }
        is_cholesky = is_symmetric(matrix);
        if (is_cholesky)
          {
            const LinearStatus status = factorise_cholesky(matrix);
            if (status.success)
              return status;
            is_cholesky = false;
          }
        return factorise_lu(matrix);
      }

      LinearStatus
      solve_gathered(std::vector<double> &x) override
      {
        int       info    = 0;
        const int leading = 3 * width + 1, one = 1;
        if (n == 0)
          return {};
        if (is_cholesky)
          cholesky.solve(x.data());
        else
          dgbtrs_("N",
                  &n,
                  &width,
                  &width,
                  &one,
                  band.data(),
                  &leading,
                  pivots.data(),
                  x.data(),
                  &n,
                  &info);
        return {};
      }

    private:
      LinearStatus
      factorise_cholesky(const Matrix &matrix)
      {
        cholesky.reinit(n, width);
        for (int i = 0; i < n; ++i)
          for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
            if (matrix.column[k] <= i)
              cholesky.entry(i, matrix.column[k]) = matrix.value[k];
        const int failed = cholesky.factorise();
        if (failed >= 0)
          return LinearStatus::failure("matrix not positive definite", failed);
        return judge_pivots([&](const int i) {
          return cholesky.pivot(i);
        });
      }

      LinearStatus
      factorise_lu(const Matrix &matrix)
      {
        const int leading = 3 * width + 1, diagonal = 2 * width;
        band.assign(std::size_t(leading) * n, 0.);
        for (int i = 0; i < n; ++i)
          for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
            band[std::size_t(matrix.column[k]) * leading + diagonal + i - matrix.column[k]] =
              matrix.value[k];
        int info = 0;
        pivots.resize(n);
        dgbtrf_(&n, &n, &width, &width, band.data(), &leading, pivots.data(), &info);
        if (info > 0)
          return LinearStatus::failure("singular matrix", info - 1);
        return judge_pivots([&](const int i) {
          return band[std::size_t(i) * leading + diagonal];
        });
      }

      template <typename Pivot>
      LinearStatus
      judge_pivots(const Pivot &pivot_of) const
      {
        double       largest = 0., smallest = std::numeric_limits<double>::max();
        LinearStatus status;
        for (int i = 0; i < n; ++i)
          {
            const double pivot = std::abs(pivot_of(i));
            largest            = std::max(largest, pivot);
            if (pivot < smallest)
              {
                smallest                = pivot;
                status.weakest_equation = i;
              }
          }
        if (n > 0 && smallest < smallest_pivot)
          return LinearStatus::failure("matrix singular to working precision",
                                       status.weakest_equation);
        status.condition_estimate = n > 0 ? largest / smallest : 1.;
        return status;
      }

      int                 n = 0, width = 0;
      bool                is_cholesky = false;
      BandCholesky        cholesky;
      std::vector<double> band;
      std::vector<int>    pivots;
    };
  } // namespace

  std::unique_ptr<LinearSolver::Backend>
  make_banded_backend()
  {
    return std::make_unique<BandedBackend>();
  }
} // namespace kedge
