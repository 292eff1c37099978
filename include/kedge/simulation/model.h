#ifndef kedge_simulation_model_h
#define kedge_simulation_model_h

#include <kedge/porous/soil_bodies.h>
#include <kedge/scene/scene.h>
#include <kedge/simulation/bodies.h>
#include <kedge/simulation/field.h>
#include <kedge/simulation/points_on_grid.h>
#include <kedge/solid/ghost_term.h>
#include <kedge/solid/load_term.h>
#include <kedge/transfer/motion_term.h>

namespace kedge
{
  struct NodalLaw;
  template <int dim>
  struct ContactFields;
  template <int dim>
  class RigidBodies;

  /**
   * What a scene is made of: the points on their grid, the fields, the terms of the
   * balance, its unknowns and its books. It owns all of these and does nothing with
   * them; Step and Run do. Fields and terms are chosen once, here, from the scene.
   */
  template <int dim>
  class Model
  {
  public:
    /**
     * @param program when loads are evaluated, other than in a run
     *
     * @throws UserError for what the scene does not allow
     */
    Model(const Scene<dim> &scene, const MPI_Comm communicator, const LoadProgram &program = {});

    /**
     * Makes the bodies' points and the grid around them (collective).
     *
     * @throws UserError for bodies outside the grid, empty or overlapping
     */
    void
    create_points();

    /** The points as generated, with exposed faces, for probes; all ranks have all. */
    const std::vector<PointOrigin<dim>> &
    generated_points() const
    {
      return generated;
    }

    /** What create_points() has to say of initial stresses beyond the yield surface. */
    const std::vector<std::string> &
    initial_stress_notes() const
    {
      return stress_notes;
    }

    /** The rigid bodies; nothing if there are none. */
    const RigidBodies<dim> *
    rigid() const
    {
      return rigid_bodies;
    }

    /** Frees what only the start-up needs. */
    void
    forget_generated_points();

    /** Patches of all fields, in order. */
    std::vector<const Patch<dim> *>
    patches() const;

    const Scene<dim>                         scene;
    const MPI_Comm                           communicator;
    const Scheme                             scheme;
    const Bodies                             bodies;
    PointsOnGrid<dim>                        points;
    std::vector<std::unique_ptr<Field<dim>>> fields;
    Terms<dim>                               terms;
    Unknowns<dim>                            unknowns;
    Ledger                                   ledger;
    /** Part of the step at whose end prescribed pressures are taken. */
    double pressure_fraction = 1.;

  private:
    void
    make_fields(const LoadProgram &program);
    const MotionTerm<dim> &
    choose_terms(const unsigned int field, const LoadProgram &program);
    LoadTerm<dim> &
    choose_loads(const unsigned int field, MotionTerm<dim> &motion, const LoadProgram &program);
    void
    choose_body_conditions(const unsigned int field, const LoadProgram &program);
    void
    choose_porous_terms(const unsigned int    field,
                        LoadTerm<dim>        &loads,
                        const GhostTerm<dim> *ghosts,
                        const LoadProgram    &program);
    void
    choose_mixture_term(const unsigned int field, LoadTerm<dim> &loads, const LoadProgram &program);
    SoilBodies
    soil_bodies() const;
    /** The node conditions that hold for a field. */
    std::vector<NodeConditionParameters<dim>>
    conditions_of(const unsigned int field) const;
    void
    choose_surface_terms();
    void
    choose_load_control();
    void
    choose_rigid_terms(const LoadProgram &program);
    void
    choose_contact_terms(const LoadProgram &program);
    void
    choose_nodal_contact_term(const ContactParameters &contact);
    void
    add_nodal_contact(const ContactParameters  &contact,
                      const NodalLaw           &law,
                      const ContactFields<dim> &pair);
    template <class T>
    T &
    add_term(std::unique_ptr<T> term);
    void
    declare();
    double
    smallest_cell_size() const;
    void
    check_overlaps() const;

    const GridLevels<dim>                 levels_at_start; ///< before there are points
    std::vector<PointOrigin<dim>>         generated;
    std::vector<std::string>              stress_notes;
    std::vector<const SurfaceTerm<dim> *> surface_terms; ///< come first
    std::vector<ControlledLoads<dim> *>   load_terms;    ///< of all fields
    RigidBodies<dim> *rigid_bodies  = nullptr;           ///< of their term; none if there are none
    std::size_t       n_field_terms = 0;                 ///< of single fields; others come behind
  };
} // namespace kedge

#endif
