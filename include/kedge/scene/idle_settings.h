#ifndef kedge_scene_idle_settings_h
#define kedge_scene_idle_settings_h

#include <kedge/scene/parameter_file.h>
#include <kedge/scene/scene.h>

#include <string>
#include <vector>

namespace kedge
{
  /**
   * A line for each setting of a scene that differs from its default and has no effect
   * with the others: which, and what it would go with. Settings that would let a user
   * believe in other physics are refused by read_scene() instead.
   */
  template <int dim>
  std::vector<std::string>
  idle_settings(const ParameterFile &file, const Scene<dim> &scene);
} // namespace kedge

#endif
