#ifndef kedge_time_integration_scheme_h
#define kedge_time_integration_scheme_h

#include <kedge/time_integration/parameters.h>

namespace kedge
{
  /**
   * A one-step scheme of the generalised-alpha family (Tables 3.3 and 3.4, with
   * the acceleration of step n that the print forgets), or the quasi-static
   * limit. Equilibrium is stated as
   *   M a_m + f_int(alpha_f u) = f_ext(t_n + alpha_f dt),
   *   a_m = alpha_m a_{n+1} + (1 - alpha_m) a_n,
   * u the displacement over the step; the CLC scheme uses the conserving
   * stress in f_int instead.
   */
  struct Scheme
  {
    explicit Scheme(const TimeParameters &parameters);

    bool   dynamic;
    bool   conserving_stress;
    bool   carries_acceleration; ///< a_n lives on the material points
    double alpha_f;
    double alpha_m;
    double beta;
    double gamma;

    /** d a_m / d u [1/s^2]; 0 without inertia. */
    double
    inertia_coefficient(const double dt) const
    {
      return dynamic ? alpha_m / (beta * dt * dt) : 0.;
    }

    /** a_{n+1} [m/s^2]. */
    double
    end_acceleration(const double u, const double v_n, const double a_n, const double dt) const
    {
      return (u / dt - v_n) / (beta * dt) - (0.5 / beta - 1.) * a_n;
    }

    /** a_m, the acceleration of the equilibrium [m/s^2]. */
    double
    equilibrium_acceleration(const double u,
                             const double v_n,
                             const double a_n,
                             const double dt) const
    {
      return alpha_m * end_acceleration(u, v_n, a_n, dt) + (1. - alpha_m) * a_n;
    }

    /** v_{n+1} [m/s]. */
    double
    end_velocity(const double u, const double v_n, const double a_n, const double dt) const
    {
      return gamma / (beta * dt) * u + (1. - gamma / beta) * v_n +
             dt * (1. - 0.5 * gamma / beta) * a_n;
    }

    /** Whether the fluid in pores moves by itself, with a velocity at the material points. */
    bool
    carries_fluid_velocity() const
    {
      return dynamic && conserving_stress;
    }

    /** Part of the step at which surfaces in contact stand in balance; its end without inertia. */
    double
    contact_alpha() const
    {
      return dynamic ? alpha_f : 1.;
    }

    /** Whether contact can do as much work in a step as its energy loses, to round-off. */
    bool
    conserves_contact() const
    {
      return dynamic && !carries_acceleration && alpha_f == 0.5;
    }

    /**
     * The time by which an error of the velocity at the start of a step is to be multiplied for
     * the displacement that makes good for it by the end [s]; 0 without inertia.
     */
    double
    catching_up(const double dt) const
    {
      return dynamic ? dt * (1. - beta / gamma) : 0.;
    }

    /**
     * Time at which the external load of a step is evaluated: the middle for
     * schemes of mid-point type, t_n + alpha_f dt otherwise.
     */
    double
    load_time(const double t_n, const double dt) const
    {
      return t_n + alpha_f * dt;
    }
  };
} // namespace kedge

#endif
