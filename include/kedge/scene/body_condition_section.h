#ifndef kedge_scene_body_condition_section_h
#define kedge_scene_body_condition_section_h

#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/solid/parameters.h>

namespace kedge
{
  /** The section Body conditions: motion prescribed on bodies, which carry it along. */
  template <int dim>
  SectionDeclaration
  declare_body_conditions(const ValuePatterns<dim> &allow);

  /** @throws UserError for names that no body has, and conditions that prescribe nothing. */
  template <int dim>
  std::vector<BodyConditionParameters<dim>>
  read_body_conditions(const ParameterReader &reader);
} // namespace kedge

#endif
