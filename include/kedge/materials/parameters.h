#ifndef kedge_materials_parameters_h
#define kedge_materials_parameters_h

#include <string>

namespace kedge
{
  enum class MaterialKind
  {
    hencky,
    von_mises
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
  };
} // namespace kedge

#endif
