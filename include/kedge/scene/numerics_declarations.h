#ifndef kedge_scene_numerics_declarations_h
#define kedge_scene_numerics_declarations_h

#include <kedge/scene/declarations.h>

namespace kedge
{
  /** The sections of the method, which a user seldom needs: Newton to Stabilisation. */
  template <int dim>
  std::vector<SectionDeclaration>
  declare_numerics(const ValuePatterns<dim> &allow);
} // namespace kedge

#endif
