#include <kedge/solid/solid_problem.h>

namespace kedge
{
  namespace
  {
    /** Raises the scaled diagonal of a singular tangent; Newton's residual stays exact. */
    constexpr double singular_shift = 1e-10;

    /** A tangent worse than this may be why Newton's method fails. */
    constexpr double suspicious_condition = 1e9;
  } // namespace



  template <int dim>
  SolidProblem<dim>::SolidProblem(const InternalForce<dim>       &internal_force,
                                  const Scheme                   &scheme,
                                  const LinearSolverParameters   &parameters,
                                  const std::vector<std::string> &body_names)
    : internal_force(internal_force)
    , scheme(scheme)
    , body_names(body_names)
    , linear_solver(parameters, {dim, false, scheme.dynamic})
  {}



  template <int dim>
  void
  SolidProblem<dim>::reinit(const BackgroundGrid<dim> &grid,
                            const ActiveNodes<dim>    &nodes,
                            const NodeConditions<dim> &conditions,
                            const NodeTies<dim>       &ties,
                            const StepPoints<dim>     &points,
                            const NodeMatrix<dim>     &mass,
                            const NodeMatrix<dim>     *ghost_stiffness,
                            const int                  stiffness_radius,
                            const bool                 new_pattern)
  {
    this->grid       = &grid;
    this->nodes      = &nodes;
    this->conditions = &conditions;
    this->ties       = &ties;
    this->points     = &points;
    this->mass       = &mass;
    this->penalty    = ghost_stiffness;
    if (!new_pattern)
      return;
    stiffness.reinit(nodes.n_local(), dim, stiffness_radius);
    status.resize(std::size_t(nodes.n_local()) * dim);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        status[std::size_t(i) * dim + d] = conditions.prescribed(i, d) ? NodalStatus::prescribed
                                           : ties.tie_of(i) >= 0       ? NodalStatus::tied
                                                                       : NodalStatus::free;
    equations.reinit(grid, nodes, ties, status, stiffness);
    linear_solver.pattern_changed();
  }



  template <int dim>
  void
  SolidProblem<dim>::start(NodalState &state, const double t_n, const double dt)
  {
    this->state = &state;
    this->t_n   = t_n;
    this->dt    = dt;
    warning_.clear();
    condition        = 0.;
    weakest_equation = -1;
    linear_tolerance = 0.;
    diagonal.assign(equations.system().n_rows(), 0.);
    internal.resize(state.displacement.size());
    inertia.assign(state.displacement.size(), 0.);
    acceleration.resize(state.displacement.size());
    residual.resize(state.displacement.size());
    set_prescribed_displacements();
    if (conditions->any_moving())
      follow_supports();
  }



  template <int dim>
  void
  SolidProblem<dim>::set_prescribed_displacements()
  {
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        if (conditions->prescribed(i, d))
          state->displacement[std::size_t(i) * dim + d] =
            conditions->increment(i, d, t_n, t_n + dt);
    ties->prolong(state->displacement);
  }



  /**
   * Where supports move, the first guess follows them: u_f = -K^-1 (r_f(0) +
   * K_fp u_p) with the tangent of the state at t_n and its product with the
   * prescribed u_p as a difference of residuals. Without it, the cells next to
   * the supports would start the iteration with all of the motion.
   */
  template <int dim>
  void
  SolidProblem<dim>::follow_supports()
  {
    const std::vector<double> supports_moved = state->displacement;
    constexpr double          part           = 1e-6;
    for (double &u : state->displacement)
      u *= part;
    bool ok = evaluate().ok;

    const std::vector<double> moved_a_little = residual;
    std::fill(state->displacement.begin(), state->displacement.end(), 0.);
    ok = evaluate().ok && ok;
    if (ok)
      {
        for (std::size_t i = 0; i < residual.size(); ++i)
          residual[i] += (moved_a_little[i] - residual[i]) / part;
        double norm = 0.;
        ok          = solve_correction(norm, false).success && std::isfinite(norm);
      }
    state->displacement = supports_moved;
    if (!ok)
      return;
    apply_correction(1.);
    if (!evaluate().ok)
      state->displacement = supports_moved;
  }



