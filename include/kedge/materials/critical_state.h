#ifndef kedge_materials_critical_state_h
#define kedge_materials_critical_state_h

#include <kedge/materials/improved_hencky.h>

namespace kedge
{
  /** p' and what belongs to it of Hencky's law, which knows no pores. */
  inline VolumetricResponse<>
  volumetric_response(const Hencky &law, const double strain, const double)
  {
    return {law.bulk_modulus * strain,
            law.bulk_modulus,
            0.,
            law.bulk_modulus * strain,
            law.bulk_modulus,
            0.};
  }

  inline VolumetricResponse<>
  volumetric_response(const ImprovedHencky &law, const double strain, const double n)
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
    static constexpr bool takes_packs          = false;
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
    struct Response
    {
      double kirchhoff_stress[3]; ///< principal values tau'_i [Pa]
      double work_increment;      ///< dPsi + dD, all stored and dissipated work [J/m^3]
      double plastic_multiplier;  ///< d lambda = dD [J/m^3]; 0 in an elastic step
      double plastic_volume;      ///< d eps_v^p
      double plastic_shear;       ///< d eps_s^p = |dev d eps^p|
      double flow[3];             ///< n = dev tau/|dev tau|; 0 without shear
      double volume_strain;       ///< ln J at the end [-]

      /** d(p', rho)/d(tr eps^tr, |dev eps^tr|) [Pa] */
      double volume_volume, volume_shear, shear_volume, shear_shear;
      double secant_shear;  ///< rho/|dev eps^tr| [Pa]
      double work_coupling; ///< (d(dPsi + dD)/d eps^tr - tau) by dp' [-]

      unsigned int n_iterations; ///< of the return
      bool         valid;        ///< false if there is no return; nothing else is set then
    };

    explicit CriticalState(const MaterialParameters &parameters);

    Response
    respond(const double (&strain_n)[3],
            const double (&increment)[3],
            const History<double> &history) const;

    /** d tau'_i / d eps^tr_j [Pa], consistent with the return; unsymmetric. */
    double
    tangent(const Response &r, const int i, const int j) const
    {
      return r.volume_volume + r.volume_shear * r.flow[j] + r.shear_volume * r.flow[i] +
             (r.shear_shear - r.secant_shear) * r.flow[i] * r.flow[j] +
             r.secant_shear * ((i == j ? 1. : 0.) - 1. / 3.);
    }

    /** (tau_i - tau_j) / (eps^tr_i - eps^tr_j) of two principal directions [Pa]. */
    double
    secant_shear(const Response &r, const int, const int) const
    {
      return r.secant_shear;
    }

    /** d(dPsi + dD)/d eps^tr_i [Pa], which is not tau'_i while A and B change. */
    double
    work_slope(const Response &r, const int i) const
    {
      return r.kirchhoff_stress[i] +
             r.work_coupling * (r.volume_volume + r.volume_shear * r.flow[i]);
    }

    /** Elastic free energy [J/m^3]; the history gives ln J of the same state. */
    double
    energy(const double (&elastic_strain)[3], const History<double> &history) const
    {
      return elastic.energy(elastic_strain, of_elasticity(history));
    }

    /** Part of the strain increment in direction i that is plastic [-]. */
    double
    plastic_increment(const Response &r, const int i) const
    {
      return r.plastic_volume / 3. + r.plastic_shear * r.flow[i];
    }

    History<double>
    updated(const Response &r, const History<double> &history) const
    {
      return {history.equivalent_plastic_strain + std::sqrt(2. / 3.) * r.plastic_shear,
              history.plastic_volume_strain + r.plastic_volume,
              r.volume_strain};
    }

    /** Frozen energy Psi_2 = -a_0 eps_v^p or 0 [J/m^3]. */
    double
    hardening_energy(const History<double> &history) const
    {
      return -shift * history.plastic_volume_strain;
    }

    /** dD of the step [J/m^3]. */
    double
    dissipation(const Response &r) const
    {
      return r.plastic_multiplier;
    }

    double
    p_wave_modulus() const
    {
      return elastic.p_wave_modulus();
    }

    /** The yield function and what it is made of, at a strain and porosity. */
    struct Surface
    {
      VolumetricResponse<> volume;
      double               phi, rho; ///< dissipative stresses [Pa]
      double               A, B;     ///< half axes [Pa]
      double               excess;   ///< f = sqrt((phi/A)^2 + (rho/B)^2) - 1 [-]
    };

    /** @param shear |dev eps^e| */
    Surface
    surface(const double volume_strain, const double shear, const double n) const;

    const Elasticity elastic;
    const double     bulk_modulus;         ///< undeformed [Pa]
    const double     centre;               ///< a_0 = gamma p_c/2 [Pa]
    const double     shift;                ///< what the frozen energy adds to phi: a_0 or 0 [Pa]
    const double     surface_alpha;        ///< alpha [-]
    const double     surface_gamma;        ///< gamma [-]
    const double     critical_state_slope; ///< M = rho/P at the critical state [-]

  private:
    struct Return;

    /** What the elastic law answers by. */
    static HistoryOf<Elasticity>
    of_elasticity(const History<double> &history)
    {
      if constexpr (has_columns<Elasticity>)
        return {history.volume_strain};
      else
        return {};
    }

    double
    porosity_at(const double volume_strain) const;

    bool
    return_to_surface(const double trial_volume,
                      const double trial_shear,
                      const double n,
                      Return      &result) const;

    void
    set_plastic(const Return &result,
                const double  trial_volume,
                const double  trial_shear,
                const double  n,
                Response     &response) const;
  };
} // namespace kedge

#endif
