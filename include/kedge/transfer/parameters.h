#ifndef kedge_transfer_parameters_h
#define kedge_transfer_parameters_h

#include <cmath>

namespace kedge
{
  enum class VelocityUpdate
  {
    flip,
    pic
  };

  /** What is done where the body fills cells badly. */
  enum class StabilisationKind
  {
    aggregation, ///< NodeTies
    ghost,       ///< GhostPenalty
    none
  };

  struct StabilisationParameters
  {
    StabilisationKind method                 = StabilisationKind::aggregation;
    double            smallest_filling       = 0.05; ///< below, a node is tied [cells]
    double            ghost_mass_factor      = 1e-6; ///< gamma_M of (3.153) over rho [-]
    double            ghost_stiffness_factor = 1e-6; ///< gamma_K of (3.152) over E [-]
    double ghost_conductivity_factor = 1e-3; ///< gamma_K(f) of (4.177) over kappa_0/(g h^2) [-]
    double ghost_storage_factor      = 0;    ///< gamma_M(f) of (4.176) over rho_f/K_f [-]
  };

  struct TransferParameters
  {
    VelocityUpdate velocity_mapping = VelocityUpdate::flip;
    double         filter_time      = 0;     ///< of flip [s]; 0: nothing is filtered
    double         lumping          = 0;     ///< epsilon of (3.161): 0 consistent, 1 lumped
    bool           audit            = false; ///< write what each mapping loses, Tables 3.1, 3.2

    /** Part of what only the points know of their velocities that is left after a step dt [-]. */
    double
    kept_part(const double dt) const
    {
      return velocity_mapping == VelocityUpdate::pic ? 0.
             : filter_time == 0.                     ? 1.
                                                     : std::exp(-dt / filter_time);
    }
  };
} // namespace kedge

#endif
