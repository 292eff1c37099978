#include <kedge/simulation/attachments.h>
#include <kedge/simulation/step.h>
#include <kedge/solvers/interruptible.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  Step<dim>::Step(Model<dim> &model, const bool solves)
    : model(model)
    , solves(solves)
    , step_equations(model.patches(),
                     model.unknowns,
                     model.terms,
                     model.scheme,
                     model.scene.linear_solver)
    , n_dofs(model.ledger.declare({"n_dofs", ""}))
  {}



  template <int dim>
  void
  Step<dim>::activate()
  {
    if (activated)
      return;
    find_nodes();
    const Stopwatch stopwatch(phases["transfer"]);
    for (auto &term : model.terms)
      term->activate(model.points.points());
    for (unsigned int f = 0; f < model.fields.size(); ++f)
      if (auto &transfer = model.fields[f]->transfer; transfer && solves)
        {
          std::function<void(NodeMatrix<dim> &)> add;
          if (!model.fields[f]->mapping_terms.empty())
            add = [&, f](NodeMatrix<dim> &mass) {
              for (const auto *term : model.fields[f]->mapping_terms)
                term->add_mapping_mass(f, mass);
            };
          transfer->reinit(add);
        }
    activated = true;
  }



  template <int dim>
  void
  Step<dim>::find_nodes()
  {
    const Stopwatch  stopwatch(phases["activation"]);
    std::vector<int> radius;
    for (unsigned int f = 0; f < model.fields.size(); ++f)
      {
        model.fields[f]->patch.reinit(
          model.points.points(),
          [&](std::vector<unsigned char> &reached) {
            for (auto &term : model.terms)
              term->reach(f, reached);
          },
          [&](std::vector<unsigned char> &reached) {
            for (auto &term : model.terms)
              term->claim(f, reached);
          });
        radius.push_back(solves ? model.fields[f]->tangent_radius : 0);
      }
    step_equations.reinit(radius);
  }



  /** Nodes are prescribed or free as they are at the start of the step. */
  template <int dim>
  void
  Step<dim>::set_time(const double t)
  {
    for (auto &field : model.fields)
      if (field->patch.conditions.set_time(t))
        activated = false;
  }



  template <int dim>
  LinearStatus
  Step<dim>::points_to_nodes()
  {
    for (auto &field : model.fields)
      if (field->transfer)
        {
          const LinearStatus status = field->transfer->to_nodes(trial);
          if (!status.success)
            return status;
        }
    return {};
  }



  template <int dim>
  StepReport
  Step<dim>::attempt(const StepTimes &times, const std::function<bool()> &stop)
  {
    Assert(solves, dealii::ExcMessage("This step has no matrices."));
    set_time(times.t_n);
    activate();
    {
      const Stopwatch           stopwatch(phases["transfer"]);
      std::vector<unsigned int> n_nodes;
      for (const auto &field : model.fields)
        n_nodes.push_back(field->patch.nodes.n_local());
      // x = 0 as in (3.184): the velocities of the points hold more than a smooth motion
      trial.begin(times, model.unknowns, n_nodes);
      for (auto &field : model.fields)
        field->patch.set_time_step(times.dt);
      const LinearStatus mapped = points_to_nodes();
      if (!mapped.success)
        {
          StepReport report;
          report.hopeless = true;
          report.cause    = "the mass matrix cannot be solved: " + mapped.cause;
          return report;
        }
      for (auto &term : model.terms)
        term->start(trial);
    }
    step_equations.start(trial, times.t_n + model.pressure_fraction * times.dt);
    if (!stop)
      return check_points(solve(step_equations));
    Interruptible      problem(step_equations, stop);
    const NewtonReport newton = solve(problem);
    if (!problem.interrupted)
      return check_points(newton);
    StepReport report;
    report.interrupted = true;
    return report;
  }



  /** Newton's method, again as long as a term has held something fixed that has changed since. */
  template <int dim>
  NewtonReport
  Step<dim>::solve(NewtonProblem &problem)
  {
    NewtonReport report      = solve_newton(problem, model.scene.newton);
    const auto   has_changed = [&]() {
      bool any = false;
      for (auto &term : model.terms)
        any = term->refresh(trial) || any;
      return any;
    };
    while (report.converged && has_changed())
      {
        NewtonReport again = solve_newton(problem, model.scene.newton);
        again.iterations += report.iterations;
        again.linear_iterations += report.linear_iterations;
        report = std::move(again);
      }
    return report;
  }



  template <int dim>
  std::string
  Step<dim>::failure_of(const NewtonReport &newton) const
  {
    std::string result = newton.cause;
    for (const std::string &more : {step_equations.diagnosis(), hint_on_points(model.scene)})
      result += more.empty() ? "" : "; " + more;
    return result;
  }



  template <int dim>
  StepReport
  Step<dim>::check_points(const NewtonReport &newton)
  {
    StepReport report;
    report.newton = newton;
    if (!newton.converged)
      {
        report.cause = failure_of(newton);
        return report;
      }
    const Stopwatch stopwatch(phases["history update"]);
    bool            failed = false;
    for (auto &term : model.terms)
      {
        const Answer answer = term->finish(trial);
        if (!answer.ok && !failed)
          report.cause = answer.cause;
        failed = failed || !answer.ok;
      }
    const bool any = dealii::Utilities::MPI::logical_or(failed, model.communicator);
    if (any && !failed)
      report.cause = "a material point of another rank cannot be updated";
    report.accepted = !any;
    return report;
  }



  template <int dim>
  void
  Step<dim>::commit()
  {
    model.ledger.open();
    {
      const Stopwatch stopwatch(phases["history update"]);
      for (const auto &term : model.terms)
        term->book(trial, step_equations.last_residual(), model.ledger);
      for (auto &term : model.terms)
        term->commit(trial, model.points.points());
      const std::vector<PointRecord<dim>> gone =
        model.points.follow(trial.times.t_n + trial.times.dt);
      for (const auto &term : model.terms)
        term->book_outflow(gone, model.ledger);
    }
    activated = false;
    set_time(trial.times.t_n + trial.times.dt);
    book_present_state();
  }



  template <int dim>
  void
  Step<dim>::book_state()
  {
    model.ledger.open();
    book_present_state();
  }



  template <int dim>
  void
  Step<dim>::book_present_state()
  {
    activate();
    for (const auto &term : model.terms)
      term->book_state(model.points.points(), model.ledger);
    model.ledger.book(n_dofs, step_equations.n_own_equations());
    model.ledger.close(model.communicator);
  }



  template <int dim>
  void
  Step<dim>::initialise_points(const double t, const bool after_stage)
  {
    activate();
    if (!after_stage)
      {
        for (auto &term : model.terms)
          term->initialise(model.points.points());
        activated = false;
        activate();
      }
    // what holds a body by multipliers is no part of that residual: such bodies begin without
    // acceleration, or the reactions would swing about their means for ever
    if (!model.scheme.carries_acceleration || !model.scene.body_conditions.empty())
      return;
    const Residual<dim> &residual = step_equations.residual_at_rest(t);
    for (unsigned int f = 0; f < model.fields.size(); ++f)
      {
        const Patch<dim>   &patch        = model.fields[f]->patch;
        const unsigned int  n_components = patch.n_components();
        std::vector<double> force(std::size_t(patch.nodes.n_local()) * dim, 0.);
        for (std::size_t i = 0; i < patch.nodes.n_owned(); ++i)
          for (int d = 0; d < dim; ++d)
            force[i * dim + d] = -residual.of_field(f)[i * n_components + d];
        model.fields[f]->transfer->accelerate(force, model.points.points());
      }
    activated = false;
  }



  template <int dim>
  dealii::Tensor<1, dim>
  Step<dim>::total_load(const double t)
  {
    activate();
    // internal forces sum to zero, whatever the stress: the shapes sum to one
    const Residual<dim>   &residual = step_equations.residual_at_rest(t);
    dealii::Tensor<1, dim> sum;
    for (unsigned int f = 0; f < model.fields.size(); ++f)
      {
        const Patch<dim>  &patch        = model.fields[f]->patch;
        const unsigned int n_components = patch.n_components();
        for (std::size_t i = 0; i < patch.nodes.n_owned(); ++i)
          for (int d = 0; d < dim; ++d)
            sum[d] -= residual.of_field(f)[i * n_components + d];
      }
    return dealii::Utilities::MPI::sum(sum, model.communicator);
  }



  template <int dim>
  std::map<std::string, PhaseTime>
  Step<dim>::phase_times() const
  {
    auto result            = phases;
    result["residual"]     = step_equations.timings().residual;
    result["tangent"]      = step_equations.timings().tangent;
    result["linear solve"] = step_equations.timings().linear_solve;
    return result;
  }



  template <int dim>
  double
  cfl_step(const Model<dim> &model, Step<dim> &step, const StepSizeKind kind)
  {
    const Lattice<dim> &lattice = model.points.grid().levels().finest();
    if (kind == StepSizeKind::cfl_initial)
      {
        double slowness = std::numeric_limits<double>::max();
        for (std::size_t b = 0; b < model.bodies.names.size(); ++b)
          slowness = std::min(slowness,
                              std::sqrt(model.bodies.densities[b] /
                                        p_wave_modulus(model.bodies.materials[b])));
        return lattice.smallest_cell_size() * slowness;
      }
    step.activate();
    const bool by_density = kind == StepSizeKind::cfl_density;
    double     square     = std::numeric_limits<double>::max();
    for (const auto &field : model.fields)
      {
        const Patch<dim>      &patch  = field->patch;
        const StepPoints<dim> &points = patch.points;
        std::vector<double>    at_points(3 * std::size_t(points.size()));
        for (const auto &batch : points.batches)
          for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
            {
              double volume = points.volume[slot];
              if (!by_density) // (3.128) sums the present volume
                volume *= points.determinant[slot];
              double *values = &at_points[3 * std::size_t(slot)];
              values[0]      = by_density
                                 ? points.mass[slot] / (points.volume[slot] * points.determinant[slot])
                                 : points.mass[slot];
              values[1]      = by_density ? 0. : volume;
              values[2]      = p_wave_modulus(model.bodies.materials[batch.body]);
            }
        std::vector<double> at_nodes(3 * std::size_t(patch.nodes.n_local()), 0.);
        add_scalars_to_nodes(patch, at_points, 3, at_nodes);
        patch.nodes.add_to_owners(at_nodes, 3);
        for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
          {
            const double *s = &at_nodes[3 * std::size_t(i)];
            if (s[2] > 0.)
              square = std::min(square, s[0] / ((by_density ? 1. : s[1]) * s[2]));
          }
      }
    square = dealii::Utilities::MPI::min(square, model.communicator);
    return lattice.smallest_cell_size() * std::sqrt(square);
  }

  template class Step<2>;
  template class Step<3>;
  template double
  cfl_step(const Model<2> &, Step<2> &, const StepSizeKind);
  template double
  cfl_step(const Model<3> &, Step<3> &, const StepSizeKind);
} // namespace kedge
