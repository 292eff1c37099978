#include <kedge/base/exceptions.h>
#include <kedge/rigid/line_term.h>
#include <kedge/rigid/rigid_columns.h>
#include <kedge/solid/load_columns.h>

#include <cmath>

namespace kedge
{
  namespace
  {
    /** A line was slack if it was shorter by this part of its length. */
    constexpr double slack = 1e-9;

    Vector3
    vector_of(const std::vector<double> &numbers)
    {
      Vector3 result;
      for (std::size_t d = 0; d < numbers.size(); ++d)
        result[d] = numbers[d];
      return result;
    }

    UserError
    error_of(const std::string &line, const std::string &entry, const std::string &problem)
    {
      return UserError("Lines/" + line + "/" + entry + ": " + problem);
    }

    /** What a unit impulse at a point, along @p direction, makes of the velocities of its body. */
    struct Kick
    {
      Vector3 velocity, rate; ///< of the centre, and in the body's axes
    };

    Kick
    kick_of(const RigidBody &body, const Vector3 &place_end, const Vector3 &direction)
    {
      Kick          kick;
      const Vector3 moment = cross_product_3d(place_end, direction);
      Matrix33      inertia =
        body.attitude_end * body.inertia * transpose(body.attitude_end); // in space
      Vector3 free_moment;
      for (unsigned int k = 0; k < 3; ++k)
        {
          if (body.unknowns[k] != RigidBody::held)
            kick.velocity[k] = direction[k] / body.mass;
          if (body.unknowns[k + 3] != RigidBody::held)
            free_moment[k] = moment[k];
          else
            {
              for (unsigned int l = 0; l < 3; ++l)
                inertia[k][l] = inertia[l][k] = 0.;
              inertia[k][k] = 1.;
            }
        }
      kick.rate = transpose(body.attitude_end) * (invert(inertia) * free_moment);
      return kick;
    }

    double
    kinetic_energy_at_end(const RigidBody &body)
    {
      return 0.5 * (body.mass * body.velocity_end.norm_square() +
                    body.rate_end * (body.inertia * body.rate_end));
    }
  } // namespace



  template <int dim>
  LineTerm<dim>::LineTerm(const std::vector<LineParameters>   &parameters,
                          RigidBodies<dim>                    &bodies,
                          const std::map<std::string, double> &constants,
                          const LoadProgram                   &program,
                          const Scheme                        &scheme,
                          const double                         start_time)
    : bodies(bodies)
    , program(program)
    , scheme(scheme)
  {
    times.t_n = start_time;
    for (const LineParameters &given : parameters)
      lines.push_back(make_line(given, constants, start_time));
  }



  template <int dim>
  typename LineTerm<dim>::Line
  LineTerm<dim>::make_line(const LineParameters                &given,
                           const std::map<std::string, double> &constants,
                           const double                         start_time) const
  {
    // bodies have not turned yet: their axes are those of space
    const auto place_on = [&](const unsigned int body, const std::vector<double> &place) {
      return place.empty() ? Vector3() : vector_of(place) - bodies[body].state.centre;
    };
    Line line;
    line.name      = given.name;
    line.body      = given.body;
    line.other     = given.other;
    line.place     = place_on(given.body, given.attachment);
    line.stretches = given.stiffness.has_value();
    line.stiffness = given.stiffness.value_or(1.);
    line.pushes    = given.pushes;
    if (given.other)
      line.other_place = place_on(*given.other, given.other_attachment);
    for (std::size_t d = 0; d < given.anchor.size(); ++d)
      line.anchor[d] = Expression(given.anchor[d], {"t"}, constants);
    const Vector3 other_end =
      given.other ? bodies[*given.other].state.centre + line.other_place : anchor(line, start_time);
    const double distance = (bodies[given.body].state.centre + line.place - other_end).norm();
    line.length =
      given.length.empty() ? Expression(distance) : Expression(given.length, {"t"}, constants);
    const double length = line.length({program.time(start_time)});
    if (!(length > 0.))
      throw error_of(given.name, "Length", "At the start the line has no length.");
    const bool ends_meet = !(distance > 0.);
    if (given.pushes && ends_meet)
      throw error_of(given.name,
                     "Pushes",
                     "A rod whose ends are at the same place points nowhere.");
    if (!line.stretches && distance > length * (1. + slack))
      throw error_of(given.name,
                     "Length",
                     "At the start its ends are " + std::to_string(distance) +
                       " m apart, and it does not stretch: give a Stiffness, or a longer one.");
    return line;
  }



  template <int dim>
  Vector3
  LineTerm<dim>::anchor(const Line &line, const double t) const
  {
    Vector3 result;
    for (unsigned int d = 0; d < 3; ++d)
      result[d] = line.anchor[d]({program.time(t)});
    return result;
  }



