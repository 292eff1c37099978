#ifndef kedge_porous_mixture_force_h
#define kedge_porous_mixture_force_h

#include <kedge/equations/node_matrix.h>
#include <kedge/materials/material.h>
#include <kedge/porous/mixture_points.h>
#include <kedge/porous/pore_points.h>
#include <kedge/porous/porous_force.h>

namespace kedge
{
  /** The trial state of the grid in a step of the conserving balance, ghosts up to date. */
  template <int dim>
  struct MixtureField
  {
    /** dim + 1 per local node: the displacement over the step [m], then the potential [Pa]. */
    std::vector<double>                   values;
    const std::vector<double>            &velocity_n; ///< v_n, dim per local node [m/s]
    double                                dt;         ///< [s]
    double                                theta;      ///< of the stabilisation
    double                                cell_size;  ///< [m]
    std::array<double, std::size_t(dim)>  body_force; ///< acceleration f [m/s^2]
    const std::vector<SurfacePoint<dim>> &surface;
    std::vector<double>                   surface_potentials; ///< of what is prescribed there [Pa]
    std::vector<SurfaceFlow>              surface_flows;      ///< one per place
    double                                surface_penalty;    ///< see SurfacePressures [-]
  };

  /** What flows out at a place of a surface in a step. */
  struct MixtureOutflow
  {
    double mass        = 0.; ///< [kg]
    double dissipation = 0.; ///< by the difference to the prescribed potential [J]
    double energy      = 0.; ///< that it takes along [J]
  };

  /**
   * The points' sums in the residuals of the conserving balance, in the form of MixtureResponse,
   * and in their Jacobian by displacement and potential. Sums are partial, over the points of
   * this rank.
   */
  template <int dim>
  class MixtureForce
  {
  public:
    MixtureForce(const std::vector<Material> &material_of_body,
                 const std::vector<Soil>     &soil_of_body)
      : material_of_body(material_of_body)
      , soil_of_body(soil_of_body)
    {}

    /**
     * Adds the residuals, dim + 1 values per local node: momentum but for the skeleton's inertia
     * [N], volume of fluid [m^3]. Stops at the first point that fails.
     *
     * @param outflow at each place of the field's surface
     * @param size grows by the terms' squares
     */
    PointStatus
    add_residual(const Patch<dim>            &patch,
                 const MixturePoints<dim>    &points,
                 const MixtureField<dim>     &field,
                 std::vector<double>         &residual,
                 std::vector<MixtureOutflow> &outflow,
                 PorousSize                  &size) const;

    /** Adds d residual / d (displacement, potential) to a matrix with dim + 1 components. */
    void
    add_tangent(const Patch<dim>         &patch,
                const MixturePoints<dim> &points,
                const MixtureField<dim>  &field,
                NodeMatrix<dim>          &tangent) const;

    /** The fluid of all points at the end of a step that add_residual() could follow. */
    void
    evaluate_updates(const Patch<dim>                &patch,
                     const MixturePoints<dim>        &points,
                     const MixtureField<dim>         &field,
                     std::vector<MixtureUpdate<dim>> &updates) const;

    const std::vector<Soil> &
    soils() const
    {
      return soil_of_body;
    }

  private:
    /** Calls run(MixtureBatch) for all batches until it returns false. */
    template <class Run>
    void
    for_batches(const Patch<dim>         &patch,
                const MixturePoints<dim> &points,
                const MixtureField<dim>  &field,
                const Run                &run) const;

    std::vector<Material> material_of_body;
    std::vector<Soil>     soil_of_body;
  };
} // namespace kedge

#endif
