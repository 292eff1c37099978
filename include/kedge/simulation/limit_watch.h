#ifndef kedge_simulation_limit_watch_h
#define kedge_simulation_limit_watch_h

#include <map>
#include <string>

namespace kedge
{
  /**
   * How far a quasi-static run has moved its bodies, by which one knows a limit load: near it the
   * largest displacement of all points grows faster and faster with the load, and beyond it there
   * is no equilibrium.
   */
  class LimitWatch
  {
  public:
    /** @p failure_displacement [m] ends the run; 0: none does. */
    explicit LimitWatch(const double failure_displacement);

    /** After an accepted step: the largest displacement of all points since the start [m]. */
    void
    add(const double time_step, const double largest_displacement);

    double
    largest_displacement() const
    {
      return displacement;
    }

    /** Whether a point has moved by the failure displacement. */
    bool
    has_failed() const;

    /** Whether displacements grow many times as fast as in the first step that moved anything. */
    bool
    runs_away() const;

    /**
     * "the largest displacement, 0.03 m, was still growing at 0.2 m/s, 300 times as fast as in the
     * first step"; empty before the second step.
     */
    std::string
    growth() const;

    /** What a checkpoint keeps, and takes back. */
    std::map<std::string, double>
    save() const;
    void
    restore(const std::map<std::string, double> &values);

  private:
    const double failure_displacement;
    double       displacement = 0.; ///< [m]
    double       first_rate   = 0.; ///< of the first step that moved anything [m/s]
    double       last_rate    = 0.; ///< [m/s]
  };
} // namespace kedge

#endif
