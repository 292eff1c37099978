#include "distributed_matrix.h"
#include "scaling.h"

#include <kedge/base/pack.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace kedge
{
  namespace
  {
    constexpr int exchange_tag = 4713;
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
    neighbours_.clear();
    foreign.clear();
    if (n_ranks > 1)
      {
        for (const int column : system.column)
          if (column < low || column >= high)
            foreign.push_back(column);
        std::sort(foreign.begin(), foreign.end());
        foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
        local_column.reserve(system.column.size());
        for (const int column : system.column)
          local_column.push_back(local_number(column));
        plan_exchange();
      }
    scale.resize(n + foreign.size());
    scaled.resize(n + foreign.size());
    find_row_groups();
  }



  int
  DistributedMatrix::local_number(const int column) const
  {
    const int n = static_cast<int>(n_rows()), low = static_cast<int>(system->first_row);
    if (column >= low && column < low + n)
      return column - low;
    const auto place = std::lower_bound(foreign.begin(), foreign.end(), column);
    return place != foreign.end() && *place == column
             ? n + static_cast<int>(place - foreign.begin())
             : -1;
  }



  void
  DistributedMatrix::plan_exchange()
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
        const auto first = std::lower_bound(foreign.begin(), foreign.end(), first_rows[rank]);
        const auto last  = std::lower_bound(foreign.begin(), foreign.end(), first_rows[rank + 1]);
        begin[rank]      = static_cast<int>(first - foreign.begin());
        wanted[rank]     = static_cast<int>(last - first);
      }
    MPI_Alltoall(wanted.data(), 1, MPI_INT, given.data(), 1, MPI_INT, system->communicator);
    std::vector<MPI_Request> requests;
    for (int rank = 0; rank < n_ranks; ++rank)
      if (rank != me && (wanted[rank] > 0 || given[rank] > 0))
        neighbours_.push_back({rank, std::vector<int>(given[rank]), n + begin[rank], wanted[rank]});
    for (Neighbour &neighbour : neighbours_)
      {
        requests.resize(requests.size() + 2);
        MPI_Irecv(neighbour.rows_to_send.data(),
                  static_cast<int>(neighbour.rows_to_send.size()),
                  MPI_INT,
                  neighbour.rank,
                  exchange_tag,
                  system->communicator,
                  &requests[requests.size() - 2]);
        MPI_Isend(foreign.data() + (neighbour.first_received - n),
                  neighbour.n_received,
                  MPI_INT,
                  neighbour.rank,
                  exchange_tag,
                  system->communicator,
                  &requests[requests.size() - 1]);
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    std::size_t n_sent = 0;
    for (Neighbour &neighbour : neighbours_)
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
    if (neighbours_.empty())
      return;
    std::vector<MPI_Request> requests(2 * neighbours_.size());
    double                  *outgoing = buffer.data();
    for (std::size_t k = 0; k < neighbours_.size(); ++k)
      {
        const Neighbour &neighbour = neighbours_[k];
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
    groups.clear();
    runs.clear();
    const auto row = [&](const unsigned int i) {
      return system->column.begin() + system->row_start[i];
    };
    for (unsigned int first = 0; first < n_rows(); first += groups.back().n_rows)
      {
        RowGroup group{first, 1, 0, 0};
        while (first + group.n_rows < n_rows() && std::equal(row(first),
                                                             row(first + 1),
                                                             row(first + group.n_rows),
                                                             row(first + group.n_rows + 1)))
          ++group.n_rows;
        find_runs(group);
        groups.push_back(group);
      }
  }



  void
  DistributedMatrix::find_runs(RowGroup &group)
  {
    group.first_run = runs.size();
    for (std::int64_t k = system->row_start[group.first_row];
         k < system->row_start[group.first_row + 1];
         ++k)
      {
        const int column = columns()[k];
        if (runs.size() > group.first_run && column == runs.back().first + runs.back().length)
          ++runs.back().length;
        else
          runs.push_back({column, 1});
      }
    group.end_run = runs.size();
  }



  void
  DistributedMatrix::set_values(const SparseSystem &system)
  {
    this->system = &system;
    scale_by_diagonal(n_rows(), system.row_start, columns(), system.value, scale);
    exchange(scale.data());
    scale_rows_without_diagonal(n_rows(), system.row_start, columns(), system.value, scale);
    exchange(scale.data());
  }



  /** Row by row: the processor fetches one stream of entries ahead better than three. */
  void
  DistributedMatrix::multiply_rows(const RowGroup &group, double *y) const
  {
    for (unsigned int i = group.first_row; i < group.first_row + group.n_rows; ++i)
      {
        const double *value = system->value.data() + system->row_start[i];
        Pack          sums  = 0., entries, x;
        double        sum   = 0.;
        for (std::size_t r = group.first_run; r < group.end_run; ++r)
          {
            const double *from   = scaled.data() + runs[r].first;
            const int     length = runs[r].length;
            int           k      = 0;
            for (; k + static_cast<int>(pack_width) <= length; k += pack_width)
              {
                std::memcpy(&entries, value + k, sizeof(Pack));
                std::memcpy(&x, from + k, sizeof(Pack));
                sums += entries * x;
              }
            for (; k < length; ++k)
              sum += value[k] * from[k];
            value += length;
          }
        for (unsigned int lane = 0; lane < pack_width; ++lane)
          sum += sums[lane];
        y[i] = scale[i] * sum;
      }
  }



  void
  DistributedMatrix::multiply(const double *x, double *y) const
  {
    for (unsigned int i = 0; i < n_rows(); ++i)
      scaled[i] = scale[i] * x[i];
    exchange(scaled.data());
    for (const RowGroup &group : groups)
      multiply_rows(group, y);
  }
} // namespace kedge
