#ifndef kedge_io_scene_settings_h
#define kedge_io_scene_settings_h

#include <map>
#include <string>

namespace kedge
{
  /** All parameters of a scene, defaults included: "Materials/clay/Density" and its value. */
  using SceneSettings = std::map<std::string, std::string>;

  /**
   * Whether a run may be resumed with another value: all that concerns output and checks,
   * the end of the run, and what one changes to go on after a stop at the step floor.
   */
  bool
  may_change_on_resume(const std::string &setting);

  /**
   * The settings in which a scene differs from the one that wrote a checkpoint, but for
   * those that may: "Time/Alpha was '0.5', is '1'", at most a few; empty if there are none.
   */
  std::string
  forbidden_changes(const SceneSettings &then, const SceneSettings &now);
} // namespace kedge

#endif
