#ifndef kedge_materials_improved_hencky_h
#define kedge_materials_improved_hencky_h

#include <kedge/materials/hencky.h>
#include <kedge/materials/pore_fluid.h>

namespace kedge
{
  /**
   * The spherical part of an elastic law whose energy depends on the elastic
   * volume strain eps and the porosity n. Stresses are effective Kirchhoff
   * stresses, tension positive [Pa].
   */
  template <typename Number = double>
  struct VolumetricResponse
  {
    Number pressure;                   ///< mean stress p' = dPsi/d eps
    Number slope;                      ///< dp'/d eps at fixed n
    Number porosity_slope;             ///< dp'/dn at fixed eps
    Number dissipative;                ///< p' - chi', chi' the shift stress (4.104)
    Number dissipative_slope;          ///< d(p' - chi')/d eps at fixed n
    Number dissipative_porosity_slope; ///< d(p' - chi')/dn at fixed eps
  };

  /**
   * The improved Hencky law (4.101) for the effective stress of a skeleton of
   * incompressible grains, in principal axes:
   *   Psi = K~/(2 n) eps_v^2 + G e:e  per reference volume [J/m^3],
   *   n = 1 - (1 - n_0) exp(-ln J),
   *   p' = K~ eps_v/n (1 - eps_v (1 - n)/(2 n)),  s = 2 G e,
   * eps the elastic Hencky strain, e its deviator. (The print has half this p'
   * in (C.5).) As all pores close, n -> 0, the pressure grows beyond all
   * bounds; there is no answer for n <= 0. The bulk modulus of the undeformed
   * skeleton is K_0 = K~/n_0. The total volume strain ln J comes from the
   * history and the trace of the increment.
   */
  class ImprovedHencky
  {
  public:
    static constexpr bool yields               = false;
    static constexpr bool can_fail             = true;
    static constexpr bool decoupled_volume     = false;
    static constexpr bool takes_packs          = true;
    static constexpr bool stress_is_work_slope = true;

    static constexpr std::array<Column, 1> columns{
      {{"volume_strain", "-", "ln det F", ColumnKind::volume_strain}}};

    template <typename Number>
    struct History
    {
      Number volume_strain = 0.; ///< ln det F [-]
    };

    static std::array<const SpatialConstant *, 1>
    constants(const MaterialParameters &)
    {
      return {};
    }

    /** What the law answers to a principal strain. */
    template <typename Number>
    struct Response
    {
      Number            kirchhoff_stress[3]; ///< principal values tau'_i [Pa]
      Number            work_increment;      ///< increment of Psi [J/m^3]
      Number            bulk_modulus;        ///< dp'/d eps_v, the pores deforming too (C.7) [Pa]
      Number            volume_strain;       ///< ln J at the end [-]
      Condition<Number> valid;               ///< false if n <= 0; the rest is of no use then
    };

    explicit ImprovedHencky(const MaterialParameters &parameters)
      : original(parameters)
      , bulk_modulus(original.bulk_modulus)
      , shear_modulus(original.shear_modulus)
      , initial_porosity(parameters.initial_porosity)
      , bulk_parameter(initial_porosity * bulk_modulus)
    {}

    /** n at the total volume strain ln J. */
    template <typename Number>
    Number
    porosity(const Number &volume_strain) const
    {
      using std::exp;
      return 1. - (1. - initial_porosity) * exp(-volume_strain);
    }

    /** p' and what belongs to it at an elastic volume strain and a porosity n > 0. */
    template <typename Number>
    VolumetricResponse<Number>
    volumetric(const Number &strain, const Number &n) const
    {
      const Number secant = bulk_parameter / n, closed = strain * (1. - n) / n;
      return {secant * strain * (1. - 0.5 * closed),
              secant * (1. - closed),
              0.5 * secant * strain / n * (strain * (2. - n) / n - 2.),
              secant * strain,
              secant,
              -secant * strain / n};
    }

    template <typename Number>
    Response<Number>
    respond(const Number (&strain_n)[3],
            const Number (&increment)[3],
            const History<Number> &history) const
    {
      using std::expm1;
      const Number trace_n = strain_n[0] + strain_n[1] + strain_n[2];
      const Number trace_d = increment[0] + increment[1] + increment[2];
      const Number strain  = trace_n + trace_d;

      Response<Number> response;
      response.volume_strain = history.volume_strain + trace_d;
      const Number n_n       = porosity(history.volume_strain);
      const Number n         = porosity(response.volume_strain);
      response.valid         = n > 0. && n_n > 0.;
      if (!any(response.valid))
        return response;

      const VolumetricResponse<Number> volume = volumetric(strain, n);
      response.bulk_modulus                   = volume.slope + (1. - n) * volume.porosity_slope;
      Number deviatoric                       = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const Number e_n = strain_n[i] - trace_n / 3., de = increment[i] - trace_d / 3.;
          deviatoric += de * (2. * e_n + de);
          response.kirchhoff_stress[i] = volume.pressure + 2. * shear_modulus * (e_n + de);
        }
      const Number pores_opened = -(1. - n_n) * expm1(-trace_d); // n - n_n
      response.work_increment =
        0.5 * bulk_parameter / n *
          (trace_d * (2. * trace_n + trace_d) - trace_n * trace_n * pores_opened / n_n) +
        shear_modulus * deviatoric;
      return response;
    }

    /** Free energy per reference volume [J/m^3]; the history gives ln J of the same state. */
    template <typename Number>
    Number
    energy(const Number (&strain)[3], const History<Number> &history) const
    {
      const Number trace = strain[0] + strain[1] + strain[2];
      Number       sum   = 0.;
      for (const Number &eps : strain)
        sum += (eps - trace / 3.) * (eps - trace / 3.);
      return 0.5 * bulk_parameter / porosity(history.volume_strain) * trace * trace +
             shear_modulus * sum;
    }

    /** d tau'_i / d eps_j [Pa]. */
    template <typename Number>
    Number
    tangent(const Response<Number> &response, const int i, const int j) const
    {
      return response.bulk_modulus - 2. / 3. * shear_modulus + (i == j ? 2. * shear_modulus : 0.);
    }

    /** (tau_i - tau_j) / (eps_i - eps_j) of two principal directions [Pa]. */
    template <typename Number>
    Number
    secant_shear(const Response<Number> &, const int, const int) const
    {
      return 2. * shear_modulus;
    }

    /** The volume strain at the end of the step. */
    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      History<Number> end = history;
      end.volume_strain   = response.volume_strain;
      return end;
    }

    /** P-wave modulus K_0 + 4/3 G of the undeformed skeleton [Pa]. */
    double
    p_wave_modulus() const
    {
      return original.p_wave_modulus();
    }

    const Hencky original;         ///< the law of the same K_0 and G that knows no pores
    const double bulk_modulus;     ///< K_0 = K~/n_0, undeformed [Pa]
    const double shear_modulus;    ///< G [Pa]
    const double initial_porosity; ///< n_0 [-]
    const double bulk_parameter;   ///< K~ [Pa]
  };
} // namespace kedge

#endif
