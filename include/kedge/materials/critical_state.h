#ifndef kedge_materials_critical_state_h
#define kedge_materials_critical_state_h

#include <kedge/materials/improved_hencky.h>

namespace kedge
{
  /** p' and what belongs to it of Hencky's law, which knows no pores. */
  template <typename Number>
  inline VolumetricResponse<Number>
  volumetric_response(const Hencky &law, const Number &strain, const Number &)
  {
    return {law.bulk_modulus * strain,
            law.bulk_modulus,
            0.,
            law.bulk_modulus * strain,
            law.bulk_modulus,
            0.};
  }

  template <typename Number>
  inline VolumetricResponse<Number>
  volumetric_response(const ImprovedHencky &law, const Number &strain, const Number &n)
  {
    return law.volumetric(strain, n);
  }

  /**
   * The two-parameter family of critical state of Collins and Hilder (4.194)
   * for the effective stress, on Hencky's original or improved elasticity. All
   * stresses are Kirchhoff's, P = -p' and p_c are positive in compression:
   *   a_0 = gamma p_c/2,  A = (1 - gamma) P + a_0,  B = M ((1 - alpha) P + alpha a_0),
   *   D = sqrt((A d_v^p)^2 + (B d_s^p)^2) >= 0,
   *   y = ((phi/A)^2 + (rho/B)^2 - 1)/2 <= 0,  rho = |dev tau|,
   *   d eps_v^p = d lambda phi/A^2,  d eps_s^p = d lambda rho/B^2,  D = d lambda [J/m^3],
   * phi = p' - chi' + a_0. The last term belongs to the frozen energy
   * Psi_2 = -a_0 eps_v^p: without it, as the thesis has it
   * (FrozenEnergy::none), the surface is centred at p' = 0 and nothing is
   * critical. With it, it spans 0 <= P <= p_c (original elasticity), and the
   * material flows at constant volume at P = a_0, rho = M a_0. The flow is not
   * associated, the tangent unsymmetric. p_c does not harden.
   *
   * The step is returned by backward Euler in (eps_v, |e|, lambda) at the
   * porosity that the step's volume gives, which is known beforehand.
   */
  template <class Elasticity>
  class CriticalState
  {
  public:
    static constexpr bool yields               = true;
    static constexpr bool can_fail             = true;
    static constexpr bool decoupled_volume     = false;
    static constexpr bool takes_packs          = true;
    static constexpr bool stress_is_work_slope = false;

