#include <kedge/fields/prescribed_motion.h>
#include <kedge/rigid/rigid_columns.h>
#include <kedge/rigid/rigid_term.h>
#include <kedge/solid/load_columns.h>

#include <cmath>

namespace kedge
{
  namespace
  {
    /** The place that motions may depend on. */
    void
    coordinates_of(const RigidBody &body, double (&place)[3])
    {
      for (unsigned int d = 0; d < 3; ++d)
        place[d] = body.state.centre[d];
    }
  } // namespace



  template <int dim>
  RigidTerm<dim>::RigidTerm(const std::vector<RigidBodyParameters<dim>> &parameters,
                            const dealii::BoundingBox<dim>              &domain,
                            const std::array<std::string, dim>          &body_force,
                            const std::map<std::string, double>         &constants,
                            const LoadProgram                           &program,
                            const Scheme                                &scheme,
                            const double                                 start_time,
                            const MPI_Comm                               communicator)
    : rigid(scheme.contact_alpha(), communicator)
    , program(program)
    , scheme(scheme)
    , drives(parameters.size())
  {
    make_rigid_bodies(parameters, domain, rigid);
    for (int d = 0; d < dim; ++d)
      acceleration[d] = Expression(body_force[d], {"t"}, constants);
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        has_weight.push_back(parameters[b].body_force);
        double place[3];
        coordinates_of(rigid[b], place);
        for (const unsigned int k : RigidBodies<dim>::freedoms())
          {
            const RigidFreedom &given = parameters[b].freedoms[k];
            Drive              &drive = drives[b][k];
            drive.kind                = given.motion.kind;
            drive.has_force           = !given.force.empty();
            if (drive.has_force)
              drive.force = Expression(given.force, {"t"}, constants);
            if (drive.kind == ConditionKind::free)
              continue;
            if (drive.kind != ConditionKind::fixed)
              drive.motion =
                Expression(given.motion.expression,
                           drive.kind == ConditionKind::motion ? motion_variables()
                                                               : std::vector<std::string>{"t"},
                           constants);
            // what is moved has the velocity of its motion from the start
            RigidState &state = rigid[b].state;
            (k < 3 ? state.velocity : state.angular_velocity)[k % 3] =
              drive.kind == ConditionKind::fixed
                ? 0.
                : prescribed_velocity(drive.kind, drive.motion, place, start_time, 1e-6);
          }
        if (rigid[b].inertia == Matrix33())
          rigid[b].state.angular_velocity = Vector3();
      }
  }



  template <int dim>
  void
  RigidTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    if (program.in_stage())
      for (unsigned int b = 0; b < rigid.size(); ++b)
        rigid[b].unknowns.fill(RigidBody::held);
    rigid.declare_unknowns(unknowns);
  }



  template <int dim>
  void
  RigidTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section  = Ledger::Section;
    using Kind     = Ledger::Kind;
    using Role     = Ledger::Role;
    work           = ledger.declare(external_work);
    kinetic_energy = ledger.declare(
      {"kinetic_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    for (int d = 0; d < dim; ++d)
      linear_momentum[d] =
        ledger.declare({std::string("linear_momentum_") + "xyz"[d], "kg m/s", Section::momentum});
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      angular_momentum[d] = ledger.declare(
        {std::string("angular_momentum_") + "xyz"[d], "kg m^2/s", Section::momentum});
    columns.resize(rigid.size());
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        const auto column = [&](const std::string &what, const int d, const std::string &unit) {
          return ledger.declare(rigid_column(what, unit, Kind::present, rigid[b].name, d));
        };
        Columns &of_body = columns[b];
        for (const unsigned int k : RigidBodies<dim>::freedoms())
          if (k < 3)
            {
              of_body.position[k] = column("position", k, "m");
              of_body.velocity[k] = column("velocity", k, "m/s");
            }
          else
            {
              of_body.rotation[k - 3]  = column("rotation", k - 3, "rad");
              of_body.body_rate[k - 3] = column("body_rate", k - 3, "rad/s");
            }
        for (const unsigned int k : RigidBodies<dim>::freedoms())
          of_body.reaction[k] = ledger.declare(rigid_column(k < 3 ? "reaction" : "reaction_moment",
                                                            k < 3 ? "N" : "N m",
                                                            Kind::of_step,
                                                            rigid[b].name,
                                                            k % 3));
      }
  }



  /** Where contact looks first: what is free goes on as it moves. */
  template <int dim>
  void
  RigidTerm<dim>::predict(RigidBody &body) const
  {
    if (!scheme.dynamic)
      return;
    const Vector3 rate = body.attitude_start * body.state.angular_velocity;
    for (unsigned int k = 0; k < 3; ++k)
      {
        if (body.unknowns[k] != RigidBody::held)
          body.displacement[k] = times.dt * body.state.velocity[k];
        if (body.unknowns[k + 3] != RigidBody::held)
          body.theta[k] = times.dt * rate[k];
      }
  }



  template <int dim>
  void
  RigidTerm<dim>::start(Trial<dim> &trial)
  {
    times = trial.times;
    rigid.begin();
    if (program.in_stage())
      return;
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        double place[3];
        coordinates_of(rigid[b], place);
        Vector3 turn;
        for (const unsigned int k : RigidBodies<dim>::freedoms())
          if (const Drive &drive = drives[b][k]; drive.kind != ConditionKind::free)
            {
              const double value = prescribed_increment(drive.kind,
                                                        drive.motion,
                                                        place,
                                                        times.t_n,
                                                        times.t_n + times.dt);
              if (k < 3)
                rigid.hold(b, k, value);
              else
                turn[k - 3] = value;
            }
        predict(rigid[b]);
        const double  angle = turn.norm();
        const Vector3 theta = angle > 0. ? cayley_vector(turn / angle, angle) : Vector3();
        for (unsigned int k = 3; k < 6; ++k)
          if (rigid[b].unknowns[k] == RigidBody::held)
            rigid.hold(b, k, theta[k - 3]);
        rigid[b].attitude_end = cayley(rigid[b].theta) * rigid[b].attitude_start;
      }
  }



  /** The given forces (or moments) on a body in the balance, with its weight. */
  template <int dim>
  Vector3
  RigidTerm<dim>::load(const unsigned int body, const unsigned int first_freedom) const
  {
    const double t = scheme.load_time(times.t_n, times.dt);
    Vector3      result;
    for (unsigned int d = 0; d < 3; ++d)
      {
        if (const Drive &drive = drives[body][first_freedom + d]; drive.has_force)
          result[d] += program.factor(t) * drive.force({program.time(t)});
        if (first_freedom == 0 && d < dim && has_weight[body])
          result[d] += program.factor(t) * rigid[body].mass * acceleration[d]({program.time(t)});
      }
    return result;
  }



  template <int dim>
  Vector3
  RigidTerm<dim>::end_velocity(const RigidBody &body) const
  {
    return 2. / times.dt * body.displacement - body.state.velocity;
  }



  /** W_{n+1}, in the body's axes. */
  template <int dim>
  Vector3
  RigidTerm<dim>::end_rate(const RigidBody &body) const
  {
    return 2. / times.dt * transpose(body.attitude_start) * body.theta -
           body.state.angular_velocity;
  }



  template <int dim>
  Answer
  RigidTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    rigid.read(trial.unknowns);
    rigid.clear_sums();
    double size = 0.; // of what cancels
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        const RigidBody &body = rigid[b];
        if (scheme.dynamic)
          {
            const Vector3 momentum_n = body.mass * body.state.velocity,
                          spin_n = body.attitude_start * body.inertia * body.state.angular_velocity;
            const Vector3 momentum = body.mass * end_velocity(body),
                          spin     = body.attitude_end * body.inertia * end_rate(body);
            rigid.add(b,
                      (momentum - momentum_n) / times.dt,
                      (spin - spin_n) / times.dt,
                      residual.others());
            size += (momentum.norm_square() + momentum_n.norm_square() +
                     (spin.norm_square() + spin_n.norm_square()) / (body.size * body.size)) /
                    (times.dt * times.dt);
          }
        const Vector3 force = load(b, 0), moment = load(b, 3);
        rigid.add(b, -force, -moment, residual.others());
        size += force.norm_square() + moment.norm_square() / (body.size * body.size);
      }
    residual.add_square(rigid.is_first() ? size : 0.);
    return {};
  }



  template <int dim>
  void
  RigidTerm<dim>::add_tangent(const Trial<dim> &, Tangent<dim> &tangent)
  {
    if (!scheme.dynamic || !rigid.is_first())
      return;
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        const RigidBody &body = rigid[b];
        const double     dt   = times.dt;
        // pi_{n+1} = cay(theta) a with a = A_n J W_{n+1}, linear in theta
        const Matrix33 turn   = body.attitude_end * transpose(body.attitude_start);
        const Vector3  before = body.attitude_start * body.inertia * end_rate(body);
        const Matrix33 turning =
                         -0.5 * cayley_inverse(body.theta) * cross_matrix(before + turn * before),
                       spinning = 2. / dt * body.attitude_end * body.inertia *
                                  transpose(body.attitude_start);
        const Matrix33 slope = (turning + spinning) / (dt * body.size * body.size);
        for (unsigned int k = 0; k < 6; ++k)
          for (unsigned int l = 0; l < 6; ++l)
            if (body.unknowns[k] != RigidBody::held && body.unknowns[l] != RigidBody::held &&
                (k < 3) == (l < 3) && (k >= 3 || k == l))
              tangent.add(UnknownIndex::other(body.unknowns[k]),
                          UnknownIndex::other(body.unknowns[l]),
                          k < 3 ? 2. * body.mass / (dt * dt) : slope[k - 3][l - 3]);
      }
  }



  /**
   * What Newton's method has left of the balance would add up over many steps: the momenta at the
   * end are those of the balance, to round-off.
   */
  template <int dim>
  void
  RigidTerm<dim>::take_off_residual(RigidBody &body) const
  {
    bool turns = true;
    for (const unsigned int k : RigidBodies<dim>::freedoms())
      if (k >= 3)
        turns = turns && body.unknowns[k] != RigidBody::held;
      else if (body.unknowns[k] != RigidBody::held)
        body.velocity_end[k] -= times.dt / body.mass * body.force[k];
    if (!turns)
      return;
    if (dim == 3)
      body.rate_end -=
        times.dt * (invert(body.inertia) * (transpose(body.attitude_end) * body.moment));
    else
      body.rate_end[2] -= times.dt / body.inertia[2][2] * body.moment[2];
  }



  template <int dim>
  Answer
  RigidTerm<dim>::finish(const Trial<dim> &)
  {
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        RigidBody &body   = rigid[b];
        body.velocity_end = scheme.dynamic ? end_velocity(body) : body.state.velocity;
        body.rate_end     = scheme.dynamic ? end_rate(body) : body.state.angular_velocity;
        if (scheme.dynamic)
          take_off_residual(body);
      }
    return {};
  }



  template <int dim>
  void
  RigidTerm<dim>::book(const Trial<dim> &, const Residual<dim> &, Ledger &ledger) const
  {
    if (!rigid.is_first())
      return;
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        const RigidBody &body = rigid[b];
        double           done = load(b, 0) * body.displacement + load(b, 3) * body.theta;
        for (const unsigned int k : RigidBodies<dim>::freedoms())
          {
            // what is left of the balance where nothing solves for it
            const bool   is_held  = body.unknowns[k] == RigidBody::held;
            const double reaction = is_held ? (k < 3 ? body.force : body.moment)[k % 3] : 0.;
            done += reaction * (k < 3 ? body.displacement : body.theta)[k % 3];
            ledger.book(columns[b].reaction[k], reaction);
          }
        ledger.book(work, done);
      }
  }



  template <int dim>
  void
  RigidTerm<dim>::commit(const Trial<dim> &, MaterialPoints<dim> &)
  {
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        RigidBody  &body       = rigid[b];
        RigidState &state      = body.state;
        state.velocity         = body.velocity_end;
        state.angular_velocity = body.rate_end;
        state.centre += body.displacement;
        state.attitude = turned_by(state.attitude, body.theta);
        state.rotation = rotation_vector(state.attitude, state.rotation);
      }
    rigid.begin();
  }



  template <int dim>
  void
  RigidTerm<dim>::book_momenta(Ledger &ledger) const
  {
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        const RigidState &state    = rigid[b].state;
        const Vector3     momentum = rigid[b].mass * state.velocity;
        const Vector3     spin     = rigid[b].inertia * state.angular_velocity;
        const Vector3     angular =
          cross_product_3d(Vector3(state.centre), momentum) + matrix_of(state.attitude) * spin;
        ledger.book(kinetic_energy,
                    0.5 * (momentum * state.velocity + spin * state.angular_velocity));
        for (int d = 0; d < dim; ++d)
          ledger.book(linear_momentum[d], momentum[d]);
        for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
          ledger.book(angular_momentum[d], angular[d]);
      }
  }



  template <int dim>
  void
  RigidTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    if (!rigid.is_first())
      return;
    if (scheme.dynamic)
      book_momenta(ledger);
    for (unsigned int b = 0; b < rigid.size(); ++b)
      for (const unsigned int k : RigidBodies<dim>::freedoms())
        {
          const RigidState &state = rigid[b].state;
          if (k < 3)
            {
              ledger.book(columns[b].position[k], state.centre[k]);
              ledger.book(columns[b].velocity[k], state.velocity[k]);
            }
          else
            {
              ledger.book(columns[b].rotation[k - 3], state.rotation[k - 3]);
              ledger.book(columns[b].body_rate[k - 3], state.angular_velocity[k - 3]);
            }
        }
  }



  template <int dim>
  void
  RigidTerm<dim>::save(SavedState &saved) const
  {
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        const RigidState &state  = rigid[b].state;
        auto             &values = saved["rigid body '" + rigid[b].name + "'"];
        values.assign(state.attitude.begin(), state.attitude.end());
        for (const Vector3 *part : {static_cast<const Vector3 *>(&state.centre),
                                    &state.velocity,
                                    &state.angular_velocity,
                                    &state.rotation})
          values.insert(values.end(), part->begin_raw(), part->end_raw());
      }
  }



  template <int dim>
  void
  RigidTerm<dim>::restore(const SavedState &saved)
  {
    for (unsigned int b = 0; b < rigid.size(); ++b)
      {
        RigidState &state  = rigid[b].state;
        const auto &values = saved.at("rigid body '" + rigid[b].name + "'");
        AssertThrow(values.size() == 16, dealii::ExcInternalError());
        auto next = values.begin();
        for (double &value : state.attitude)
          value = *next++;
        for (Vector3 *part : {static_cast<Vector3 *>(&state.centre),
                              &state.velocity,
                              &state.angular_velocity,
                              &state.rotation})
          for (unsigned int d = 0; d < 3; ++d)
            (*part)[d] = *next++;
      }
    rigid.begin();
  }

  template class RigidTerm<2>;
  template class RigidTerm<3>;
} // namespace kedge
