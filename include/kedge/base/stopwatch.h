#ifndef kedge_base_stopwatch_h
#define kedge_base_stopwatch_h

#include <ctime>

namespace kedge
{
  /** Time spent in a part of the program by this process. */
  struct PhaseTime
  {
    double wall = 0.; ///< [s]
    double cpu  = 0.; ///< of all threads [s]
  };

  /** Adds the time of its life to a sum. */
  class Stopwatch
  {
  public:
    explicit Stopwatch(PhaseTime &sum)
      : sum(sum)
      , wall_begin(seconds(CLOCK_MONOTONIC))
      , cpu_begin(seconds(CLOCK_PROCESS_CPUTIME_ID))
    {}
    Stopwatch(const Stopwatch &) = delete;
    Stopwatch &
    operator=(const Stopwatch &) = delete;
    ~Stopwatch()
    {
      sum.wall += seconds(CLOCK_MONOTONIC) - wall_begin;
      sum.cpu += seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin;
    }

  private:
    static double
    seconds(const clockid_t clock)
    {
      timespec time;
      clock_gettime(clock, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    PhaseTime   &sum;
    const double wall_begin, cpu_begin;
  };
} // namespace kedge

#endif
