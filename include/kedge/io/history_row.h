#ifndef kedge_io_history_row_h
#define kedge_io_history_row_h

#include <cstdint>
#include <limits>
#include <vector>

namespace kedge
{
  /**
   * One row of history.csv: the books after an accepted step (SI; per metre
   * of thickness in 2D). Energies and momenta are those of the material
   * points. In 2D the angular momentum has its z component only.
   */
  struct HistoryRow
  {
    static constexpr double unset = std::numeric_limits<double>::signaling_NaN();

    std::uint64_t step              = 0;
    double        time              = unset; ///< [s]
    double        time_step         = unset; ///< [s]
    unsigned int  newton_iterations = 0;
    unsigned int  linear_iterations = 0;
    unsigned int  rejected_attempts = 0;

    double kinetic_energy       = unset; ///< [J]
    double strain_energy        = unset;
    double hardening_energy     = 0;
    double plastic_dissipation  = 0; ///< accumulated [J]
    double stabilisation_energy = 0; ///< accumulated [J]
    double external_work        = 0; ///< accumulated, reactions of moving supports included [J]
    double energy_error         = 0; ///< total + dissipation - initial - external work [J]

    double linear_momentum[3]  = {0, 0, 0}; ///< [kg m/s]
    double angular_momentum[3] = {0, 0, 0}; ///< about the origin [kg m^2/s]
    double mass                = unset;     ///< [kg]

    // saturated soil
    double solid_mass        = 0;     ///< [kg]
    double fluid_mass        = 0;     ///< [kg]
    double fluid_inflow      = 0;     ///< accumulated, through the surface [kg]
    double fluid_error       = 0;     ///< fluid_mass less what was there and fluid_inflow [kg]
    double fluid_energy      = 0;     ///< of the compressed fluid [J]
    double darcy_dissipation = 0;     ///< accumulated [J]
    double min_porosity      = unset; ///< of all points [-]

    std::vector<double> reactions; ///< of supports on the bodies, as HistoryColumns names them [N]

    std::uint64_t n_points       = 0;
    std::uint64_t n_active_cells = 0;
    std::uint64_t n_dofs         = 0; ///< unknowns solved for
    double        min_det_F      = unset;
    double        wall_time      = 0; ///< since the start of the run [s]

    double
    total_energy() const
    {
      return kinetic_energy + strain_energy + hardening_energy + fluid_energy;
    }
  };
} // namespace kedge

#endif
