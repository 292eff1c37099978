#ifndef kedge_simulation_equilibrium_h
#define kedge_simulation_equilibrium_h

#include <kedge/equations/term.h>
#include <kedge/points/point_state.h>
#include <kedge/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace kedge
{
  /** What the stage leaves to the run. */
  template <int dim>
  struct EquilibriumState
  {
    std::vector<PointRecord<dim>> points; ///< of this rank
    std::map<std::string, double> forces; ///< columns of the last step: reactions [N; N/m in 2D]
    SavedState                    terms;  ///< surfaces, closed contacts
  };

  /**
   * The points of this rank, and what terms remember, after the quasi-static stage Equilibrium
   * of a scene (collective). Loads, pressures and fluxes are those of Time/Start; prescribed
   * motions rest. Displacement, velocity and what was dissipated are zero in the
   * result and the place is the reference position; deformation gradient, elastic strain,
   * stress and pores stay, so that the initial porosity is that of the
   * unstressed soil. Says on @p log how the stage goes.
   *
   * @throws UserError if a step of the stage does not converge
   */
  template <int dim>
  EquilibriumState<dim>
  find_equilibrium(const Scene<dim> &scene, const MPI_Comm communicator, std::ostream &log);
} // namespace kedge

#endif
