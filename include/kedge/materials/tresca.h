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
   * dD = s_u d xi. The surface has edges: points are answered one by one.
   */
  class Tresca : public HenckyPlasticity<Tresca>
  {
  public:
    static constexpr bool decoupled_volume = true;
    static constexpr bool takes_packs      = false;

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
      const auto   order = falling_order(trial);
      const Number t1 = trial[order[0]], t2 = trial[order[1]], t3 = trial[order[2]];
      const Number diameter = 2. * strength.strength(history, Number(0.));
      if (!(t1 - t3 > diameter))
        return;
      const double G = elastic.shear_modulus;
      const Number on_face =
        strength.multiplier(history, Number(t1 - t3 - diameter), 4. * G, 2., 2., response.valid);
      const Number low = t3 + 2. * G * on_face, high = t1 - 2. * G * on_face;
      if (t2 >= low && t2 <= high)
        {
          const double direction[3] = {1., 0., -1.};
          set_face(order, on_face, direction, history, response);
        }
      else if (t2 < low)
        set_edge(order, 0, 1, 2, Number(t1 - 0.5 * (t2 + t3)), Number(t2 - t3), history, response);
      else
        set_edge(order, 2, 0, 1, Number(0.5 * (t1 + t2) - t3), Number(t1 - t2), history, response);
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      return {history.equivalent_plastic_strain + equivalent_increment(response),
              history.plastic_shear_strain + response.softening_strain,
              history.undrained_strength};
    }

    const UndrainedStrength strength;

  private:
    template <typename Number>
    void
    set_face(const std::array<int, 3> &order,
             const Number             &S,
             const double (&direction)[3],
             const History<Number> &history,
             Response<Number>      &response) const
    {
      const double G            = elastic.shear_modulus;
      response.softening_strain = 2. * S;
      const Number fall         = 4. * G + 4. * strength.slope(history, response.softening_strain);
      for (int i = 0; i < 3; ++i)
        {
          response.plastic_strain[order[i]] = direction[i] * S;
          for (int j = 0; j < 3; ++j)
            response.tangent[order[i]][order[j]] -= 4. * G * G * direction[i] * direction[j] / fall;
        }
    }

    /**
     * @p single is the rank of the principal stress off the edge, @p high and @p low
     * those of the two that become equal, which differ by @p gap in the trial.
     * @p distance is from the single one to their mean, positive.
     */
    template <typename Number>
    void
    set_edge(const std::array<int, 3> &order,
             const int                 single,
             const int                 high,
             const int                 low,
             const Number             &distance,
             const Number             &gap,
             const History<Number>    &history,
             Response<Number>         &response) const
    {
      const double G        = elastic.shear_modulus;
      const double sign     = single == 0 ? 1. : -1.;
      const Number diameter = 2. * strength.strength(history, Number(0.));
      const Number S =
        strength.multiplier(history, Number(distance - diameter), 3. * G, 2., 2., response.valid);
      response.softening_strain = 2. * S;
      const Number fall         = 3. * G + 4. * strength.slope(history, response.softening_strain);

      response.plastic_strain[order[single]] = sign * S;
      response.plastic_strain[order[high]]   = 0.5 * (-sign * S + gap / (2. * G));
      response.plastic_strain[order[low]]    = 0.5 * (-sign * S - gap / (2. * G));

      // d tau_single = K tr + 2 G de_single - 2 G sign dS, the others K tr - G de_single + G sign
      // dS
      double direction[3];
      direction[single] = 1.;
      direction[high] = direction[low] = -0.5;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            const double deviator = direction[j] * 2. / 3.; // of de_single by eps_j
            response.tangent[order[i]][order[j]] =
              bulk_modulus + direction[i] * 2. * G * (deviator - 2. * G * direction[j] / fall);
          }
    }
  };
} // namespace kedge

#endif
