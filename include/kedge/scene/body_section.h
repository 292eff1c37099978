#ifndef kedge_scene_body_section_h
#define kedge_scene_body_section_h

#include <kedge/grid/parameters.h>
#include <kedge/points/parameters.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_reader.h>

#include <filesystem>

namespace kedge
{
  /** The section Bodies: what the material points make up. */
  template <int dim>
  SectionDeclaration
  declare_bodies(const ValuePatterns<dim> &allow);

  /**
   * @param folder of the scene, where files with a relative name are searched
   *
   * @throws UserError if there is no body, or one that cannot be.
   */
  template <int dim>
  std::vector<BodyParameters<dim>>
  read_bodies(const ParameterReader       &reader,
              const GridParameters<dim>   &grid,
              const std::filesystem::path &folder);
} // namespace kedge

#endif
