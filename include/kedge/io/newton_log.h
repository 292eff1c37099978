#ifndef kedge_io_newton_log_h
#define kedge_io_newton_log_h

#include <kedge/io/csv_file.h>
#include <kedge/io/run_folder.h>
#include <kedge/solvers/newton.h>

#include <memory>

namespace kedge
{
  /**
   * newton.csv: one row for the residual before and after each correction of
   * every attempt at a step. `ratio` is r_k / r_{k-1}; `order` is the observed
   * order of convergence log(r_k / r_{k-1}) / log(r_{k-1} / r_{k-2}), nan
   * where there are too few residuals, and after the last correction of a
   * converged step, which reuses the tangent.
   */
  class NewtonLog
  {
  public:
    /** @p resume_at is what position() gave at the checkpoint. Collective. */
    NewtonLog(const RunFolder &folder, const std::optional<CsvPosition> &resume_at = {});

    /** Not collective; does nothing on ranks > 0. @p time is where the step would end. */
    void
    write(const std::uint64_t step,
          const double        time,
          const bool          accepted,
          const NewtonReport &report);

    /** Where the file ends, all of it on the disk; nothing on ranks > 0. */
    CsvPosition
    position();

  private:
    std::unique_ptr<CsvFile> file;
  };
} // namespace kedge

#endif