    static constexpr std::array<Column, 3> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"plastic_volume_strain", "-", "positive where the pores open"},
       {"volume_strain", "-", "ln det F", ColumnKind::volume_strain}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< alpha [-]
      Number plastic_volume_strain     = 0.; ///< eps_v^p, positive where the pores open [-]
      Number volume_strain             = 0.; ///< eps_v = ln det F, elastic and plastic [-]
    };

    static std::array<const SpatialConstant *, 3>
    constants(const MaterialParameters &)
    {
      return {};
    }

    /** What the law answers to a principal trial strain. */
    template <typename Number>
    struct Response
    {
      Number kirchhoff_stress[3]; ///< principal values tau'_i [Pa]
      Number work_increment;      ///< dPsi + dD, all stored and dissipated work [J/m^3]
      Number plastic_multiplier;  ///< d lambda = dD [J/m^3]; 0 in an elastic step
      Number plastic_volume;      ///< d eps_v^p
      Number plastic_shear;       ///< d eps_s^p = |dev d eps^p|
      Number flow[3];             ///< n = dev tau/|dev tau|; 0 without shear
      Number volume_strain;       ///< ln J at the end [-]

      /** d(p', rho)/d(tr eps^tr, |dev eps^tr|) [Pa] */
      Number volume_volume, volume_shear, shear_volume, shear_shear;
      Number secant_shear;  ///< rho/|dev eps^tr| [Pa]
      Number work_coupling; ///< (d(dPsi + dD)/d eps^tr - tau) by dp' [-]

      Number            n_iterations; ///< of the return
      Condition<Number> valid;        ///< false if there is no return; the rest is of no use then
    };

    explicit CriticalState(const MaterialParameters &parameters);

    template <typename Number>
    Response<Number>
    respond(const Number (&strain_n)[3],
            const Number (&increment)[3],
            const HistoryOf<CriticalState, Number> &history) const;

    /** d tau'_i / d eps^tr_j [Pa], consistent with the return; unsymmetric. */
    template <typename Number>
    Number
    tangent(const Response<Number> &r, const int i, const int j) const
    {
      return r.volume_volume + r.volume_shear * r.flow[j] + r.shear_volume * r.flow[i] +
             (r.shear_shear - r.secant_shear) * r.flow[i] * r.flow[j] +
             r.secant_shear * ((i == j ? 1. : 0.) - 1. / 3.);
    }

    /** (tau_i - tau_j) / (eps^tr_i - eps^tr_j) of two principal directions [Pa]. */
    template <typename Number>
    Number
    secant_shear(const Response<Number> &r, const int, const int) const
    {
      return r.secant_shear;
    }

    /** d(dPsi + dD)/d eps^tr_i [Pa], which is not tau'_i while A and B change. */
    template <typename Number>
    Number
    work_slope(const Response<Number> &r, const int i) const
    {
      return r.kirchhoff_stress[i] +
             r.work_coupling * (r.volume_volume + r.volume_shear * r.flow[i]);
    }

    /** Elastic free energy [J/m^3]; the history gives ln J of the same state. */
    template <typename Number>
    Number
    energy(const Number (&elastic_strain)[3], const HistoryOf<CriticalState, Number> &history) const
    {
      return elastic.energy(elastic_strain, of_elasticity<Number>(history));
    }

    /** Part of the strain increment in direction i that is plastic [-]. */
    template <typename Number>
    Number
    plastic_increment(const Response<Number> &r, const int i) const
    {
      return r.plastic_volume / 3. + r.plastic_shear * r.flow[i];
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &r, const HistoryOf<CriticalState, Number> &history) const
    {
      return {history.equivalent_plastic_strain + std::sqrt(2. / 3.) * r.plastic_shear,
              history.plastic_volume_strain + r.plastic_volume,
              r.volume_strain};
    }

    /** Frozen energy Psi_2 = -a_0 eps_v^p or 0 [J/m^3]. */
    template <typename Number>
    Number
    hardening_energy(const History<Number> &history) const
    {
      return -shift * history.plastic_volume_strain;
    }

    /** dD of the step [J/m^3]. */
    template <typename Number>
    Number
    dissipation(const Response<Number> &r) const
    {
      return r.plastic_multiplier;
    }

    double
    p_wave_modulus() const
    {
      return elastic.p_wave_modulus();
    }

    /** The yield function and what it is made of, at a strain and porosity. */
    template <typename Number>
    struct Surface
    {
      VolumetricResponse<Number> volume;
      Number                     phi, rho; ///< dissipative stresses [Pa]
      Number                     A, B;     ///< half axes [Pa]
      Number                     excess;   ///< f = sqrt((phi/A)^2 + (rho/B)^2) - 1 [-]
    };

    /** @param shear |dev eps^e| */
    template <typename Number>
    Surface<Number>
    surface(const Number &volume_strain, const Number &shear, const Number &n) const;

    const Elasticity elastic;
    const double     bulk_modulus;         ///< undeformed [Pa]
    const double     centre;               ///< a_0 = gamma p_c/2 [Pa]
    const double     shift;                ///< what the frozen energy adds to phi: a_0 or 0 [Pa]
    const double     surface_alpha;        ///< alpha [-]
    const double     surface_gamma;        ///< gamma [-]
    const double     critical_state_slope; ///< M = rho/P at the critical state [-]

  private:
    template <typename Number>
    struct Return;

    /** What the elastic law answers by. */
    template <typename Number>
    static HistoryOf<Elasticity, Number>
    of_elasticity(const History<Number> &history)
    {
      if constexpr (has_columns<Elasticity>)
        return {history.volume_strain};
      else
        return {};
    }

    template <typename Number>
    Number
    porosity_at(const Number &volume_strain) const;

    /** In the lanes that are @p asked; where there is one. */
    template <typename Number>
    Condition<Number>
    return_to_surface(const Condition<Number> &asked,
                      const Number            &trial_volume,
                      const Number            &trial_shear,
                      const Number            &n,
                      Return<Number>          &result) const;

    /** In the lanes @p where there is a return. */
    template <typename Number>
    void
    set_plastic(const Condition<Number> &where,
                const Return<Number>    &result,
                const Number            &trial_volume,
                const Number            &trial_shear,
                const Number            &n,
                Response<Number>        &response) const;
  };
} // namespace kedge

#endif
