#ifndef kedge_time_integration_clock_h
#define kedge_time_integration_clock_h

#include <kedge/time_integration/parameters.h>

#include <cstdint>

namespace kedge
{
  /**
   * Simulated time and the size of the next step. The nominal step is halved
   * when an attempt is rejected and doubled again, up to the nominal one,
   * after a few accepted steps. If it adapts, it is also halved after a step
   * that was hard for Newton's method, only easy steps let it grow, and it
   * may grow beyond the nominal one, up to the largest factor. Steps end
   * exactly at the break times, at the output times if there are any, and at the end.
   */
  class Clock
  {
  public:
    explicit Clock(const TimeParameters &parameters);

    /** The step that the scene asks for at this moment, before any cuts [s]. */
    void
    set_nominal_step(const double step);

    /** From now on steps end exactly at @p start plus multiples of @p interval, too [s]. */
    void
    set_output_times(const double start, const double interval);

    double
    time() const
    {
      return time_;
    }

    std::uint64_t
    n_steps() const
    {
      return n_steps_;
    }

    bool
    finished() const
    {
      return time_ >= end;
    }

    /** The next step [s]; shortened to land on a break time or the end. */
    double
    step_size() const;

    /** The time at which the next step ends, exactly a break time where it lands on one. */
    double
    next_time() const;

    /**
     * Halves the step.
     *
     * @return false if it would fall below the floor
     */
    bool
    cut_step();

    /** Goes to next_time() after a step that took @p newton_iterations. */
    void
    advance(const unsigned int newton_iterations = 0);

    /**
     * The smallest step allowed [s]: a part of the nominal step, or of the way
     * to the next break time where that is shorter.
     */
    double
    floor() const;

    /** What a checkpoint keeps. */
    struct State
    {
      double        time, nominal;
      std::uint64_t n_steps, cuts, accepted_since_cut;
    };

    State
    state() const
    {
      return {time_, nominal, n_steps_, cuts, accepted_since_cut};
    }

    void
    restore(const State &state);

  private:
    double
    next_target() const;
    double
    next_output() const;
    /** The step before it is shortened to land on a target [s]. */
    double
    whole_step() const;

    double              end;
    double              minimum_factor;
    bool                adapts;
    std::uint64_t       growths; ///< doublings from the nominal to the largest step
    std::vector<double> break_times;
    double              output_start    = 0.;
    double              output_interval = 0.; ///< 0: steps do not care
    double              time_;
    double              nominal  = 0.;
    std::uint64_t       n_steps_ = 0;
    std::uint64_t       cuts; ///< halvings from the largest step to the present one
    std::uint64_t       accepted_since_cut = 0;
  };
} // namespace kedge

#endif