  template <int dim>
  void
  LineTerm<dim>::declare_unknowns(Unknowns<dim> &unknowns)
  {
    for (Line &line : lines)
      if (!line.stretches)
        {
          line.unknown                = unknowns.add_others(1);
          unknowns.traits.multipliers = true;
        }
  }



  template <int dim>
  void
  LineTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section = Ledger::Section;
    using Kind    = Ledger::Kind;
    using Role    = Ledger::Role;
    work          = ledger.declare(external_work);
    energy =
      ledger.declare({"line_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    dissipation =
      ledger.declare({"line_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    for (const Line &line : lines)
      columns.push_back({ledger.declare(rigid_column("tension", "N", Kind::of_step, line.name)),
                         ledger.declare(rigid_column("length", "m", Kind::of_step, line.name)),
                         ledger.declare(rigid_column("stretch", "m", Kind::of_step, line.name))});
  }



  template <int dim>
  void
  LineTerm<dim>::start(Trial<dim> &trial)
  {
    times = trial.times;
    for (Line &line : lines)
      if (!line.stretches)
        {
          const double mass = bodies[line.body].mass + (line.other ? bodies[*line.other].mass : 0.);
          line.stiffness    = scheme.dynamic ? mass / (times.dt * times.dt) : mass;
        }
  }



  template <int dim>
  typename LineTerm<dim>::Pull
  LineTerm<dim>::pull(const Line &line, const Trial<dim> &trial) const
  {
    const double t_0 = times.t_n, t_1 = times.t_n + times.dt;
    Pull         result;
    result.at           = bodies.point(line.body, line.place);
    const Vector3 place = bodies[line.body].state.centre + result.at.start;
    Vector3       other_start, other_end;
    if (line.other)
      {
        result.at_other = bodies.point(*line.other, line.other_place);
        other_start     = bodies[*line.other].state.centre + result.at_other.start;
        other_end       = other_start + bodies.displacement(result.at_other);
      }
    else
      {
        other_start = anchor(line, t_0);
        other_end   = anchor(line, t_1);
      }
    result.line         = {place - other_start,
                           place + bodies.displacement(result.at) - other_end,
                           bodies.alpha};
    result.length_start = line.length({program.time(t_0)});
    result.length_end   = line.length({program.time(t_1)});
    const double end    = result.line.length_end() - result.length_end;
    result.taut         = true;
    if (line.stretches)
      result.tension = line_tension(line.stiffness,
                                    result.line.length_start() - result.length_start,
                                    end,
                                    line.pushes,
                                    scheme.dynamic);
    else
      {
        const double x = trial.unknowns.others[line.unknown];
        result.taut    = line.pushes || x + end > 0.;
        result.tension = {line.stiffness * x, 0.};
      }
    return result;
  }



  template <int dim>
  Answer
  LineTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    double size = 0.;
    for (const Line &line : lines)
      {
        const Pull   here    = pull(line, trial);
        const double tension = here.tension.value;
        size += tension * tension;
        if (tension != 0.)
          {
            if (!(here.line.length() > 0.))
              return Answer::failure("line '" + line.name + "' has no length");
            const Vector3 force = tension * here.line.pull();
            bodies.add_force(here.at, force, residual.others());
            if (line.other)
              bodies.add_force(here.at_other, -force, residual.others());
          }
        if (line.stretches)
          continue;
        const double off = here.taut ? here.line.length_end() - here.length_end
                                     : trial.unknowns.others[line.unknown];
        size += here.taut ? std::pow(line.stiffness * here.length_end, 2) : 0.;
        if (bodies.is_first())
          residual.others()[line.unknown] += line.stiffness * off;
      }
    residual.add_square(bodies.is_first() ? size : 0.);
    return {};
  }



  template <int dim>
  void
  LineTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    if (bodies.is_first())
      for (const Line &line : lines)
        add_to_tangent(line, pull(line, trial), tangent);
  }



  template <int dim>
  void
  LineTerm<dim>::add_to_tangent(const Line &line, const Pull &here, Tangent<dim> &tangent) const
  {
    const UnknownIndex multiplier = UnknownIndex::other(line.unknown);
    if (!line.stretches && !here.taut)
      tangent.add(multiplier, multiplier, line.stiffness);
    if (!(here.line.length() > 0. && here.line.length_end() > 0.))
      return;
    const Vector3  direction = here.line.end / here.line.length_end();
    const Vector3  force     = here.tension.value * here.line.pull();
    const Matrix33 slope     = here.tension.value * here.line.pull_slope() +
                           here.tension.slope * outer_product(here.line.pull(), direction);
    const auto for_both = [&](const auto &visit) {
      bodies.for_unknowns(here.at, visit);
      if (line.other)
        bodies.for_unknowns(here.at_other,
                            [&](const UnknownIndex &unknown,
                                const Vector3      &motion,
                                const Vector3      &work) {
                              visit(unknown, -motion, -work);
                            });
    };
    for_both([&](const UnknownIndex &row, const Vector3 &motion, const Vector3 &work) {
      for_both([&](const UnknownIndex &column, const Vector3 &by, const Vector3 &) {
        tangent.add(row, column, -(work * (slope * by)));
      });
      if (line.stretches)
        return;
      tangent.add(row, multiplier, -line.stiffness * (work * here.line.pull()));
      if (here.taut)
        tangent.add(multiplier, row, line.stiffness * (direction * motion));
    });
    bodies.add_lever_slope(here.at, force, tangent);
    if (line.other)
      bodies.add_lever_slope(here.at_other, -force, tangent);
  }



  /**
   * Takes from the ends of a line that has become taut the velocity with which they would part,
   * by one impulse along it; says how much kinetic energy that costs.
   */
  template <int dim>
  double
  LineTerm<dim>::stop_ends(const Pull &here, const bool has_other)
  {
    const Vector3 direction = here.line.end / here.line.length_end();
    const double  wound     = (here.length_end - here.length_start) / times.dt;
    double        parting = -wound, mobility = 0.;
    std::vector<std::pair<RigidBody *, Kick>> kicks;
    const auto add = [&](const RigidPoint &point, const double sign) {
      RigidBody    &body = bodies[point.body];
      const Vector3 rate = body.attitude_end * body.rate_end;
      const Kick    kick = kick_of(body, point.end, sign * direction);
      parting += sign * direction * (body.velocity_end + cross_product_3d(rate, point.end));
      mobility += sign * direction *
                  (kick.velocity + cross_product_3d(body.attitude_end * kick.rate, point.end));
      kicks.emplace_back(&body, kick);
    };
    add(here.at, 1.);
    if (has_other)
      add(here.at_other, -1.);
    if (!(parting > 0. && mobility > 0.))
      return 0.;
    double lost = 0.;
    for (auto &[body, kick] : kicks)
      {
        lost += kinetic_energy_at_end(*body);
        body->velocity_end -= parting / mobility * kick.velocity;
        body->rate_end -= parting / mobility * kick.rate;
        lost -= kinetic_energy_at_end(*body);
      }
    return lost;
  }



  template <int dim>
  Answer
  LineTerm<dim>::finish(const Trial<dim> &trial)
  {
    stopped = 0.;
    for (const Line &line : lines)
      if (!line.stretches && !line.pushes && scheme.dynamic)
        {
          const Pull here      = pull(line, trial);
          const bool was_slack = here.line.length_start() < here.length_start * (1. - slack);
          if (here.taut && was_slack)
            stopped += stop_ends(here, line.other.has_value());
        }
    return {};
  }



  template <int dim>
  void
  LineTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    if (!bodies.is_first())
      return;
    ledger.book(dissipation, stopped);
    for (std::size_t k = 0; k < lines.size(); ++k)
      {
        const Line  &line    = lines[k];
        const Pull   here    = pull(line, trial);
        const double tension = here.tension.value;
        const double wound   = here.length_end - here.length_start;
        const double grown   = here.line.length_end() - here.line.length_start();
        double       supply  = -tension * wound;
        if (!line.other && tension != 0.)
          supply += tension * here.line.pull() *
                    (anchor(line, times.t_n + times.dt) - anchor(line, times.t_n));
        ledger.book(work, supply);
        if (!line.stretches)
          ledger.book(dissipation, tension * (grown - wound));
        ledger.book(columns[k].tension, tension);
        ledger.book(columns[k].length, here.line.length_end());
        ledger.book(columns[k].stretch, here.line.length_end() - here.length_end);
      }
  }



  template <int dim>
  void
  LineTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    if (!bodies.is_first())
      return;
    for (const Line &line : lines)
      if (line.stretches)
        {
          const double t     = times.t_n + times.dt;
          const auto   place = [&](const unsigned int body, const Vector3 &on_it) {
            const RigidState &state = bodies[body].state;
            return state.centre + matrix_of(state.attitude) * on_it;
          };
          const Vector3 other =
            line.other ? Vector3(place(*line.other, line.other_place)) : anchor(line, t);
          ledger.book(energy,
                      stored_in_line(line.stiffness,
                                     (place(line.body, line.place) - other).norm() -
                                       line.length({program.time(t)}),
                                     line.pushes));
        }
  }

  template <int dim>
  void
  LineTerm<dim>::save(SavedState &state) const
  {
    state[name()] = {program.time(times.t_n + times.dt)}; // a stage ends at the start of the run
  }



  template <int dim>
  void
  LineTerm<dim>::restore(const SavedState &state)
  {
    times = {state.at(name()).at(0), 0.};
  }

  template class LineTerm<2>;
  template class LineTerm<3>;
} // namespace kedge
