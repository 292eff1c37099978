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

  /**
   * A constant of a law that may differ from place to place: factor times an
   * expression of the reference place X = (x, y, z).
   */
  struct SpatialConstant
  {
    double      value       = 0.;    ///< the same everywhere, or that at X = 0
    std::string expression  = "";    ///< of x, y, z; empty if it is the same everywhere
    double      factor      = 1.;    ///< by which the expression is multiplied
    std::string entry       = "";    ///< its name in the scene
    bool        may_be_zero = false; ///< else it must be positive

    SpatialConstant() = default;
    SpatialConstant(const double value)
      : value(value)
    {}
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
    SpatialConstant yield_stress;          ///< uniaxial, sigma_y = sqrt(3/2) rho_y [Pa]
    double          hardening_modulus = 0; ///< H [Pa]

    // critical_state, critical_state_improved
    double       preconsolidation_pressure = 0; ///< p_c, of the Kirchhoff stress [Pa]
    double       critical_state_slope      = 0; ///< M = |dev tau|/P at the critical state [-]
    double       surface_alpha             = 1; ///< alpha in (0, 1] [-]
    double       surface_gamma             = 1; ///< gamma in (0, 1] [-]
    FrozenEnergy frozen_energy             = FrozenEnergy::centred;
  };
} // namespace kedge

#endif
