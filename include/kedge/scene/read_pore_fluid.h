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
   * The section Surface pressures.
   *
   * @throws UserError for a body that is not there
   */
  template <int dim>
  std::vector<SurfacePressureParameters>
  read_surface_pressures(const ParameterReader &reader);
} // namespace kedge

#endif
