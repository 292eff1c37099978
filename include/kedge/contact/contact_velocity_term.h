#ifndef kedge_contact_contact_velocity_term_h
#define kedge_contact_contact_velocity_term_h

#include <kedge/contact/nodal_contact_term.h>

namespace kedge
{
  /**
   * Contact at common nodes by their velocities (5.120)-(5.126): where the
   * bodies approach each other, n.(v - v~) > 0 with v the first body's velocity and v~ the mean of
   * both by their lumped masses,
   *   F_B = -sum_A M~_BA n_A [n_A.(v_A - v~_A)] / dt
   * over the nodes A in contact, with the first body's effective mass M~, consistent or
   * lumped as the mapping's. Print has the other sign. The force stands at nodes that both bodies
   * have, or it would have no counterpart. v is the mean velocity of the step, u/dt. With friction
   * the same sum of the whole [v_A - v~_A] gives the trial force, whose part along the surface at B
   * is scaled back to mu |F_B| (5.125).
   */
  template <int dim>
  class ContactVelocityTerm : public NodalContactTerm<dim>
  {
  public:
    /** @param mass of each field, one component; must last as long as this */
    ContactVelocityTerm(const std::string                            &pair,
                        const ContactFields<dim>                     &fields,
                        const std::array<const NodeMatrix<dim> *, 2> &mass,
                        const double                                  alpha,
                        const double                                  friction)
      : NodalContactTerm<dim>(pair, fields, alpha, friction > 0.)
      , mass(mass)
      , friction(friction)
    {}

    void
    start(Trial<dim> &trial) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    std::vector<dealii::Tensor<1, dim>>
    forces(const Trial<dim> &trial) const override;

  private:
    /** The mass that couples two of the nodes. */
    struct Coupling
    {
      std::size_t at, from; ///< numbers among nodes()
      double      mass;     ///< M~_BA times the second body's share of the lumped mass at A [kg]
    };

    /** Sums of the forces at a node before friction is bounded [N]. */
    struct TrialForce
    {
      dealii::Tensor<1, dim> normal, whole; ///< by the velocities along n, by all of them
    };

    std::vector<TrialForce>
    trial_forces(const Trial<dim> &trial) const;
    bool
    approaches(const ContactNode<dim> &node, const Trial<dim> &trial) const
    {
      return node.direction[0] * this->relative_displacement(node, trial) > 0.;
    }
    dealii::Tensor<1, dim>
    along_surface(const std::size_t node, const dealii::Tensor<1, dim> &vector) const
    {
      const dealii::Tensor<1, dim> &n = this->nodes()[node].direction[0];
      return vector - (vector * n) * n;
    }
    dealii::Tensor<2, dim>
    slope_of_friction(const std::size_t             node,
                      const TrialForce             &force,
                      const dealii::Tensor<1, dim> &normal_from) const;

    const std::array<const NodeMatrix<dim> *, 2> mass;
    const double                                 friction; ///< mu [-]
    std::vector<Coupling>                        couplings;
  };
} // namespace kedge

#endif
