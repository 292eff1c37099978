#ifndef kedge_solvers_band_cholesky_h
#define kedge_solvers_band_cholesky_h

#include <cstddef>
#include <vector>

namespace kedge
{
  /**
   * The factor of a symmetric positive definite band matrix, A = L L^T, found
   * block column by block column with level 3 BLAS. LAPACK's dpbtrf does so
   * from a width of 64 on only and is up to ten times slower on narrow bands.
   *
   * Entry (i, j), i >= j, is stored at i - j of column j, so that any block is
   * a dense matrix of leading dimension n_stored - 1. Blocks reach past the
   * band by up to block_size - 1 entries, which are stored as well.
   */
  class BandCholesky
  {
  public:
    /** An empty matrix of size n whose entries are |i - j| <= width from the diagonal. */
    void
    reinit(const int n, const int width);

    /** Entry i >= j, to be set before factorise(). */
    double &
    entry(const int i, const int j)
    {
      return band[std::size_t(j) * n_stored + (i - j)];
    }

    /** @return -1, or the number of the first pivot that is not positive */
    int
    factorise();

    /** Overwrites the right-hand side with the solution. */
    void
    solve(double *x) const;

    /** The pivot of unknown i as elimination without square roots has it. */
    double
    pivot(const int i) const;

  private:
    /** The part of the matrix that one step of the factorisation deals with. */
    struct Step
    {
      int n_block; ///< rows of the diagonal block
      int n_below; ///< rows below that it reaches
    };

    Step
    step(const int begin) const;
    const double *
    block(const int i, const int j) const
    {
      return band.data() + std::size_t(j) * n_stored + (i - j);
    }

    int                 n = 0, width = 0, block_size = 1;
    int                 n_stored = 0; ///< entries of each column
    std::vector<double> band;
  };
} // namespace kedge

#endif
