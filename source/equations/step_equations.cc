#include <kedge/equations/step_equations.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace kedge
{
  namespace
  {
    /** Raises the scaled diagonal of a singular tangent; Newton's residual stays exact. */
    constexpr double singular_shift = 1e-10;

    /** So many unknowns that belong to no node iterative methods take beside the others. */
    constexpr unsigned int largest_border = 64;

    /** Part of the supports' motion by which the residual's slope is taken. */
    constexpr double small_part = 1e-6;
  } // namespace



  template <int dim>
  StepEquations<dim>::StepEquations(const std::vector<const Patch<dim> *> &patches,
                                    const Unknowns<dim>                   &unknowns,
                                    Terms<dim>                            &terms,
                                    const Scheme                          &scheme,
                                    const LinearSolverParameters          &parameters)
    : patches(patches)
    , unknowns(unknowns)
    , terms(terms)
    , scheme(scheme)
    , tangent(patches, unknowns)
    , residual(patches, unknowns, tangent)
    , diagonal(patches.size())
    , linear_solver(parameters, unknowns.traits)
  {}



  template <int dim>
  void
  StepEquations<dim>::reinit(const std::vector<int> &radius)
  {
    tangent.reinit(radius);
    residual.reinit();
  }



  template <int dim>
  void
  StepEquations<dim>::start(Trial<dim> &trial, const double t_pressure)
  {
    this->trial = &trial;
    warning.clear();
    condition        = 0.;
    weakest_equation = -1;
    linear_tolerance = 0.;
    tell_solver      = true;
    for (unsigned int f = 0; f < patches.size(); ++f)
      diagonal[f].assign(tangent.equations_of_field(f).size(), 0.);

    const UnknownVector at_rest = trial.unknowns;
    bool                moves   = false;
    for (unsigned int f = 0; f < patches.size(); ++f)
      {
        patches[f]->constraints.prescribe(trial.times.t_n,
                                          trial.times.dt,
                                          t_pressure,
                                          trial.unknowns.fields[f]);
        moves = moves || patches[f]->conditions.any_moving();
      }
    trial.follow(scheme);
    if (moves)
      follow_supports(at_rest);
  }



  /**
   * Where supports move, the first guess follows them: x_f = -K^-1 (r_f(0) +
   * K_fp x_p) with the tangent of the state at t_n and its product with the
   * prescribed x_p as a difference of residuals. Without it, the cells next to
   * the supports would start the iteration with all of the motion.
   */
  template <int dim>
  void
  StepEquations<dim>::follow_supports(const UnknownVector &at_rest)
  {
    const UnknownVector supports_moved = trial->unknowns;
    const auto          set            = [&](const UnknownVector &x) {
      trial->unknowns = x;
      trial->follow(scheme);
      return evaluate().ok;
    };
    UnknownVector moved_a_little = at_rest;
    for (std::size_t f = 0; f < patches.size(); ++f)
      for (std::size_t k = 0; k < at_rest.fields[f].size(); ++k)
        moved_a_little.fields[f][k] +=
          small_part * (supports_moved.fields[f][k] - at_rest.fields[f][k]);
    bool ok = set(moved_a_little);

    UnknownVector linearised = residual.all();
    ok                       = set(at_rest) && ok;
    if (ok)
      {
        for (std::size_t f = 0; f < patches.size(); ++f)
          {
            const auto &here = residual.of_field(f);
            auto       &r    = linearised.fields[f];
            for (std::size_t k = 0; k < here.size(); ++k)
              r[k] = here[k] + (r[k] - here[k]) / small_part;
          }
        const std::vector<double> &here = residual.others();
        for (std::size_t k = 0; k < here.size(); ++k)
          linearised.others[k] = here[k] + (linearised.others[k] - here[k]) / small_part;
        replaced_residual = std::move(linearised);
        double norm       = 0.;
        ok                = solve_correction(norm, false).success && std::isfinite(norm);
        replaced_residual.reset();
      }
    if (ok)
      {
        base = supports_moved;
        retract(1.);
        ok = evaluate().ok;
      }
    if (!ok)
      {
        trial->unknowns = supports_moved;
        trial->follow(scheme);
      }
  }



  template <int dim>
  NewtonProblem::Evaluation
  StepEquations<dim>::evaluate()
  {
    const Stopwatch stopwatch(timings_.residual);
    residual.set_zero();
    std::string  cause;
    unsigned int n_failed = 0;
    for (auto &term : terms)
      {
        const Answer answer = term->add_residual(*trial, residual);
        residual.end_term();
        if (answer.ok)
          continue;
        ++n_failed;
        if (cause.empty())
          cause = answer.cause + " (" + term->name() + ")";
      }
    NewtonProblem::Evaluation result = residual.end(diagonal, trial->unknowns, n_failed);
    if (n_failed > 0)
      result.cause = cause;
    else if (!result.ok)
      result.cause = std::isfinite(result.residual_norm)
                       ? "a material point of another rank cannot follow the trial step"
                       : "the residual is not finite";
    return result;
  }



  template <int dim>
  const Residual<dim> &
  StepEquations<dim>::residual_at_rest(const double t)
  {
    residual.set_zero();
    for (auto &term : terms)
      {
        term->add_residual_at_rest(t, residual);
        residual.end_term();
      }
    return residual;
  }



  template <int dim>
  void
  StepEquations<dim>::assemble_tangent()
  {
    const Stopwatch stopwatch(timings_.tangent);
    tangent.set_zero();
    for (auto &term : terms)
      term->add_tangent(*trial, tangent);
    tangent.assemble();
    if (tangent.take_new_pattern())
      {
        linear_solver.pattern_changed();
        describe_nodes();
        tell_solver = true;
      }
    if (tell_solver && displacements.dim == dim)
      linear_solver.set_blocks(displacements);
    tell_solver = false;
    for (unsigned int f = 0; f < patches.size(); ++f)
      if (unknowns.fields[f].measure_diagonal)
        diagonal[f] = tangent.diagonal(f);
    for (auto &term : terms)
      term->prepare_solver(*trial, tangent, linear_solver);
  }



  /** Whose displacements the equations of a new pattern are, if they are nothing else. */
  template <int dim>
  void
  StepEquations<dim>::describe_nodes()
  {
    displacements     = MixedBlocks();
    displacements.dim = 0; // not known
    for (const auto &field : unknowns.fields)
      if (field.n_components != dim)
        return;
    if (unknowns.n_others() > 0 &&
        (unknowns.n_others() > largest_border ||
         dealii::Utilities::MPI::n_mpi_processes(tangent.system().communicator) > 1))
      return;
    displacements.dim      = dim;
    displacements.n_others = unknowns.n_others();
    for (unsigned int f = 0; f < patches.size(); ++f)
      for (const unsigned int k : tangent.equations_of_field(f))
        {
          const auto x = patches[f]->node_position(k / dim);
          displacements.component.push_back(static_cast<unsigned char>(k % dim));
          displacements.position.insert(displacements.position.end(), x.begin_raw(), x.end_raw());
        }
  }



  template <int dim>
  LinearStatus
  StepEquations<dim>::factorise()
  {
    LinearStatus answer = linear_solver.factorise(tangent.system());
    if (!answer.success && answer.equation >= 0)
      {
        // barely held nodes: what nothing determines stays where it is
        warning = answer.cause + describe_equation(answer.equation);
        answer  = linear_solver.factorise(tangent.system(), singular_shift);
      }
    else if (answer.condition_estimate > condition)
      {
        condition          = answer.condition_estimate;
        weakest_equation   = answer.weakest_equation;
        largest_condition_ = std::max(largest_condition_, condition);
      }
    return answer;
  }



  template <int dim>
  LinearStatus
  StepEquations<dim>::solve_correction(double &norm, const bool keep_tangent)
  {
    if (!keep_tangent)
      assemble_tangent();

    const Stopwatch     stopwatch(timings_.linear_solve);
    std::vector<double> solution;
    std::vector<double> right_side =
      tangent.gather(replaced_residual ? *replaced_residual : residual.all());
    for (double &value : right_side)
      value = -value;
    LinearStatus answer;
    if (!keep_tangent)
      answer = factorise();
    if (answer.success)
      answer = linear_solver.solve(right_side, solution, linear_tolerance);
    if (!answer.success)
      return answer;
    tangent.scatter(solution, correction);
    base          = trial->unknowns;
    double square = 0.;
    for (unsigned int e = 0; e < solution.size(); ++e)
      square += std::pow(solution[e] / tangent.weight_of_equation(e), 2);
    norm = std::sqrt(dealii::Utilities::MPI::sum(square, patches.front()->nodes.communicator()));
    return answer;
  }



  template <int dim>
  void
  StepEquations<dim>::retract(const double factor)
  {
    unknowns.retract(base, factor, correction, trial->unknowns);
    trial->follow(scheme);
  }



  template <int dim>
  std::string
  StepEquations<dim>::diagnosis() const
  {
    if (!warning.empty() || condition < unknowns.suspicious_condition)
      return warning;
    std::ostringstream text;
    text << std::scientific << std::setprecision(0) << "the tangent is nearly singular (condition "
         << condition << ")" << describe_equation(weakest_equation);
    return text.str();
  }



  template <int dim>
  std::string
  StepEquations<dim>::describe_equation(const std::int64_t equation) const
  {
    if (equation < 0)
      return "";
    const SparseSystem &system         = tangent.system();
    double              place[dim + 2] = {};
    if (equation >= system.first_row && equation < system.first_row + system.n_rows())
      {
        const UnknownIndex index =
          tangent.unknown(static_cast<unsigned int>(equation - system.first_row));
        if (index.field == UnknownIndex::no_field)
          place[dim] = dim + 1;
        else
          {
            const auto x = patches[index.field]->node_position(index.node);
            for (int d = 0; d < dim; ++d)
              place[d] = x[d];
            place[dim] = index.component;
          }
      }
    MPI_Allreduce(MPI_IN_PLACE,
                  place,
                  dim + 2,
                  MPI_DOUBLE,
                  MPI_SUM,
                  patches.front()->nodes.communicator());
    const int component = static_cast<int>(place[dim]);
    if (component > dim)
      return ": nothing determines an unknown beside those of the nodes";
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

  template class StepEquations<2>;
  template class StepEquations<3>;
} // namespace kedge
