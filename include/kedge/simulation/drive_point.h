#ifndef kedge_simulation_drive_point_h
#define kedge_simulation_drive_point_h

#include <kedge/base/exceptions.h>
#include <kedge/scene/path_scene.h>

#include <mpi.h>

#include <filesystem>

namespace kedge
{
  /** The columns of the history.csv that drive_point() writes. */
  std::vector<std::string>
  path_columns(const PathScene &scene);

  /**
   * Drives a single material point along a path and writes history.csv into
   * the folder @p output: a row for the start and one for each step, with the
   * deformation gradient, Kirchhoff and Cauchy stress [Pa], energies and
   * dissipation per reference volume [J/m^3]. Of an element test of soil these
   * are effective stresses; it adds strains, total stresses, the pore pressure,
   * porosity and void ratio. Then the checks of the scene.
   * Collective.
   *
   * @param strict a failed check makes the exit code numerical_stop
   *
   * @throws UserError for a path that does not begin at F = I, for checks of
   * columns that there are not, and for what the folder does not allow
   */
  ExitCode
  drive_point(const PathScene             &scene,
              const std::filesystem::path &output,
              const bool                   strict,
              const MPI_Comm               communicator);
} // namespace kedge

#endif
