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
   * Divides the strengths of the materials by Strength reduction: c, tan phi, s_u, sigma_y (and its
   * hardening); psi becomes phi at most.
   *
   * @throws UserError for a model whose strength is not one of them.
   */
  void
  reduce_strength(const ParameterReader &reader, std::vector<MaterialParameters> &materials);

  /**
   * Strains of softening that hold for one cell size, on a grid whose cells are
   * @p cell_size [m] wide: a shear band is as wide as some cells.
   */
  void
  scale_softening(const double cell_size, std::vector<MaterialParameters> &materials);
} // namespace kedge

#endif
