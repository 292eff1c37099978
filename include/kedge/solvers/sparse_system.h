#ifndef kedge_solvers_sparse_system_h
#define kedge_solvers_sparse_system_h

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace kedge
{
  /**
   * A sparse matrix in compressed rows, each rank holding the consecutive
   * rows [first_row, first_row + n_rows). Columns are global and sorted in
   * each row.
   */
  struct SparseSystem
  {
    MPI_Comm                  communicator = MPI_COMM_SELF;
    std::int64_t              n_global     = 0;
    std::int64_t              first_row    = 0;
    std::vector<std::int64_t> row_start    = {0}; ///< n_rows + 1 entries
    std::vector<int>          column;
    std::vector<double>       value;

    unsigned int
    n_rows() const
    {
      return static_cast<unsigned int>(row_start.size()) - 1;
    }
  };
} // namespace kedge

#endif
