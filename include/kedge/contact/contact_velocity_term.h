#ifndef kedge_contact_contact_velocity_term_h
#define kedge_contact_contact_velocity_term_h

#include <kedge/contact/nodal_contact_term.h>

namespace kedge
{
  /**
   * Contact at common nodes by their velocities (5.120)-(5.126), without friction: where the
   * bodies approach each other, n.(v - v~) > 0 with v the first body's velocity and v~ the mean of
   * both by their lumped masses,
   *   F_B = -sum_A M~_BA n_A [n_A.(v_A - v~_A)] / dt
   * over the nodes A in contact, with the first body's effective mass M~, consistent or
   * lumped as the mapping's. Print has the other sign. The force stands at nodes that both bodies
   * have, or it would have no counterpart. v is the mean velocity of the step, u/dt.
   */
  template <int dim>
  class ContactVelocityTerm : public NodalContactTerm<dim>
  {
  public:
    /** @param mass of each field, one component; must last as long as this */
    ContactVelocityTerm(const std::string                            &pair,
                        const ContactFields<dim>                     &fields,
                        const std::array<const NodeMatrix<dim> *, 2> &mass,
                        const double                                  alpha)
      : NodalContactTerm<dim>(pair, fields, alpha, false)
      , mass(mass)
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

    const std::array<const NodeMatrix<dim> *, 2> mass;
    std::vector<Coupling>                        couplings;
  };
} // namespace kedge

#endif
