#ifndef kedge_rigid_rigid_term_h
#define kedge_rigid_rigid_term_h

#include <kedge/base/load_program.h>
#include <kedge/equations/term.h>
#include <kedge/rigid/rigid_bodies.h>

namespace kedge
{
  /**
   * Inertia of the rigid bodies of a scene, their weight, and what moves or pushes their degrees of
   * freedom. With the angular momentum pi in space, the angular velocity W in the body's axes and
   * Theta = A_n^T theta, the mid-point rule of Simo and Wong (1991) is
   *   m (v_{n+1} - v_n) / dt = f,          u = dt (v_n + v_{n+1}) / 2,
   *   (pi_{n+1} - pi_n) / dt = moment,  Theta = dt (W_n + W_{n+1}) / 2,   pi = A J W:
   * without a moment pi stays, and the kinetic energy changes by what forces do, for steps of any
   * size. This term comes before all others that act on the bodies: it takes the trial state and
   * begins their sums.
   */
  template <int dim>
  class RigidTerm : public Term<dim>
  {
  public:
    /**
     * @param body_force acceleration of all bodies that do not say otherwise, expressions of t
     * @param program    when expressions are evaluated; a stage before the run holds the bodies
     */
    RigidTerm(const std::vector<RigidBodyParameters<dim>> &parameters,
              const dealii::BoundingBox<dim>              &domain,
              const std::array<std::string, dim>          &body_force,
              const std::map<std::string, double>         &constants,
              const LoadProgram                           &program,
              const Scheme                                &scheme,
              const double                                 start_time,
              const MPI_Comm                               communicator);

    std::string
    name() const override
    {
      return "rigid bodies";
    }

    RigidBodies<dim> &
    bodies()
    {
      return rigid;
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

    void
    declare_books(Ledger &ledger) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

    void
    save(SavedState &state) const override;

    void
    restore(const SavedState &state) override;

  private:
    /** What acts along a degree of freedom, or moves it. */
    struct Drive
    {
      ConditionKind kind = ConditionKind::free;
      Expression    motion, force;
      bool          has_force = false;
    };

    /** Columns of one body. */
    struct Columns
    {
      std::array<Ledger::Index, 3> position, rotation, velocity, body_rate;
      std::array<Ledger::Index, 6> reaction;
    };

    Vector3
    load(const unsigned int body, const unsigned int first_freedom) const;
    Vector3
    end_velocity(const RigidBody &body) const;
    Vector3
    end_rate(const RigidBody &body) const;
    void
    predict(RigidBody &body) const;
    void
    take_off_residual(RigidBody &body) const;
    void
    book_momenta(Ledger &ledger) const;

    RigidBodies<dim>                  rigid;
    const LoadProgram                 program;
    const Scheme                      scheme;
    std::vector<std::array<Drive, 6>> drives; ///< one per body
    std::vector<bool>                 has_weight;
    std::array<Expression, dim>       acceleration;
    StepTimes                         times; ///< of the attempt
    std::vector<Columns>              columns;
    Ledger::Index                     work = 0, kinetic_energy = 0;
    std::array<Ledger::Index, dim>    linear_momentum{};
    std::array<Ledger::Index, 3>      angular_momentum{};
  };
} // namespace kedge

#endif
