#ifndef kedge_scene_rigid_section_h
#define kedge_scene_rigid_section_h

#include <kedge/rigid/parameters.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_reader.h>

#include <filesystem>

namespace kedge
{
  // The sections Rigid bodies and Lines.

  template <int dim>
  SectionDeclaration
  declare_rigid_bodies(const ValuePatterns<dim> &allow);

  template <int dim>
  SectionDeclaration
  declare_lines(const ValuePatterns<dim> &allow);

  /**
   * @param folder of the scene, where files with a relative name are searched
   * @throws UserError for what is missing or does not go together
   */
  template <int dim>
  std::vector<RigidBodyParameters<dim>>
  read_rigid_bodies(const ParameterReader       &reader,
                    const GridParameters<dim>   &grid,
                    const std::filesystem::path &folder);

  std::vector<LineParameters>
  read_lines(const ParameterReader &reader);
} // namespace kedge

#endif
