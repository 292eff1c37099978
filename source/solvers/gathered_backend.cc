#include "gathered_backend.h"
#include "scaling.h"

#include <numeric>

namespace kedge
{
  namespace
  {
    std::vector<int>
    offsets(const std::vector<int> &counts)
    {
      std::vector<int> result(counts.size(), 0);
      std::partial_sum(counts.begin(), counts.end() - 1, result.begin() + 1);
      return result;
    }

    /** What rank 0 found out, told to all. */
    LinearStatus
    agree(LinearStatus status, const MPI_Comm communicator, const int rank)
    {
      std::int64_t message[3] = {status.success ? 1 : 0, status.equation, status.weakest_equation};
      MPI_Bcast(message, 3, MPI_INT64_T, 0, communicator);
      MPI_Bcast(&status.condition_estimate, 1, MPI_DOUBLE, 0, communicator);
      if (rank != 0)
        {
          status.success          = message[0] == 1;
          status.equation         = message[1];
          status.weakest_equation = message[2];
          status.cause            = status.success ? "" : "singular or ill-conditioned matrix";
        }
      return status;
    }
  } // namespace



  void
  GatheredBackend::gather_pattern(const SparseSystem &system)
  {
    communicator = system.communicator;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    const int n_rows = system.n_rows(), n_entries = static_cast<int>(system.column.size());
    rows_of_rank.resize(n_ranks);
    entries_of_rank.resize(n_ranks);
    MPI_Allgather(&n_rows, 1, MPI_INT, rows_of_rank.data(), 1, MPI_INT, communicator);
    MPI_Allgather(&n_entries, 1, MPI_INT, entries_of_rank.data(), 1, MPI_INT, communicator);
    first_row_of_rank   = offsets(rows_of_rank);
    first_entry_of_rank = offsets(entries_of_rank);

    std::vector<int> lengths(n_rows), all_lengths(system.n_global);
    for (int i = 0; i < n_rows; ++i)
      lengths[i] = static_cast<int>(system.row_start[i + 1] - system.row_start[i]);
    matrix.n = static_cast<int>(system.n_global);
    if (rank == 0)
      matrix.column.resize(first_entry_of_rank.back() + entries_of_rank.back());
    MPI_Gatherv(lengths.data(),
                n_rows,
                MPI_INT,
                all_lengths.data(),
                rows_of_rank.data(),
                first_row_of_rank.data(),
                MPI_INT,
                0,
                communicator);
    MPI_Gatherv(system.column.data(),
                n_entries,
                MPI_INT,
                matrix.column.data(),
                entries_of_rank.data(),
                first_entry_of_rank.data(),
                MPI_INT,
                0,
                communicator);
    if (rank == 0)
      {
        matrix.row_start.assign(matrix.n + 1, 0);
        std::partial_sum(all_lengths.begin(), all_lengths.end(), matrix.row_start.begin() + 1);
        matrix.value.resize(matrix.column.size());
      }
  }



  LinearStatus
  GatheredBackend::factorise(const SparseSystem &system, const bool new_pattern, const double shift)
  {
    if (new_pattern)
      gather_pattern(system);
    MPI_Gatherv(system.value.data(),
                static_cast<int>(system.value.size()),
                MPI_DOUBLE,
                matrix.value.data(),
                entries_of_rank.data(),
                first_entry_of_rank.data(),
                MPI_DOUBLE,
                0,
                communicator);
    LinearStatus status;
    if (rank == 0)
      {
        scaling.assign(matrix.n, 1.);
        scale_by_diagonal(matrix.n, matrix.row_start, matrix.column.data(), matrix.value, scaling);
        scale_rows_without_diagonal(matrix.n,
                                    matrix.row_start,
                                    matrix.column.data(),
                                    matrix.value,
                                    scaling);
        for (int i = 0; i < matrix.n; ++i)
          for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
            {
              matrix.value[k] *= scaling[i] * scaling[matrix.column[k]];
              if (matrix.column[k] == i)
                matrix.value[k] += shift;
            }
        status = factorise_gathered(matrix, new_pattern);
      }
    return n_ranks > 1 ? agree(status, communicator, rank) : status;
  }



  bool
  GatheredBackend::is_symmetric(const Matrix &matrix)
  {
    // Rows ascend, and columns within rows, so that the entries right of the
    // diagonal of row j are asked for one after the other.
    std::vector<int> next(matrix.n);
    for (int i = 0; i < matrix.n; ++i)
      {
        int k = matrix.row_start[i];
        for (; k < matrix.row_start[i + 1] && matrix.column[k] < i; ++k)
          {
            const int transpose = next[matrix.column[k]]++;
            if (transpose == matrix.row_start[matrix.column[k] + 1] ||
                matrix.column[transpose] != i ||
                !(std::abs(matrix.value[transpose] - matrix.value[k]) <= symmetry_tolerance))
              return false;
          }
        while (k < matrix.row_start[i + 1] && matrix.column[k] == i)
          ++k;
        next[i] = k;
      }
    for (int i = 0; i < matrix.n; ++i)
      if (next[i] != matrix.row_start[i + 1])
        return false;
    return true;
  }



  LinearStatus
  GatheredBackend::solve(const std::vector<double> &b,
                         std::vector<double>       &x,
                         const double,
                         const unsigned int)
  {
    std::vector<double> all(rank == 0 ? matrix.n : 0);
    MPI_Gatherv(b.data(),
                static_cast<int>(b.size()),
                MPI_DOUBLE,
                all.data(),
                rows_of_rank.data(),
                first_row_of_rank.data(),
                MPI_DOUBLE,
                0,
                communicator);
    LinearStatus status;
    if (rank == 0)
      {
        for (int i = 0; i < matrix.n; ++i)
          all[i] *= scaling[i];
        status = solve_gathered(all);
        for (int i = 0; i < matrix.n; ++i)
          all[i] *= scaling[i];
      }
    x.resize(b.size());
    MPI_Scatterv(all.data(),
                 rows_of_rank.data(),
                 first_row_of_rank.data(),
                 MPI_DOUBLE,
                 x.data(),
                 static_cast<int>(x.size()),
                 MPI_DOUBLE,
                 0,
                 communicator);
    return n_ranks > 1 ? agree(status, communicator, rank) : status;
  }
} // namespace kedge
