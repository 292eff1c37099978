#ifndef kedge_rigid_joint_term_h
#define kedge_rigid_joint_term_h

#include <kedge/rigid/axes_product.h>
#include <kedge/rigid/line_law.h>
#include <kedge/rigid/rigid_term.h>

namespace kedge
{
  /**
   * Joints between rigid bodies, or of a body with a place in space. What a joint holds at zero is
   * bilinear in the places or axes of its two bodies, so that its increment over a step is the
   * product of what moves with its discrete gradient: with multipliers lambda and mu,
   *   x_1 + r_1 - x_2 - r_2 = 0,  f = lambda at both mid-levers,     f.(D_1 - D_2) = 0,
   *   b_1 . d_2 = 0,              m = mu (b_mid x d_mid),  m.(theta_1 - theta_2) = 0,
   * at the end of each step, without work and with all momenta kept, for steps of any size
   * (AxesProduct). A hinge has two such products in space, none in the plane; a fixed joint three
   * and one. Stops of a hinge are springs of the same products; friction is a moment about the
   * axis that grows up to its limit.
   */
  template <int dim>
  class JointTerm : public Term<dim>
  {
  public:
    /**
     * What gives in a joint, as a part of its multiplier's length: of bodies that are held on both
     * sides nothing else determines the multiplier.
     */
    static constexpr double compliance = 1e-13;

    JointTerm(const std::vector<JointParameters> &parameters,
              RigidBodies<dim>                   &bodies,
              const Scheme                       &scheme);

    std::string
    name() const override
    {
      return "joints";
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

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

  private:
    /** A stop: the spring of a product that has become positive. */
    struct Stop
    {
      AxesProduct product; ///< - sin of the angle that is left
      Vector3     towards; ///< of the other body: with it the product is cos of that angle
    };

    struct Joint
    {
      std::string              name;
      std::array<Vector3, 2>   places; ///< on the bodies, in their own axes; of space: in space
      std::array<int, 2>       bodies; ///< the second one may be space_itself
      std::vector<AxesProduct> held;
      std::vector<Stop>        stops;
      Vector3                  axis, reference, across; ///< an orthonormal triad
      bool                     is_hinge;
      double                   stop_stiffness = 0.; ///< [N m]
      double                   friction       = 0.; ///< largest moment [N m]
      double                   stiffness      = 1.; ///< that scales the equations [N/m]
      double                   size           = 1.; ///< that makes lengths of products [m]
      unsigned int             unknown        = 0;  ///< first of dim, those of products, friction
    };

    struct Columns
    {
      std::array<Ledger::Index, 3> force{}, moment{};
      Ledger::Index                gap = 0, angle = 0;
    };

    /** Calls visit(body, sign) for its bodies: 1 of the first, -1 of the second. */
    template <typename Visit>
    void
    for_bodies(const Joint &joint, const Visit &visit) const
    {
      for (unsigned int side = 0; side < 2; ++side)
        if (joint.bodies[side] != space_itself)
          visit(static_cast<unsigned int>(joint.bodies[side]), side == 0 ? 1. : -1.);
    }

    /** Calls visit(point, sign) for its places on its bodies. */
    template <typename Visit>
    void
    for_sides(const Joint &joint, const Visit &visit) const
    {
      for_bodies(joint, [&](const unsigned int body, const double sign) {
        visit(bodies.point(body, joint.places[sign > 0. ? 0 : 1]), sign);
      });
    }

    Joint
    make_joint(const JointParameters &given) const;
    void
    add_stops(const JointParameters &given, Joint &joint) const;
    /** How far its places are apart at the end of the step [m]. */
    Vector3
    gap(const Joint &joint) const;
    /** By how much the first body is turned against the other about the axis, at the end [rad]. */
    double
    angle(const Joint &joint) const;
    LineTension
    stop_moment(const Joint &joint, const Stop &stop) const;
    Vector3
    relative_theta(const Joint &joint) const;
    /** (theta_1 - theta_2).a_mid [rad]. */
    double
    turn(const Joint &joint) const;
    /** The moment of friction over stiffness and size that would stick [m], and its limit. */
    std::pair<double, double>
    friction_trial(const Joint &joint, const UnknownVector &unknowns) const;
    Vector3
    moment(const Joint &joint, const UnknownVector &unknowns) const;
    void
    add_place(const Joint &joint, const UnknownVector &unknowns, Tangent<dim> &tangent) const;
    void
    add_products(const Joint &joint, const UnknownVector &unknowns, Tangent<dim> &tangent) const;
    void
    add_friction(const Joint &joint, const UnknownVector &unknowns, Tangent<dim> &tangent) const;

    RigidBodies<dim>    &bodies;
    const Scheme         scheme;
    std::vector<Joint>   joints;
    std::vector<Columns> columns;
    Ledger::Index        energy = 0, dissipation = 0;
  };
} // namespace kedge

#endif