  template <int dim>
  NewtonProblem::Evaluation
  SolidProblem<dim>::evaluate()
  {
    const Stopwatch            stopwatch(timings_.residual);
    const auto                &window = grid->window();
    const std::vector<double> &u      = state->displacement;
    std::fill(internal.begin(), internal.end(), 0.);
    const PointStatus answer = internal_force.add_force(*points, window, *nodes, u, internal);
    if (penalty != nullptr)
      add_ghost_force();
    ties->restrict_sums(internal);
    nodes->add_to_owners(internal, dim);
    if (scheme.dynamic)
      {
        for (std::size_t i = 0; i < u.size(); ++i)
          acceleration[i] = scheme.equilibrium_acceleration(u[i],
                                                            state->velocity_n[i],
                                                            state->acceleration_n[i],
                                                            dt);
        multiply(*mass, window, *nodes, dim, acceleration, inertia);
        ties->restrict_sums(inertia);
        nodes->add_to_owners(inertia, dim);
      }

    // squares: residual, internal, inertia, external, diagonal times displacement; failures
    double sums[6] = {0, 0, 0, 0, 0, answer.ok() ? 0. : 1.};
    for (unsigned int e = 0; e < equations.system().n_rows(); ++e)
      {
        const unsigned int i = equations.nodal_index(e);
        const double       r = internal[i] + inertia[i] - state->external_force[i];
        sums[0] += r * r;
        sums[1] += internal[i] * internal[i];
        sums[2] += inertia[i] * inertia[i];
        sums[3] += state->external_force[i] * state->external_force[i];
        sums[4] += diagonal[e] * diagonal[e] * u[i] * u[i];
      }
    for (std::size_t i = 0; i < residual.size(); ++i)
      residual[i] = internal[i] + inertia[i] - state->external_force[i];
    MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, nodes->communicator());

