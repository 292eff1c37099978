#ifndef kedge_scene_read_geometry_h
#define kedge_scene_read_geometry_h

#include <kedge/grid/parameters.h>
#include <kedge/points/geometry.h>
#include <kedge/scene/parameter_reader.h>

namespace kedge
{
  /** Where a body may be. */
  enum class BodyExtent
  {
    in_grid,
    anywhere
  };

  /**
   * The entry Geometry of a body.
   *
   * @param folder of the scene, where files with a relative name are searched
   * @throws UserError if a file cannot be used or the body reaches past the grid.
   */
  template <int dim>
  std::shared_ptr<Geometry<dim>>
  read_geometry(const SectionReader         &section,
                const GridParameters<dim>   &grid,
                const std::filesystem::path &folder,
                const BodyExtent             extent = BodyExtent::in_grid);

  /** Its parts that do not touch, see parse_pieces(). */
  template <int dim>
  std::vector<std::shared_ptr<Geometry<dim>>>
  read_pieces(const SectionReader         &section,
              const GridParameters<dim>   &grid,
              const std::filesystem::path &folder);
} // namespace kedge

#endif
