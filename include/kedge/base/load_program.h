#ifndef kedge_base_load_program_h
#define kedge_base_load_program_h

namespace kedge
{
  /**
   * When the expressions of loads are evaluated, and by which factor they count. In a run
   * they follow the time; in a stage before it they stand still at the start of
   * the run, and may grow from nothing over the stage.
   */
  class LoadProgram
  {
  public:
    /** Loads as the scene says. */
    LoadProgram() = default;

    /**
     * Loads of a stage from time 0 to @p duration [s].
     *
     * @param start of the run, at which all expressions are taken [s]
     * @param grows whether forces grow linearly over the stage
     */
    LoadProgram(const double start, const double duration, const bool grows)
      : stands_still(true)
      , start(start)
      , slope(grows ? 1. / duration : 0.)
    {}

    /** Whether this is a stage before a run, in which time stands still. */
    bool
    in_stage() const
    {
      return stands_still;
    }

    /** Time for the expressions at time @p t of the computation [s]. */
    double
    time(const double t) const
    {
      return stands_still ? start : t;
    }

    /** Factor of forces at time @p t of the computation. */
    double
    factor(const double t) const
    {
      return slope > 0. ? slope * t : 1.;
    }

  private:
    bool   stands_still = false;
    double start        = 0.;
    double slope        = 0.; ///< [1/s]; 0: forces do not grow
  };
} // namespace kedge

#endif
