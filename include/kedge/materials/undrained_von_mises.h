#ifndef kedge_materials_undrained_von_mises_h
#define kedge_materials_undrained_von_mises_h

#include <kedge/materials/hencky_plasticity.h>
#include <kedge/materials/undrained_strength.h>

namespace kedge
{
  /**
   * Clay that is sheared undrained, by von Mises:
   *   f = |s| - sqrt(2) s_u(xi) <= 0,  d eps^p = d lambda s/|s|,  d xi = sqrt(2) d lambda,
   * on Hencky's elasticity, s_u by UndrainedStrength. The radius is that of
   * simple shear and plane strain; in triaxial compression it bears
   * 2/sqrt(3) = 1.155 times what Tresca does of the same s_u.
   */
  class UndrainedVonMises : public HenckyPlasticity<UndrainedVonMises>
  {
  public:
    static constexpr bool decoupled_volume   = true;
    static constexpr bool stiffness_of_place = false;
    static constexpr bool takes_packs        = true;

    static constexpr auto columns = UndrainedStrength::columns;
    template <typename Number>
    using History = UndrainedStrength::History<Number>;

    static auto
    constants(const MaterialParameters &parameters)
    {
      return UndrainedStrength::constants(parameters);
    }

    explicit UndrainedVonMises(const MaterialParameters &parameters)
      : HenckyPlasticity(parameters)
      , strength(parameters)
    {}

    template <typename Number>
    void
    return_stress(const Number (&trial)[3],
                  const History<Number> &history,
                  Response<Number>      &response) const
    {
      using std::sqrt;
      const double root = std::sqrt(2.), G = elastic.shear_modulus;
      const Number pressure = (trial[0] + trial[1] + trial[2]) / 3.;
      Number       s[3], square = 0.;
      for (int i = 0; i < 3; ++i)
        {
          s[i] = trial[i] - pressure;
          square += s[i] * s[i];
        }
      const Number norm   = sqrt(square);
      const Number excess = norm - root * strength.strength(history, Number(0.));
      const auto   yields = excess > 0.;
      if (!any(yields))
        return;
      const Number multiplier =
        strength.multiplier(history, excess, 2. * G, root, root, response.valid);
      response.softening_strain = root * multiplier;

      const Number divisor = select(yields, norm, Number(1.));
      const Number theta   = 1. - 2. * G * multiplier / divisor;
      const Number slope   = strength.slope(history, response.softening_strain);
      const Number normal  = select(yields, 2. * G * (theta - slope / (G + slope)), Number(0.));
      for (int i = 0; i < 3; ++i)
        {
          s[i] /= divisor;
          response.plastic_strain[i] = multiplier * s[i];
        }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          response.tangent[i][j] =
            bulk_modulus + 2. * G * theta * ((i == j ? 1. : 0.) - 1. / 3.) - normal * s[i] * s[j];
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      return {history.equivalent_plastic_strain + equivalent_increment(response),
              history.plastic_shear_strain + response.softening_strain,
              history.undrained_strength,
              history.time_step};
    }

    const UndrainedStrength strength;
  };
} // namespace kedge

#endif
