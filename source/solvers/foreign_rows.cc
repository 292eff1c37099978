#include "foreign_rows.h"

#include <algorithm>

namespace kedge
{
  namespace
  {
    constexpr int lengths_tag = 4714, columns_tag = 4715, values_tag = 4716;

    /** Sends and receives, one message from and to each neighbour. */
    template <typename T>
    void
    exchange(const DistributedMatrix           &matrix,
             const std::vector<std::vector<T>> &to_send,
             std::vector<std::vector<T>>       &to_receive,
             const MPI_Datatype                 type,
             const int                          tag)
    {
      const auto              &neighbours = matrix.neighbours();
      std::vector<MPI_Request> requests(2 * neighbours.size());
      for (std::size_t k = 0; k < neighbours.size(); ++k)
        {
          MPI_Irecv(to_receive[k].data(),
                    static_cast<int>(to_receive[k].size()),
                    type,
                    neighbours[k].rank,
                    tag,
                    matrix.values().communicator,
                    &requests[2 * k]);
          MPI_Isend(to_send[k].data(),
                    static_cast<int>(to_send[k].size()),
                    type,
                    neighbours[k].rank,
                    tag,
                    matrix.values().communicator,
                    &requests[2 * k + 1]);
        }
      MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }
  } // namespace



  void
  ForeignRows::reinit(const DistributedMatrix &matrix)
  {
    const SparseSystem           &system     = matrix.values();
    const auto                   &neighbours = matrix.neighbours();
    const std::size_t             n          = neighbours.size();
    std::vector<std::vector<int>> lengths(n), columns(n), foreign_lengths(n), foreign_columns(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        for (const int row : neighbours[k].rows_to_send)
          {
            const auto begin = system.row_start[row], end = system.row_start[row + 1];
            lengths[k].push_back(static_cast<int>(end - begin));
            columns[k].insert(columns[k].end(),
                              system.column.begin() + begin,
                              system.column.begin() + end);
          }
        foreign_lengths[k].resize(neighbours[k].n_received);
      }
    exchange(matrix, lengths, foreign_lengths, MPI_INT, lengths_tag);
    received.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        std::size_t sum = 0;
        for (const int length : foreign_lengths[k])
          sum += length;
        foreign_columns[k].resize(sum);
      }
    exchange(matrix, columns, foreign_columns, MPI_INT, columns_tag);

    row_start.assign(1, 0);
    column.clear();
    sources.clear();
    for (std::size_t k = 0; k < n; ++k)
      {
        received[k].values.resize(foreign_columns[k].size());
        received[k].first_source = sources.size();
        int source               = 0;
        for (const int length : foreign_lengths[k])
          {
            for (const int end = source + length; source < end; ++source)
              {
                const int local = matrix.local_number(foreign_columns[k][source]);
                if (local < 0)
                  continue;
                column.push_back(local);
                sources.push_back(source);
              }
            row_start.push_back(static_cast<std::int64_t>(column.size()));
          }
        received[k].end_source = sources.size();
      }
    value.resize(column.size());
  }



  void
  ForeignRows::get_values(const DistributedMatrix &matrix)
  {
    const SparseSystem              &system     = matrix.values();
    const auto                      &neighbours = matrix.neighbours();
    std::vector<std::vector<double>> to_send(neighbours.size()), to_receive(neighbours.size());
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      {
        for (const int row : neighbours[k].rows_to_send)
          to_send[k].insert(to_send[k].end(),
                            system.value.begin() + system.row_start[row],
                            system.value.begin() + system.row_start[row + 1]);
        to_receive[k].swap(received[k].values);
      }
    exchange(matrix, to_send, to_receive, MPI_DOUBLE, values_tag);
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      {
        received[k].values.swap(to_receive[k]);
        for (std::size_t s = received[k].first_source; s < received[k].end_source; ++s)
          value[s] = received[k].values[sources[s]];
      }
  }
} // namespace kedge
