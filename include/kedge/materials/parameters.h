#ifndef kedge_materials_parameters_h
#define kedge_materials_parameters_h

#include <string>
#include <vector>

namespace kedge
{
  enum class MaterialKind
  {
    hencky,
    von_mises,
    improved_hencky,
    critical_state,          ///< on hencky
    critical_state_improved, ///< on improved_hencky
    tresca,
    undrained_von_mises,
    drucker_prager,
    mohr_coulomb,
    modified_cam_clay
  };

  /** What the critical-state model stores in plastic changes of volume. */
  enum class FrozenEnergy
  {
    centred, ///< -a_0 eps_v^p, which puts the surface where critical states are compressed
    none     ///< as the thesis prints it
  };

  /** Where Drucker and Prager's cone bears what Mohr and Coulomb's law does. */
  enum class ConeMatch
  {
    plane_strain,
    compression, ///< triaxial
    extension    ///< triaxial
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
   * What a constant of place may depend on: the reference place X = (x, y, z) and how far below
   * the highest point of its body, along y, that is [m].
   */
  inline std::vector<std::string>
  spatial_variables()
  {
    return {"x", "y", "z", "depth"};
  }

  /**
   * A constant of a law that may differ from place to place: factor times an
   * expression of spatial_variables().
   */
  struct SpatialConstant
  {
    double      value       = 0.;    ///< the same everywhere, or that at X = 0
    std::string expression  = "";    ///< of spatial_variables(); empty if it is the same everywhere
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
    double       viscosity     = 0; ///< eta, of a dashpot beside the material [Pa s]

    /** n_0, pores/volume at J = 1, of a skeleton that is or can be saturated [-] */
    double initial_porosity = 0;

    // von_mises
    SpatialConstant yield_stress;          ///< uniaxial, sigma_y = sqrt(3/2) rho_y [Pa]
    double          hardening_modulus = 0; ///< H [Pa]

    // tresca, undrained_von_mises
    SpatialConstant undrained_strength;        ///< s_u0 [Pa]
    double          remoulded_strength  = 1.;  ///< d, over the intact one [-]
    double          softening_strain    = 10.; ///< xi_95 [-]
    double          softening_cell_size = 0.;  ///< for which it holds [m]; 0: on every grid
    double          rate_coefficient    = 0.;  ///< mu, growth of s_u per decade of rate [-]
    double          reference_rate      = 1.;  ///< up to which s_u is that given [1/s]

    // drucker_prager, mohr_coulomb
    SpatialConstant cohesion;              ///< c [Pa]
    SpatialConstant stiffness_factor = 1.; ///< of both moduli [-]
    double          friction_angle   = 0.; ///< phi [deg]
    double          dilation_angle   = 0.; ///< psi [deg]
    ConeMatch       cone_match       = ConeMatch::plane_strain;
    double          apex_rounding    = 0.; ///< e/k of drucker_prager [-]
    double          tension_cut_off  = 1.; ///< of the apex [-]

    // modified_cam_clay
    double          swelling_slope       = 0.;       ///< kappa, by the void ratio [-]
    double          compression_slope    = 0.;       ///< lambda, by the void ratio [-]
    double          initial_void_ratio   = 0.;       ///< e_0 [-]
    double          critical_state_ratio = 0.;       ///< M = q/p' at the critical state [-]
    double          reference_pressure   = 0.;       ///< p_r [Pa]
    SpatialConstant start_preconsolidation_pressure; ///< p_c at the start [Pa], or its ratio
    bool preconsolidation_by_ratio = false; ///< to that of the surface through the initial stress

    // critical_state, critical_state_improved
    double       preconsolidation_pressure = 0; ///< p_c, of the Kirchhoff stress [Pa]
    double       critical_state_slope      = 0; ///< M = |dev tau|/P at the critical state [-]
    double       surface_alpha             = 1; ///< alpha in (0, 1] [-]
    double       surface_gamma             = 1; ///< gamma in (0, 1] [-]
    FrozenEnergy frozen_energy             = FrozenEnergy::centred;
  };
} // namespace kedge

#endif
