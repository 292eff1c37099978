#ifndef kedge_scene_read_scene_h
#define kedge_scene_read_scene_h

#include <kedge/scene/parameter_file.h>
#include <kedge/scene/scene.h>

namespace kedge
{
  /**
   * The entry Dimension of a scene file.
   *
   * @throws UserError if it is missing or neither 2 nor 3.
   */
  unsigned int
  scene_dimension(const ParameterFile &file);

  /**
   * Makes a checked scene of a parameter file. Use:
   * @code
   *   ParameterFile file = ParameterFile::read("beam.prm", MPI_COMM_WORLD);
   *   file.set("Bodies/beam/Points per cell = 2");
   *   const Scene<2> scene = read_scene<2>(file);
   * @endcode
   *
   * Needs no communication: every rank makes the same scene of its copy.
   *
   * @throws UserError for anything that cannot be used, with the entry's full
   * name, file and line, the value, what is allowed, and the nearest valid
   * name where a name is not known.
   */
  template <int dim>
  Scene<dim>
  read_scene(const ParameterFile &file);
} // namespace kedge

#endif
