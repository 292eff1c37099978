#ifndef kedge_simulation_run_log_h
#define kedge_simulation_run_log_h

#include <kedge/io/progress.h>
#include <kedge/scene/scene.h>
#include <kedge/simulation/outlook.h>
#include <kedge/simulation/rejections.h>
#include <kedge/simulation/scene_loads.h>

namespace kedge
{
  /** What a run says of its steps: progress, rejected attempts, where it stopped and why. */
  class RunLog
  {
  public:
    template <int dim>
    RunLog(const RunFolder &folder, const Scene<dim> &scene);

    /** An accepted step; @p wall is the wall time of the run so far [s]. */
    void
    accepted(const HistoryRow &row, const double wall);

    /** An attempt that is repeated with less. */
    void
    cut(const double size, const double time, const std::string &cause);

    /** The attempt at which the run stops. */
    void
    stopped(const double size, const double time, const std::string &cause, const bool at_floor);

    /** How many points have left the grid in the run so far; says so of the first ones. */
    void
    outflow(const double n_points, const double time);

    /** The last line of progress. */
    void
    finish(const HistoryRow &row);

    /** How far the loads had grown where the run stopped. */
    void
    say_loads(const double time);

    /** The loads alone as a text, "Body force 0.87"; empty if none changes. */
    std::string
    load_factors(const double time) const;

    /** Which loads between two times are no finite numbers; empty if all are. */
    std::string
    bad_loads(const double begin, const double end) const;

  private:
    const RunFolder &folder;
    Progress         progress;
    Rejections       rejections;
    Outlook          outlook;
    SceneLoads       loads;
    double           end;         ///< of the run [s]
    double           n_gone = 0.; ///< points that have left the grid
  };
} // namespace kedge

#endif
