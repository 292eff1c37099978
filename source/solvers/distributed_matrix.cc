#include "distributed_matrix.h"

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    constexpr int exchange_tag = 4713;

    /** Rows of one node have the same columns: at most three displacements and a pressure. */
    constexpr unsigned int most_together = 4;
  } // namespace



  void
  DistributedMatrix::reinit(const SparseSystem &system)
  {
    this->system   = &system;
    const int n    = static_cast<int>(system.n_rows());
    const int low  = static_cast<int>(system.first_row);
    const int high = low + n;
    int       n_ranks;
    MPI_Comm_size(system.communicator, &n_ranks);
    local_column.clear();
    neighbours.clear();
    std::vector<int> foreign;
    if (n_ranks > 1)
      {
        for (const int column : system.column)
          if (column < low || column >= high)
            foreign.push_back(column);
        std::sort(foreign.begin(), foreign.end());
        foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
        local_column.reserve(system.column.size());
        for (const int column : system.column)
          local_column.push_back(
            column >= low && column < high
              ? column - low
              : n + static_cast<int>(std::lower_bound(foreign.begin(), foreign.end(), column) -
                                     foreign.begin()));
        plan_exchange(foreign);
      }
    scale.resize(n + foreign.size());
    scaled.resize(n + foreign.size());
    find_row_groups();
  }



  void
  DistributedMatrix::plan_exchange(const std::vector<int> &foreign_columns)
  {
    int n_ranks, me;
    MPI_Comm_size(system->communicator, &n_ranks);
    MPI_Comm_rank(system->communicator, &me);
    const int n = static_cast<int>(system->n_rows()), low = static_cast<int>(system->first_row);
    std::vector<int> first_rows(n_ranks + 1, static_cast<int>(system->n_global));
    MPI_Allgather(&low, 1, MPI_INT, first_rows.data(), 1, MPI_INT, system->communicator);

    std::vector<int> wanted(n_ranks, 0), given(n_ranks, 0), begin(n_ranks, 0);
    for (int rank = 0; rank < n_ranks; ++rank)
      {
        const auto first =
          std::lower_bound(foreign_columns.begin(), foreign_columns.end(), first_rows[rank]);
        const auto last =
          std::lower_bound(foreign_columns.begin(), foreign_columns.end(), first_rows[rank + 1]);
        begin[rank]  = static_cast<int>(first - foreign_columns.begin());
        wanted[rank] = static_cast<int>(last - first);
      }
    MPI_Alltoall(wanted.data(), 1, MPI_INT, given.data(), 1, MPI_INT, system->communicator);
    std::vector<MPI_Request> requests;
    for (int rank = 0; rank < n_ranks; ++rank)
      if (rank != me && (wanted[rank] > 0 || given[rank] > 0))
        neighbours.push_back({rank, std::vector<int>(given[rank]), n + begin[rank], wanted[rank]});
    for (Neighbour &neighbour : neighbours)
      {
        requests.resize(requests.size() + 2);
        MPI_Irecv(neighbour.rows_to_send.data(),
                  static_cast<int>(neighbour.rows_to_send.size()),
                  MPI_INT,
                  neighbour.rank,
                  exchange_tag,
                  system->communicator,
                  &requests[requests.size() - 2]);
        MPI_Isend(foreign_columns.data() + (neighbour.first_received - n),
                  neighbour.n_received,
                  MPI_INT,
                  neighbour.rank,
                  exchange_tag,
                  system->communicator,
                  &requests[requests.size() - 1]);
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    std::size_t n_sent = 0;
    for (Neighbour &neighbour : neighbours)
      {
        n_sent += neighbour.rows_to_send.size();
        for (int &row : neighbour.rows_to_send)
          row -= low;
      }
    buffer.resize(n_sent);
  }



  void
  DistributedMatrix::exchange(double *x) const
  {
    if (neighbours.empty())
      return;
    std::vector<MPI_Request> requests(2 * neighbours.size());
    double                  *outgoing = buffer.data();
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      {
        const Neighbour &neighbour = neighbours[k];
        MPI_Irecv(x + neighbour.first_received,
                  neighbour.n_received,
                  MPI_DOUBLE,
                  neighbour.rank,
                  exchange_tag,
                  system->communicator,
                  &requests[2 * k]);
        const int n_sent = static_cast<int>(neighbour.rows_to_send.size());
        for (int i = 0; i < n_sent; ++i)
          outgoing[i] = x[neighbour.rows_to_send[i]];
        MPI_Isend(outgoing,
                  n_sent,
                  MPI_DOUBLE,
                  neighbour.rank,
                  exchange_tag,
                  system->communicator,
                  &requests[2 * k + 1]);
        outgoing += n_sent;
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }



  void
  DistributedMatrix::find_row_groups()
  {
    rows_together.assign(n_rows(), 1);
    const auto row = [&](const unsigned int i) {
      return system->column.begin() + system->row_start[i];
    };
    for (unsigned int first = 0; first < n_rows(); first += rows_together[first])
      for (unsigned int i = first + 1; i < std::min(n_rows(), first + most_together); ++i)
        {
          if (!std::equal(row(first), row(first + 1), row(i), row(i + 1)))
            break;
          ++rows_together[first];
        }
  }



  void
  DistributedMatrix::set_values(const SparseSystem &system)
  {
    this->system = &system;
    for (unsigned int i = 0; i < n_rows(); ++i)
      {
        scale[i]      = 1.;
        const int row = static_cast<int>(system.first_row) + static_cast<int>(i);
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          if (system.column[k] == row && system.value[k] != 0.)
            scale[i] = 1. / std::sqrt(std::abs(system.value[k]));
      }
    exchange(scale.data());
  }



  template <int n_together>
  void
  DistributedMatrix::multiply_rows(const unsigned int first, double *y) const
  {
    const std::int64_t begin           = system->row_start[first];
    const std::int64_t length          = system->row_start[first + 1] - begin;
    const int         *column          = columns() + begin;
    const double      *value           = system->value.data() + begin;
    double             sum[n_together] = {};
    for (std::int64_t k = 0; k < length; ++k)
      {
        const double x = scaled[column[k]];
        for (int r = 0; r < n_together; ++r)
          sum[r] += value[r * length + k] * x;
      }
    for (int r = 0; r < n_together; ++r)
      y[first + r] = scale[first + r] * sum[r];
  }



  void
  DistributedMatrix::multiply(const double *x, double *y) const
  {
    for (unsigned int i = 0; i < n_rows(); ++i)
      scaled[i] = scale[i] * x[i];
    exchange(scaled.data());
    for (unsigned int i = 0; i < n_rows(); i += rows_together[i])
      switch (rows_together[i])
        {
          case 1:
            multiply_rows<1>(i, y);
            break;
          case 2:
            multiply_rows<2>(i, y);
            break;
          case 3:
            multiply_rows<3>(i, y);
            break;
          default:
            multiply_rows<4>(i, y);
        }
  }
} // namespace kedge
