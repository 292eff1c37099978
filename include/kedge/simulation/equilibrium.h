#ifndef kedge_simulation_equilibrium_h
#define kedge_simulation_equilibrium_h

#include <kedge/points/point_state.h>
#include <kedge/scene/scene.h>

#include <deal.II/base/mpi.h>

namespace kedge
{
  /**
   * The points of this rank after the quasi-static stage Equilibrium of a scene
   * (collective). Loads, pressures and fluxes are those of Time/Start; prescribed
   * motions rest. Displacement, velocity and what was dissipated are zero in the
   * result and the place is the reference position; deformation gradient, elastic strain,
   * stress and pores stay, so that the initial porosity is that of the
   * unstressed soil.
   *
   * @throws UserError if a step of the stage does not converge
   */
  template <int dim>
  std::vector<PointRecord<dim>>
  points_in_equilibrium(const Scene<dim> &scene, const MPI_Comm communicator);
} // namespace kedge

#endif
