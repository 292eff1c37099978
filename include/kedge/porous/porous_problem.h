#ifndef kedge_porous_porous_problem_h
#define kedge_porous_porous_problem_h

#include <kedge/porous/porous_force.h>
#include <kedge/porous/pressure_blocks.h>
#include <kedge/porous/pressure_mapping.h>
#include <kedge/porous/surface_fluxes.h>
#include <kedge/solid/balance.h>
#include <kedge/solid/external_loads.h>
#include <kedge/time_integration/scheme.h>
#include <kedge/transfer/equation_system.h>

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

    /** Mass and ghost stiffness are not used: the points carry the mixture's mass. */
    void
    reinit(const BackgroundGrid<dim> &grid,
           const ActiveNodes<dim>    &nodes,
           const NodeConditions<dim> &conditions,
           const NodeTies<dim>       &ties,
           const StepPoints<dim>     &points,
           const NodeMatrix<dim>     &mass,
           const NodeMatrix<dim>     *ghost_stiffness,
           const int                  stiffness_radius,
           const bool                 new_pattern) override;

    /** Reads the pores of the points that reinit() got. */
    void
    read_pores(const MaterialPoints<dim> &cloud);

    void
    start(NodalState &state, const double t_n, const double dt) override;

    NewtonProblem::Evaluation
    evaluate() override;

    void
    set_linear_tolerance(const double tolerance) override
    {
      linear_tolerance = tolerance;
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override;

    void
    apply_correction(const double factor) override;

    double
    reaction_work() const override;

    std::vector<double>
    reactions() const override;

    std::string
    diagnosis() const override;

    double
    largest_condition() const override
    {
      return largest_condition_;
    }

    std::uint64_t
    n_equations() const override
    {
      return equations.system().n_global;
    }

    std::string
    linear_method() const override
    {
      return linear_solver.method();
    }

    const SolidTimings &
    timings() const override
    {
      return timings_;
    }

    /** The pores of all points at the end of the step, after convergence. */
    void
    evaluate_updates(std::vector<PoreUpdate<dim>> &updates) const;

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

  private:
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
    assemble_tangent();
    void
    assemble_blocks();
    double
    weight(const unsigned int nodal_index) const;
    std::string
    describe_point(const unsigned int slot) const;
    std::string
    describe_equation(const std::int64_t equation) const;

    const PorousForce<dim>         porous_force;
    const ExternalLoads<dim>      &loads;
    const SurfacePressures<dim>   &surfaces;
    const SurfaceFluxes<dim>      &fluxes;
    const double                   surface_penalty;
    const Scheme                   scheme;
    const std::vector<double>      modulus_of_body;
    const double                   modulus; ///< the largest
    const std::vector<std::string> body_names;
    LinearSolver                   linear_solver;

    const BackgroundGrid<dim> *grid       = nullptr;
    const ActiveNodes<dim>    *nodes      = nullptr;
    const NodeConditions<dim> *conditions = nullptr;
    const NodeTies<dim>       *ties       = nullptr;
    const StepPoints<dim>     *points     = nullptr;
    NodalState                *state      = nullptr;
    PorePoints<dim>            pores;
    PressureMapping<dim>       pressure_mapping;
    double                     t_n       = 0.;
    double                     dt        = 0.;
    double                     cell_size = 0.;

    NodeMatrix<dim>          tangent;
    EquationSystem<dim>      equations;
    PressureBlocks<dim>      blocks;
    bool                     blocks_have_pattern = false, blocks_have_values = false;
    double                   linear_tolerance = 0.;
    std::vector<NodalStatus> status;
    std::vector<double>      unknowns, residual, correction; ///< dim + 1 per node
    std::vector<double>      acceleration;
    std::vector<double>      supply;  ///< by fluxes in this step, as residual; empty: none [m^3]
    std::vector<double>      outflow; ///< through surfaces with a pressure [m^3]
    SolidTimings             timings_;
    std::string              warning_; ///< of a singular tangent in this step
    double                   condition          = 0.;
    double                   largest_condition_ = 0.;
    std::int64_t             weakest_equation   = -1;
  };
} // namespace kedge

#endif
