#ifndef kedge_materials_drucker_prager_h
#define kedge_materials_drucker_prager_h

#include <kedge/materials/closing_of_cracks.h>
#include <kedge/materials/friction.h>
#include <kedge/materials/hencky_plasticity.h>

namespace kedge
{
  /**
   * Sand by Drucker and Prager with a smooth apex and a tension cut-off, on
   * Hencky's elasticity. With the mean stress P and J_2 of Kirchhoff's,
   *   f = 3 alpha P + S - k <= 0,  S = sqrt(J_2 + e^2),
   *   g = 3 beta P + S,  d eps^p = d lambda dg/d tau,
   *   P <= P_t = t (k - e)/(3 alpha),
   * with beta <= alpha by the angle of dilation, e <= k the rounding of the apex and
   * t <= 1. The cone's step has one unknown L = d lambda,
   *   S = k - 3 alpha P^tr + 9 K alpha beta L,
   *   r(L) = J_2^tr S^2/(S + G L)^2 + e^2 - S^2 = 0,
   *   P = P^tr - 3 K beta L,  s = S/(S + G L) s^tr,
   * bracketed and found by Newton's method. What stays beyond the cut-off goes to it
   * (P = P_t), along it to the corner if the cone is in the way; it has been torn open then, and
   * bears pressure again when it has closed (ClosingOfCracks). dD >= 0 since beta <= alpha.
   * The cohesion, and with it k, e and P_t, may differ from place to place.
   */
  class DruckerPrager : public HenckyPlasticity<DruckerPrager>
  {
  public:
    static constexpr bool decoupled_volume   = false;
    static constexpr bool takes_packs        = true;
    static constexpr bool stiffness_of_place = true;

