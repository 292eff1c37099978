#ifndef kedge_surfaces_surface_faces_h
#define kedge_surfaces_surface_faces_h

#include <kedge/base/expression.h>
#include <kedge/points/generation.h>
#include <kedge/points/material_points.h>
#include <kedge/surfaces/face_functions.h>
#include <kedge/surfaces/parameters.h>

#include <unordered_map>

namespace kedge
{
  /** The outer face of a material point, or a section through it, in configuration n. */
  template <int dim>
  struct SurfacePoint
  {
    unsigned int       slot;
    unsigned int       surface;         ///< number of the surface
    double             offset[dim];     ///< from the point to the face's centre [m]
    double             area[dim];       ///< outward normal times area [m^2]
    double             reference_area;  ///< of the undeformed face [m^2]
    dealii::Point<dim> reference_place; ///< of its centre [m]
    Stencil<dim>       functions;       ///< of the nodes at the face, see functions_at_face()
  };

  /** Where the faces of a surface stood at the start. */
  template <int dim>
  struct SurfaceExtent
  {
    dealii::Point<dim>     low, high;    ///< of the faces' centres [m]
    dealii::Tensor<1, dim> half_lengths; ///< of the largest face [m]
    unsigned int           n_faces = 0;
  };

  /**
   * Outer faces of bodies on which something is prescribed, or sections through them: the faces
   * belong to material points and move and deform with them. A section that runs between two
   * points belongs to both, half each.
   */
  template <int dim>
  class SurfaceFaces
  {
  public:
    /** @param what begins the message on a surface without faces */
    SurfaceFaces(const std::string                    &what,
                 const std::vector<SurfaceParameters> &parameters,
                 const std::map<std::string, double>  &constants);

    /**
     * Finds the faces, or the parts of them where Where is true, among the points just
     * generated (all of them, on all ranks) and marks their points as loaded.
     *
     * @param body_names one per body
     * @throws UserError for a surface that finds no exposed face
     */
    void
    attach(std::vector<GeneratedPoint<dim>> &points, const std::vector<std::string> &body_names);

    /** Of a surface, on all ranks, after attach(). */
    const SurfaceExtent<dim> &
    extent(const unsigned int surface) const
    {
      return extents[surface];
    }

    /** Reads the faces of this rank's points as they are at the start of a step. */
    void
    reinit(const MaterialPoints<dim> &cloud, const Patch<dim> &patch);

    bool
    empty() const
    {
      return parameters.empty();
    }

    /** Of the surfaces. */
    std::vector<std::string>
    names() const
    {
      std::vector<std::string> result;
      for (const auto &surface : parameters)
        result.push_back(surface.name);
      return result;
    }

    /** Of this rank, by increasing slot. */
    const std::vector<SurfacePoint<dim>> &
    points() const
    {
      return faces;
    }

  private:
    struct Face
    {
      unsigned int           surface;
      double                 area;   ///< undeformed [m^2]
      dealii::Point<dim>     place;  ///< of its centre, at the start [m]
      dealii::Tensor<1, dim> offset; ///< undeformed, from the point to the face's centre [m]
    };

    /** The face that a generated point has on a surface; of no area if it has none. */
    Face
    face_of(const GeneratedPoint<dim> &point,
            const unsigned int         surface,
            const Expression          &where) const;
    void
    extend(SurfaceExtent<dim> &extent, const Face &face, const PointState<dim> &state) const;

    const std::string                                    what;
    const std::vector<SurfaceParameters>                 parameters;
    const std::map<std::string, double>                  constants;
    std::unordered_map<std::uint64_t, std::vector<Face>> faces_of; ///< by id of the point
    std::vector<SurfacePoint<dim>>                       faces;
    std::vector<SurfaceExtent<dim>>                      extents; ///< one per surface
  };
} // namespace kedge

#endif
