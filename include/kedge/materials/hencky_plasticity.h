#ifndef kedge_materials_hencky_plasticity_h
#define kedge_materials_hencky_plasticity_h

#include <kedge/materials/hencky.h>

namespace kedge
{
  /** What a law on Hencky's elasticity answers that stores nothing in its plastic strains. */
  template <typename Number>
  struct PlasticResponse
  {
    Number            kirchhoff_stress[3]; ///< principal values tau_i [Pa]
    Number            work_increment;      ///< dPsi + dD, all stored and dissipated work [J/m^3]
    Number            trial_strain[3];     ///< eps^tr [-]
    Number            plastic_strain[3];   ///< d eps^p [-]
    Number            tangent[3][3];       ///< d tau_i/d eps^tr_j [Pa]
    Number            dissipation;         ///< dD = tau : d eps^p [J/m^3]
    Number            softening_strain;    ///< by how much what it softens by has grown [-]
    Number            opening;             ///< by how much it has been torn open, or closed [-]
    Condition<Number> valid;               ///< false if there is no return
  };

  /**
   * What laws share whose elasticity is Hencky's, in principal axes, and that
   * dissipate all plastic work, associated or not:
   *   dD = tau_{n+1} : d eps^p,  d eps^p = eps^tr - eps^e_{n+1},
   *   d(dPsi + dD)/d eps^tr = tau + (d tau/d eps^tr)^T : d eps^p.
   * (The second term vanishes for associated perfect plasticity only.)
   * If Law::stiffness_of_place, both moduli are history.stiffness times those of the parameters:
   * stresses are those of the soil whose strength is that much smaller, times it.
   *
   * @tparam Law gives return_stress(trial stress, history, response), which sets
   * plastic_strain, tangent, softening_strain and valid; handed over, they are
   * those of an elastic step.
   */
  template <class Law>
  class HenckyPlasticity
  {
  public:
    static constexpr bool yields               = true;
    static constexpr bool can_fail             = true;
    static constexpr bool stress_is_work_slope = false;

    template <typename Number>
    using Response = PlasticResponse<Number>;

    explicit HenckyPlasticity(const MaterialParameters &parameters)
      : elastic(parameters)
      , bulk_modulus(elastic.bulk_modulus)
    {}

    template <typename Number, class History>
    Response<Number>
    respond(const Number (&strain_n)[3], const Number (&increment)[3], const History &history) const
    {
      Response<Number> response;
      const auto       trial = elastic.respond(strain_n, increment);
      for (int i = 0; i < 3; ++i)
        {
          response.trial_strain[i]   = strain_n[i] + increment[i];
          response.plastic_strain[i] = 0.;
          for (int j = 0; j < 3; ++j)
            response.tangent[i][j] = elastic.tangent(trial, i, j);
        }
      response.softening_strain = 0.;
      response.opening          = 0.;
      response.valid            = response.softening_strain <= 0.;
      law().return_stress(trial.kirchhoff_stress, softer(history), response);

      Number elastic_increment[3];
      for (int i = 0; i < 3; ++i)
        elastic_increment[i] = increment[i] - response.plastic_strain[i];
      const auto end       = elastic.respond(strain_n, elastic_increment);
      response.dissipation = 0.;
      for (int i = 0; i < 3; ++i)
        {
          response.kirchhoff_stress[i] = end.kirchhoff_stress[i];
          response.dissipation += end.kirchhoff_stress[i] * response.plastic_strain[i];
        }
      response.work_increment = end.work_increment + response.dissipation;
      if constexpr (Law::stiffness_of_place)
        stiffen(history.stiffness, response);
      return response;
    }

    /** d tau_i / d eps^tr_j [Pa], consistent with the return. */
    template <typename Number>
    Number
    tangent(const Response<Number> &response, const int i, const int j) const
    {
      return response.tangent[i][j];
    }

    /** (tau_i - tau_j) / (eps^tr_i - eps^tr_j), its limit for equal strains [Pa]. */
    template <typename Number>
    Number
    secant_shear(const Response<Number> &response, const int i, const int j) const
    {
      using std::abs;
      constexpr double smallest_difference = 1e-10; // of strains
      const Number     difference          = response.trial_strain[i] - response.trial_strain[j];
      const Number     limit               = response.tangent[i][i] - response.tangent[i][j];
      const auto       apart               = abs(difference) > smallest_difference;
      const Number     divisor             = select(apart, difference, Number(1.));
      return select(apart,
                    (response.kirchhoff_stress[i] - response.kirchhoff_stress[j]) / divisor,
                    limit);
    }

    /** d(dPsi + dD)/d eps^tr_i [Pa]. */
    template <typename Number>
    Number
    work_slope(const Response<Number> &response, const int i) const
    {
      Number slope = response.kirchhoff_stress[i];
      for (int j = 0; j < 3; ++j)
        slope += response.tangent[j][i] * response.plastic_strain[j];
      return slope;
    }

    /** Elastic free energy of the elastic strain [J/m^3]. */
    template <typename Number, class History>
    Number
    energy(const Number (&elastic_strain)[3], const History &history) const
    {
      if constexpr (Law::stiffness_of_place)
        return history.stiffness * elastic.energy(elastic_strain);
      else
        {
          (void)history;
          return elastic.energy(elastic_strain);
        }
    }

    /** Part of the strain increment in direction i that is plastic [-]. */
    template <typename Number>
    Number
    plastic_increment(const Response<Number> &response, const int i) const
    {
      return response.plastic_strain[i];
    }

    /** Nothing is stored in plastic strains. */
    template <class History>
    auto
    hardening_energy(const History &history) const
    {
      return 0. * history.equivalent_plastic_strain;
    }

    /** dD of the step [J/m^3]. */
    template <typename Number>
    Number
    dissipation(const Response<Number> &response) const
    {
      return response.dissipation;
    }

    double
    p_wave_modulus() const
    {
      return elastic.p_wave_modulus();
    }

    const Hencky elastic;
    const double bulk_modulus; ///< K [Pa]

  protected:
    /** Growth of the equivalent plastic strain, sqrt(2/3) |dev d eps^p| [-]. */
    template <typename Number>
    static Number
    equivalent_increment(const Response<Number> &response)
    {
      using std::sqrt;
      const auto  &p    = response.plastic_strain;
      const Number mean = (p[0] + p[1] + p[2]) / 3.;
      return sqrt(2. / 3. *
                  ((p[0] - mean) * (p[0] - mean) + (p[1] - mean) * (p[1] - mean) +
                   (p[2] - mean) * (p[2] - mean)));
    }

  private:
    /** The history of the soil of stiffness 1. */
    template <class History>
    static History
    softer(const History &history)
    {
      History result = history;
      if constexpr (Law::stiffness_of_place)
        result.cohesion /= history.stiffness;
      return result;
    }

    template <typename Number>
    static void
    stiffen(const Number &stiffness, Response<Number> &response)
    {
      response.work_increment *= stiffness;
      response.dissipation *= stiffness;
      for (int i = 0; i < 3; ++i)
        {
          response.kirchhoff_stress[i] *= stiffness;
          for (int j = 0; j < 3; ++j)
            response.tangent[i][j] *= stiffness;
        }
    }

    const Law &
    law() const
    {
      return static_cast<const Law &>(*this);
    }
  };
} // namespace kedge

#endif
