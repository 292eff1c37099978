#ifndef kedge_porous_porous_force_h
#define kedge_porous_porous_force_h

#include <kedge/materials/material.h>
#include <kedge/porous/pore_points.h>
#include <kedge/porous/pore_update.h>
#include <kedge/porous/surface_pressures.h>
#include <kedge/porous/surface_valves.h>
#include <kedge/solid/internal_force.h>

namespace kedge
{
  /**
   * The trial state of the grid in a step of the u-p balance, ghosts up to
   * date. Unknowns stand node by node: the displacement over the step, dim
   * components [m], then the pore pressure at balance [Pa].
   */
  template <int dim>
  struct PorousTrial
  {
    const std::vector<double>            &unknowns;     ///< dim + 1 per local node
    const std::vector<double>            &acceleration; ///< dim per local node; empty: none
    double                                inertia;      ///< d acceleration/d u [1/s^2]
    double                                dt;           ///< [s]
    double                                cell_size;    ///< [m], for PorousSize
    std::array<double, std::size_t(dim)>  body_force;   ///< acceleration f [m/s^2]
    const std::vector<SurfacePoint<dim>> &surface;
    std::vector<double>                   surface_pressures; ///< prescribed, one per place [Pa]
    std::vector<SurfaceFlow>              surface_flows;     ///< one per place
    double                                surface_penalty;   ///< see SurfacePressures [-]
  };

  /** Size of the terms that cancel in the residuals: sums of squares over the rank's cells. */
  struct PorousSize
  {
    double momentum = 0.; ///< [N^2]
    double fluid    = 0.; ///< [m^6]
  };

  /**
   * The points' sums in the residuals of the u-p balance (4.154), (4.155), in
   * the form of PoreResponse, and in their Jacobian (B.44)-(B.62). The
   * gradients of the basis are those of configuration n, pulled back from the
   * configuration of balance. Sums are partial, over the points of this rank.
   */
  template <int dim>
  class PorousForce
  {
  public:
    /**
     * @param alpha  fraction of the displacement at which balance is stated
     * @param scheme of the pores
     */
    PorousForce(const std::vector<Material> &material_of_body,
                const std::vector<Soil>     &soil_of_body,
                const double                 alpha,
                const PoreScheme            &scheme);

    /**
     * Adds the residuals, dim + 1 values per local node: momentum [N], volume
     * of fluid [m^3]. Stops at the first point that fails.
     *
     * @param size grows by the terms' squares
     * @param outflow the volume that leaves at each place of the trial's surface [m^3]
     */
    PointStatus
    add_residual(const Patch<dim>       &patch,
                 const PorePoints<dim>  &pores,
                 const PorousTrial<dim> &trial,
                 std::vector<double>    &residual,
                 std::vector<double>    &outflow,
                 PorousSize             &size) const;

    /** Adds d residual / d unknowns to @p tangent, a matrix with dim + 1 components. */
    void
    add_tangent(const Patch<dim>       &patch,
                const PorePoints<dim>  &pores,
                const PorousTrial<dim> &trial,
                NodeMatrix<dim>        &tangent) const;

    /** The pores of all points at the end of a step that add_residual() could follow. */
    void
    evaluate_updates(const Patch<dim>             &patch,
                     const PorePoints<dim>        &pores,
                     const PorousTrial<dim>       &trial,
                     std::vector<PoreUpdate<dim>> &updates) const;

    /** (N - N^0) p of all points for a nodal pressure, one value per local node [Pa]. */
    static std::vector<double>
    fluctuations(const Patch<dim> &patch, const std::vector<double> &nodal_pressure);

    const std::vector<Soil> &
    soils() const
    {
      return soil_of_body;
    }

    const PoreScheme &
    scheme() const
    {
      return pore_scheme;
    }

  private:
    /** Calls run(PorousBatch) for all batches until it returns false. */
    template <class Run>
    void
    for_batches(const Patch<dim>       &patch,
                const PorePoints<dim>  &pores,
                const PorousTrial<dim> &trial,
                const Run              &run) const;

    std::vector<Material> material_of_body;
    std::vector<Soil>     soil_of_body;
    double                alpha;
    PoreScheme            pore_scheme;
  };
} // namespace kedge

#endif
