#ifndef kedge_porous_pore_update_h
#define kedge_porous_pore_update_h

#include <kedge/points/point_state.h>

namespace kedge
{
  /** The pores of a material point at the end of a step, not yet committed. */
  template <int dim>
  struct PoreUpdate
  {
    double pressure;            ///< p_{n+1} [Pa]
    double fluctuation;         ///< (N - N^0) p_{n+1} [Pa]
    double porosity;            ///< n_{n+1} [-]
    double mass;                ///< of skeleton and fluid [kg]
    double content_rate;        ///< m'_{n+1} per V0 [kg/m^3/s]
    double content_rate_change; ///< m''_{n+1} per V0 [kg/m^3/s^2]
    double darcy_velocity[dim]; ///< [m/s]
    double darcy_dissipation;   ///< in this step [J]
    double flow_work;           ///< of f on the flow, in this step [J]
    double inertia_work;        ///< of -a on it [J]
    double known_inflow;        ///< dt m' as far as it is known at n [kg]
    double stabilisation_work;  ///< of the stabilisation, in this step [J]
  };

  /** Writes it into the history. */
  template <int dim>
  void
  apply_pore_update(const PoreUpdate<dim> &update, PointState<dim> &state);
} // namespace kedge

#endif
