#ifndef kedge_scene_output_declarations_h
#define kedge_scene_output_declarations_h

#include <kedge/scene/declarations.h>

namespace kedge
{
  /** The section Output. */
  template <int dim>
  SectionDeclaration
  declare_output(const ValuePatterns<dim> &allow);
} // namespace kedge

#endif
