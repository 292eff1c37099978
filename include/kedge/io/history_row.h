#ifndef kedge_io_history_row_h
#define kedge_io_history_row_h

#include <cstdint>
#include <limits>
#include <vector>

namespace kedge
{
  /**
   * One row of history.csv: the accepted step and the books after it (SI; per metre
   * of thickness in 2D).
   */
  struct HistoryRow
  {
    static constexpr double unset = std::numeric_limits<double>::signaling_NaN();

    std::uint64_t step              = 0;
    double        time              = unset; ///< [s]
    double        time_step         = unset; ///< [s]
    unsigned int  newton_iterations = 0;
    unsigned int  linear_iterations = 0;
    unsigned int  rejected_attempts = 0;
    /** Of the ledger, in the order of its columns. */
    std::vector<double> books;
    std::uint64_t       n_points  = 0; ///< of the run, for the log
    double              wall_time = 0; ///< since the start of the run [s]
  };
} // namespace kedge

#endif
