#ifndef kedge_porous_pressure_projection_h
#define kedge_porous_pressure_projection_h

#include <kedge/transfer/mass_system.h>

namespace kedge
{
  /**
   * The nodal pressures closest to those of the points,
   *   sum_B (sum_p V J N_A N_B + K_f M_G) p_B = sum_p V J N_A p_p,
   * at the free nodes, by a MassSystem; linear fields are exact. As the mass of ghosts is
   * part of the mapping of velocities (3.183), so is their storage M_G of this one: pressures
   * that jump in badly filled cells would otherwise be given to the ghosts in every step.
   * Collective.
   *
   * @param pressures of the points, in the slots of StepPoints [Pa]
   * @param bulk_modulus K_f [Pa]
   * @param storage M_G, partial sums; see PorousGhostTerm [m^3/Pa]
   * @param nodal dim + 1 values per local node, the last the pressure: first guess and
   *        prescribed values on entry, the solution on return, ghosts up to date
   */
  template <int dim>
  void
  project_pressure(const Patch<dim>          &patch,
                   const std::vector<double> &pressures,
                   const double               bulk_modulus,
                   const NodeMatrix<dim>     &storage,
                   std::vector<double>       &nodal);
} // namespace kedge

#endif
