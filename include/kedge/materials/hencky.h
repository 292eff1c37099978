#ifndef kedge_materials_hencky_h
#define kedge_materials_hencky_h

#include <kedge/materials/history.h>
#include <kedge/materials/parameters.h>

#include <cmath>

namespace kedge
{
  /**
   * Hencky's hyperelastic law (3.87) in principal axes,
   *   Psi = K/2 (tr eps)^2 + G e:e  per reference volume [J/m^3],
   *   tau_i = dPsi/deps_i = lambda tr eps + 2 G eps_i [Pa],
   * eps the logarithmic (Hencky) elastic strain, e its deviator.
   */
  class Hencky
  {
  public:
    static constexpr bool has_history          = false; ///< answers by its MaterialHistory
    static constexpr bool yields               = false; ///< has plastic strains
    static constexpr bool can_fail             = false; ///< its Response has a flag, valid
    static constexpr bool decoupled_volume     = true; ///< mean stress K tr eps, whatever the shape
    static constexpr bool stress_is_work_slope = true; ///< d(dPsi + dD)/d eps^tr = tau

    /** What the law answers to a principal trial strain. */
    struct Response
    {
      double kirchhoff_stress[3]; ///< principal values tau_i [Pa]
      double work_increment;      ///< Psi(eps_n + deps) - Psi(eps_n) [J/m^3]
    };

    explicit Hencky(const MaterialParameters &parameters)
      : bulk_modulus(parameters.young_modulus / (3. * (1. - 2. * parameters.poisson_ratio)))
      , shear_modulus(parameters.young_modulus / (2. * (1. + parameters.poisson_ratio)))
      , lame_modulus(bulk_modulus - 2. / 3. * shear_modulus)
    {}

    /**
     * Stress and stored work at the strain @p strain_n + @p increment. The
     * work is formed from the increment itself, so that its error is relative
     * to the increment and not to the stored energy.
     */
    Response
    respond(const double (&strain_n)[3],
            const double (&increment)[3],
            const MaterialHistory & = {}) const
    {
      const double trace_n = strain_n[0] + strain_n[1] + strain_n[2];
      const double trace_d = increment[0] + increment[1] + increment[2];

      Response response;
      double   deviatoric = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const double e_n = strain_n[i] - trace_n / 3., de = increment[i] - trace_d / 3.;
          deviatoric += de * (2. * e_n + de);
          response.kirchhoff_stress[i] =
            lame_modulus * (trace_n + trace_d) + 2. * shear_modulus * (strain_n[i] + increment[i]);
        }
      response.work_increment =
        bulk_modulus * trace_d * (trace_n + 0.5 * trace_d) + shear_modulus * deviatoric;
      return response;
    }

    /** Free energy per reference volume [J/m^3]. */
    double
    energy(const double (&strain)[3], const MaterialHistory & = {}) const
    {
      const double trace = strain[0] + strain[1] + strain[2];
      double       sum   = 0.;
      for (const double eps : strain)
        sum += (eps - trace / 3.) * (eps - trace / 3.);
      return 0.5 * bulk_modulus * trace * trace + shear_modulus * sum;
    }

    /** dtau_i / deps_j [Pa]. */
    double
    tangent(const Response &, const int i, const int j) const
    {
      return lame_modulus + (i == j ? 2. * shear_modulus : 0.);
    }

    /** (tau_i - tau_j) / (eps_i - eps_j) of any two principal directions [Pa]. */
    double
    secant_shear(const Response &) const
    {
      return 2. * shear_modulus;
    }

    /** P-wave modulus K + 4/3 G [Pa]. */
    double
    p_wave_modulus() const
    {
      return bulk_modulus + 4. / 3. * shear_modulus;
    }

    const double bulk_modulus;  ///< K [Pa]
    const double shear_modulus; ///< G [Pa]
    const double lame_modulus;  ///< lambda [Pa]
  };
} // namespace kedge

#endif
