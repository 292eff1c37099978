#ifndef kedge_surfaces_surface_faces_h
#define kedge_surfaces_surface_faces_h

#include <kedge/points/material_points.h>
#include <kedge/surfaces/surface_facets.h>
#include <kedge/surfaces/surface_term.h>

#include <unordered_map>

namespace kedge
{
  /** Where the faces of a surface stood at the start. */
  template <int dim>
  struct SurfaceExtent
  {
    dealii::Point<dim>     low, high;    ///< of the faces' centres [m]
    dealii::Tensor<1, dim> half_lengths; ///< of the largest face [m]
    unsigned int           n_faces = 0;
  };

  /**
   * Outer faces of bodies on which something is prescribed, or sections through them. On sides
   * along the axes, and in sections, they belong to material points and move and deform with them;
   * on sides that are oblique or curved they are facets of the surface that the body carries. A
   * section that runs between two points belongs to both, half each.
   */
  template <int dim>
  class SurfaceFaces
  {
  public:
    /**
     * @param what     begins the message on a surface without faces
     * @param surfaces that bodies carry; those of bodies that are not among them consist of the
     *                 faces of their points, and must last as long as this
     */
    SurfaceFaces(const std::string                           &what,
                 const std::vector<SurfaceParameters>        &parameters,
                 const std::map<std::string, double>         &constants,
                 const std::vector<const SurfaceTerm<dim> *> &surfaces = {});

    /**
     * Finds the faces, or the parts of them where Where is true, among the points just
     * generated (all of them, on all ranks) and marks their points as loaded.
     *
     * @param body_names one per body
     * @throws UserError for a surface that finds no exposed face
     */
    void
    attach(std::vector<GeneratedPoint<dim>> &points, const std::vector<std::string> &body_names);

    /** Of a surface of points' faces, on all ranks, after attach(). */
    const SurfaceExtent<dim> &
    extent(const unsigned int surface) const
    {
      return extents[surface];
    }

    /** Places on the facets of a surface that consists of such, and areas that they stand for, at
     * the start of the run; on all ranks, after attach(). */
    const std::vector<PlaceOfSurface<dim>> &
    start_of_facets(const unsigned int surface) const
    {
      return facets_at_start[surface];
    }

    /** Whether a surface has found any face, after attach(). */
    bool
    any(const unsigned int surface) const
    {
      return extents[surface].n_faces > 0 || !facets_at_start[surface].empty();
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
      unsigned int           side;
      double                 area;   ///< undeformed [m^2]
      dealii::Point<dim>     place;  ///< of its centre, at the start [m]
      dealii::Tensor<1, dim> offset; ///< undeformed, from the point to the face's centre [m]
    };

    const BodySurface<dim> *
    on_facets(const unsigned int surface) const;
    void
    attach_to_points(const unsigned int                surface,
                     const unsigned int                side,
                     const Expression                 &where,
                     std::vector<GeneratedPoint<dim>> &points,
                     const std::vector<std::string>   &body_names);
    void
    add_faces(const std::uint64_t   id,
              const unsigned int    slot,
              const PointCore<dim> &state,
              const Patch<dim>     &patch);
    /** The face that a generated point has on a side of a surface; of no area if it has none. */
    Face
    face_of(const GeneratedPoint<dim> &point,
            const unsigned int         surface,
            const unsigned int         side,
            const Expression          &where) const;
    void
    extend(SurfaceExtent<dim> &extent, const Face &face, const PointState<dim> &state) const;

    const std::string                                    what;
    const std::vector<SurfaceParameters>                 parameters;
    const std::map<std::string, double>                  constants;
    const std::vector<const SurfaceTerm<dim> *>          surfaces;
    std::unordered_map<std::uint64_t, std::vector<Face>> faces_of; ///< by id of the point
    SurfaceFacets<dim>                                   facets;
    std::vector<SurfacePoint<dim>>                       faces;
    std::vector<SurfaceExtent<dim>>                      extents; ///< one per surface
    std::vector<std::vector<PlaceOfSurface<dim>>>        facets_at_start;
  };
} // namespace kedge

#endif
