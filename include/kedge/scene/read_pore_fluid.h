#ifndef kedge_scene_read_pore_fluid_h
#define kedge_scene_read_pore_fluid_h

#include <kedge/scene/parameter_reader.h>
#include <kedge/scene/scene.h>

namespace kedge
{
  /**
   * The section Pore fluid; nothing if the bodies are dry.
   *
   * @param scene what has been read of the other sections
   * @throws UserError for what is missing, and for what saturated bodies cannot have
   */
  template <int dim>
  std::optional<PorousParameters>
  read_pore_fluid(const ParameterReader &reader, const Scene<dim> &scene);

  /**
   * The sections Surface pressures and Surface fluxes.
   *
   * @throws UserError for a body that is not there
   */
  template <int dim>
  void
  read_surfaces(const ParameterReader &reader, Scene<dim> &scene);
} // namespace kedge

#endif
