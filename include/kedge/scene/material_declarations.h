#ifndef kedge_scene_material_declarations_h
#define kedge_scene_material_declarations_h

#include <kedge/scene/declarations.h>

namespace kedge
{
  /** The section Materials. */
  template <int dim>
  SectionDeclaration
  declare_materials(const ValuePatterns<dim> &allow);
} // namespace kedge

#endif
