#include <kedge/solid/balance.h>

namespace kedge
{
  namespace
  {
    /** Raises the scaled diagonal of a singular tangent; Newton's residual stays exact. */
    constexpr double singular_shift = 1e-10;
  } // namespace



  template <int dim>
  Balance<dim>::Balance(const int                       n_components,
                        const double                    suspicious_condition,
                        const LinearSolverParameters   &parameters,
                        const MatrixTraits             &traits,
                        const std::vector<std::string> &body_names)
    : linear_solver(parameters, traits)
    , n_components(n_components)
    , suspicious_condition(suspicious_condition)
    , body_names(body_names)
  {
    weights.fill(1.);
  }



  template <int dim>
  void
  Balance<dim>::reinit(const BackgroundGrid<dim> &grid,
                       const ActiveNodes<dim>    &nodes,
                       const NodeConditions<dim> &conditions,
                       const NodeTies<dim>       &ties,
                       const StepPoints<dim>     &points,
                       const NodeMatrix<dim>     &mass,
                       const GhostMatrices<dim>  *ghosts,
                       const int                  stiffness_radius,
                       const bool                 new_pattern)
  {
    this->grid       = &grid;
    this->nodes      = &nodes;
    this->conditions = &conditions;
    this->ties       = &ties;
    this->points     = &points;
    this->mass       = &mass;
    this->ghosts     = ghosts;
    if (!new_pattern)
      return;
    tangent.reinit(nodes.n_local(), n_components, stiffness_radius);
    status.resize(std::size_t(nodes.n_local()) * n_components);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      for (int c = 0; c < n_components; ++c)
        {
          const bool prescribed =
            c < dim ? conditions.prescribed(i, c) : conditions.pressure_prescribed(i);
          status[std::size_t(i) * n_components + c] = ties.is_tied(i, c) ? NodalStatus::tied
                                                      : prescribed       ? NodalStatus::prescribed
                                                                         : NodalStatus::free;
        }
    equations.reinit(grid, nodes, ties, status, tangent);
    linear_solver.pattern_changed();
    pattern_changed();
  }



  template <int dim>
  void
  Balance<dim>::begin_step(NodalState &state, const double t_n, const double dt)
  {
    this->state = &state;
    this->t_n   = t_n;
    this->dt    = dt;
    warning_.clear();
    condition        = 0.;
    weakest_equation = -1;
    linear_tolerance = 0.;
  }



  template <int dim>
  void
  Balance<dim>::add_to_diagonal_blocks(const double           coefficient,
                                       const NodeMatrix<dim> &matrix,
                                       const int              first,
                                       const int              end)
  {
    std::vector<unsigned int> slots(matrix.n_slots()); // of the matrix, in the wider tangent
    for (unsigned int s = 0; s < slots.size(); ++s)
      slots[s] = tangent.slot(matrix.offset(s));
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      {
        const double *matrix_row = matrix.row(i, 0);
        for (int p = first; p < end; ++p)
          {
            double *row = tangent.row(i, p);
            for (unsigned int s = 0; s < slots.size(); ++s)
              row[slots[s] * n_components + p] += coefficient * matrix_row[s];
          }
      }
  }



  template <int dim>
  NewtonProblem::Evaluation
  Balance<dim>::conclude(const double       squared_norm,
                         const double       n_failed,
                         const PointStatus &answer) const
  {
    NewtonProblem::Evaluation result;
    result.residual_norm = std::sqrt(squared_norm);
    result.ok            = n_failed == 0. && std::isfinite(squared_norm);
    if (n_failed > 0.)
      result.cause = answer.ok() ? "a material point of another rank cannot follow the trial step"
                                 : describe_point(answer.failed_slot);
    else if (!result.ok)
      result.cause = "the residual is not finite";
    return result;
  }



  template <int dim>
  LinearStatus
  Balance<dim>::solve_correction(double &norm, const bool keep_tangent)
  {
    if (!keep_tangent)
      assemble_tangent();

    const Stopwatch     stopwatch(timings_.linear_solve);
    std::vector<double> right_side, solution;
    equations.gather(residual, right_side);
    for (double &value : right_side)
      value = -value;
    LinearStatus answer;
    if (!keep_tangent)
      answer = linear_solver.factorise(equations.system());
    if (!answer.success && answer.equation >= 0)
      {
        // barely held nodes: what nothing determines stays where it is
        warning_ = answer.cause + describe_equation(answer.equation);
        answer   = linear_solver.factorise(equations.system(), singular_shift);
      }
    else if (!keep_tangent && answer.condition_estimate > condition)
      {
        condition          = answer.condition_estimate;
        weakest_equation   = answer.weakest_equation;
        largest_condition_ = std::max(largest_condition_, condition);
      }
    if (answer.success)
      answer = linear_solver.solve(right_side, solution, linear_tolerance);
    if (!answer.success)
      return answer;
    equations.scatter(solution, correction);
    nodes->update_ghosts(correction, n_components);
    ties->prolong(correction, n_components);
    double square = 0.;
    for (unsigned int e = 0; e < solution.size(); ++e)
      square += std::pow(solution[e] / weights[equations.nodal_index(e) % n_components], 2);
    norm = std::sqrt(dealii::Utilities::MPI::sum(square, nodes->communicator()));
    return answer;
  }



  template <int dim>
  double
  Balance<dim>::reaction_work() const
  {
    double work = 0.;
    for (unsigned int i = 0; i < nodes->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        if (conditions->prescribed(i, d))
          work += residual[std::size_t(i) * n_components + d] *
                  state->displacement[std::size_t(i) * dim + d];
    return dealii::Utilities::MPI::sum(work, nodes->communicator());
  }



  template <int dim>
  std::vector<double>
  Balance<dim>::reactions() const
  {
    std::vector<double> forces(std::size_t(conditions->size()) * dim, 0.);
    for (unsigned int i = 0; i < nodes->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        if (conditions->prescribed(i, d))
          forces[conditions->condition(i, d) * dim + d] +=
            residual[std::size_t(i) * n_components + d];
    dealii::Utilities::MPI::sum(forces, nodes->communicator(), forces);
    return forces;
  }



  template <int dim>
  std::string
  Balance<dim>::diagnosis() const
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
  Balance<dim>::describe_point(const unsigned int slot) const
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
  Balance<dim>::describe_equation(const std::int64_t equation) const
  {
    if (equation < 0)
      return "";
    const SparseSystem &system         = equations.system();
    double              place[dim + 2] = {};
    if (equation >= system.first_row && equation < system.first_row + system.n_rows())
      {
        const unsigned int k =
          equations.nodal_index(static_cast<unsigned int>(equation - system.first_row));
        const auto x = grid->lattice().node_position(
          grid->window().node_index(nodes->window_node(k / n_components)));
        for (int d = 0; d < dim; ++d)
          place[d] = x[d];
        place[dim] = k % n_components;
      }
    MPI_Allreduce(MPI_IN_PLACE, place, dim + 2, MPI_DOUBLE, MPI_SUM, nodes->communicator());
    const int          component = static_cast<int>(place[dim]);
    std::ostringstream text;
    text << ": nothing holds the "
         << (component == dim ? std::string("pore pressure")
                              : std::string("displacement component ") + "xyz"[component])
         << " of the node at (";
    for (int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "") << place[d];
    text << "), in the cells around it the body is too thin or too loosely held";
    return text.str();
  }

  template class Balance<2>;
  template class Balance<3>;
} // namespace kedge
