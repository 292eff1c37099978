#ifndef kedge_materials_undrained_strength_h
#define kedge_materials_undrained_strength_h

#include <kedge/base/pack.h>
#include <kedge/materials/history.h>
#include <kedge/materials/parameters.h>

#include <cmath>

namespace kedge
{
  /**
   * Undrained shear strength of a clay that softens by plastic shear and bears more the
   * faster it is sheared (Einav and Randolph 2005),
   *   s_u(xi) = R [d + (1 - d) exp(-3 xi/xi_95)] s_u0,  R = 1 + mu log10(max(1, xi'/r)),
   * s_u0 of the place; xi the accumulated plastic shear strain, work-conjugate
   * to s_u: dD = s_u d xi, in simple shear the plastic part of gamma; its rate xi' is the mean
   * of the step, d xi/dt, r the reference rate. R is that of the step's end: implicit, it does
   * not lag, and its tangent is symmetric. Without a time step R = 1.
   */
  class UndrainedStrength
  {
  public:
    static constexpr std::array<Column, 4> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"plastic_shear_strain", "-", "xi, accumulated, by which undrained strength softens"},
       {"undrained_strength", "Pa", "s_u0 of the intact soil", ColumnKind::of_place},
       {"time_step", "s", "of the present step", ColumnKind::time_step}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< sqrt(2/3) of all |d eps^p| [-]
      Number plastic_shear_strain      = 0.; ///< xi [-]
      Number undrained_strength        = 0.; ///< s_u0 [Pa]
      Number time_step                 = 0.; ///< dt [s]; 0: there is no rate
    };

    static std::array<const SpatialConstant *, 4>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, nullptr, &parameters.undrained_strength, nullptr}};
    }

    explicit UndrainedStrength(const MaterialParameters &parameters)
      : remoulded(parameters.remoulded_strength)
      , rate(3. / parameters.softening_strain)
      , rate_coefficient(parameters.rate_coefficient)
      , reference_rate(parameters.reference_rate)
    {}

    /** s_u after a further @p growth of xi, sheared slowly [Pa]. */
    template <typename Number>
    Number
    slow_strength(const History<Number> &history, const Number &growth) const
    {
      using std::exp;
      return history.undrained_strength *
             (remoulded + (1. - remoulded) * exp(-rate * (history.plastic_shear_strain + growth)));
    }

    /** d slow_strength/dxi there [Pa]. */
    template <typename Number>
    Number
    slow_slope(const History<Number> &history, const Number &growth) const
    {
      return -rate * (slow_strength(history, growth) - remoulded * history.undrained_strength);
    }

    /** s_u after a further @p growth of xi within the time step [Pa]. */
    template <typename Number>
    Number
    strength(const History<Number> &history, const Number &growth) const
    {
      const Number slow = slow_strength(history, growth);
      return rate_coefficient > 0. ? Number(slow * rate_factor(history, growth)) : slow;
    }

    /** ds_u/dxi there [Pa]. */
    template <typename Number>
    Number
    slope(const History<Number> &history, const Number &growth) const
    {
      const Number slow = slow_slope(history, growth);
      if (!(rate_coefficient > 0.))
        return slow;
      const auto   fast    = is_fast(history, growth);
      const Number divisor = select(fast, growth, Number(1.));
      return slow * rate_factor(history, growth) +
             select(fast,
                    slow_strength(history, growth) * rate_coefficient / (ln_10 * divisor),
                    Number(0.));
    }

    /**
     * The root S of excess - stiffness S - factor (s_u(xi + c S) - s_u(xi)) = 0,
     * c = @p conjugate, where @p excess > 0, else 0. Of slow strengths the left-hand side falls
     * and is concave, so that Newton's iterates approach the root from above. It falls
     * where stiffness + factor c ds_u/dxi > 0; @p valid is false elsewhere. What a rate adds
     * makes the root smaller.
     */
    template <typename Number>
    Number
    multiplier(const History<Number> &history,
               const Number          &excess,
               const double           stiffness,
               const double           factor,
               const double           conjugate,
               Condition<Number>     &valid) const
    {
      using std::abs;
      constexpr int           most_iterations = 30, most_bisections = 100;
      const Condition<Number> yields = excess > 0.;
      const Number            start  = slow_strength(history, Number(0.));
      valid =
        valid && (stiffness + factor * conjugate * slow_slope(history, Number(0.)) > 0. || !yields);
      Condition<Number> open = yields;
      Number            S    = 0.;
      for (int iteration = 0; iteration < most_iterations; ++iteration)
        {
          const Number growth = conjugate * S;
          const Number rest =
            excess - stiffness * S - factor * (slow_strength(history, growth) - start);
          const Number change =
            rest / (stiffness + factor * conjugate * slow_slope(history, growth));
          S    = select(open, S + change, S);
          open = open && abs(change) > 1e-15 * abs(S);
          if (!any(open))
            break;
        }
      if (!(rate_coefficient > 0.))
        return S;
      // between none and that of slow shear, by Newton's method with bisection
      Number low = 0., high = S;
      open = yields;
      for (int iteration = 0; iteration < most_bisections; ++iteration)
        {
          const Number growth = conjugate * S;
          const Number rest = excess - stiffness * S - factor * (strength(history, growth) - start);
          const Number fall = stiffness + factor * conjugate * slope(history, growth);
          low               = select(rest > 0., S, low);
          high              = select(rest < 0., S, high);
          const Number newton = S + rest / select(fall > 0., fall, Number(1.));
          const auto   inside = fall > 0. && newton >= low && newton <= high;
          const Number next   = select(inside, newton, 0.5 * (low + high));
          const Number change = select(open && abs(rest) > 0., next - S, Number(0.));
          S += change;
          open = open && abs(change) > 1e-15 * abs(S);
          if (!any(open))
            break;
        }
      return S;
    }

    const double remoulded;        ///< d = remoulded over intact strength, in (0, 1] [-]
    const double rate;             ///< 3/xi_95 [-]
    const double rate_coefficient; ///< mu, per decade [-]
    const double reference_rate;   ///< r, of xi [1/s]

  private:
    static constexpr double ln_10 = 2.302585092994045684;

    /** Whether xi grows faster than the reference rate. */
    template <typename Number>
    Condition<Number>
    is_fast(const History<Number> &history, const Number &growth) const
    {
      return history.time_step > 0. && growth > reference_rate * history.time_step;
    }

    /** R of the step. */
    template <typename Number>
    Number
    rate_factor(const History<Number> &history, const Number &growth) const
    {
      using std::log1p;
      const auto   fast = is_fast(history, growth);
      const Number slow = select(fast, reference_rate * history.time_step, Number(1.));
      const Number more = select(fast, growth - slow, Number(0.));
      return 1. + rate_coefficient / ln_10 * log1p(more / slow);
    }
  };
} // namespace kedge

#endif
