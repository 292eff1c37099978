#ifndef kedge_points_outline_h
#define kedge_points_outline_h

#include <kedge/geometry/surface_mesh.h>
#include <kedge/points/geometry.h>

namespace kedge
{
  /** A region whose surface is known in closed form. */
  template <int dim>
  class Outlined
  {
  public:
    virtual ~Outlined() = default;

    /** The surface with facets of about @p spacing [m]; nothing if it is not known after all. */
    virtual std::optional<SurfaceMesh<dim>>
    outline(const double spacing) const = 0;
  };

  /** The surface of a region if it is known in closed form. */
  template <int dim>
  std::optional<SurfaceMesh<dim>>
  outline(const Geometry<dim> &geometry, const double spacing)
  {
    const auto *outlined = dynamic_cast<const Outlined<dim> *>(&geometry);
    return outlined == nullptr ? std::nullopt : outlined->outline(spacing);
  }
} // namespace kedge

#endif
