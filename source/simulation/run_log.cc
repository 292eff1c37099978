#include <kedge/simulation/run_log.h>

namespace kedge
{
  template <int dim>
  RunLog::RunLog(const RunFolder &folder, const Scene<dim> &scene)
    : folder(folder)
    , progress(folder, scene.output.progress_interval, scene.time.start, scene.time.end)
    , rejections(folder)
    , outlook(folder, scene.time.start, scene.time.end)
    , loads(scene)
    , end(scene.time.end)
  {}



  void
  RunLog::accepted(const HistoryRow &row, const double wall)
  {
    if (progress.is_due())
      rejections.sum_up();
    progress.report(row);
    outlook.report(row.time, row.time_step, wall, rejections.last_cause());
  }



  void
  RunLog::cut(const double size, const double time, const std::string &cause)
  {
    rejections.cut(size, time, cause);
  }



  void
  RunLog::stopped(const double       size,
                  const double       time,
                  const std::string &cause,
                  const bool         at_floor)
  {
    rejections.stop(size, time, cause, at_floor ? "; the step is at its floor" : "");
  }



  void
  RunLog::outflow(const double n_points, const double time)
  {
    if (n_points > 0. && n_gone == 0.)
      folder.log() << "  material leaves the grid through its open sides, first at t = " << time
                   << " s" << std::endl;
    n_gone = n_points;
  }



  void
  RunLog::finish(const HistoryRow &row)
  {
    rejections.sum_up();
    progress.finish(row);
    if (n_gone > 0.)
      folder.log() << "  " << static_cast<std::uint64_t>(n_gone)
                   << " material points have left the grid; what they took with them stands in "
                      "the columns outflow_... of history.csv"
                   << std::endl;
  }



  void
  RunLog::say_loads(const double time)
  {
    const std::string reached = loads.factors_at(time, end);
    if (!reached.empty())
      folder.log() << "  loads and supports reached, as parts of those at Time/End: " << reached
                   << std::endl;
  }



  std::string
  RunLog::load_factors(const double time) const
  {
    return loads.factors_at(time, end, false);
  }



  std::string
  RunLog::bad_loads(const double begin, const double end_of_step) const
  {
    for (const double t : {begin, end_of_step, 0.5 * (begin + end_of_step)})
      if (const std::string bad = loads.not_finite_at(t); !bad.empty())
        return bad;
    return "";
  }

  template RunLog::RunLog(const RunFolder &, const Scene<2> &);
  template RunLog::RunLog(const RunFolder &, const Scene<3> &);
} // namespace kedge
