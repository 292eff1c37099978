#ifndef kedge_rigid_axes_product_h
#define kedge_rigid_axes_product_h

#include <kedge/rigid/rigid_bodies.h>

namespace kedge
{
  /** What stands for space where a body is asked for. */
  constexpr int space_itself = -1;

  /** A place (or a direction) of a body as a step moves it; one of space stays. */
  template <int dim>
  RigidPoint
  point_of(const RigidBodies<dim> &bodies, const int body, const Vector3 &place)
  {
    if (body != space_itself)
      return bodies.point(static_cast<unsigned int>(body), place);
    RigidPoint fixed;
    fixed.body  = RigidBody::held;
    fixed.start = fixed.end = fixed.lever = place;
    return fixed;
  }

  /**
   * The product h = b.d of a direction b of one body and d of another one, or of space. Over a step
   *   h_1 - h_0 = (theta_1 - theta_2) . (b_mid x d_mid):
   * moments +- mu (b_mid x d_mid) on the two bodies do the work mu (h_1 - h_0) to round-off, for
   * rotations of any size, and keep the angular momentum. Without inertia the balance is that of
   * the end, and so are the moments.
   */
  struct AxesProduct
  {
    int     first, second; ///< bodies; the second may be space_itself
    Vector3 b, d;          ///< in the bodies' own axes

    template <int dim>
    double
    at_start(const RigidBodies<dim> &bodies) const
    {
      return point_of(bodies, first, b).start * point_of(bodies, second, d).start;
    }

    template <int dim>
    double
    at_end(const RigidBodies<dim> &bodies) const
    {
      return point_of(bodies, first, b).end * point_of(bodies, second, d).end;
    }

    /** b_mid x d_mid: the moment on the first body for mu = 1. */
    template <int dim>
    Vector3
    moment(const RigidBodies<dim> &bodies) const
    {
      return cross_product_3d(point_of(bodies, first, b).lever, point_of(bodies, second, d).lever);
    }

    /** Adds the moments of @p mu to both bodies [N m]. */
    template <int dim>
    void
    add(const double mu, RigidBodies<dim> &bodies, std::vector<double> &residual) const
    {
      const Vector3 here = mu * moment(bodies);
      bodies.add(static_cast<unsigned int>(first), Vector3(), -here, residual);
      if (second != space_itself)
        bodies.add(static_cast<unsigned int>(second), Vector3(), here, residual);
    }

    /**
     * Calls visit(unknown, dh, work, dm) for the rotations of both bodies: how h at the end and the
     * first body's moment for mu = 1 follow the unknown, and what its equation gets of mu = 1.
     */
    template <int dim, typename Visit>
    void
    for_unknowns(const RigidBodies<dim> &bodies, const Visit &visit) const
    {
      const RigidPoint of_first  = point_of(bodies, first, b),
                       of_second = point_of(bodies, second, d);
      const Vector3 direction    = cross_product_3d(of_first.lever, of_second.lever);
      const auto    of           = [&](const int body, const bool is_first) {
        if (body == space_itself)
          return;
        const RigidBody &on = bodies[static_cast<unsigned int>(body)];
        for (unsigned int k = 3; k < 6; ++k)
          if (on.unknowns[k] != RigidBody::held)
            {
              Vector3 axis;
              axis[k - 3]         = 1. / on.size;
              const Vector3 turns = (is_first ? of_first : of_second).slope * axis;
              const Vector3 lever = bodies.alpha * turns;
              visit(UnknownIndex::other(on.unknowns[k]),
                    is_first ? turns * of_second.end : of_first.end * turns,
                    is_first ? direction * axis : -(direction * axis),
                    is_first ? cross_product_3d(lever, of_second.lever)
                                          : cross_product_3d(of_first.lever, lever));
            }
      };
      of(first, true);
      of(second, false);
    }

    /** Adds the derivative of what add() adds, with d mu / d h at the end. */
    template <int dim>
    void
    add_tangent(const double            mu,
                const double            slope,
                const RigidBodies<dim> &bodies,
                Tangent<dim>           &tangent) const
    {
      for_unknowns(
        bodies,
        [&](const UnknownIndex &column, const double dh, const double, const Vector3 &dm) {
          const auto row = [&](const int body, const double sign) {
            if (body == space_itself)
              return;
            const RigidBody &on = bodies[static_cast<unsigned int>(body)];
            const Vector3    by = sign / on.size * (slope * dh * moment(bodies) + mu * dm);
            for (unsigned int k = 3; k < 6; ++k)
              if (on.unknowns[k] != RigidBody::held)
                tangent.add(UnknownIndex::other(on.unknowns[k]), column, by[k - 3]);
          };
          row(first, -1.);
          row(second, 1.);
        });
    }
  };
} // namespace kedge

#endif
