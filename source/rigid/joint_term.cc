#include <kedge/rigid/joint_term.h>
#include <kedge/rigid/rigid_columns.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    Vector3
    unit(const unsigned int d)
    {
      Vector3 result;
      result[d] = 1.;
      return result;
    }

    /** A direction across another one. */
    Vector3
    across_of(const Vector3 &axis)
    {
      unsigned int smallest = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(axis[d]) < std::abs(axis[smallest]))
          smallest = d;
      const Vector3 result = cross_product_3d(axis, unit(smallest));
      return result / result.norm();
    }
  } // namespace



  template <int dim>
  JointTerm<dim>::JointTerm(const std::vector<JointParameters> &parameters,
                            RigidBodies<dim>                   &bodies,
                            const Scheme                       &scheme)
    : bodies(bodies)
    , scheme(scheme)
  {
    for (const JointParameters &given : parameters)
      joints.push_back(make_joint(given));
  }



  template <int dim>
  typename JointTerm<dim>::Joint
  JointTerm<dim>::make_joint(const JointParameters &given) const
  {
    Joint joint;
    joint.name   = given.name;
    joint.bodies = {
      {static_cast<int>(given.body), given.other ? static_cast<int>(*given.other) : space_itself}};
    joint.is_hinge       = given.turns;
    joint.stop_stiffness = given.stop_stiffness;
    joint.friction       = given.friction;
    joint.size           = bodies[given.body].size;
    Vector3 place, axis;
    for (std::size_t d = 0; d < given.place.size(); ++d)
      place[d] = given.place[d];
    for (unsigned int d = 0; d < 3; ++d)
      axis[d] = given.axis[d];
    // bodies have not turned yet: their axes are those of space
    for (unsigned int side = 0; side < 2; ++side)
      joint.places[side] =
        joint.bodies[side] == space_itself
          ? place
          : place - bodies[static_cast<unsigned int>(joint.bodies[side])].state.centre;
    joint.axis      = axis / axis.norm();
    joint.across    = cross_product_3d(joint.axis, across_of(joint.axis));
    joint.reference = cross_product_3d(joint.across, joint.axis);
    const auto hold = [&](const Vector3 &b, const Vector3 &d) {
      joint.held.push_back({joint.bodies[0], joint.bodies[1], b, d});
    };
    if (!joint.is_hinge)
      hold(unit(0), unit(1));
    if (!joint.is_hinge && dim == 3)
      {
        hold(unit(0), unit(2));
        hold(unit(1), unit(2));
      }
    if (joint.is_hinge && dim == 3)
      {
        hold(joint.reference, joint.axis);
        hold(joint.across, joint.axis);
      }
    if (joint.is_hinge)
      add_stops(given, joint);
    return joint;
  }



  template <int dim>
  void
  JointTerm<dim>::add_stops(const JointParameters &given, Joint &joint) const
  {
    const auto add = [&](const double at, const double sign) {
      const double co = std::cos(at), si = std::sin(at);
      joint.stops.push_back({{joint.bodies[0],
                              joint.bodies[1],
                              joint.reference,
                              sign * (co * joint.across - si * joint.reference)},
                             co * joint.reference + si * joint.across});
    };
    if (given.highest)
      add(*given.highest, 1.);
    if (given.lowest)
      add(*given.lowest, -1.);
  }



  template <int dim>
  void
  JointTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    for (Joint &joint : joints)
      {
        const auto n_held = static_cast<unsigned int>(joint.held.size());
        joint.unknown     = unknowns.add_others(dim + n_held + (joint.friction > 0. ? 1 : 0));
        unknowns.traits.multipliers = true;
      }
  }



  template <int dim>
  void
  JointTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section = Ledger::Section;
    using Kind    = Ledger::Kind;
    using Role    = Ledger::Role;
    energy =
      ledger.declare({"joint_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    dissipation = ledger.declare(
      {"joint_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    for (const Joint &joint : joints)
      {
        Columns    of_joint;
        const auto column = [&](const std::string &what, const std::string &unit, const int d) {
          return ledger.declare(rigid_column(what, unit, Kind::of_step, joint.name, d));
        };
        for (int d = 0; d < dim; ++d)
          of_joint.force[d] = column("joint_force", "N", d);
        for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
          of_joint.moment[d] = column("joint_moment", "N m", d);
        if (joint.is_hinge)
          of_joint.angle = column("joint_angle", "rad", -1);
        of_joint.gap = column("joint_gap", "m", -1);
        columns.push_back(of_joint);
      }
  }



  template <int dim>
  void
  JointTerm<dim>::start(Trial<dim> &trial)
  {
    for (Joint &joint : joints)
      {
        double mass = 0.;
        for_bodies(joint, [&](const unsigned int body, const double) {
          mass += bodies[body].mass;
        });
        joint.stiffness = scheme.dynamic ? mass / (trial.times.dt * trial.times.dt) : mass;
      }
  }



  template <int dim>
  Vector3
  JointTerm<dim>::gap(const Joint &joint) const
  {
    Vector3 result = joint.bodies[1] == space_itself ? -joint.places[1] : Vector3();
    for_sides(joint, [&](const RigidPoint &point, const double sign) {
      const RigidBody &on = bodies[point.body];
      result += sign * (Vector3(on.state.centre) + on.displacement + point.end);
    });
    return result;
  }



  template <int dim>
  double
  JointTerm<dim>::angle(const Joint &joint) const
  {
    const auto with = [&](const Vector3 &d) {
      return AxesProduct{joint.bodies[0], joint.bodies[1], joint.reference, d}.at_end(bodies);
    };
    return std::atan2(with(joint.across), with(joint.reference));
  }



  /** Of a stop, by which it pulls the product back; only if it is less than 90 degrees away. */
  template <int dim>
  LineTension
  JointTerm<dim>::stop_moment(const Joint &joint, const Stop &stop) const
  {
    const AxesProduct towards{stop.product.first,
                              stop.product.second,
                              stop.product.b,
                              stop.towards};
    if (!(towards.at_start(bodies) > 0.))
      return {};
    return line_tension(joint.stop_stiffness,
                        stop.product.at_start(bodies),
                        stop.product.at_end(bodies),
                        false,
                        scheme.dynamic);
  }



  template <int dim>
  Vector3
  JointTerm<dim>::relative_theta(const Joint &joint) const
  {
    Vector3 theta;
    for_bodies(joint, [&](const unsigned int body, const double sign) {
      theta += sign * bodies[body].theta;
    });
    return theta;
  }



  template <int dim>
  double
  JointTerm<dim>::turn(const Joint &joint) const
  {
    return relative_theta(joint) * point_of(bodies, joint.bodies[0], joint.axis).lever;
  }



  template <int dim>
  std::pair<double, double>
  JointTerm<dim>::friction_trial(const Joint &joint, const UnknownVector &unknowns) const
  {
    const double x = unknowns.others[joint.unknown + dim + joint.held.size()];
    return {x + joint.size * turn(joint), joint.friction / (joint.stiffness * joint.size)};
  }



  template <int dim>
  Answer
  JointTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    const std::vector<double> &x    = trial.unknowns.others;
    std::vector<double>       &sums = residual.others();
    double                     size = 0.;
    for (const Joint &joint : joints)
      {
        const double s = joint.stiffness;
        unsigned int i = joint.unknown;
        Vector3      force;
        for (int d = 0; d < dim; ++d)
          force[d] = s * x[i + d];
        size += force.norm_square();
        for_sides(joint, [&](const RigidPoint &point, const double sign) {
          bodies.add_force(point, sign * force, sums);
        });
        const Vector3 apart = gap(joint);
        const auto    row   = [&](const double value) {
          if (bodies.is_first())
            sums[i] += s * value;
          ++i;
        };
        for (int d = 0; d < dim; ++d)
          row(apart[d] + compliance * x[i]);
        for (const AxesProduct &product : joint.held)
          {
            product.add(s * joint.size * x[i], bodies, sums);
            size += std::pow(s * x[i], 2);
            row(joint.size * product.at_end(bodies) + compliance * x[i]);
          }
        for (const Stop &stop : joint.stops)
          stop.product.add(-stop_moment(joint, stop).value, bodies, sums);
        if (!(joint.friction > 0.))
          continue;
        const Vector3 axis = point_of(bodies, joint.bodies[0], joint.axis).lever;
        for_bodies(joint, [&](const unsigned int body, const double sign) {
          bodies.add(body, Vector3(), sign * s * joint.size * x[i] * axis, sums);
        });
        const auto [would, limit] = friction_trial(joint, trial.unknowns);
        row(x[i] - std::clamp(would, -limit, limit));
      }
    residual.add_square(bodies.is_first() ? size : 0.);
    return {};
  }



  template <int dim>
  void
  JointTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    if (!bodies.is_first())
      return;
    for (const Joint &joint : joints)
      {
        add_place(joint, trial.unknowns, tangent);
        add_products(joint, trial.unknowns, tangent);
        if (joint.friction > 0.)
          add_friction(joint, trial.unknowns, tangent);
      }
  }



  template <int dim>
  void
  JointTerm<dim>::add_place(const Joint         &joint,
                            const UnknownVector &unknowns,
                            Tangent<dim>        &tangent) const
  {
    const double s = joint.stiffness;
    Vector3      force;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const UnknownIndex multiplier = UnknownIndex::other(joint.unknown + d);
        force[d]                      = s * unknowns.others[joint.unknown + d];
        tangent.add(multiplier, multiplier, s * compliance);
      }
    for_sides(joint, [&](const RigidPoint &point, const double sign) {
      bodies.for_unknowns(point,
                          [&](const UnknownIndex &unknown,
                              const Vector3      &motion,
                              const Vector3      &work) {
                            for (unsigned int d = 0; d < dim; ++d)
                              {
                                const auto multiplier = UnknownIndex::other(joint.unknown + d);
                                tangent.add(unknown, multiplier, -sign * s * work[d]);
                                tangent.add(multiplier, unknown, sign * s * motion[d]);
                              }
                          });
      bodies.add_lever_slope(point, sign * force, tangent);
    });
  }



  template <int dim>
  void
  JointTerm<dim>::add_products(const Joint         &joint,
                               const UnknownVector &unknowns,
                               Tangent<dim>        &tangent) const
  {
    const double s = joint.stiffness;
    for (std::size_t k = 0; k < joint.held.size(); ++k)
      {
        const auto         i          = static_cast<unsigned int>(joint.unknown + dim + k);
        const UnknownIndex multiplier = UnknownIndex::other(i);
        joint.held[k].add_tangent(s * joint.size * unknowns.others[i], 0., bodies, tangent);
        joint.held[k].for_unknowns(
          bodies,
          [&](const UnknownIndex &unknown, const double dh, const double work, const Vector3 &) {
            tangent.add(unknown, multiplier, -s * joint.size * work);
            tangent.add(multiplier, unknown, s * joint.size * dh);
          });
        tangent.add(multiplier, multiplier, s * compliance);
      }
    for (const Stop &stop : joint.stops)
      {
        const LineTension moment = stop_moment(joint, stop);
        if (moment.value != 0. || moment.slope != 0.)
          stop.product.add_tangent(-moment.value, -moment.slope, bodies, tangent);
      }
  }



  template <int dim>
  void
  JointTerm<dim>::add_friction(const Joint         &joint,
                               const UnknownVector &unknowns,
                               Tangent<dim>        &tangent) const
  {
    const double       s = joint.stiffness;
    const auto         i = static_cast<unsigned int>(joint.unknown + dim + joint.held.size());
    const UnknownIndex multiplier = UnknownIndex::other(i);
    const auto [would, limit]     = friction_trial(joint, unknowns);
    const bool       sticks       = std::abs(would) <= limit;
    const RigidPoint axis         = point_of(bodies, joint.bodies[0], joint.axis);
    const Vector3    theta        = relative_theta(joint);
    const auto       for_both     = [&](const auto &visit) {
      for_bodies(joint, [&](const unsigned int body, const double sign) {
        for (unsigned int k = 3; k < 6; ++k)
          if (bodies[body].unknowns[k] != RigidBody::held)
            visit(UnknownIndex::other(bodies[body].unknowns[k]),
                  sign / bodies[body].size * unit(k - 3),
                  sign > 0.);
      });
    };
    tangent.add(multiplier, multiplier, sticks ? s * compliance : s);
    for_both([&](const UnknownIndex &row, const Vector3 &along, const bool) {
      tangent.add(row, multiplier, s * joint.size * (along * axis.lever));
      for_both([&](const UnknownIndex &column, const Vector3 &by, const bool of_first) {
        if (of_first)
          tangent.add(row,
                      column,
                      s * joint.size * unknowns.others[i] *
                        (along * (bodies.alpha * axis.slope * by)));
      });
    });
    if (sticks)
      for_both([&](const UnknownIndex &column, const Vector3 &by, const bool of_first) {
        double turning = by * axis.lever;
        if (of_first)
          turning += theta * (bodies.alpha * axis.slope * by);
        tangent.add(multiplier, column, -s * joint.size * turning);
      });
  }



  /** On the first body, of all that the joint does, about the axes of space. */
  template <int dim>
  Vector3
  JointTerm<dim>::moment(const Joint &joint, const UnknownVector &unknowns) const
  {
    const double s = joint.stiffness;
    auto         i = joint.unknown + dim;
    Vector3      sum;
    for (const AxesProduct &product : joint.held)
      sum += s * joint.size * unknowns.others[i++] * product.moment(bodies);
    for (const Stop &stop : joint.stops)
      sum -= stop_moment(joint, stop).value * stop.product.moment(bodies);
    if (joint.friction > 0.)
      sum -=
        s * joint.size * unknowns.others[i] * point_of(bodies, joint.bodies[0], joint.axis).lever;
    return sum;
  }



  template <int dim>
  void
  JointTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    if (!bodies.is_first())
      return;
    const std::vector<double> &x = trial.unknowns.others;
    for (std::size_t k = 0; k < joints.size(); ++k)
      {
        const Joint  &joint = joints[k];
        const Vector3 sum   = moment(joint, trial.unknowns);
        for (int d = 0; d < dim; ++d)
          ledger.book(columns[k].force[d], joint.stiffness * x[joint.unknown + d]);
        for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
          ledger.book(columns[k].moment[d], sum[d]);
        if (joint.is_hinge)
          ledger.book(columns[k].angle, angle(joint));
        ledger.book(columns[k].gap, gap(joint).norm());
        if (joint.friction > 0.)
          ledger.book(dissipation,
                      joint.stiffness * joint.size * x[joint.unknown + dim + joint.held.size()] *
                        turn(joint));
      }
  }



  template <int dim>
  void
  JointTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    if (!bodies.is_first())
      return;
    for (const Joint &joint : joints)
      for (const Stop &stop : joint.stops)
        {
          const AxesProduct towards{stop.product.first,
                                    stop.product.second,
                                    stop.product.b,
                                    stop.towards};
          if (towards.at_end(bodies) > 0.)
            ledger.book(energy,
                        stored_in_line(joint.stop_stiffness, stop.product.at_end(bodies), false));
        }
  }

  template class JointTerm<2>;
  template class JointTerm<3>;
} // namespace kedge
