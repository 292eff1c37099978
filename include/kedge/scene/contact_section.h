#ifndef kedge_scene_contact_section_h
#define kedge_scene_contact_section_h

#include <kedge/contact/parameters.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_reader.h>

namespace kedge
{
  /** The section Contact: bodies that may move apart. */
  template <int dim>
  SectionDeclaration
  declare_contact(const ValuePatterns<dim> &allow);

  /** @throws UserError for names that no body has, and bodies that stand on both sides, and walls
   * that are not one. */
  template <int dim>
  std::vector<ContactParameters>
  read_contacts(const ParameterReader &reader);
} // namespace kedge

#endif
