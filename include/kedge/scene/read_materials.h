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

  /**
   * Strains of softening that hold for one cell size, on a grid whose cells are
   * @p cell_size [m] wide: a shear band is as wide as some cells.
   */
  void
  scale_softening(const double cell_size, std::vector<MaterialParameters> &materials);
} // namespace kedge

#endif
