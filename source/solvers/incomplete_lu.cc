#include "incomplete_lu.h"

#include <cmath>

namespace kedge
{
  namespace
  {
    /** Entries below this, where diagonals are 1, are left out. */
    constexpr double threshold = 0.01;

    /** Pivots that fall below this are left at the diagonal's 1. */
    constexpr double smallest_pivot = 1e-3;
  } // namespace



  void
  IncompleteLu::copy_large_entries(const DistributedMatrix &matrix)
  {
    const SparseSystem        &system = matrix.values();
    const std::vector<double> &scale  = matrix.scaling();
    const int                  n      = static_cast<int>(matrix.n_rows());
    const int                 *from   = matrix.columns();
    row_start.assign(1, 0);
    diagonal.resize(n);
    column.clear();
    value.clear();
    for (int i = 0; i < n; ++i)
      {
        bool has_diagonal = false;
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          {
            const int j = from[k];
            if (j >= n)
              continue;
            if (j >= i && !has_diagonal)
              {
                has_diagonal = true;
                diagonal[i]  = static_cast<std::int64_t>(column.size());
                column.push_back(i);
                value.push_back(j == i ? scale[i] * scale[i] * system.value[k] : 1.);
                if (j == i)
                  continue;
              }
            const double entry = scale[i] * scale[j] * system.value[k];
            if (std::abs(entry) > threshold)
              {
                column.push_back(j);
                value.push_back(entry);
              }
          }
        if (!has_diagonal)
          {
            diagonal[i] = static_cast<std::int64_t>(column.size());
            column.push_back(i);
            value.push_back(1.);
          }
        row_start.push_back(static_cast<std::int64_t>(column.size()));
      }
  }



  void
  IncompleteLu::factorise(const DistributedMatrix &matrix)
  {
    copy_large_entries(matrix);
    const int n = static_cast<int>(matrix.n_rows());
    place.assign(n, -1);
    for (int i = 0; i < n; ++i)
      {
        for (std::int64_t k = row_start[i]; k < row_start[i + 1]; ++k)
          place[column[k]] = k;
        for (std::int64_t k = row_start[i]; k < diagonal[i]; ++k)
          {
            const int j = column[k];
            value[k] *= value[diagonal[j]];
            for (std::int64_t q = diagonal[j] + 1; q < row_start[j + 1]; ++q)
              if (place[column[q]] >= 0)
                value[place[column[q]]] -= value[k] * value[q];
          }
        double &pivot = value[diagonal[i]];
        pivot         = std::abs(pivot) > smallest_pivot ? 1. / pivot : 1.;
        for (std::int64_t k = row_start[i]; k < row_start[i + 1]; ++k)
          place[column[k]] = -1;
      }
  }



  void
  IncompleteLu::solve(double *x) const
  {
    const int n = static_cast<int>(diagonal.size());
    for (int i = 0; i < n; ++i)
      {
        double sum = x[i];
        for (std::int64_t k = row_start[i]; k < diagonal[i]; ++k)
          sum -= value[k] * x[column[k]];
        x[i] = sum;
      }
    for (int i = n - 1; i >= 0; --i)
      {
        double sum = x[i];
        for (std::int64_t k = diagonal[i] + 1; k < row_start[i + 1]; ++k)
          sum -= value[k] * x[column[k]];
        x[i] = sum * value[diagonal[i]];
      }
  }
} // namespace kedge
