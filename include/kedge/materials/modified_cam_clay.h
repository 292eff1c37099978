#ifndef kedge_materials_modified_cam_clay_h
#define kedge_materials_modified_cam_clay_h

#include <kedge/materials/cam_clay_return.h>
#include <kedge/materials/history.h>
#include <kedge/materials/parameters.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  /**
   * Modified Cam Clay that hardens, at finite strain, for the effective
   * Kirchhoff stress (Borja and Tamagnini 1998). Pressures and volume strains
   * positive in compression here: p = -tr tau/3, q = sqrt(3/2) |dev tau|,
   * e_v = -tr eps^e, e_s = sqrt(2/3) |dev eps^e|.
   *   Psi_e = p_r kappa exp(e_v/kappa) + 3/2 G e_s^2,  p = p_r exp(e_v/kappa),  q = 3 G e_s,
   *   f = q^2/M^2 + p (p - p_c) <= 0, associated,
   *   p_c = p_c,n exp(d e_v^p/(lambda - kappa)),  Psi_p = (lambda - kappa) p_c/2,
   *   dD = tau : d eps^p - dPsi_p >= 0.
   * p_r is the pressure of the undeformed reference configuration, where a soil that
   * bears nothing else is in equilibrium; kappa and lambda are slopes by logarithmic
   * strain, those by the void ratio over 1 + e_0.
   *
   * The step is returned by backward Euler (CamClayReturn) in (e_v, e_s, L, ln p_c):
   *   e_v - e_v^tr + L (2 p - p_c) = 0,  e_s - e_s^tr + 2 L q/M^2 = 0,  f = 0,
   *   ln p_c - ln p_c,n - L (2 p - p_c)/(lambda - kappa) = 0.
   */
  class ModifiedCamClay
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
       {"preconsolidation_pressure", "Pa", "p_c, of the Kirchhoff stress", ColumnKind::of_place}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< sqrt(2/3) of all |dev d eps^p| [-]
      Number plastic_volume_strain     = 0.; ///< positive where the pores open [-]
      Number preconsolidation_pressure = 0.; ///< p_c [Pa]
    };

    static std::array<const SpatialConstant *, 3>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, nullptr, &parameters.start_preconsolidation_pressure}};
    }

    /** What the law answers to a principal trial strain. */
    template <typename Number>
    struct Response
    {
      Number            kirchhoff_stress[3]; ///< principal values tau'_i [Pa]
      Number            work_increment;      ///< dPsi + dD, all stored and dissipated work [J/m^3]
      Number            dissipation;         ///< dD [J/m^3]
      Number            flow[3];             ///< dev eps^tr/|dev eps^tr|; 0 without shear
      Number            plastic_volume;      ///< -tr d eps^p: positive in compression [-]
      Number            plastic_shear;       ///< sqrt(2/3) |dev d eps^p| [-]
      Number            preconsolidation;    ///< p_c at the end [Pa]
      Number            p_v, p_s, q_v, q_s;  ///< d(p, q)/d(e_v^tr, e_s^tr) [Pa]
      Number            shear_secant;        ///< (tau_i - tau_j)/(eps^tr_i - eps^tr_j) [Pa]
      Condition<Number> valid; ///< false if there is no return; the rest is of no use then
    };

    explicit ModifiedCamClay(const MaterialParameters &parameters)
      : shear_modulus(parameters.young_modulus / (2. * (1. + parameters.poisson_ratio)))
      , kappa(parameters.swelling_slope / (1. + parameters.initial_void_ratio))
      , lambda(parameters.compression_slope / (1. + parameters.initial_void_ratio))
      , critical_state_ratio(parameters.critical_state_ratio)
      , reference_pressure(parameters.reference_pressure)
      , largest_pressure(parameters.preconsolidation_by_ratio
                           ? parameters.reference_pressure
                           : std::max(parameters.start_preconsolidation_pressure.value,
                                      parameters.reference_pressure))
      , preconsolidation_by_ratio(parameters.preconsolidation_by_ratio)
    {}

    /** p at an elastic volume strain, compression positive [Pa]. */
    template <typename Number>
    Number
    pressure(const Number &volume) const
    {
      using std::exp;
      return reference_pressure * exp(volume / kappa);
    }

    /** f over p_c^2 [-]. */
    template <typename Number>
    Number
    yield_function(const Number &p, const Number &q, const Number &p_c) const
    {
      return (q * q / (critical_state_ratio * critical_state_ratio) + p * (p - p_c)) / (p_c * p_c);
    }

    template <typename Number>
    Response<Number>
    respond(const Number (&strain_n)[3],
            const Number (&increment)[3],
            const History<Number> &history) const
    {
      using std::exp;
      using std::expm1;
      using std::sqrt;
      Response<Number> r;
      const Number     trace_n = strain_n[0] + strain_n[1] + strain_n[2];
      const Number     trace_d = increment[0] + increment[1] + increment[2];
      Number           deviator_n[3], deviator_d[3], square = 0.;
      for (int i = 0; i < 3; ++i)
        {
          deviator_n[i]      = strain_n[i] - trace_n / 3.;
          deviator_d[i]      = increment[i] - trace_d / 3.;
          const Number trial = deviator_n[i] + deviator_d[i];
          square += trial * trial;
        }
      const Number norm = sqrt(square);
      for (int i = 0; i < 3; ++i)
        r.flow[i] = select(norm > 0.,
                           (deviator_n[i] + deviator_d[i]) / select(norm > 0., norm, Number(1.)),
                           Number(0.));

      typename CamClayReturn<Number>::Trial trial;
      trial.volume = -(trace_n + trace_d);
      trial.q      = 3. * shear_modulus * sqrt(Number(2.) / 3.) * norm;
      trial.p_c    = history.preconsolidation_pressure;
      trial.c      = 6. * shear_modulus /
                (critical_state_ratio * critical_state_ratio * history.preconsolidation_pressure);
      Number plastic = 0., multiplier = 0.; // volume, and L p_c,n
      r.valid = trial.p_c > 0.;
      const CamClayReturn<Number> way_back(
        {reference_pressure, kappa, lambda - kappa, critical_state_ratio},
        trial);
      r.valid = way_back.find(r.valid, plastic, multiplier);
      if (!any(r.valid))
        return r;
      const Number p     = pressure(Number(trial.volume - plastic));
      const Number q     = trial.q / (1. + trial.c * multiplier);
      r.plastic_volume   = plastic;
      r.plastic_shear    = trial.c * multiplier * q / (3. * shear_modulus);
      r.preconsolidation = trial.p_c * exp(plastic / (lambda - kappa));
      set_slopes(trial, way_back.equations(plastic, multiplier), p, q, multiplier, r);

      // energies from increments, or they cancel in small steps
      const Number p_n    = pressure(Number(-trace_n));
      Number       stored = p_n * kappa * expm1((-trace_d - plastic) / kappa);
      for (int i = 0; i < 3; ++i)
        {
          const Number change = deviator_d[i] - sqrt(Number(1.5)) * r.plastic_shear * r.flow[i];
          stored += shear_modulus * change * (2. * deviator_n[i] + change);
          r.kirchhoff_stress[i] = -p + sqrt(Number(2.) / 3.) * q * r.flow[i];
        }
      const Number plastic_work = p * r.plastic_volume + q * r.plastic_shear;
      r.work_increment          = stored + plastic_work;
      r.dissipation             = plastic_work - 0.5 * (lambda - kappa) * trial.p_c *
                                       expm1(r.plastic_volume / (lambda - kappa));
      return r;
    }

    /** d tau_i / d eps^tr_j [Pa], consistent with the return. */
    template <typename Number>
    Number
    tangent(const Response<Number> &r, const int i, const int j) const
    {
      const double root = std::sqrt(2. / 3.);
      return r.p_v - root * (r.p_s * r.flow[j] + r.q_v * r.flow[i]) +
             (2. / 3. * r.q_s - r.shear_secant) * r.flow[i] * r.flow[j] +
             r.shear_secant * ((i == j ? 1. : 0.) - 1. / 3.);
    }

    /** (tau_i - tau_j) / (eps^tr_i - eps^tr_j) of two principal directions [Pa]. */
    template <typename Number>
    Number
    secant_shear(const Response<Number> &r, const int, const int) const
    {
      return r.shear_secant;
    }

    /** d(dPsi + dD)/d eps^tr_i = tau_i + sum_j d tau_j/d eps^tr_i d eps^p_j [Pa]. */
    template <typename Number>
    Number
    work_slope(const Response<Number> &r, const int i) const
    {
      Number slope = r.kirchhoff_stress[i];
      for (int j = 0; j < 3; ++j)
        slope += tangent(r, j, i) * plastic_increment(r, j);
      return slope;
    }

    /** Elastic free energy, p_r kappa in the reference configuration [J/m^3]. */
    template <typename Number>
    Number
    energy(const Number (&strain)[3], const History<Number> &) const
    {
      const Number trace = strain[0] + strain[1] + strain[2];
      Number       sum   = 0.;
      for (const Number &eps : strain)
        sum += (eps - trace / 3.) * (eps - trace / 3.);
      return kappa * pressure(Number(-trace)) + shear_modulus * sum;
    }

    /** Part of the strain increment in direction i that is plastic [-]. */
    template <typename Number>
    Number
    plastic_increment(const Response<Number> &r, const int i) const
    {
      return -r.plastic_volume / 3. + std::sqrt(1.5) * r.plastic_shear * r.flow[i];
    }

    template <typename Number>
    History<Number>
    updated(const Response<Number> &r, const History<Number> &history) const
    {
      return {history.equivalent_plastic_strain + r.plastic_shear,
              history.plastic_volume_strain - r.plastic_volume,
              r.preconsolidation};
    }

    /** Psi_p = (lambda - kappa) p_c/2 [J/m^3]. */
    template <typename Number>
    Number
    hardening_energy(const History<Number> &history) const
    {
      return 0.5 * (lambda - kappa) * history.preconsolidation_pressure;
    }

    /** dD of the step [J/m^3]. */
    template <typename Number>
    Number
    dissipation(const Response<Number> &r) const
    {
      return r.dissipation;
    }

    /** K + 4/3 G at the largest pressure that it has borne, K = p/kappa [Pa]. */
    double
    p_wave_modulus() const
    {
      return largest_pressure / kappa + 4. / 3. * shear_modulus;
    }

    const double shear_modulus;             ///< G [Pa]
    const double kappa;                     ///< of swelling, by logarithmic strain [-]
    const double lambda;                    ///< of compression, by logarithmic strain [-]
    const double critical_state_ratio;      ///< M = q/p at the critical state [-]
    const double reference_pressure;        ///< p_r [Pa]
    const double largest_pressure;          ///< [Pa]
    const bool   preconsolidation_by_ratio; ///< p_c at the start is given over that of the surface
                                            ///< through the initial stress

  private:
    /** d(p, q)/d(e_v^tr, e_s^tr) of the equations that define the return. */
    template <typename Number>
    void
    set_slopes(const typename CamClayReturn<Number>::Trial     &trial,
               const typename CamClayReturn<Number>::Equations &at,
               const Number                                    &p,
               const Number                                    &q,
               const Number                                    &m,
               Response<Number>                                &r) const
    {
      const double G     = shear_modulus;
      const Number one   = 1. + trial.c * m;
      r.shear_secant     = 2. * G / one;
      const auto   flows = m > 0.;
      const double M_2   = critical_state_ratio * critical_state_ratio;
      const Number p_c = r.preconsolidation, size = trial.p_c * trial.p_c;
      // by e_v^tr at fixed d e_v^p: dp = p/kappa; by e_s^tr: dq = 3 G/one
      const Number volume_t  = 2. * m * p / (kappa * trial.p_c);
      const Number surface_t = p * (2. * p - p_c) / (kappa * size);
      const Number surface_s = 2. * q * 3. * G / (one * M_2 * size);
      const Number det =
        select(flows, at.volume_v * at.surface_m - at.volume_m * at.surface_v, Number(1.));
      const Number v_v = (-volume_t * at.surface_m + at.volume_m * surface_t) / det;
      const Number m_v = (-at.volume_v * surface_t + at.surface_v * volume_t) / det;
      const Number v_s = at.volume_m * surface_s / det, m_s = -at.volume_v * surface_s / det;
      r.p_v = select(flows, p / kappa * (1. - v_v), p / kappa);
      r.p_s = select(flows, -p / kappa * v_s, Number(0.));
      r.q_v = select(flows, -q * trial.c / one * m_v, Number(0.));
      r.q_s = select(flows, 3. * G / one - q * trial.c / one * m_s, Number(3. * G));
    }
  };
} // namespace kedge

#endif
