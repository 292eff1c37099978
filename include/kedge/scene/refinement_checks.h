#ifndef kedge_scene_refinement_checks_h
#define kedge_scene_refinement_checks_h

#include <kedge/scene/parameter_reader.h>
#include <kedge/scene/scene.h>

namespace kedge
{
  /**
   * What a refined grid (Grid/Refinement) cannot bear.
   *
   * @throws UserError that says so
   */
  template <int dim>
  void
  check_refinement(const ParameterReader &reader, const Scene<dim> &scene);
} // namespace kedge

#endif
