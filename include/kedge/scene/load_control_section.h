#ifndef kedge_scene_load_control_section_h
#define kedge_scene_load_control_section_h

#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/scene/scene.h>

namespace kedge
{
  /** The section Load control: dead loads that are found from how a material point moves. */
  template <int dim>
  SectionDeclaration
  declare_load_control(const ValuePatterns<dim> &allow);

  /**
   * Nothing if the section is empty.
   *
   * @param scene of which all other sections have been read
   * @throws UserError for inertia, pore water, loads that are not dead, a point of no body
   */
  template <int dim>
  std::optional<LoadControlParameters<dim>>
  read_load_control(const ParameterReader &reader, const Scene<dim> &scene);
} // namespace kedge

#endif
