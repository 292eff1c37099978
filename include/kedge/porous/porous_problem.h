#ifndef kedge_porous_porous_problem_h
#define kedge_porous_porous_problem_h

#include <kedge/porous/porous_force.h>
#include <kedge/porous/pressure_blocks.h>
#include <kedge/porous/pressure_mapping.h>
#include <kedge/porous/surface_fluxes.h>
#include <kedge/solid/balance.h>
#include <kedge/solid/external_loads.h>
#include <kedge/time_integration/scheme.h>

namespace kedge
{
  /** What entered the fluid of the bodies through prescribed pressures, at nodes and on surfaces.
   */
  struct FluidInflow
  {
    double mass = 0.; ///< in the balance of the step: dt m' [kg]
    double work = 0.; ///< done on it, free enthalpy times mass [J]
  };

  /**
   * The u-p balance of one step (4.154), (4.155) at the free components of the
   * active nodes, dim displacements and a pore pressure each:
   *   momentum of the mixture,  f'_int(u) - Q p + M(u, p) (a - f) - t = 0,
   *   volume of the fluid,      dt/rho_0 (m' - div(kappa/g w)) + PPP = 0,
   * with all inertia and body force taken point by point (PorousForce), so that
   * M follows the fluid that flows in and out.
   *
   * With ghost stabilisation (4.174), (4.178) also, on the nodes of partly filled cells,
   *   alpha_f K_G u + M_G a   and   dt K_G^(f)/rho_0 p + M_G^(f)/rho_0 (p_{n+1} - p_n).
   *
   * Newton's norms weigh volumes of fluid by M/h (M the skeleton's P-wave
   * modulus, h a cell) and pressures by h/M: a strain counts as much in one
   * equation as in the other, so that neither hides the other.
   */
  template <int dim>
  class PorousProblem : public Balance<dim>
  {
  public:
    PorousProblem(const PorousForce<dim>         &force,
                  const ExternalLoads<dim>       &loads,
                  const SurfacePressures<dim>    &surfaces,
                  const SurfaceFluxes<dim>       &fluxes,
                  const PorousParameters         &pore_fluid,
                  const Scheme                   &scheme,
                  const LinearSolverParameters   &parameters,
                  const std::vector<double>      &p_wave_modulus_of_body,
                  const std::vector<std::string> &body_names);

    /** Reads the pores of the points that reinit() got. */
    void
    read_pores(const MaterialPoints<dim> &cloud);

    void
    start(NodalState &state, const double t_n, const double dt) override;

    NewtonProblem::Evaluation
    evaluate() override;

    void
    apply_correction(const double factor) override;

    /** The pores of all points at the end of the step, after convergence. */
    void
    evaluate_updates(std::vector<PoreUpdate<dim>> &updates) const;

    /** Work done against the ghost terms of the pressure in this step [J] (collective). */
    double
    work_against_ghosts() const;

    /** Through prescribed pressures in this step, after convergence (collective). */
    FluidInflow
    inflow() const;

    /**
     * The forces that accelerate the mixture at rest at time @p t, body force
     * and @p external_force included [N]; owned nodes, collective.
     */
    std::vector<double>
    unbalanced_force(const std::vector<double> &external_force, const double t);

    const PorousForce<dim> &
    force() const
    {
      return porous_force;
    }

  protected:
    void
    assemble_tangent() override;

    void
    pattern_changed() override
    {
      blocks_have_pattern = false;
    }

  private:
    using Balance<dim>::conditions;
    using Balance<dim>::correction;
    using Balance<dim>::dt;
    using Balance<dim>::equations;
    using Balance<dim>::ghosts;
    using Balance<dim>::grid;
    using Balance<dim>::linear_solver;
    using Balance<dim>::nodes;
    using Balance<dim>::points;
    using Balance<dim>::residual;
    using Balance<dim>::state;
    using Balance<dim>::status;
    using Balance<dim>::t_n;
    using Balance<dim>::tangent;
    using Balance<dim>::ties;
    using Balance<dim>::timings_;
    using Balance<dim>::weights;

    void
    add_ghosts(PorousSize &size);
    void
    add_ghosts_to_tangent();
    void
    project_pressure();
    std::vector<double>
    ghost_flow() const;
    void
    set_supply();
    void
    set_prescribed();
    void
    copy_displacement();
    PorousTrial<dim>
    trial() const;
    PorousTrial<dim>
    trial_at(const std::vector<double> &accelerations,
             const double               inertia,
             const double               step,
             const double               t_load,
             const double               t_pressure) const;
    void
    assemble_blocks();

    const PorousForce<dim>       porous_force;
    const ExternalLoads<dim>    &loads;
    const SurfacePressures<dim> &surfaces;
    const SurfaceFluxes<dim>    &fluxes;
    const double                 surface_penalty;
    const Scheme                 scheme;
    const std::vector<double>    modulus_of_body;
    const double                 modulus; ///< the largest

    PorePoints<dim>      pores;
    PressureMapping<dim> pressure_mapping;
    PressureBlocks<dim>  blocks;
    bool                 blocks_have_pattern = false, blocks_have_values = false;
    std::vector<double>  unknowns;   ///< dim + 1 per node
    std::vector<double>  pressure_n; ///< at the nodes, of the points at n; for the ghosts' storage
    std::vector<double>  acceleration;
    std::vector<double>  supply;  ///< by fluxes in this step, as residual; empty: none [m^3]
    std::vector<double>  outflow; ///< through surfaces with a pressure [m^3]
  };
} // namespace kedge

#endif
