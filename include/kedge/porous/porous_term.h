#ifndef kedge_porous_porous_term_h
#define kedge_porous_porous_term_h

#include <kedge/equations/term.h>
#include <kedge/porous/porous_force.h>
#include <kedge/porous/prepared_blocks.h>
#include <kedge/porous/pressure_mapping.h>
#include <kedge/porous/soil_bodies.h>
#include <kedge/porous/surface_fluxes.h>
#include <kedge/solid/external_loads.h>

namespace kedge
{
  /**
   * The u-p balance of the saturated bodies of a field (4.154), (4.155), dim displacements and a
   * pore pressure per node:
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
  class PorousTerm : public Term<dim>
  {
  public:
    /**
     * @param loads  whose body force acts on the mixture; must last as long as this
     * @param radius how far points couple nodes
     */
    PorousTerm(const unsigned int           field,
               const Patch<dim>            &patch,
               const SoilBodies            &bodies,
               const ExternalLoads<dim>    &loads,
               const SurfacePressures<dim> &surfaces,
               const SurfaceFluxes<dim>    &fluxes,
               const PorousParameters      &parameters,
               const Scheme                &scheme,
               const PoreScheme            &pore_scheme,
               const int                    radius);

    std::string
    name() const override
    {
      return "saturated soil";
    }

    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    void
    initialise(MaterialPoints<dim> &cloud) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_residual_at_rest(const double t, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    void
    prepare_solver(const Trial<dim>   &trial,
                   const Tangent<dim> &tangent,
                   LinearSolver       &solver) override;

    bool
    refresh(const Trial<dim> &trial) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

    /** The water that presses on the bodies' surfaces. */
    const SurfaceLoads<dim> &
    water_pressures() const
    {
      return surfaces;
    }

    /** The points' pores in the present configuration. */
    const PorePoints<dim> &
    pore_points() const
    {
      return pores;
    }

    const PorousForce<dim> &
    force() const
    {
      return porous_force;
    }

  private:
    /** Fluid that came in through prescribed pressures and fluxes in a step. */
    struct Inflow
    {
      double mass = 0.; ///< in the balance of the step: dt m' [kg]
      double work = 0.; ///< done on it, free enthalpy times mass [J]
    };
    /** What the solver is given of the tangent. */
    struct SolverBlocks
    {
      PressureBlocks<dim> blocks;
      bool                have_pattern = false, have_values = false;
    };
    struct Columns
    {
      Ledger::Index stabilisation, fluid_energy, darcy, work, neglected;
      Ledger::Index solid_mass, fluid_mass, inflow, min_porosity;
    };

    void
    set_supply(const StepTimes &times);
    PorousTrial<dim>
    at_trial(const Trial<dim> &trial) const;
    PorousTrial<dim>
    at(const std::vector<double> &unknowns,
       const std::vector<double> &accelerations,
       const double               inertia,
       const double               step,
       const double               t_load,
       const double               t_pressure) const;
    std::vector<double>
    open_outflow(const Trial<dim> &trial) const;
    Inflow
    inflow(const Trial<dim> &trial, const Residual<dim> &residual) const;
    double
    pressure_time(const StepTimes &times) const;

    const unsigned int        field;
    const Patch<dim>         &patch;
    const SoilBodies          bodies;
    const PorousForce<dim>    porous_force;
    const ExternalLoads<dim> &loads;
    SurfacePressures<dim>     surfaces;
    SurfaceFluxes<dim>        fluxes;
    const PorousParameters    parameters;
    const Scheme              scheme;
    const int                 radius;
    std::vector<double>       modulus_of_body;    ///< P-wave [Pa]
    double                    volume_weight = 0.; ///< of the fluid's balance in Newton's norm

    PorePoints<dim>              pores;
    PressureMapping<dim>         pressure_mapping;
    PreparedBlocks<dim>          prepared;
    std::vector<double>          supply_share; ///< by fluxes in this step; empty: none [m^3]
    std::vector<double>          supply;       ///< the same, complete at the owned nodes
    std::vector<double>          outflow;      ///< through surfaces with a pressure [m^3]
    std::vector<PoreUpdate<dim>> updates;
    Columns                      columns{};
  };
} // namespace kedge

#endif
