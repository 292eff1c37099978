#include <kedge/time_integration/clock.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Accepted steps after which a cut step is doubled again. */
    constexpr unsigned int steps_before_growth = 3;

    /** Newton iterations of a step that lets the next ones grow. */
    constexpr unsigned int easy_iterations = 5;

    /** Newton iterations of a step that makes the next one smaller. */
    constexpr unsigned int hard_iterations = 10;

    /** A remainder of less than this part of a step is not worth a step of its own. */
    constexpr double step_tolerance = 1e-6;
  } // namespace



  Clock::Clock(const TimeParameters &parameters)
    : end(parameters.end)
    , minimum_factor(parameters.minimum_step_factor)
    , adapts(parameters.adapt_step)
    , growths(adapts ? static_cast<std::uint64_t>(std::log2(parameters.maximum_step_factor)) : 0)
    , break_times(parameters.break_times)
    , time_(parameters.start)
    , cuts(growths)
  {
    std::sort(break_times.begin(), break_times.end());
  }



  void
  Clock::set_nominal_step(const double step)
  {
    nominal = step;
  }



  void
  Clock::set_output_times(const double start, const double interval)
  {
    output_start    = start;
    output_interval = interval;
  }



  double
  Clock::next_output() const
  {
    if (!(output_interval > 0.))
      return end;
    // a time that was hit may lie below its multiple by rounding
    const double n_past = std::floor((time_ - output_start) / output_interval + step_tolerance);
    return output_start + (n_past + 1.) * output_interval;
  }



  double
  Clock::next_target() const
  {
    const double target = std::min(next_output(), end);
    for (const double t : break_times)
      if (t > time_)
        return std::min(t, target);
    return target;
  }



  double
  Clock::step_size() const
  {
    return next_time() - time_;
  }



  double
  Clock::next_time() const
  {
    const double step   = whole_step();
    const double target = next_target();
    return target - time_ < step * (1. + step_tolerance) ? target : time_ + step;
  }



  double
  Clock::whole_step() const
  {
    return std::ldexp(nominal, static_cast<int>(growths) - static_cast<int>(cuts));
  }



  bool
  Clock::cut_step()
  {
    accepted_since_cut = 0;
    // a step shortened by a target is cut below itself, not below the nominal one
    const double present = step_size();
    do
      ++cuts;
    while (whole_step() > 0.75 * present);
    return whole_step() >= floor() * (1. - step_tolerance);
  }



  double
  Clock::floor() const
  {
    const double whole =
      std::min(nominal, std::max(next_target() - time_, step_tolerance * nominal));
    return whole * minimum_factor;
  }



  void
  Clock::advance(const unsigned int newton_iterations)
  {
    time_ = next_time();
    ++n_steps_;
    // cuts of a step that the target had made short do not make the next ones so
    while (cuts > 0 && whole_step() < floor() * (1. - step_tolerance))
      --cuts;
    if (adapts && newton_iterations > easy_iterations)
      {
        accepted_since_cut = 0;
        if (newton_iterations >= hard_iterations && 0.5 * whole_step() >= floor())
          ++cuts;
      }
    else if (cuts > 0 && ++accepted_since_cut >= steps_before_growth)
      {
        --cuts;
        accepted_since_cut = 0;
      }
  }



  void
  Clock::restore(const State &state)
  {
    time_              = state.time;
    nominal            = state.nominal;
    n_steps_           = state.n_steps;
    cuts               = state.cuts;
    accepted_since_cut = state.accepted_since_cut;
  }
} // namespace kedge
