#ifndef kedge_simulation_step_engine_h
#define kedge_simulation_step_engine_h

#include <kedge/io/history_row.h>
#include <kedge/porous/porous_problem.h>
#include <kedge/scene/scene.h>
#include <kedge/solid/external_loads.h>
#include <kedge/solid/point_update.h>
#include <kedge/solid/solid_problem.h>
#include <kedge/transfer/audit.h>
#include <kedge/transfer/ghost_penalty.h>
#include <kedge/transfer/velocity_mapping.h>

#include <map>
#include <optional>

namespace kedge
{
  /** How an attempt at a step ended. */
  struct StepReport
  {
    bool         accepted = false;
    bool         hopeless = false; ///< a smaller step would not help
    std::string  cause;            ///< of a rejection
    NewtonReport newton;
  };

  /** What the pore fluid did in a step, beside what the points tell. */
  struct PoreBooks
  {
    double inflow            = 0.; ///< of mass, through the surface [kg]
    double darcy_dissipation = 0.; ///< [J]
    double stabilisation     = 0.; ///< work of the pressure's stabilisation [J]
  };

  /**
   * The material points, the grid and the algorithm of one step: (A) activate
   * the grid around the points, (B) map points to grid, (C, D) find the nodal
   * displacements, (E) map back. An attempt changes nothing that is
   * committed; accept_step() commits all at once.
   */
  template <int dim>
  class StepEngine
  {
  public:
    StepEngine(const Scene<dim> &scene, const MPI_Comm communicator);

    /**
     * Makes the bodies' points and the grid around them.
     *
     * @throws UserError for bodies outside the grid, empty or overlapping
     */
    void
    create_points();

    /** Restores the points of a checkpoint; create_points() must have been called. */
    void
    restore_points(const std::vector<PointRecord<dim>> &records,
                   const LatticeWindow<dim>            &covered,
                   const std::vector<unsigned int>     &weights);

    /** The points as generated, with exposed faces, for probes; all ranks have all. */
    const std::vector<PointOrigin<dim>> &
    generated_points() const
    {
      return generated;
    }

    /** Frees what only the start-up needs. */
    void
    forget_generated_points();

    /** The step allowed by the waves, (3.126), (3.127) or (3.195) [s] (collective). */
    double
    cfl_step(const StepSizeKind kind);

    /**
     * Gives the points what only the grid can tell them: the fluctuation of
     * their pore pressure and, for schemes that carry it, the acceleration of
     * equilibrium at the start, M a = f_ext(t) - f_int (collective).
     */
    void
    initialise_points(const double t);

    /** One attempt, from time @p t to @p t + @p dt. */
    StepReport
    try_step(const double t, const double dt);

    /** Commits the last attempt, which must have been accepted. */
    void
    accept_step();

    /** Fills the books of the committed state: energies, momenta, counts. */
    void
    write_books(HistoryRow &row);

    /** Work of external forces and moving supports in the last accepted step [J]. */
    double
    work_of_last_step() const
    {
      return step_work;
    }

    /** Work done against the ghost stabilisation in the last accepted step [J]. */
    double
    ghost_work_of_last_step() const
    {
      return ghost_work;
    }

    /** What fluid brought in through prescribed pressures and lost by flow, in that step. */
    const PoreBooks &
    pore_books_of_last_step() const
    {
      return pore_books;
    }

    /** Forces of the supports in the last accepted step: dim values per node condition [N]. */
    const std::vector<double> &
    reactions_of_last_step() const
    {
      return reactions;
    }

    const MaterialPoints<dim> &
    points() const
    {
      return cloud;
    }

    const BackgroundGrid<dim> &
    grid() const
    {
      return background;
    }

    /** What grid().cover() was last called with. */
    const LatticeWindow<dim> &
    covered_cells() const
    {
      return covered;
    }

    const std::vector<unsigned int> &
    covered_weights() const
    {
      return weights;
    }

    /** Active nodes and the nodal values of the last attempt, for output. */
    const ActiveNodes<dim> &
    active_nodes() const
    {
      return nodes;
    }

    const NodalState &
    nodal_state() const
    {
      return nodal;
    }

    /** Goes on from other points, each rank's share of them (collective). */
    void
    replace_points(const std::vector<PointRecord<dim>> &records);

    /** Points, nodes, unknowns of the present configuration (collective). */
    void
    activate();

    /** Whether the bodies are saturated with a pore fluid. */
    bool
    has_pores() const
    {
      return scene.pore_fluid.has_value();
    }

    /** Whether something of the step's balance is there for stability alone. */
    bool
    has_stabilisation() const
    {
      return has_ghosts() || (has_pores() && scene.pore_fluid->stabilisation > 0.);
    }

