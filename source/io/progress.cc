#include <kedge/io/progress.h>

#include <cmath>
#include <cstdio>

namespace kedge
{
  Progress::Progress(const RunFolder &folder,
                     const double     interval,
                     const double     start_time,
                     const double     end_time)
    : folder(folder)
    , interval(interval)
    , start_time(start_time)
    , end_time(end_time)
    , start(Clock::now())
    , due(start)
  {}



  std::string
  Progress::duration(const double seconds)
  {
    const auto n = static_cast<unsigned long>(std::llround(std::min(seconds, 1e9)));
    char       text[48];
    if (n < 60)
      std::snprintf(text, sizeof(text), "%lus", n);
    else if (n < 3600)
      std::snprintf(text, sizeof(text), "%lum %02lus", n / 60, n % 60);
    else if (n < 86400)
      std::snprintf(text, sizeof(text), "%luh %02lum", n / 3600, n / 60 % 60);
    else
      std::snprintf(text, sizeof(text), "%lud %02luh", n / 86400, n / 3600 % 24);
    return text;
  }



  bool
  Progress::is_due() const
  {
    return folder.is_root() && Clock::now() >= due;
  }



  void
  Progress::report(const HistoryRow &row)
  {
    if (!folder.is_root())
      return;
    const Clock::time_point now = Clock::now();
    if (now >= due)
      print(row, now);
  }



  void
  Progress::finish(const HistoryRow &row)
  {
    if (folder.is_root() && (!any || printed_step != row.step))
      print(row, Clock::now());
  }



  void
  Progress::print(const HistoryRow &row, const Clock::time_point now)
  {
    const double seconds = std::chrono::duration<double>(now - start).count();
    const double done    = row.time - start_time;
    const double to_go   = done > 0 ? seconds * std::max(0., end_time - row.time) / done : -1.;
    folder.log() << line(row, end_time, to_go) << std::endl;
    const double pause = interval > 0. ? std::max(interval, 0.01 * seconds) : 0.;
    any                = true;
    printed_step       = row.step;
    due                = now + std::chrono::duration_cast<Clock::duration>(
                  std::chrono::duration<double>(std::min(pause, 1e9)));
  }



  std::string
  Progress::line(const HistoryRow &row, const double end_time, const double seconds_to_go)
  {
    char text[256];
    std::snprintf(text,
                  sizeof(text),
                  "step %6llu  time %.6g of %.6g s  dt %.3g s  Newton %u  points %llu",
                  static_cast<unsigned long long>(row.step),
                  row.time,
                  end_time,
                  row.time_step,
                  row.newton_iterations,
                  static_cast<unsigned long long>(row.n_points));
    return text + (seconds_to_go < 0 ? std::string() : "  to go " + duration(seconds_to_go));
  }
} // namespace kedge
