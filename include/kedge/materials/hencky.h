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
    static constexpr bool yields               = false; ///< has plastic strains
    static constexpr bool can_fail             = false; ///< its Response has a flag, valid
    static constexpr bool decoupled_volume     = true; ///< mean stress K tr eps, whatever the shape
    static constexpr bool stress_is_work_slope = true; ///< d(dPsi + dD)/d eps^tr = tau
    static constexpr bool takes_packs          = true; ///< answers several points at once

    /** What it answers by beside the elastic strain: nothing. */
    static constexpr std::array<Column, 0> columns{};
    template <typename Number>
    struct History
    {};

    /** What the law answers to a principal trial strain. */
    template <typename Number>
    struct Response
    {
      Number kirchhoff_stress[3]; ///< principal values tau_i [Pa]
      Number work_increment;      ///< Psi(eps_n + deps) - Psi(eps_n) [J/m^3]
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
    template <typename Number>
    Response<Number>
    respond(const Number (&strain_n)[3],
            const Number (&increment)[3],
            const History<Number> & = {}) const
    {
      const Number trace_n = strain_n[0] + strain_n[1] + strain_n[2];
      const Number trace_d = increment[0] + increment[1] + increment[2];

      Response<Number> response;
      Number           deviatoric = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const Number e_n = strain_n[i] - trace_n / 3., de = increment[i] - trace_d / 3.;
          deviatoric += de * (2. * e_n + de);
          response.kirchhoff_stress[i] =
            lame_modulus * (trace_n + trace_d) + 2. * shear_modulus * (strain_n[i] + increment[i]);
        }
      response.work_increment =
        bulk_modulus * trace_d * (trace_n + 0.5 * trace_d) + shear_modulus * deviatoric;
      return response;
    }

    /** Free energy per reference volume [J/m^3]. */
    template <typename Number>
    Number
    energy(const Number (&strain)[3], const History<Number> & = {}) const
    {
      const Number trace = strain[0] + strain[1] + strain[2];
      Number       sum   = 0.;
      for (const Number &eps : strain)
        sum += (eps - trace / 3.) * (eps - trace / 3.);
      return 0.5 * bulk_modulus * trace * trace + shear_modulus * sum;
    }

    /** dtau_i / deps_j [Pa]. */
    template <typename Number>
    Number
    tangent(const Response<Number> &, const int i, const int j) const
    {
      return lame_modulus + (i == j ? 2. * shear_modulus : 0.);
    }

    /** (tau_i - tau_j) / (eps_i - eps_j) of two principal directions [Pa]. */
    template <typename Number>
    Number
    secant_shear(const Response<Number> &, const int, const int) const
    {
      return 2. * shear_modulus;
    }

    /** Where the numbers of the columns come from: a constant of place, or 0. */
    static std::array<const SpatialConstant *, 0>
    constants(const MaterialParameters &)
    {
      return {};
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
