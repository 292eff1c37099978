#include "bordered_preconditioner.h"

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** A pivot of S below this part of its largest entry determines nothing: 1 stands for it. */
    constexpr double smallest_pivot = 1e-14;
  } // namespace



  BorderedPreconditioner::BorderedPreconditioner(std::unique_ptr<Preconditioner> inner,
                                                 const unsigned int              n_border)
    : inner(std::move(inner))
    , n_border(n_border)
  {}



  /** Columns are sorted: those of the border end each row. */
  void
  BorderedPreconditioner::analyse(const SparseSystem &system)
  {
    n_inside            = system.n_rows() - n_border;
    inside              = SparseSystem();
    inside.communicator = system.communicator;
    inside.n_global     = n_inside;
    for (unsigned int i = 0; i < n_inside; ++i)
      {
        for (std::int64_t k = system.row_start[i];
             k < system.row_start[i + 1] && system.column[k] < static_cast<int>(n_inside);
             ++k)
          inside.column.push_back(system.column[k]);
        inside.row_start.push_back(static_cast<std::int64_t>(inside.column.size()));
      }
    inside.value.resize(inside.column.size());
    inside_matrix.reinit(inside);
    inner->analyse(inside);
  }



  void
  BorderedPreconditioner::take_values(const DistributedMatrix &matrix)
  {
    const SparseSystem &system = matrix.values();
    for (unsigned int i = 0; i < n_inside; ++i)
      std::copy_n(system.value.begin() + system.row_start[i],
                  inside.row_start[i + 1] - inside.row_start[i],
                  inside.value.begin() + inside.row_start[i]);
    inside_matrix.set_values(inside);
  }



  void
  BorderedPreconditioner::factorise(const DistributedMatrix &matrix)
  {
    take_values(matrix);
    inner->factorise(inside_matrix);
    find_schur_complement(matrix);
  }



  void
  BorderedPreconditioner::follow(const DistributedMatrix &matrix)
  {
    take_values(matrix);
    inner->follow(inside_matrix);
    find_schur_complement(matrix);
  }



  /** Of a row of the border with the unknowns inside, scaled. */
  double
  BorderedPreconditioner::product_with_row(const DistributedMatrix &matrix,
                                           const unsigned int       row,
                                           const double            *x) const
  {
    const SparseSystem        &system = matrix.values();
    const std::vector<double> &scale  = matrix.scaling();
    double                     sum    = 0.;
    for (std::int64_t k = system.row_start[row]; k < system.row_start[row + 1]; ++k)
      if (const int j = system.column[k]; j < static_cast<int>(n_inside))
        sum += system.value[k] * scale[j] * x[j];
    return scale[row] * sum;
  }



  void
  BorderedPreconditioner::find_schur_complement(const DistributedMatrix &matrix)
  {
    const SparseSystem              &system = matrix.values();
    const std::vector<double>       &scale  = matrix.scaling();
    std::vector<std::vector<double>> border(n_border, std::vector<double>(n_inside, 0.));
    for (unsigned int i = 0; i < n_inside; ++i)
      for (std::int64_t k = system.row_start[i] + inside.row_start[i + 1] - inside.row_start[i];
           k < system.row_start[i + 1];
           ++k)
        border[system.column[k] - n_inside][i] =
          scale[i] * system.value[k] * scale[system.column[k]];
    schur.assign(std::size_t(n_border) * n_border, 0.);
    for (unsigned int i = 0; i < n_border; ++i)
      {
        const unsigned int row = n_inside + i;
        for (std::int64_t k = system.row_start[row]; k < system.row_start[row + 1]; ++k)
          if (const int j = system.column[k] - static_cast<int>(n_inside); j >= 0)
            schur[i * n_border + j] = scale[row] * system.value[k] * scale[system.column[k]];
      }
    columns.assign(n_border, std::vector<double>(n_inside, 0.));
    for (unsigned int j = 0; j < n_border; ++j)
      {
        if (std::all_of(border[j].begin(), border[j].end(), [](const double b) {
              return b == 0.;
            }))
          continue;
        inner->multiply(inside_matrix, border[j].data(), columns[j].data());
        for (unsigned int i = 0; i < n_border; ++i)
          schur[i * n_border + j] -= product_with_row(matrix, n_inside + i, columns[j].data());
      }
    factorise_schur_complement();
  }



  /** LU with partial pivoting. */
  void
  BorderedPreconditioner::factorise_schur_complement()
  {
    double largest = 0.;
    for (const double entry : schur)
      largest = std::max(largest, std::abs(entry));
    pivots.resize(n_border);
    const auto S = [&](const unsigned int i, const unsigned int j) -> double & {
      return schur[i * n_border + j];
    };
    for (unsigned int k = 0; k < n_border; ++k)
      {
        pivots[k] = k;
        for (unsigned int i = k + 1; i < n_border; ++i)
          if (std::abs(S(i, k)) > std::abs(S(pivots[k], k)))
            pivots[k] = i;
        for (unsigned int j = 0; j < n_border && pivots[k] != k; ++j)
          std::swap(S(k, j), S(pivots[k], j));
        if (!(std::abs(S(k, k)) > smallest_pivot * largest))
          S(k, k) = 1.;
        for (unsigned int i = k + 1; i < n_border; ++i)
          {
            S(i, k) /= S(k, k);
            for (unsigned int j = k + 1; j < n_border; ++j)
              S(i, j) -= S(i, k) * S(k, j);
          }
      }
  }



  void
  BorderedPreconditioner::solve_schur_complement(std::vector<double> &z) const
  {
    for (unsigned int k = 0; k < n_border; ++k)
      std::swap(z[k], z[pivots[k]]);
    for (unsigned int i = 1; i < n_border; ++i)
      for (unsigned int j = 0; j < i; ++j)
        z[i] -= schur[i * n_border + j] * z[j];
    for (unsigned int i = n_border; i-- > 0;)
      {
        for (unsigned int j = i + 1; j < n_border; ++j)
          z[i] -= schur[i * n_border + j] * z[j];
        z[i] /= schur[i * n_border + i];
      }
  }



  void
  BorderedPreconditioner::multiply(const DistributedMatrix &matrix, const double *x, double *y)
  {
    inner->multiply(inside_matrix, x, y);
    std::vector<double> z(x + n_inside, x + n_inside + n_border);
    for (unsigned int i = 0; i < n_border; ++i)
      z[i] -= product_with_row(matrix, n_inside + i, y);
    solve_schur_complement(z);
    for (unsigned int j = 0; j < n_border; ++j)
      if (z[j] != 0.)
        for (unsigned int i = 0; i < n_inside; ++i)
          y[i] -= columns[j][i] * z[j];
    std::copy(z.begin(), z.end(), y + n_inside);
  }
} // namespace kedge
