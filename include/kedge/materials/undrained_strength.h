#ifndef kedge_materials_undrained_strength_h
#define kedge_materials_undrained_strength_h

#include <kedge/base/pack.h>
#include <kedge/materials/history.h>
#include <kedge/materials/parameters.h>

#include <cmath>

namespace kedge
{
  /**
   * Undrained shear strength of a clay that softens by plastic shear (Einav and
   * Randolph 2005),
   *   s_u(xi) = [d + (1 - d) exp(-3 xi/xi_95)] s_u0,
   * s_u0 of the place; xi the accumulated plastic shear strain, work-conjugate
   * to s_u: dD = s_u d xi, in simple shear the plastic part of gamma.
   */
  class UndrainedStrength
  {
  public:
    static constexpr std::array<Column, 3> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"plastic_shear_strain", "-", "xi, accumulated, by which undrained strength softens"},
       {"undrained_strength", "Pa", "s_u0 of the intact soil", ColumnKind::of_place}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< sqrt(2/3) of all |d eps^p| [-]
      Number plastic_shear_strain      = 0.; ///< xi [-]
      Number undrained_strength        = 0.; ///< s_u0 [Pa]
    };

    static std::array<const SpatialConstant *, 3>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, nullptr, &parameters.undrained_strength}};
    }

    explicit UndrainedStrength(const MaterialParameters &parameters)
      : remoulded(parameters.remoulded_strength)
      , rate(3. / parameters.softening_strain)
    {}

    /** s_u after a further @p growth of xi [Pa]. */
    template <typename Number>
    Number
    strength(const History<Number> &history, const Number &growth) const
    {
      using std::exp;
      return history.undrained_strength *
             (remoulded + (1. - remoulded) * exp(-rate * (history.plastic_shear_strain + growth)));
    }

    /** ds_u/dxi there [Pa]. */
    template <typename Number>
    Number
    slope(const History<Number> &history, const Number &growth) const
    {
      return -rate * (strength(history, growth) - remoulded * history.undrained_strength);
    }

    /**
     * The root S of excess - stiffness S - factor (s_u(xi + c S) - s_u(xi)) = 0,
     * c = @p conjugate, where @p excess > 0, else 0. The left-hand side falls and
     * is concave, so that Newton's iterates approach the root from above. It falls
     * where stiffness + factor c ds_u/dxi > 0; @p valid is false elsewhere.
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
      constexpr int           most_iterations = 30;
      const Condition<Number> yields          = excess > 0.;
      const Number            start           = strength(history, Number(0.));
      valid =
        valid && (stiffness + factor * conjugate * slope(history, Number(0.)) > 0. || !yields);
      Number S = 0.;
      for (int iteration = 0; iteration < most_iterations; ++iteration)
        {
          const Number growth = conjugate * S;
          const Number rest = excess - stiffness * S - factor * (strength(history, growth) - start);
          const Number change = rest / (stiffness + factor * conjugate * slope(history, growth));
          S                   = select(yields, S + change, Number(0.));
          if (!any(yields && abs(change) > 1e-15 * abs(S)))
            break;
        }
      return S;
    }

    const double remoulded; ///< d = remoulded over intact strength, in (0, 1] [-]
    const double rate;      ///< 3/xi_95 [-]
  };
} // namespace kedge

#endif
