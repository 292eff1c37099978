#ifndef kedge_porous_mixture_term_h
#define kedge_porous_mixture_term_h

#include <kedge/equations/term.h>
#include <kedge/porous/mixture_force.h>
#include <kedge/porous/nodal_potential.h>
#include <kedge/porous/prepared_blocks.h>
#include <kedge/porous/pressure_mapping.h>
#include <kedge/porous/soil_bodies.h>
#include <kedge/porous/surface_fluxes.h>
#include <kedge/solid/external_loads.h>

namespace kedge
{
  /**
   * The conserving balance of the saturated bodies of a field (theory_mixture.md): dim
   * displacements and a pore pressure per node as in PorousTerm, the fluid's velocity at the
   * material points. It holds internal forces and all of the fluid; the inertia of the skeleton
   * is InertiaTerm's and its weight LoadTerm's, as of a dry body: a point's mass is that of its
   * grains.
   *
   * Its tangent must be the first that is added to that of the field: it goes over from the
   * nodes' potential to their pressure.
   */
  template <int dim>
  class MixtureTerm : public Term<dim>
  {
  public:
    /**
     * @param loads  whose body force acts on the fluid; must last as long as this
     * @param radius how far points couple nodes
     */
    MixtureTerm(const unsigned int           field,
                const Patch<dim>            &patch,
                const SoilBodies            &bodies,
                const ExternalLoads<dim>    &loads,
                const SurfacePressures<dim> &surfaces,
                const SurfaceFluxes<dim>    &fluxes,
                const PorousParameters      &parameters,
                const Scheme                &scheme,
                const int                    radius);

    std::string
    name() const override
    {
      return "saturated soil";
    }

    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    take_over(std::vector<PointRecord<dim>> &points) const override;

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

  private:
    struct Columns
    {
      Ledger::Index stabilisation, stabilisation_stored, stabilisation_torque[3];
      Ledger::Index kinetic_energy, fluid_kinetic_energy, fluid_energy, darcy, surface, filter,
        work;
      Ledger::Index momentum[3], angular_momentum[3], mass;
      Ledger::Index solid_mass, fluid_mass, inflow, min_porosity;
    };
    /** What comes in through prescribed nodes and fluxes, and goes out through surfaces. */
    struct Exchange
    {
      double mass = 0., energy = 0., dissipation = 0.;
    };

    bool
    holds_any_node() const;
    void
    translate(Trial<dim> &trial) const;
    void
    filter_velocities(const Trial<dim> &trial);
    NodalPotential<dim>
    potential(const Trial<dim> &trial) const;
    MixtureField<dim>
    at_trial(const Trial<dim> &trial) const;
    std::vector<double>
    open_outflow(const Trial<dim> &trial) const;
    void
    set_supply(const StepTimes &times);
    void
    add_supply(const Trial<dim> &trial, std::vector<double> &sums) const;
    Exchange
    exchange(const Trial<dim> &trial, const Residual<dim> &residual) const;
    double
    fluid_mass(const Soil &soil, const unsigned int slot) const;
    void
    book_motion(Ledger &ledger) const;

    const unsigned int        field;
    const Patch<dim>         &patch;
    const SoilBodies          bodies;
    const MixtureForce<dim>   force;
    const ExternalLoads<dim> &loads;
    SurfacePressures<dim>     surfaces;
    SurfaceFluxes<dim>        fluxes;
    const PorousParameters    parameters;
    const Scheme              scheme;
    const int                 radius;
    std::vector<double>       modulus_of_body;    ///< P-wave [Pa]
    double                    volume_weight = 0.; ///< of the fluid's balance in Newton's norm

    MixturePoints<dim>              points;
    PressureMapping<dim>            pressure_mapping;
    PreparedBlocks<dim>             prepared;
    std::vector<double>             supply;  ///< by fluxes in this step, partial; empty: none [m^3]
    std::vector<MixtureOutflow>     outflow; ///< through surfaces with a pressure
    std::vector<MixtureUpdate<dim>> updates;
    Columns                         columns{};
  };
} // namespace kedge

#endif