    /** Whether a material of the scene can yield. */
    bool
    has_plasticity() const
    {
      return std::any_of(material_of_body.begin(), material_of_body.end(), yields);
    }

    std::uint64_t
    n_equations() const
    {
      return balance->n_equations();
    }

    /** Worst condition estimate of a tangent so far; 0 if unknown. */
    double
    largest_condition() const
    {
      return balance->largest_condition();
    }

    std::string
    linear_method() const
    {
      return balance->linear_method();
    }

    /** Time spent so far by this process, by phase. */
    std::map<std::string, PhaseTime>
    phase_times() const;

    /** Whether the mappings are audited: asked for, and there are velocities to map. */
    bool
    audits_transfer() const
    {
      return scene.transfer.audit && scheme.dynamic;
    }

    /** What the mappings of the last accepted step lost, if Mapping/Audit asks for it. */
    const std::optional<TransferAudit<dim>> &
    transfer_audit() const
    {
      return audit;
    }

  private:
    std::unique_ptr<Balance<dim>>
    make_balance();
    std::vector<Soil>
    soils_of_bodies() const;
    void
    saturate(std::vector<GeneratedPoint<dim>> &points) const;
    void
    initialise_fluctuations();
    void
    initialise_accelerations(const double t);
    void
    add_pore_work();
    void
    write_pore_books(HistoryRow &row) const;
    std::vector<PointRecord<dim>>
    generate_records();
    void
    check_overlaps() const;
    void
    cover_points(const std::vector<PointRecord<dim>> &records);
    void
    find_nodes();
    void
    map_velocities_back();
    void
    follow_points();
    bool
    has_ghosts() const
    {
      return scene.stabilisation.method == StabilisationKind::ghost;
    }
    void
    assemble_ghosts();
    double
    work_against_ghosts() const;
    const NodeMatrix<dim> &
    mapping_mass() const
    {
      return ghosts_in_mapping ? ghosted_mass : mass;
    }
    LinearStatus
    particle_to_grid(const double t, const double dt);
    void
    apply_external_forces(const double t);
    std::string
    check_points();
    void
    update_velocities(const unsigned int slot, PointState<dim> &state) const;

    const Scene<dim>         scene;
    const MPI_Comm           communicator;
    const Scheme             scheme;
    const int                stencil_radius;
    const int                stiffness_radius;
    const std::vector<bool>  shared_volume; ///< of the points in a cell, one per body
    std::vector<BasisKind>   basis_of_body;
    std::vector<Material>    material_of_body;
    std::vector<double>      modulus_of_body; ///< Young's [Pa]
    const MemoryColumns      columns_of_body; ///< of the laws' histories, in the points' memory
    std::vector<std::string> body_names;

    BackgroundGrid<dim>   background;
    MaterialPoints<dim>   cloud;
    StepPoints<dim>       step_points;
    ActiveNodes<dim>      nodes;
    NodeConditions<dim>   conditions;
    NodeTies<dim>         ties;
    ExternalLoads<dim>    loads;
    SurfacePressures<dim> surfaces;
    SurfaceFluxes<dim>    fluxes;
    NodeMatrix<dim>       mass;
    GhostPenalty<dim>     ghosts;
    GhostMatrices<dim>    ghost_terms;
    NodeMatrix<dim>       ghosted_mass; ///< mass and ghost mass
    bool                  ghosts_in_mapping = false;
    VelocityMapping<dim>  mapping;
    NodalState            nodal;

    PorousProblem<dim> *porous = nullptr; ///< the balance, if it is that of saturated soil
    std::unique_ptr<Balance<dim>> balance;

    std::vector<PointOrigin<dim>>       generated;
    LatticeWindow<dim>                  covered;
    std::vector<unsigned int>           weights;
    bool                                activated = false, new_pattern = false;
    double                              step_t     = 0.;
    double                              step_dt    = 0.;
    double                              step_work  = 0.;
    double                              ghost_work = 0.;
    std::vector<double>                 reactions;
    std::vector<dealii::Tensor<1, dim>> point_forces;
    std::vector<dealii::Tensor<1, dim>> point_displacements;
    std::vector<PointUpdate<dim>>       updates;
    std::vector<PoreUpdate<dim>>        pore_updates;
    PoreBooks                           pore_books;
    std::vector<dealii::Tensor<1, dim>> velocity_changes, accelerations;
    std::map<std::string, PhaseTime>    phases;
    std::optional<TransferAudit<dim>>   audit;
  };
} // namespace kedge

#endif
