#ifndef kedge_scene_read_materials_h
#define kedge_scene_read_materials_h

#include <kedge/materials/parameters.h>
#include <kedge/scene/parameter_reader.h>

#include <vector>

namespace kedge
{
  /**
   * The section Materials.
   *
   * @throws UserError for entries that do not fit the model.
   */
  std::vector<MaterialParameters>
  read_materials(const ParameterReader &reader);
} // namespace kedge

#endif
