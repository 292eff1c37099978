#ifndef kedge_solvers_scaling_h
#define kedge_solvers_scaling_h

#include <cmath>
#include <vector>

namespace kedge
{
  /**
   * S of the scaled matrix S A S: 1/sqrt|a_ii|, which makes its diagonal 1, or 0 for rows
   * without a diagonal, which scale_rows_without_diagonal() sees to. Columns are local
   * numbers, those of the rows first.
   */
  template <typename RowStart>
  inline void
  scale_by_diagonal(const unsigned int         n_rows,
                    const RowStart            &row_start,
                    const int                 *column,
                    const std::vector<double> &value,
                    std::vector<double>       &scale)
  {
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        scale[i] = 0.;
        for (auto k = row_start[i]; k < row_start[i + 1]; ++k)
          if (column[k] == static_cast<int>(i) && value[k] != 0.)
            scale[i] = 1. / std::sqrt(std::abs(value[k]));
      }
  }

  /**
   * The rows without a diagonal, those of multipliers: with 1/sqrt(sum_k (a_ik S_k)^2) over
   * the unknowns k that have one. For a symmetric matrix this is the diagonal of the Schur
   * complement where a_kk alone stands for the others: their rows become as large as
   * these, whatever their units. Empty rows keep 1.
   */
  template <typename RowStart>
  inline void
  scale_rows_without_diagonal(const unsigned int         n_rows,
                              const RowStart            &row_start,
                              const int                 *column,
                              const std::vector<double> &value,
                              std::vector<double>       &scale)
  {
    std::vector<double> found(scale.begin(), scale.begin() + n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      if (scale[i] == 0.)
        {
          double square = 0.;
          for (auto k = row_start[i]; k < row_start[i + 1]; ++k)
            square += std::pow(value[k] * scale[column[k]], 2);
          found[i] = square > 0. ? 1. / std::sqrt(square) : 1.;
        }
    std::copy(found.begin(), found.end(), scale.begin());
  }
} // namespace kedge

#endif
