#ifndef kedge_time_integration_pore_scheme_h
#define kedge_time_integration_pore_scheme_h

#include <kedge/time_integration/parameters.h>

namespace kedge
{
  /**
   * How the pores follow the scheme of the skeleton. The fluid content m per
   * reference volume plays the part of the unknown in Newmark's formulas
   * (4.166), (4.167), at each material point, in place of the pressure: then
   * the mass of the fluid changes by what flows through the surface and by
   * nothing else.
   *   m'_{n+1} = gamma/(beta dt) (m_{n+1} - m_n) + known_rate(m'_n, m''_n),
   * quasi-static and mid-point: (m_{n+1} - m_n)/dt.
   *
   * Balance is stated at the pressure p_e = p_n + theta (p_{n+1} - p_n).
   */
  struct PoreScheme
  {
    explicit PoreScheme(const TimeParameters &parameters);

    bool   carries_rates; ///< m' and m'' live on the material points
    double theta;         ///< 1 but for the mid-point scheme
    double beta;
    double gamma;

    /** dt d m'_{n+1} / d m_{n+1} [-]. */
    double
    content_factor() const
    {
      return gamma / beta;
    }

    /** Part of m'_{n+1} that is known at n. */
    double
    known_rate(const double rate_n, const double rate_change_n, const double dt) const
    {
      return (1. - gamma / beta) * rate_n + dt * (1. - 0.5 * gamma / beta) * rate_change_n;
    }

    /** m'_{n+1} after the content has changed by @p increment. */
    double
    end_rate(const double increment,
             const double rate_n,
             const double rate_change_n,
             const double dt) const
    {
      return content_factor() / dt * increment + known_rate(rate_n, rate_change_n, dt);
    }

    /** m''_{n+1}. */
    double
    end_rate_change(const double increment,
                    const double rate_n,
                    const double rate_change_n,
                    const double dt) const
    {
      return (increment / dt - rate_n) / (beta * dt) - (0.5 / beta - 1.) * rate_change_n;
    }
  };
} // namespace kedge

#endif
