#ifndef kedge_porous_surface_pressures_h
#define kedge_porous_surface_pressures_h

#include <kedge/base/expression.h>
#include <kedge/points/generation.h>
#include <kedge/points/material_points.h>
#include <kedge/porous/parameters.h>
#include <kedge/transfer/step_points.h>

#include <unordered_map>

namespace kedge
{
  /** The outer face of a material point, in configuration n. */
  template <int dim>
  struct SurfacePoint
  {
    unsigned int slot;
    unsigned int surface;     ///< number of the surface pressure
    double       offset[dim]; ///< from the point to the face's centre [m]
    double       area[dim];   ///< outward normal times area [m^2]
  };

  /**
   * Pore pressures prescribed on outer faces of bodies: the faces belong to
   * material points and move and deform with them. What stands on such a surface
   * as water also presses on the mixture, traction -p n, (4.198).
   */
  template <int dim>
  class SurfacePressures
  {
  public:
    SurfacePressures(const std::vector<SurfacePressureParameters> &parameters,
                     const std::map<std::string, double>          &constants);

    /**
     * Finds the faces among the points just generated (all of them, on all
     * ranks) and marks their points as loaded.
     *
     * @param body_names one per body
     * @throws UserError for a pressure that finds no exposed face
     */
    void
    attach(std::vector<GeneratedPoint<dim>> &points, const std::vector<std::string> &body_names);

    /** Reads the faces of this rank's points as they are at the start of a step. */
    void
    reinit(const MaterialPoints<dim> &cloud, const StepPoints<dim> &points);

    bool
    empty() const
    {
      return parameters.empty();
    }

    /** Of this rank, by increasing slot. */
    const std::vector<SurfacePoint<dim>> &
    points() const
    {
      return faces;
    }

    /** The prescribed pressure of each surface at time @p t [Pa]. */
    std::vector<double>
    pressures(const double t) const;

    /** Adds the force of the water on the points, one per slot, at time @p t [N]. */
    void
    add_force(const double t, std::vector<dealii::Tensor<1, dim>> &forces) const;

  private:
    struct Face
    {
      unsigned int surface;
      double       area;   ///< undeformed [m^2]
      double       offset; ///< undeformed, from the point to the face [m]
    };

    const std::vector<SurfacePressureParameters>         parameters;
    const std::map<std::string, double>                  constants;
    std::vector<Expression>                              expressions; ///< of t [Pa]
    std::unordered_map<std::uint64_t, std::vector<Face>> faces_of;    ///< by id of the point
    std::vector<SurfacePoint<dim>>                       faces;
  };
} // namespace kedge

#endif
