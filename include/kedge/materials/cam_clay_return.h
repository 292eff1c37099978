#ifndef kedge_materials_cam_clay_return_h
#define kedge_materials_cam_clay_return_h

#include <kedge/materials/lane.h>

#include <cmath>
#include <limits>

namespace kedge
{
  /** The constants of ModifiedCamClay that its return needs. */
  struct CamClayConstants
  {
    double reference_pressure;   ///< p_r [Pa]
    double kappa;                ///< of swelling, by logarithmic strain [-]
    double hardening;            ///< lambda - kappa [-]
    double critical_state_ratio; ///< M = q/p at the critical state [-]
  };

  /**
   * The return of ModifiedCamClay to its surface by backward Euler, with q and p_c eliminated:
   * of the plastic volume strain v and m = L p_c,n
   *   m (2 p - p_c)/p_c,n - v = 0,  f/p_c,n^2 = 0,
   *   p = p_r exp((e_v^tr - v)/kappa),  p_c = p_c,n exp(v/(lambda - kappa)),  q = q^tr/(1 + c m).
   * By Newton's method for both, and where that goes astray by a bracketed one for m with an inner
   * one for v. The lanes of a Pack do not influence each other.
   */
  template <typename Number>
  class CamClayReturn
  {
  public:
    /** What the return starts from. */
    struct Trial
    {
      Number volume; ///< e_v^tr
      Number q;      ///< 3 G e_s^tr [Pa]
      Number p_c;    ///< p_c,n [Pa]
      Number c;      ///< q = q^tr/(1 + c m), m = L p_c,n
    };

    /** The equations at a plastic volume strain and a multiplier m = L p_c,n. */
    struct Equations
    {
      Number volume, surface;    ///< m (2 p - p_c)/p_c,n - d e_v^p, and f/p_c,n^2
      Number volume_v, volume_m; ///< derivatives by d e_v^p and m
      Number surface_v, surface_m;
    };

    CamClayReturn(const CamClayConstants &law, const Trial &trial)
      : law(law)
      , trial(trial)
    {}

    Equations
    equations(const Number &plastic, const Number &m) const
    {
      using std::exp;
      const Number p       = law.reference_pressure * exp((trial.volume - plastic) / law.kappa),
                   p_slope = -p / law.kappa;
      const Number p_c = trial.p_c * exp(plastic / law.hardening), p_c_slope = p_c / law.hardening;
      const Number q    = trial.q / (1. + trial.c * m);
      const double M_2  = law.critical_state_ratio * law.critical_state_ratio;
      const Number size = trial.p_c * trial.p_c;
      return {m * (2. * p - p_c) / trial.p_c - plastic,
              (q * q / M_2 + p * (p - p_c)) / size,
              m * (2. * p_slope - p_c_slope) / trial.p_c - 1.,
              (2. * p - p_c) / trial.p_c,
              (p_slope * (2. * p - p_c) - p * p_c_slope) / size,
              -2. * q * q * trial.c / ((1. + trial.c * m) * M_2 * size)};
    }

    /** The plastic volume strain and m, 0 of elastic steps; where there is an answer. */
    Condition<Number>
    find(const Condition<Number> &asked, Number &plastic, Number &m) const
    {
      // f of a stress on the surface, from strains over kappa
      const auto beyond = asked && equations(Number(0.), Number(0.)).surface > round_offs(100.);
      if (!any(beyond))
        return asked;
      const auto converged = solve_both(beyond, plastic, m);
      const auto left      = beyond && !converged;
      if (!any(left))
        return asked;
      plastic          = select(left, Number(0.), plastic);
      m                = select(left, Number(0.), m);
      const auto found = solve_bracketed(left, plastic, m);
      return asked && (!left || found);
    }

  private:
    /** A few round-offs of a number in each lane [-]. */
    static double
    round_offs(const double how_many)
    {
      return how_many * static_cast<double>(std::numeric_limits<Lane<Number>>::epsilon());
    }

    /** How near a plastic volume strain can be found [-]. */
    Number
    volume_accuracy(const Number &plastic) const
    {
      using std::abs;
      return round_offs(64.) * (abs(plastic) + law.kappa);
    }

    /** How near a multiplier can be found: round-off of f, of order 1, over its slope. */
    static Number
    multiplier_accuracy(const Number &m, const Number &slope)
    {
      const auto falls = slope < 0.;
      return round_offs(16.) *
             (m + select(falls, -1. / select(falls, slope, Number(-1.)), Number(0.)));
    }

