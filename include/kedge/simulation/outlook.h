#ifndef kedge_simulation_outlook_h
#define kedge_simulation_outlook_h

#include <kedge/io/run_folder.h>

#include <string>

namespace kedge
{
  /**
   * Says in time that a run whose steps have shrunk cannot end in a sensible time: when,
   * at the pace of the last seconds, it would take more than a day and
   * twenty times as long as it has run, with steps of less than a hundredth of the largest.
   * Again each time when that has grown tenfold.
   */
  class Outlook
  {
  public:
    Outlook(const RunFolder &folder, const double start, const double end);

    /**
     * After an accepted step.
     *
     * @param time     reached [s]
     * @param step     its size [s]
     * @param wall     wall time of the run so far [s]
     * @param cause    of the last rejected step; may be empty
     */
    void
    report(const double time, const double step, const double wall, const std::string &cause);

    /** What report() would say; empty if all is well. */
    std::string
    warning(const double time, const double step, const double wall, const std::string &cause);

  private:
    const RunFolder &folder;
    double           end;
    double           window_time;      ///< simulated time when the window began [s]
    double           window_wall = 0.; ///< wall time then [s]
    double           largest     = 0.; ///< step so far [s]
    double           announced   = 0.; ///< time to go that was said last [s]
  };
} // namespace kedge

#endif
