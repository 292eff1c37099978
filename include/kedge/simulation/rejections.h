#ifndef kedge_simulation_rejections_h
#define kedge_simulation_rejections_h

#include <kedge/io/run_folder.h>

#include <string>

namespace kedge
{
  /**
   * Attempts at steps that failed, in the log: the first ones in full, those that
   * follow summed up, so that a run that is cut again and again can still be read.
   */
  class Rejections
  {
  public:
    explicit Rejections(const RunFolder &folder);

    /** An attempt over @p size [s] from @p time [s] on; the run tries again with less. */
    void
    cut(const double size, const double time, const std::string &cause);

    /** The last attempt of a run that stops; @p why is what follows the cause. */
    void
    stop(const double size, const double time, const std::string &cause, const std::string &why);

    /** Sums up what was not shown. */
    void
    sum_up();

    /** Cause of the last rejection; empty if there was none. */
    const std::string &
    last_cause() const;

  private:
    void
    print(const double size, const double time, const std::string &cause, const std::string &next);

    const RunFolder &folder;
    std::string      cause;
    unsigned int     n_shown  = 0;
    unsigned int     n_hidden = 0;  ///< since the last line
    double           smallest = 0.; ///< of the hidden ones [s]
    double           last     = 0.; ///< time of the last hidden one [s]
  };
} // namespace kedge

#endif