    /** Exponentials: no further in a step than they are nearly straight. */
    Number
    within_reach(const Number &change) const
    {
      const Number most = 0.5 * law.kappa;
      return select(change > most, most, select(change < -most, -most, change));
    }

    /** df/dm along the plastic volume strains that the first equation gives. */
    static Number
    slope_of_surface(const Equations &at)
    {
      return at.surface_m - at.surface_v * at.volume_m / at.volume_v;
    }

    /**
     * The plastic volume strain of a multiplier, in the lanes that are @p asked; where it was
     * found. The first equation falls by it.
     */
    Condition<Number>
    solve_volume(const Condition<Number> &asked, const Number &m, Number &plastic) const
    {
      constexpr int     most_iterations = 200;
      Condition<Number> open            = asked;
      for (int iteration = 0; iteration < most_iterations && any(open); ++iteration)
        {
          const auto   at     = equations(plastic, m);
          const Number change = -at.volume / at.volume_v;
          plastic             = select(open, plastic + within_reach(change), plastic);
          const Number size   = volume_accuracy(plastic);
          open                = open && !(change * change <= size * size);
        }
      return asked && !open;
    }

    /** Newton's method for both equations at once, which mostly converges; where it has. */
    Condition<Number>
    solve_both(const Condition<Number> &asked, Number &plastic, Number &m) const
    {
      constexpr int     most_iterations = 12;
      Condition<Number> open = asked, found = asked && !asked;
      for (int iteration = 0; iteration < most_iterations && any(open); ++iteration)
        {
          const auto   at    = equations(plastic, m);
          const Number slope = slope_of_surface(at);
          open               = open && slope < 0.;
          const Number to_m  = -(at.surface - at.surface_v * at.volume / at.volume_v) /
                              select(open, slope, Number(-1.));
          const Number to_volume    = -(at.volume + at.volume_m * to_m) / at.volume_v;
          plastic                   = select(open, plastic + within_reach(to_volume), plastic);
          m                         = select(open, m + to_m, m);
          const Number small_volume = volume_accuracy(plastic),
                       small_m      = multiplier_accuracy(m, slope);
          const auto done = open && to_volume * to_volume <= small_volume * small_volume &&
                            to_m * to_m <= small_m * small_m;
          found = found || (done && m >= 0.);
          open  = open && !done && m >= 0.;
        }
      return found;
    }

    /** low and high with f > 0 at low, f < 0 at high and the plastic volume strain at low. */
    Condition<Number>
    bracket(const Condition<Number> &asked, Number &plastic, Number &low, Number &high) const
    {
      constexpr int     most_doublings = 200;
      Condition<Number> open = asked, found = asked && !asked;
      for (int doubling = 0; doubling < most_doublings && any(open); ++doubling)
        {
          Number volume   = plastic;
          open            = solve_volume(open, high, volume);
          const auto past = open && equations(volume, high).surface < 0.;
          found           = found || past;
          open            = open && !past;
          plastic         = select(open, volume, plastic);
          low             = select(open, high, low);
          high            = select(open, 2. * high, high);
        }
      return found;
    }

    /** Newton's method for the multiplier alone, kept in its bracket; where it has converged. */
    Condition<Number>
    solve_bracketed(const Condition<Number> &asked, Number &plastic, Number &m) const
    {
      constexpr int     most_iterations = 200;
      Number            low = 0., high = law.kappa;
      Condition<Number> open = bracket(asked, plastic, low, high), found = asked && !asked;
      m = select(asked, low, m);
      for (int iteration = 0; iteration < most_iterations && any(open); ++iteration)
        {
          open                = solve_volume(open, m, plastic);
          const auto at       = equations(plastic, m);
          const auto off      = at.surface > 0.;
          low                 = select(open && off, m, low);
          high                = select(open && !off, m, high);
          const Number slope  = slope_of_surface(at);
          const auto   falls  = slope < 0.;
          const Number newton = m - at.surface / select(falls, slope, Number(-1.));
          const Number next =
            select(falls && newton >= low && newton <= high, newton, 0.5 * (low + high));
          const Number change = next - m;
          m                   = select(open, next, m);
          const Number size   = multiplier_accuracy(m, slope);
          const auto   done   = open && (change * change <= size * size || high - low <= size);
          found               = found || done;
          open                = open && !done;
        }
      return solve_volume(found, m, plastic);
    }

    const CamClayConstants law;
    const Trial            trial;
  };
} // namespace kedge

#endif
