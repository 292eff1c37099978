#include "band_cholesky.h"

#include <algorithm>

extern "C"
{
  void
  dgemv_(const char   *transpose,
         const int    *m,
         const int    *n,
         const double *alpha,
         const double *a,
         const int    *lda,
         const double *x,
         const int    *incx,
         const double *beta,
         double       *y,
         const int    *incy);
  void
  dpotrf_(const char *uplo, const int *n, double *a, const int *lda, int *info);
  void
  dsyrk_(const char   *uplo,
         const char   *transpose,
         const int    *n,
         const int    *k,
         const double *alpha,
         const double *a,
         const int    *lda,
         const double *beta,
         double       *c,
         const int    *ldc);
  void
  dtrsm_(const char   *side,
         const char   *uplo,
         const char   *transpose,
         const char   *diag,
         const int    *m,
         const int    *n,
         const double *alpha,
         const double *a,
         const int    *lda,
         double       *b,
         const int    *ldb);
  void
  dtrsv_(const char   *uplo,
         const char   *transpose,
         const char   *diag,
         const int    *n,
         const double *a,
         const int    *lda,
         double       *x,
         const int    *incx);
}

namespace kedge
{
  namespace
  {
    constexpr int    one  = 1;
    constexpr double plus = 1., minus = -1.;
  } // namespace



  void
  BandCholesky::reinit(const int n, const int width)
  {
    this->n     = n;
    this->width = width;
    block_size  = width < 48 ? 16 : (width < 320 ? 32 : 64);
    n_stored    = width + block_size;
    band.assign(std::size_t(n_stored) * n, 0.);
  }



  BandCholesky::Step
  BandCholesky::step(const int begin) const
  {
    const int n_block = std::min(block_size, n - begin);
    return {n_block, std::min(width, n - begin - n_block)};
  }



  int
  BandCholesky::factorise()
  {
    const int lda = n_stored - 1;
    for (int begin = 0; begin < n; begin += block_size)
      {
        const auto [n_block, n_below] = step(begin);
        double *diagonal              = &entry(begin, begin);
        int     info                  = 0;
        dpotrf_("L", &n_block, diagonal, &lda, &info);
        if (info != 0)
          return begin + info - 1;
        if (n_below == 0)
          continue;
        double *below = &entry(begin + n_block, begin);
        double *rest  = &entry(begin + n_block, begin + n_block);
        dtrsm_("R", "L", "T", "N", &n_below, &n_block, &plus, diagonal, &lda, below, &lda);
        dsyrk_("L", "N", &n_below, &n_block, &minus, below, &lda, &plus, rest, &lda);
      }
    return -1;
  }



  void
  BandCholesky::solve(double *x) const
  {
    const int  lda      = n_stored - 1;
    const auto multiply = [&](const char *transpose, const int begin, const Step &part) {
      const int     next   = begin + part.n_block;
      const bool    upward = *transpose == 'T';
      const double *from   = x + (upward ? next : begin);
      double       *to     = x + (upward ? begin : next);
      if (part.n_below > 0)
        dgemv_(transpose,
               &part.n_below,
               &part.n_block,
               &minus,
               block(next, begin),
               &lda,
               from,
               &one,
               &plus,
               to,
               &one);
    };
    const auto divide = [&](const char *transpose, const int begin, const Step &part) {
      dtrsv_("L", transpose, "N", &part.n_block, block(begin, begin), &lda, x + begin, &one);
    };
    for (int begin = 0; begin < n; begin += block_size)
      {
        const Step part = step(begin);
        divide("N", begin, part);
        multiply("N", begin, part);
      }
    for (int begin = n - 1 - (n - 1) % block_size; begin >= 0; begin -= block_size)
      {
        const Step part = step(begin);
        multiply("T", begin, part);
        divide("T", begin, part);
      }
  }



  double
  BandCholesky::pivot(const int i) const
  {
    const double diagonal = *block(i, i);
    return diagonal * diagonal;
  }
} // namespace kedge
