// Parameters of the soils that the tests use, and differences of what they answer.
#ifndef kedge_tests_materials_soils_h
#define kedge_tests_materials_soils_h

#include <kedge/materials/material.h>

#include <random>

namespace kedge::test
{
  /** K_0 = 30 MPa, G = 28 MPa, n_0 = 0.2, p_c = 250 kPa: thesis, tables 4.6 and 4.7 (A). */
  inline MaterialParameters
  soil(const FrozenEnergy frozen_energy = FrozenEnergy::centred)
  {
    const double       K = 30e6, G = 28e6;
    MaterialParameters parameters;
    parameters.young_modulus             = 9. * K * G / (3. * K + G);
    parameters.poisson_ratio             = (3. * K - 2. * G) / (2. * (3. * K + G));
    parameters.initial_porosity          = 0.2;
    parameters.preconsolidation_pressure = 2.5e5;
    parameters.critical_state_slope      = 0.964;
    parameters.surface_alpha             = 0.3;
    parameters.surface_gamma             = 0.9;
    parameters.frozen_energy             = frozen_energy;
    return parameters;
  }

  /** P = -p' [Pa] */
  inline double
  pressure_of(const double (&tau)[3])
  {
    return -(tau[0] + tau[1] + tau[2]) / 3.;
  }

  /** rho = |dev tau| [Pa] */
  inline double
  shear_of(const double (&tau)[3])
  {
    const double P = pressure_of(tau);
    return std::sqrt((tau[0] + P) * (tau[0] + P) + (tau[1] + P) * (tau[1] + P) +
                     (tau[2] + P) * (tau[2] + P));
  }

  /** A history of any of the soils' laws. */
  struct SoilHistory
  {
    double equivalent_plastic_strain = 0., plastic_volume_strain = 0., volume_strain = 0.;

    template <class Elasticity>
    using Yielding = HistoryOf<CriticalState<Elasticity>>;

    operator Yielding<Hencky>() const
    {
      return {equivalent_plastic_strain, plastic_volume_strain, volume_strain};
    }
    operator Yielding<ImprovedHencky>() const
    {
      return {equivalent_plastic_strain, plastic_volume_strain, volume_strain};
    }
    operator ImprovedHencky::History<double>() const
    {
      return {volume_strain};
    }
  };

  /** A committed state and a step from it, in principal axes. */
  struct SoilStep
  {
    double      strain[3], increment[3];
    SoilHistory history;
  };

  /** Strains of the order of @p strain, mostly compressed, and steps of the order of @p step. */
  inline SoilStep
  random_step(std::mt19937 &generator, const double strain, const double step)
  {
    std::uniform_real_distribution<double> uniform(-1, 1);
    SoilStep                               result;
    for (int i = 0; i < 3; ++i)
      {
        result.strain[i]    = strain * (uniform(generator) - 0.5);
        result.increment[i] = step * (uniform(generator) - 0.2);
      }
    result.history.equivalent_plastic_strain = 0.1;
    result.history.plastic_volume_strain     = -0.02;
    result.history.volume_strain = result.strain[0] + result.strain[1] + result.strain[2] - 0.02;
    return result;
  }

  /**
   * Largest errors of a law's tangent [relative to its largest entry] and of
   * the slope of its work [relative to the stress] at the end of a step,
   * against central differences with strains of @p h.
   */
  template <class Material>
  std::pair<double, double>
  slope_errors(const Material &material, const SoilStep &step, const double h)
  {
    const HistoryOf<Material> history = step.history;
    const auto                at      = material.respond(step.strain, step.increment, history);
    double                    tangent_error = 0., work_error = 0., size = 0., stiffness = 0.;
    for (const double tau : at.kirchhoff_stress)
      size = std::max(size, std::abs(tau));
    for (int j = 0; j < 3; ++j)
      {
        SoilStep plus = step, minus = step;
        plus.increment[j] += h;
        minus.increment[j] -= h;
        const auto up   = material.respond(plus.strain, plus.increment, history);
        const auto down = material.respond(minus.strain, minus.increment, history);
        for (int i = 0; i < 3; ++i)
          stiffness = std::max(stiffness, std::abs(material.tangent(at, i, j)));
        for (int i = 0; i < 3; ++i)
          tangent_error =
            std::max(tangent_error,
                     std::abs((up.kirchhoff_stress[i] - down.kirchhoff_stress[i]) / (2. * h) -
                              material.tangent(at, i, j)));
        double slope = at.kirchhoff_stress[j];
        if constexpr (!Material::stress_is_work_slope)
          slope = material.work_slope(at, j);
        work_error =
          std::max(work_error,
                   std::abs((up.work_increment - down.work_increment) / (2. * h) - slope));
      }
    return {tangent_error / stiffness, work_error / size};
  }
} // namespace kedge::test

#endif
