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
  /** The outer face of a material point, in configuration n. */
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

  /**
   * Outer faces of bodies on which something is prescribed: the faces belong to
   * material points and move and deform with them.
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

    const std::string                                    what;
    const std::vector<SurfaceParameters>                 parameters;
    const std::map<std::string, double>                  constants;
    std::unordered_map<std::uint64_t, std::vector<Face>> faces_of; ///< by id of the point
    std::vector<SurfacePoint<dim>>                       faces;
  };
} // namespace kedge

#endif
