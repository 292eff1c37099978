#ifndef kedge_materials_parameters_h
#define kedge_materials_parameters_h

#include <string>

namespace kedge
{
  enum class MaterialKind
  {
    hencky,
    von_mises,
    improved_hencky,
    critical_state,         ///< on hencky
    critical_state_improved ///< on improved_hencky
  };

  /** What the critical-state model stores in plastic changes of volume. */
  enum class FrozenEnergy
  {
    centred, ///< -a_0 eps_v^p, which puts the surface where critical states are compressed
    none     ///< as the thesis prints it
  };

  /**
   * Which change of volume gives the pressure: each point's own, or the mean
   * of those of its body in its cell, which does not lock.
   */
  enum class VolumeChange
  {
    pointwise,
    cell_mean
  };

  /** A material as the scene names it; density in the reference configuration. */
  struct MaterialParameters
  {
    std::string  name;
    MaterialKind kind          = MaterialKind::hencky;
    VolumeChange volume_change = VolumeChange::pointwise;
    double       density       = 0; ///< [kg/m^3]
    double       young_modulus = 0; ///< [Pa]
    double       poisson_ratio = 0; ///< [-]

    /** n_0, pores/volume at J = 1, of a skeleton that is or can be saturated [-] */
    double initial_porosity = 0;

    // von_mises
    double yield_stress      = 0; ///< uniaxial, sigma_y = sqrt(3/2) rho_y [Pa]
    double hardening_modulus = 0; ///< H [Pa]

    // critical_state, critical_state_improved
    double       preconsolidation_pressure = 0; ///< p_c, of the Kirchhoff stress [Pa]
    double       critical_state_slope      = 0; ///< M = |dev tau|/P at the critical state [-]
    double       surface_alpha             = 1; ///< alpha in (0, 1] [-]
    double       surface_gamma             = 1; ///< gamma in (0, 1] [-]
    FrozenEnergy frozen_energy             = FrozenEnergy::centred;
  };
} // namespace kedge

#endif
