#ifndef kedge_scene_joint_section_h
#define kedge_scene_joint_section_h

#include <kedge/rigid/parameters.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_reader.h>

namespace kedge
{
  // The section Joints.

  template <int dim>
  SectionDeclaration
  declare_joints(const ValuePatterns<dim> &allow);

  /** @throws UserError for what is missing or does not go together */
  template <int dim>
  std::vector<JointParameters>
  read_joints(const ParameterReader &reader);
} // namespace kedge

#endif
