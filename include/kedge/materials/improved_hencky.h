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
  struct VolumetricResponse
  {
    double pressure;                   ///< mean stress p' = dPsi/d eps
    double slope;                      ///< dp'/d eps at fixed n
    double porosity_slope;             ///< dp'/dn at fixed eps
    double dissipative;                ///< p' - chi', chi' the shift stress (4.104)
    double dissipative_slope;          ///< d(p' - chi')/d eps at fixed n
    double dissipative_porosity_slope; ///< d(p' - chi')/dn at fixed eps
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
    static constexpr bool takes_packs          = false;
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
    struct Response
    {
      double kirchhoff_stress[3]; ///< principal values tau'_i [Pa]
      double work_increment;      ///< increment of Psi [J/m^3]
      double bulk_modulus;        ///< dp'/d eps_v, the pores deforming too (C.7) [Pa]
      double volume_strain;       ///< ln J at the end [-]
      bool   valid;               ///< false if n <= 0; nothing else is set then
    };

    explicit ImprovedHencky(const MaterialParameters &parameters)
      : original(parameters)
      , bulk_modulus(original.bulk_modulus)
      , shear_modulus(original.shear_modulus)
      , initial_porosity(parameters.initial_porosity)
      , bulk_parameter(initial_porosity * bulk_modulus)
    {}

    /** n at the total volume strain ln J. */
    double
    porosity(const double volume_strain) const
    {
      return 1. - (1. - initial_porosity) * std::exp(-volume_strain);
    }

    /** p' and what belongs to it at an elastic volume strain and a porosity n > 0. */
    VolumetricResponse
    volumetric(const double strain, const double n) const
    {
      const double secant = bulk_parameter / n, closed = strain * (1. - n) / n;
      return {secant * strain * (1. - 0.5 * closed),
              secant * (1. - closed),
              0.5 * secant * strain / n * (strain * (2. - n) / n - 2.),
              secant * strain,
              secant,
              -secant * strain / n};
    }

    Response
    respond(const double (&strain_n)[3],
            const double (&increment)[3],
            const History<double> &history) const
    {
      const double trace_n = strain_n[0] + strain_n[1] + strain_n[2];
      const double trace_d = increment[0] + increment[1] + increment[2];
      const double strain  = trace_n + trace_d;

      Response response;
      response.volume_strain = history.volume_strain + trace_d;
      const double n_n       = porosity(history.volume_strain);
      const double n         = porosity(response.volume_strain);
      response.valid         = n > 0. && n_n > 0.;
      if (!response.valid)
        return response;

      const VolumetricResponse volume = volumetric(strain, n);
      response.bulk_modulus           = volume.slope + (1. - n) * volume.porosity_slope;
      double deviatoric               = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const double e_n = strain_n[i] - trace_n / 3., de = increment[i] - trace_d / 3.;
          deviatoric += de * (2. * e_n + de);
          response.kirchhoff_stress[i] = volume.pressure + 2. * shear_modulus * (e_n + de);
        }
      const double pores_opened = -(1. - n_n) * std::expm1(-trace_d); // n - n_n
      response.work_increment =
        0.5 * bulk_parameter / n *
          (trace_d * (2. * trace_n + trace_d) - trace_n * trace_n * pores_opened / n_n) +
        shear_modulus * deviatoric;
      return response;
    }

    /** Free energy per reference volume [J/m^3]; the history gives ln J of the same state. */
    double
    energy(const double (&strain)[3], const History<double> &history) const
    {
      const double trace = strain[0] + strain[1] + strain[2];
      double       sum   = 0.;
      for (const double eps : strain)
        sum += (eps - trace / 3.) * (eps - trace / 3.);
      return 0.5 * bulk_parameter / porosity(history.volume_strain) * trace * trace +
             shear_modulus * sum;
    }

    /** d tau'_i / d eps_j [Pa]. */
    double
    tangent(const Response &response, const int i, const int j) const
    {
      return response.bulk_modulus - 2. / 3. * shear_modulus + (i == j ? 2. * shear_modulus : 0.);
    }

    /** (tau_i - tau_j) / (eps_i - eps_j) of two principal directions [Pa]. */
    double
    secant_shear(const Response &, const int, const int) const
    {
      return 2. * shear_modulus;
    }

    /** The volume strain at the end of the step. */
    History<double>
    updated(const Response &response, const History<double> &history) const
    {
      History<double> end = history;
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
