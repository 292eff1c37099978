#ifndef kedge_scene_numerics_declarations_h
#define kedge_scene_numerics_declarations_h

#include <kedge/scene/declarations.h>

namespace kedge
{
  /** The section Pore fluid. */
  template <int dim>
  SectionDeclaration
  declare_pore_fluid(const ValuePatterns<dim> &allow);

  /** The section Time. */
  template <int dim>
  SectionDeclaration
  declare_time(const ValuePatterns<dim> &allow);

  /** The sections of the method, which a user seldom needs: Newton to Stabilisation. */
  template <int dim>
  std::vector<SectionDeclaration>
  declare_numerics(const ValuePatterns<dim> &allow);
} // namespace kedge

#endif
