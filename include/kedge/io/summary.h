#ifndef kedge_io_summary_h
#define kedge_io_summary_h

#include <kedge/equations/ledger.h>
#include <kedge/io/check_result.h>
#include <kedge/io/history_row.h>
#include <kedge/io/run_folder.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace kedge
{
  /** What summary.json says of a run. Times are wall seconds of the slowest rank. */
  struct RunSummary
  {
    std::map<std::string, std::string>
                 versions; ///< kedge, deal.II, Trilinos, p4est, BLAS, build_type
    std::string  scene;
    std::string  title;
    std::string  status; ///< finished, interrupted, numerical_stop
    std::string  reason; ///< of a stop, or of a limit load; else empty
    unsigned int dim     = 2;
    unsigned int n_ranks = 1;

    std::vector<std::string> bodies; ///< their names, in the order of the numbers of the field body

    std::map<std::string, std::uint64_t> counts; ///< points, active cells, dofs ..

    std::uint64_t n_steps                    = 0;
    std::uint64_t n_newton_iterations        = 0;
    std::uint64_t n_linear_iterations        = 0;
    std::uint64_t n_rejected_attempts        = 0;
    double        largest_condition_estimate = 0.; ///< of the tangents; 0 if unknown

    double                        wall_seconds = 0;
    double                        cpu_seconds  = 0; ///< of all ranks together
    std::map<std::string, double> phase_wall_seconds;
    std::map<std::string, double> phase_cpu_seconds;     ///< of all ranks together
    double                        peak_memory_bytes = 0; ///< of all ranks together

    double largest_displacement = HistoryRow::unset; ///< of a point, of quasi-static runs [m]

    /** Material points times Newton iterations over the time spent in them [1/s]. */
    double point_updates_per_second = HistoryRow::unset;

    std::vector<Ledger::Column> columns; ///< of the books in final_row
    HistoryRow                  final_row;
    std::vector<CheckResult>    checks;
  };

  /** The text of summary.json. */
  std::string
  summary_json(const RunSummary &summary);

  /** Replaces summary.json atomically by rank 0. Collective. */
  void
  write_summary(const RunFolder &folder, const RunSummary &summary);

  /** Sum over the ranks of the peak memory [bytes]. Collective. */
  double
  peak_memory(const MPI_Comm communicator);

  /** Sum over the ranks of the processor time used so far, all threads [s]. Collective. */
  double
  cpu_seconds(const MPI_Comm communicator);
} // namespace kedge

#endif
