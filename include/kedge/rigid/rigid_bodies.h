#ifndef kedge_rigid_rigid_bodies_h
#define kedge_rigid_rigid_bodies_h

#include <kedge/equations/tangent.h>
#include <kedge/geometry/surface_mesh.h>
#include <kedge/rigid/parameters.h>
#include <kedge/rigid/rotation.h>

namespace kedge
{
  /** Where a rigid body is and how it moves. In 2D z is 0, and it turns about z. */
  struct RigidState
  {
    dealii::Point<3> centre; ///< of mass [m]
    Attitude         attitude = {{1., 0., 0., 0.}};
    Vector3          velocity;         ///< of the centre [m/s]
    Vector3          angular_velocity; ///< about the body's own axes [rad/s]
    Vector3          rotation;         ///< since the start, angle times axis [rad]
  };

  /** A rigid body as it is, and as a step tries it. Its own axes are those of space at the start.
   */
  struct RigidBody
  {
    /** The number of a degree of freedom that is no unknown: fixed or prescribed. */
    static constexpr unsigned int held = static_cast<unsigned int>(-1);

    std::string                 name;
    double                      mass = 0.; ///< [kg; kg/m in 2D]
    Matrix33                    inertia;   ///< about the centre, in its own axes [kg m^2; kg m]
    double                      size = 1.; ///< an unknown of rotation is theta times it [m]
    std::array<unsigned int, 6> unknowns;  ///< numbers among those that belong to no node, or held
    RigidState                  state;

    // of the step
    Matrix33 attitude_start, attitude_end; ///< rotation matrices
    Vector3  displacement;                 ///< of the centre over the step [m]
    Vector3  theta;                        ///< the step turns the body by cay(theta)
    Vector3  force, moment; ///< what inertia needs less what acts; 0 where balanced [N; N m]
    Vector3  velocity_end, rate_end; ///< velocities that the step leads to [m/s; rad/s]
  };

  /** A place of a rigid body in a step, seen from the centre [m]. */
  struct RigidPoint
  {
    unsigned int body;
    Vector3      start, end; ///< at the start and the end of the step
    Vector3      lever;      ///< in the configuration of the balance
    Matrix33     slope;      ///< d (end - start) / d theta
  };

  /**
   * The rigid bodies of a scene, to which terms add forces. A step moves a body's centre by u
   * and turns it by cay(theta); what is at r from its centre moves by
   *   D = u + theta x r_mid,   r_mid = (r_n + r_{n+1}) / 2,
   * so that a force f at r_mid, with the moment r_mid x f, does the work f.u + theta.(r_mid x f) =
   * f.D, to round-off for steps of any size (Simo and Wong 1991). Without inertia the balance is
   * that of the step's end, and so is the lever.
   */
  template <int dim>
  class RigidBodies
  {
  public:
    /**
     * @param alpha part of the step at which the balance stands
     * @param communicator of all ranks, which all know all bodies; the first adds what they do
     */
    RigidBodies(const double alpha, const MPI_Comm communicator);

    /** The degrees of freedom of a body in the space of the scene, of x, y, z and about them. */
    static const std::vector<unsigned int> &
    freedoms();

    /** Makes an unknown of each degree of freedom that is not held. */
    void
    declare_unknowns(Unknowns<dim> &unknowns);

    /** Before a step: nothing has moved yet. */
    void
    begin();

    /** Takes the unknowns of a trial state; what is held keeps what hold() has said. */
    void
    read(const UnknownVector &unknowns);

    /** Prescribes a degree of freedom over the step: a displacement [m], or a part of theta. */
    void
    hold(const unsigned int body, const unsigned int freedom, const double value);

    RigidBody &
    operator[](const unsigned int body)
    {
      return bodies[body];
    }

    const RigidBody &
    operator[](const unsigned int body) const
    {
      return bodies[body];
    }

    unsigned int
    size() const
    {
      return static_cast<unsigned int>(bodies.size());
    }

    void
    append(const RigidBody &body, const SurfaceMesh<dim> &surface)
    {
      bodies.push_back(body);
      surfaces.push_back(surface);
    }

    /** A body's surface in its own axes, seen from its centre; empty if it has no shape. */
    const SurfaceMesh<dim> &
    surface(const unsigned int body) const
    {
      return surfaces[body];
    }

    /** What is at @p place, seen from the centre, in the body's own axes. */
    RigidPoint
    point(const unsigned int body, const Vector3 &place) const;

    /** Its displacement over the step. */
    Vector3
    displacement(const RigidPoint &point) const
    {
      return bodies[point.body].displacement + point.end - point.start;
    }

    /** Adds what inertia needs, or with the other sign what acts on a body. */
    void
    add(const unsigned int   body,
        const Vector3       &force,
        const Vector3       &moment,
        std::vector<double> &residual);

    /** Adds a force that acts at a point. */
    void
    add_force(const RigidPoint &point, const Vector3 &force, std::vector<double> &residual)
    {
      add(point.body, -force, -cross_product_3d(point.lever, force), residual);
    }

    /** Forgets the sums of add(). */
    void
    clear_sums();

    /**
     * Calls visit(unknown, motion, work) for the unknowns of a point's body: how the point moves
     * with the unknown, dD/du, and what the unknown's equation gets of a force at the point,
     * f.work.
     */
    template <typename Visit>
    void
    for_unknowns(const RigidPoint &point, const Visit &visit) const
    {
      const RigidBody &body = bodies[point.body];
      for (unsigned int k = 0; k < 6; ++k)
        if (body.unknowns[k] != RigidBody::held)
          {
            Vector3 axis;
            axis[k % 3]                = 1.;
            const UnknownIndex unknown = UnknownIndex::other(body.unknowns[k]);
            if (k < 3)
              visit(unknown, axis, axis);
            else
              visit(unknown,
                    point.slope * axis / body.size,
                    cross_product_3d(axis, point.lever) / body.size);
          }
    }

    /** Adds the slope of the moment of a force that does not change as its lever turns. */
    void
    add_lever_slope(const RigidPoint &point, const Vector3 &force, Tangent<dim> &tangent) const;

    /** Whether this rank adds what all ranks know. */
    bool
    is_first() const
    {
      return first;
    }

    const double alpha;

  private:
    const bool                    first;
    std::vector<RigidBody>        bodies;
    std::vector<SurfaceMesh<dim>> surfaces;
  };

  /**
   * The bodies of a scene: masses and inertias by integration over their surfaces, where they are
   * not given.
   *
   * @param domain where shapes without bounds are looked at
   * @throws UserError for what the scene does not allow
   */
  template <int dim>
  void
  make_rigid_bodies(const std::vector<RigidBodyParameters<dim>> &parameters,
                    const dealii::BoundingBox<dim>              &domain,
                    RigidBodies<dim>                            &bodies);
} // namespace kedge

#endif
