#ifndef kedge_io_progress_h
#define kedge_io_progress_h

#include <kedge/io/history_row.h>
#include <kedge/io/run_folder.h>

#include <chrono>
#include <string>

namespace kedge
{
  /**
   * Progress lines in the log: time, step, step size, Newton iterations, points, time to
   * go. At most one per @p interval wall seconds, and rarer the longer a run lasts: one per
   * hundredth of its time, so that an hour gives about 450 lines. An interval of 0 gives
   * a line per step.
   */
  class Progress
  {
  public:
    Progress(const RunFolder &folder,
             const double     interval,
             const double     start_time,
             const double     end_time);

    /** After an accepted step. Looks at the clock and returns if it is not yet time. */
    void
    report(const HistoryRow &row);

    /** Whether report() would print now. */
    bool
    is_due() const;

    /** Prints the last line whatever the clock says, unless it stands already. */
    void
    finish(const HistoryRow &row);

    /** One line, without its end. @p seconds_to_go < 0: unknown. */
    static std::string
    line(const HistoryRow &row, const double end_time, const double seconds_to_go);

    /** 42s, 3m 07s, 2h 05m, 3d 04h. */
    static std::string
    duration(const double seconds);

  private:
    using Clock = std::chrono::steady_clock;

    void
    print(const HistoryRow &row, const Clock::time_point now);

    const RunFolder  &folder;
    double            interval;
    double            start_time;
    double            end_time;
    Clock::time_point start;
    Clock::time_point due;
    bool              any          = false;
    std::uint64_t     printed_step = 0;
  };
} // namespace kedge

#endif
