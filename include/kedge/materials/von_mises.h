#ifndef kedge_materials_von_mises_h
#define kedge_materials_von_mises_h

#include <kedge/materials/hencky.h>

namespace kedge
{
  /**
   * Associated von Mises plasticity with linear isotropic hardening on
   * Hencky's elasticity, in principal axes (thesis 3.4, appendix B.1; Simo
   * 1992). Yield, flow and energies per reference volume:
   *   f = |s| - sqrt(2/3) (sigma_y + H alpha) <= 0,  s = dev tau,
   *   d eps^p = d lambda n,  n = s/|s|,  d alpha = sqrt(2/3) d lambda,
   *   Psi = Psi_1(eps^e) + H alpha^2 / 2,  dD = sigma_y d alpha.
   * A step returns radially, in closed form:
   *   d lambda = f^tr / (2 G + 2 H/3),
   *   dPsi + dD = Psi_1(eps^tr) - Psi_1(eps^e_n) - (G + H/3) d lambda^2,
   * whose derivative by eps^tr is tau_{n+1}.
   */
  class VonMises
  {
  public:
    static constexpr bool yields               = true;
    static constexpr bool can_fail             = false;
    static constexpr bool decoupled_volume     = true;
    static constexpr bool stress_is_work_slope = true;
    static constexpr bool takes_packs          = true;

    static constexpr std::array<Column, 2> columns{
      {{"equivalent_plastic_strain", "-", "accumulated"},
       {"yield_stress", "Pa", "sigma_y of the virgin material", ColumnKind::of_place}}};

    template <typename Number>
    struct History
    {
      Number equivalent_plastic_strain = 0.; ///< alpha [-]
      Number yield_stress              = 0.; ///< sigma_y, uniaxial, of the virgin material [Pa]
    };

    static std::array<const SpatialConstant *, 2>
    constants(const MaterialParameters &parameters)
    {
      return {{nullptr, &parameters.yield_stress}};
    }

    /** What the law answers to a principal trial strain. */
    template <typename Number>
    struct Response
    {
      Number kirchhoff_stress[3]; ///< principal values tau_i [Pa]
      Number work_increment;      ///< dPsi + dD, all stored and dissipated work [J/m^3]
      Number plastic_multiplier;  ///< d lambda = |d eps^p| [-]; 0 in an elastic step
      Number flow[3];             ///< n; of no use in an elastic step
      Number shear_factor;        ///< theta = 1 - 2 G d lambda / |s^tr|; 1 in an elastic step
      Number yield_stress;        ///< sigma_y of the place [Pa]
    };

    explicit VonMises(const MaterialParameters &parameters)
      : elastic(parameters)
      , bulk_modulus(elastic.bulk_modulus)
      , hardening_modulus(parameters.hardening_modulus)
    {}

    template <typename Number>
    Response<Number>
    respond(const Number (&strain_n)[3],
            const Number (&increment)[3],
            const History<Number> &history) const
    {
      using std::sqrt;
      const Hencky::Response<Number> trial = elastic.respond(strain_n, increment);

      Response<Number> response;
      const Number     pressure =
        (trial.kirchhoff_stress[0] + trial.kirchhoff_stress[1] + trial.kirchhoff_stress[2]) / 3.;
      Number square = 0.;
      for (int i = 0; i < 3; ++i)
        {
          response.kirchhoff_stress[i] = trial.kirchhoff_stress[i];
          response.flow[i]             = trial.kirchhoff_stress[i] - pressure;
          square += response.flow[i] * response.flow[i];
        }
      response.work_increment     = trial.work_increment;
      response.plastic_multiplier = 0.;
      response.shear_factor       = 1.;
      response.yield_stress       = history.yield_stress;

      const Number norm   = sqrt(square);
      const Number excess = norm - radius(history);
      const auto   yields = excess > 0.;
      if (!any(yields))
        return response;

      const double G       = elastic.shear_modulus;
      const Number divisor = select(yields, norm, 1.);
      response.plastic_multiplier =
        select(yields, excess / (2. * G + 2. / 3. * hardening_modulus), 0.);
      response.shear_factor = 1. - 2. * G * response.plastic_multiplier / divisor;
      response.work_increment -=
        (G + hardening_modulus / 3.) * response.plastic_multiplier * response.plastic_multiplier;
      for (int i = 0; i < 3; ++i)
        {
          response.flow[i] /= divisor;
          response.kirchhoff_stress[i] -= 2. * G * response.plastic_multiplier * response.flow[i];
        }
      return response;
    }

    /** dtau_i / deps^tr_j [Pa], consistent with the return. */
    template <typename Number>
    Number
    tangent(const Response<Number> &response, const int i, const int j) const
    {
      const double G      = elastic.shear_modulus;
      const auto   yields = response.plastic_multiplier > 0.;
      Number       value =
        elastic.bulk_modulus + 2. * G * response.shear_factor * ((i == j ? 1. : 0.) - 1. / 3.);
      if (any(yields))
        value -=
          select(yields,
                 2. * G *
                   (response.shear_factor - hardening_modulus / (3. * G + hardening_modulus)) *
                   response.flow[i] * response.flow[j],
                 0.);
      return value;
    }

    /** (tau_i - tau_j) / (eps^tr_i - eps^tr_j) of two principal directions [Pa]. */
    template <typename Number>
    Number
    secant_shear(const Response<Number> &response, const int, const int) const
    {
      return 2. * elastic.shear_modulus * response.shear_factor;
    }

    /** Elastic free energy Psi_1 of the elastic strain [J/m^3]. */
    template <typename Number>
    Number
    energy(const Number (&elastic_strain)[3], const History<Number> &) const
    {
      return elastic.energy(elastic_strain);
    }

    /** Part of the strain increment in direction i that is plastic [-]. */
    template <typename Number>
    Number
    plastic_increment(const Response<Number> &response, const int i) const
    {
      return select(response.plastic_multiplier > 0.,
                    response.plastic_multiplier * response.flow[i],
                    0.);
    }

    /** alpha at the end of the step. */
    template <typename Number>
    History<Number>
    updated(const Response<Number> &response, const History<Number> &history) const
    {
      History<Number> end = history;
      end.equivalent_plastic_strain =
        history.equivalent_plastic_strain + std::sqrt(2. / 3.) * response.plastic_multiplier;
      return end;
    }

    /** Psi_2 = H alpha^2 / 2, energy stored in hardening [J/m^3]. */
    template <typename Number>
    Number
    hardening_energy(const History<Number> &history) const
    {
      return 0.5 * hardening_modulus * history.equivalent_plastic_strain *
             history.equivalent_plastic_strain;
    }

    /** dD = sigma_y d alpha of the step [J/m^3]. */
    template <typename Number>
    Number
    dissipation(const Response<Number> &response) const
    {
      return std::sqrt(2. / 3.) * response.yield_stress * response.plastic_multiplier;
    }

    double
    p_wave_modulus() const
    {
      return elastic.p_wave_modulus();
    }

    /** Radius of the yield surface, largest |s| [Pa]. */
    template <typename Number>
    Number
    radius(const History<Number> &history) const
    {
      return std::sqrt(2. / 3.) *
             (history.yield_stress + hardening_modulus * history.equivalent_plastic_strain);
    }

    const Hencky elastic;
    const double bulk_modulus;      ///< K [Pa]
    const double hardening_modulus; ///< H = d sigma_y / d alpha [Pa]
  };
} // namespace kedge

#endif
