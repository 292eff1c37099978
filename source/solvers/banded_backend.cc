#include "gathered_backend.h"

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
  void
  dpbtrf_(const char *uplo, const int *n, const int *kd, double *ab, const int *ldab, int *info);
  void
  dpbtrs_(const char   *uplo,
          const int    *n,
          const int    *kd,
          const int    *nrhs,
          const double *ab,
          const int    *ldab,
          double       *b,
          const int    *ldb,
          int          *info);
}

namespace kedge
{
  namespace
  {
    /** Band LU with partial pivoting, or band Cholesky, from LAPACK. */
    class BandedBackend : public GatheredBackend
    {
    public:
      explicit BandedBackend(const bool cholesky)
        : cholesky(cholesky)
      {}

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
        leading = cholesky ? width + 1 : 3 * width + 1;
        band.assign(std::size_t(leading) * n, 0.);
        const int top = cholesky ? width : 2 * width; // row of the diagonal
        for (int i = 0; i < n; ++i)
          for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
            if (!cholesky || matrix.column[k] >= i) // the upper triangle suffices
              band[std::size_t(matrix.column[k]) * leading + top + i - matrix.column[k]] =
                matrix.value[k];
        int info = 0;
        if (cholesky)
          dpbtrf_("U", &n, &width, band.data(), &leading, &info);
        else
          {
            pivots.resize(n);
            dgbtrf_(&n, &n, &width, &width, band.data(), &leading, pivots.data(), &info);
          }
        if (info > 0)
          return LinearStatus::failure(cholesky ? "matrix not positive definite"
                                                : "singular matrix",
                                       info - 1);
        double       largest = 0., smallest = std::numeric_limits<double>::max();
        LinearStatus status;
        for (int i = 0; i < n; ++i)
          {
            const double diagonal = band[std::size_t(i) * leading + top];
            const double pivot    = std::abs(cholesky ? diagonal * diagonal : diagonal);
            largest               = std::max(largest, pivot);
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

      LinearStatus
      solve_gathered(std::vector<double> &x) override
      {
        int       info = 0;
        const int one  = 1;
        if (n == 0)
          return {};
        if (cholesky)
          dpbtrs_("U", &n, &width, &one, band.data(), &leading, x.data(), &n, &info);
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
      const bool          cholesky;
      int                 n = 0, width = 0, leading = 0;
      std::vector<double> band;
      std::vector<int>    pivots;
    };
  } // namespace

  std::unique_ptr<LinearSolver::Backend>
  make_banded_backend(const MatrixTraits &traits)
  {
    return std::make_unique<BandedBackend>(traits.positive_definite);
  }
} // namespace kedge
