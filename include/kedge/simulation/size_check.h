#ifndef kedge_simulation_size_check_h
#define kedge_simulation_size_check_h

#include <kedge/scene/path_scene.h>
#include <kedge/scene/scene.h>

namespace kedge
{
  /**
   * Refuses scenes that no machine can run, before anything is allocated: more material
   * points than fit into the memory that is free, more steps or pictures than can be
   * computed and stored.
   *
   * @throws UserError with the figure and the entry to change
   */
  template <int dim>
  void
  check_size(const Scene<dim> &scene);

  /** The same for a single point: the rows of its table. */
  void
  check_size(const PathScene &scene);
} // namespace kedge

#endif
