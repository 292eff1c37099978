#ifndef kedge_scene_path_scene_h
#define kedge_scene_path_scene_h

#include <kedge/io/parameters.h>
#include <kedge/materials/parameters.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_file.h>
#include <kedge/stress/parameters.h>

namespace kedge
{
  /** A material and the path along which a single point of it is driven, checked. */
  struct PathScene
  {
    std::string                   name; ///< the file's name without folder and ending
    std::string                   title;
    std::map<std::string, double> constants;
    MaterialParameters            material;
    PathParameters                path;
    std::vector<CheckParameters>  checks;     ///< of columns of history.csv
    std::string                   parameters; ///< all values used
  };

  /** Whether a parameter file is a path: has the section Path, which scenes do not. */
  bool
  is_path_file(const ParameterFile &file);

  /** The sections of a path file: Path and, as in a scene, Constants, Materials, Checks. */
  std::vector<SectionDeclaration>
  declare_path(const std::map<std::string, double> &constants);

  /**
   * Makes a checked path of a parameter file. Every rank makes the same of its copy.
   *
   * @throws UserError as read_scene() does.
   */
  PathScene
  read_path_scene(const ParameterFile &file);
} // namespace kedge

#endif