    static constexpr std::array<Column, 5> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"plastic_volume_strain", "-", "positive where the pores open"},
       {"cohesion", "Pa", "c of the place", ColumnKind::of_place},
       {"stiffness", "-", "factor of both moduli, of the place", ColumnKind::of_place},
       {"opening", "-", "volume strain by which tension has torn it open"}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< sqrt(2/3) of all |dev d eps^p| [-]
      Number plastic_volume_strain     = 0.; ///< positive where the pores open [-]
      Number cohesion                  = 0.; ///< c [Pa]
      Number stiffness                 = 1.; ///< of both moduli [-]
      Number opening                   = 0.; ///< volume strain by tension, to be closed first [-]
    };

    static std::array<const SpatialConstant *, 5>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, nullptr, &parameters.cohesion, &parameters.stiffness_factor, nullptr}};
    }

    explicit DruckerPrager(const MaterialParameters &parameters)
      : HenckyPlasticity(parameters)
      , cone(parameters)
      , rounding(parameters.apex_rounding)
      , cut_off(parameters.tension_cut_off)
    {}

    template <typename Number>
    void
    return_stress(const Number (&trial)[3],
                  const History<Number> &history,
                  Response<Number>      &response) const
    {
      using std::sqrt;
      const double                  K = bulk_modulus, G = elastic.shear_modulus;
      const double                  al = cone.friction, be = cone.dilation;
      const Number                  mean = (trial[0] + trial[1] + trial[2]) / 3.;
      const ClosingOfCracks<Number> closing(mean, K, history.opening);
      const Number                  P0 = closing.mean;
      Number                        s0[3];
      const Number                  J = second_invariant(trial, mean, s0);
      const Number                  k = cone.strength * history.cohesion, e = rounding * k;
      const Number                  P_t = cut_off * (k - e) / (3. * al), S0 = sqrt(J + e * e);

      const auto yields = 3. * al * P0 + S0 - k > 0.;
      const auto torn   = P0 > P_t;
      if (!any(yields || torn || closing.change > 0.))
        return;

      // what the stress becomes: P = pressure, s = factor s0, and their slopes by
      // the volume strain and by s0 : de
      Number pressure = P0, factor = 1., P_v = K * closing.slope, P_s = 0., f_v = 0., f_s = 0.;
      const Number start = k - 3. * al * P0, growth = 9. * K * al * be;
      Number       L = 0.;
      if (any(yields))
        {
          response.valid    = return_to_cone(yields, start, J, e, L);
          const Number S    = start + growth * L;
          const Number sum  = select(yields, S + G * L, Number(1.)),
                       th   = select(yields, S / sum, Number(1.));
          const Number th_S = G * L / (sum * sum), th_L = -S * G / (sum * sum);
          const Number r_L     = 2. * J * th * (th_S * growth + th_L) - 2. * S * growth;
          const Number r_P     = -3. * al * (2. * J * th * th_S - 2. * S);
          const Number divisor = select(yields, r_L, Number(1.));
          const Number L_v = -r_P * K * closing.slope / divisor, L_s = -th * th * 2. * G / divisor;
          pressure = select(yields, P0 - 3. * K * be * L, pressure);
          factor   = th;
          P_v      = select(yields, K * closing.slope - 3. * K * be * L_v, P_v);
          P_s      = select(yields, -3. * K * be * L_s, P_s);
          f_v =
            select(yields, (th_S * growth + th_L) * L_v - 3. * al * K * closing.slope * th_S, f_v);
          f_s = select(yields, (th_S * growth + th_L) * L_s, f_s);
        }
      const auto cut = pressure > P_t || (torn && !yields) || (torn && !response.valid);
      if (any(cut))
        {
          const Number S_t    = k - 3. * al * P_t;
          const auto   corner = cut && S0 > S_t;
          const Number square = S_t * S_t - e * e;
          const Number radius = sqrt(select(square > 0., square, Number(0.)));
          const Number norm   = sqrt(select(corner, J, Number(1.)));
          const Number th     = select(corner, radius / norm, Number(1.));
          pressure            = select(cut, P_t, pressure);
          factor              = select(cut, th, factor);
          P_v                 = select(cut, Number(0.), P_v);
          P_s                 = select(cut, Number(0.), P_s);
          f_v                 = select(cut, Number(0.), f_v);
          // d|s0| = s0 : 2 G de/|s0|, |s0|^2 = 2 J
          f_s            = select(corner, -G * th / (norm * norm), select(cut, Number(0.), f_s));
          response.valid = response.valid || cut;
        }
      response.opening = select(cut, (P0 - P_t) / K, Number(0.)) - closing.change;
      set_return(s0, mean, pressure, factor, P_v, P_s, f_v, f_s, response);
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      return {history.equivalent_plastic_strain + equivalent_increment(response),
              history.plastic_volume_strain + response.plastic_strain[0] +
                response.plastic_strain[1] + response.plastic_strain[2],
              history.cohesion,
              history.stiffness,
              history.opening + response.opening};
    }

    const MatchedCone cone;
    const double      rounding; ///< e/k, in [0, 1) [-]
    const double      cut_off;  ///< t, of the apex of the cone, in [0, 1] [-]

  private:
    /** J_2 and the deviator of principal stresses. */
    template <typename Number>
    static Number
    second_invariant(const Number (&stress)[3], const Number &mean, Number (&deviator)[3])
    {
      Number J = 0.;
      for (int i = 0; i < 3; ++i)
        {
          deviator[i] = stress[i] - mean;
          J += 0.5 * deviator[i] * deviator[i];
        }
      return J;
    }

    /**
     * L of the cone, in the lanes that @p yields; says where there is one. r > 0 at the
     * lower bound of the bracket and r < 0 at its upper one.
     */
    template <typename Number>
    Condition<Number>
    return_to_cone(const Condition<Number> &yields,
                   const Number            &start,
                   const Number            &J,
                   const Number            &e,
                   Number                  &L) const
    {
      using std::abs;
      using std::sqrt;
      constexpr int most_iterations = 100;
      const double  G               = elastic.shear_modulus;
      const double  growth          = 9. * bulk_modulus * cone.friction * cone.dilation;
      const auto    within          = start > e; // the whole deviator could go, at this pressure
      const auto    exists          = within || Number(growth) > 0.;
      const Number  to_e =
        growth > 0. ? Number((e - start) / Number(growth > 0. ? growth : 1.)) : Number(0.);
      Number low = select(to_e > 0., to_e, Number(0.));
      // no deviator less than at zero growth; S no more than that of the trial's deviator
      const Number radius = sqrt(select(within, start * start - e * e, Number(1.)));
      Number       high   = start * (sqrt(J) - radius) / (G * radius);
      if (growth > 0.)
        {
          const Number other = (sqrt(J + e * e) - start) / growth;
          high               = select(within && high < other, high, other);
        }
      high = select(yields && exists, high, Number(0.));
      low  = select(yields && exists, low, Number(0.));
      // at S = e = 0 the equation holds by itself
      L                        = select(within, low, 0.5 * (low + high));
      const auto        solves = yields && exists;
      Condition<Number> open   = solves;
      for (int iteration = 0; iteration < most_iterations; ++iteration)
        {
          const Number S   = select(solves, start + growth * L, Number(1.));
          const Number sum = S + G * L, positive = select(sum > 0., sum, Number(1.));
          const Number th       = select(sum > 0., S / positive, Number(1.));
          const Number r        = J * th * th + e * e - S * S;
          const Number th_slope = G * (L * growth - S) / (positive * positive);
          const Number slope    = 2. * J * th * th_slope - 2. * S * growth;
          low                   = select(solves && r > 0., L, low);
          high                  = select(solves && r < 0., L, high);
          const auto   falls    = slope < 0.;
          const Number newton   = L - r / select(falls, slope, Number(1.));
          const auto   inside   = falls && newton >= low && newton <= high;
          const Number next     = select(inside, newton, 0.5 * (low + high));
          const Number change   = select(open && abs(r) > 0., next - L, Number(0.));
          L += change;
          open = open && abs(change) > 1e-15 * abs(L);
          if (!any(open))
            break;
        }
      return !yields || exists;
    }

    template <typename Number>
    void
    set_return(const Number (&s0)[3],
               const Number     &P0,
               const Number     &pressure,
               const Number     &factor,
               const Number     &P_v,
               const Number     &P_s,
               const Number     &f_v,
               const Number     &f_s,
               Response<Number> &response) const
    {
      const double G = elastic.shear_modulus;
      for (int i = 0; i < 3; ++i)
        {
          response.plastic_strain[i] =
            (1. - factor) * s0[i] / (2. * G) + (P0 - pressure) / (3. * bulk_modulus);
          for (int j = 0; j < 3; ++j)
            response.tangent[i][j] = P_v + P_s * s0[j] +
                                     2. * G * factor * ((i == j ? 1. : 0.) - 1. / 3.) +
                                     s0[i] * (f_v + f_s * s0[j]);
        }
    }
  };
} // namespace kedge

#endif
