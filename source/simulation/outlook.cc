#include <kedge/io/progress.h>
#include <kedge/simulation/outlook.h>

#include <algorithm>
#include <sstream>

namespace kedge
{
  namespace
  {
    constexpr double window    = 5.;     ///< wall time over which the pace is taken [s]
    constexpr double too_long  = 86400.; ///< wall time [s]
    constexpr double far_more  = 20.;    ///< times the wall time so far
    constexpr double too_small = 0.01;   ///< of the largest step
  }                                      // namespace



  Outlook::Outlook(const RunFolder &folder, const double start, const double end)
    : folder(folder)
    , end(end)
    , window_time(start)
  {}



  void
  Outlook::report(const double time, const double step, const double wall, const std::string &cause)
  {
    const std::string text = warning(time, step, wall, cause);
    if (!text.empty())
      folder.log() << text << std::endl;
  }



  std::string
  Outlook::warning(const double       time,
                   const double       step,
                   const double       wall,
                   const std::string &cause)
  {
    largest = std::max(largest, step);
    if (wall - window_wall < window)
      return "";
    const double pace  = (time - window_time) / (wall - window_wall);
    const double to_go = (end - time) / pace;
    window_time        = time;
    window_wall        = wall;
    if (step > too_small * largest || to_go < std::max(too_long, far_more * wall) ||
        to_go < 10. * announced)
      return "";
    announced = to_go;
    std::ostringstream text;
    text << "  WARNING: at this pace the run takes another " << Progress::duration(to_go)
         << ". Its steps, now " << step << " s, are " << step / largest << " of the largest one. "
         << (cause.empty() ? "They follow Time/Step, which the stiffest or lightest cells rule."
                           : "The last step that was cut: " + cause + ".")
         << " A signal (Ctrl-C) ends the run with a checkpoint.";
    return text.str();
  }
} // namespace kedge