    NewtonProblem::Evaluation result;
    result.residual_norm = std::sqrt(sums[0]);
    result.scale =
      std::sqrt(sums[1]) + std::sqrt(sums[2]) + std::sqrt(sums[3]) + std::sqrt(sums[4]);
    if (sums[5] > 0.)
      {
        result.ok    = false;
        result.cause = answer.ok() ? "a material point of another rank cannot follow the trial step"
                                   : describe_point(answer.failed_slot);
      }
    else if (!std::isfinite(sums[0]))
      {
        result.ok    = false;
        result.cause = "the residual is not finite";
      }
    return result;
  }



  template <int dim>
  void
  SolidProblem<dim>::add_ghost_force()
  {
    std::vector<double> force(internal.size());
    multiply(*penalty, grid->window(), *nodes, dim, state->displacement, force);
    for (std::size_t i = 0; i < force.size(); ++i)
      internal[i] += scheme.alpha_f * force[i];
  }



  template <int dim>
  void
  SolidProblem<dim>::add_to_diagonal_blocks(const double coefficient, const NodeMatrix<dim> &matrix)
  {
    std::vector<unsigned int> slots(matrix.n_slots()); // of the matrix, in the wider stiffness
    for (unsigned int s = 0; s < slots.size(); ++s)
      slots[s] = stiffness.slot(matrix.offset(s));
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        const double *matrix_row = matrix.row(i, 0);
        for (int p = 0; p < dim; ++p)
          {
            double *row = stiffness.row(i, p);
            for (unsigned int s = 0; s < slots.size(); ++s)
              row[slots[s] * dim + p] += coefficient * matrix_row[s];
          }
      }
  }



  template <int dim>
  void
  SolidProblem<dim>::assemble_tangent()
  {
    const Stopwatch stopwatch(timings_.tangent);
    stiffness.set_zero();
    internal_force.add_stiffness(*points, grid->window(), *nodes, state->displacement, stiffness);
    if (penalty != nullptr)
      add_to_diagonal_blocks(scheme.alpha_f, *penalty);
    if (scheme.dynamic)
      add_to_diagonal_blocks(scheme.inertia_coefficient(dt), *mass);
    equations.fill(*nodes, stiffness);
    const SparseSystem &system = equations.system();
    for (unsigned int e = 0; e < system.n_rows(); ++e)
      for (std::int64_t k = system.row_start[e]; k < system.row_start[e + 1]; ++k)
        if (system.column[k] == system.first_row + e)
          diagonal[e] = system.value[k];
  }



  template <int dim>
  LinearStatus
  SolidProblem<dim>::solve_correction(double &norm, const bool keep_tangent)
  {
    if (!keep_tangent)
      assemble_tangent();

    const Stopwatch     stopwatch(timings_.linear_solve);
    std::vector<double> right_side, solution;
    equations.gather(residual, right_side);
    for (double &value : right_side)
      value = -value;
    LinearStatus status;
    if (!keep_tangent)
      status = linear_solver.factorise(equations.system());
    if (!status.success && status.equation >= 0)
      {
        // barely held nodes: what no force determines stays where it is
        warning_ = status.cause + describe_equation(status.equation);
        status   = linear_solver.factorise(equations.system(), singular_shift);
      }
    else if (!keep_tangent && status.condition_estimate > condition)
      {
        condition          = status.condition_estimate;
        weakest_equation   = status.weakest_equation;
        largest_condition_ = std::max(largest_condition_, condition);
      }
    if (status.success)
      status = linear_solver.solve(right_side, solution, linear_tolerance);
    if (!status.success)
      return status;
    equations.scatter(solution, correction);
    nodes->update_ghosts(correction, dim);
    ties->prolong(correction);
    double square = 0.;
    for (const double value : solution)
      square += value * value;
    norm = std::sqrt(dealii::Utilities::MPI::sum(square, nodes->communicator()));
    return status;
  }



  template <int dim>
  void
  SolidProblem<dim>::apply_correction(const double factor)
  {
    for (std::size_t i = 0; i < correction.size(); ++i)
      state->displacement[i] += factor * correction[i];
  }



  template <int dim>
  double
  SolidProblem<dim>::reaction_work() const
  {
    double work = 0.;
    for (unsigned int i = 0; i < nodes->n_owned() * dim; ++i)
      if (status[i] == NodalStatus::prescribed)
        work += residual[i] * state->displacement[i];
    return dealii::Utilities::MPI::sum(work, nodes->communicator());
  }



  template <int dim>
  std::vector<double>
  SolidProblem<dim>::reactions() const
  {
    std::vector<double> forces(std::size_t(conditions->size()) * dim, 0.);
    for (unsigned int i = 0; i < nodes->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        if (conditions->prescribed(i, d))
          forces[conditions->condition(i, d) * dim + d] += residual[std::size_t(i) * dim + d];
    dealii::Utilities::MPI::sum(forces, nodes->communicator(), forces);
    return forces;
  }



  template <int dim>
  std::string
  SolidProblem<dim>::diagnosis() const
  {
    if (!warning_.empty() || condition < suspicious_condition)
      return warning_;
    std::ostringstream text;
    text << std::scientific << std::setprecision(0) << "the tangent is nearly singular (condition "
         << condition << ")" << describe_equation(weakest_equation);
    return text.str();
  }



  template <int dim>
  std::string
  SolidProblem<dim>::describe_point(const unsigned int slot) const
  {
    std::ostringstream text;
    unsigned int       body = 0;
    for (const auto &batch : points->batches)
      if (slot >= batch.begin && slot < batch.end)
        body = batch.body;
    text << "material point " << points->id[slot] << " of body '" << body_names[body] << "' at ("
         << points->location[slot] << ") has det F <= 0 or no finite stress";
    return text.str();
  }



  template <int dim>
  std::string
  SolidProblem<dim>::describe_equation(const std::int64_t equation) const
  {
    if (equation < 0)
      return "";
    const SparseSystem &system         = equations.system();
    double              place[dim + 2] = {};
    if (equation >= system.first_row && equation < system.first_row + system.n_rows())
      {
        const unsigned int nodal =
          equations.nodal_index(static_cast<unsigned int>(equation - system.first_row));
        const auto x =
          grid->lattice().node_position(grid->window().node_index(nodes->window_node(nodal / dim)));
        for (int d = 0; d < dim; ++d)
          place[d] = x[d];
        place[dim] = nodal % dim;
      }
    MPI_Allreduce(MPI_IN_PLACE, place, dim + 2, MPI_DOUBLE, MPI_SUM, nodes->communicator());
    std::ostringstream text;
    text << ": nothing holds the displacement component "
         << "xyz"[static_cast<int>(place[dim])] << " of the node at (";
    for (int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "") << place[d];
    text << "), in the cells around it the body is too thin or too loosely held";
    return text.str();
  }

  template class SolidProblem<2>;
  template class SolidProblem<3>;
} // namespace kedge
