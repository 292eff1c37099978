#ifndef kedge_materials_tresca_h
#define kedge_materials_tresca_h

#include <kedge/materials/hencky_plasticity.h>
#include <kedge/materials/principal_order.h>
#include <kedge/materials/undrained_strength.h>

namespace kedge
{
  /**
   * Clay that is sheared undrained, by Tresca:
   *   f = tau_1 - tau_3 - 2 s_u(xi) <= 0,  tau_1 >= tau_2 >= tau_3,
   * associated, on Hencky's elasticity, s_u by UndrainedStrength. With the sum S
   * of the multipliers, d xi = 2 S (on a face d eps^p_1 - d eps^p_3), and
   *   face:             tau_1 - 2 G S, tau_2, tau_3 + 2 G S,
   *                     f^tr - 4 G S - 2 [s_u(xi + 2 S) - s_u(xi)] = 0;
   *   tau_2 = tau_3:    tau_1 - 2 G S, (tau_2 + tau_3)/2 + G S,
   *                     tau_1 - (tau_2 + tau_3)/2 - 3 G S = 2 s_u(xi + 2 S);
   *   tau_1 = tau_2:    the mirror image.
   * dD = s_u d xi.
   */
  class Tresca : public HenckyPlasticity<Tresca>
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

    explicit Tresca(const MaterialParameters &parameters)
      : HenckyPlasticity(parameters)
      , strength(parameters)
    {}

    template <typename Number>
    void
    return_stress(const Number (&trial)[3],
                  const History<Number> &history,
                  Response<Number>      &response) const
    {
      const FallingOrder<Number> order(trial);
      const Number               t1 = order.value[0], t2 = order.value[1], t3 = order.value[2];
      const Number               diameter = 2. * strength.strength(history, Number(0.));
      const auto                 yields   = t1 - t3 > diameter;
      if (!any(yields))
        return;
      const double   G = elastic.shear_modulus;
      Return<Number> at;
      at.S =
        strength.multiplier(history, Number(t1 - t3 - diameter), 4. * G, 2., 2., response.valid);
      at.yields          = yields;
      at.low_pair        = yields && t2 < t3 + 2. * G * at.S;
      at.high_pair       = yields && !at.low_pair && t2 > t1 - 2. * G * at.S;
      at.gap             = 0.;
      const auto on_edge = at.low_pair || at.high_pair;
      if (any(on_edge))
        {
          const Number distance = select(at.low_pair, t1 - 0.5 * (t2 + t3), 0.5 * (t1 + t2) - t3);
          const Number S        = strength.multiplier(history,
                                               select(on_edge, distance - diameter, Number(-1.)),
                                               3. * G,
                                               2.,
                                               2.,
                                               response.valid);
          at.S                  = select(on_edge, S, at.S);
          at.gap = select(at.low_pair, t2 - t3, select(at.high_pair, t1 - t2, Number(0.)));
        }
      set_return(order, at, history, response);
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

  private:
    template <typename Number>
    struct Return
    {
      Number            S;   ///< sum of the multipliers
      Number            gap; ///< by which the two differ in the trial that become equal [Pa]
      Condition<Number> yields;
      Condition<Number> low_pair;  ///< tau_2 = tau_3
      Condition<Number> high_pair; ///< tau_1 = tau_2
    };

    /** On an edge the stress off it falls by 2 G S, and each of the two meets it by half of that.
     */
    template <typename Number>
    void
    set_return(const FallingOrder<Number> &order,
               const Return<Number>       &at,
               const History<Number>      &history,
               Response<Number>           &response) const
    {
      const double G            = elastic.shear_modulus;
      const auto   on_edge      = at.low_pair || at.high_pair;
      response.softening_strain = 2. * at.S;
      const Number fall         = select(on_edge, Number(3. * G), Number(4. * G)) +
                          4. * strength.slope(history, response.softening_strain);

      const Number half_gap = at.gap / (4. * G);
      // d eps^p_i = S times these, and what makes the pair equal
      const Number direction[3] = {select(at.high_pair, Number(0.5), Number(1.)),
                                   select(at.low_pair,
                                          Number(-0.5),
                                          select(at.high_pair, Number(0.5), Number(0.))),
                                   select(at.low_pair, Number(-0.5), Number(-1.))};
      Number       plastic[3], tangent[3][3];
      for (int i = 0; i < 3; ++i)
        plastic[i] = direction[i] * at.S;
      plastic[0] += select(at.high_pair, half_gap, Number(0.));
      plastic[1] += select(at.low_pair, half_gap, select(at.high_pair, -half_gap, Number(0.)));
      plastic[2] -= select(at.low_pair, half_gap, Number(0.));

      const Number softened =
        select(at.yields, 4. * G * G / select(at.yields, fall, Number(1.)), Number(0.));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            // the whole deviator's stiffness, or on an edge what is left of it along the edge
            const Number whole = 2. * G * ((i == j ? 1. : 0.) - 1. / 3.);
            const Number along = 4. / 3. * G * direction[i] * direction[j];
            tangent[i][j] =
              bulk_modulus + select(on_edge, along, whole) - softened * direction[i] * direction[j];
          }
      order.restore(plastic);
      order.restore(tangent);
      for (int i = 0; i < 3; ++i)
        {
          response.plastic_strain[i] = plastic[i];
          for (int j = 0; j < 3; ++j)
            response.tangent[i][j] = tangent[i][j];
        }
    }
  };
} // namespace kedge

#endif
