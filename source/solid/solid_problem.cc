#include <kedge/solid/solid_problem.h>

namespace kedge
{
  namespace
  {
    /** A tangent worse than this may be why Newton's method fails. */
    constexpr double suspicious_condition = 1e9;
  } // namespace



  template <int dim>
  SolidProblem<dim>::SolidProblem(const InternalForce<dim>       &internal_force,
                                  const Scheme                   &scheme,
                                  const LinearSolverParameters   &parameters,
                                  const std::vector<std::string> &body_names)
    : Balance<dim>(dim, suspicious_condition, parameters, {dim, false, scheme.dynamic}, body_names)
    , internal_force(internal_force)
    , scheme(scheme)
  {}



  template <int dim>
  void
  SolidProblem<dim>::start(NodalState &state, const double t_n, const double dt)
  {
    this->begin_step(state, t_n, dt);
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
        ok          = this->solve_correction(norm, false).success && std::isfinite(norm);
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
    if (ghosts != nullptr)
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

    NewtonProblem::Evaluation result = this->conclude(sums[0], sums[5], answer);
    result.scale =
      std::sqrt(sums[1]) + std::sqrt(sums[2]) + std::sqrt(sums[3]) + std::sqrt(sums[4]);
    return result;
  }



  template <int dim>
  void
  SolidProblem<dim>::add_ghost_force()
  {
    std::vector<double> force(internal.size());
    multiply(ghosts->stiffness, grid->window(), *nodes, dim, state->displacement, force);
    for (std::size_t i = 0; i < force.size(); ++i)
      internal[i] += scheme.alpha_f * force[i];
  }



  template <int dim>
  void
  SolidProblem<dim>::assemble_tangent()
  {
    const Stopwatch stopwatch(timings_.tangent);
    tangent.set_zero();
    internal_force.add_stiffness(*points, grid->window(), *nodes, state->displacement, tangent);
    if (ghosts != nullptr)
      this->add_to_diagonal_blocks(scheme.alpha_f, ghosts->stiffness, 0, dim);
    if (scheme.dynamic)
      this->add_to_diagonal_blocks(scheme.inertia_coefficient(dt), *mass, 0, dim);
    equations.fill(*nodes, tangent);
    const SparseSystem &system = equations.system();
    for (unsigned int e = 0; e < system.n_rows(); ++e)
      for (std::int64_t k = system.row_start[e]; k < system.row_start[e + 1]; ++k)
        if (system.column[k] == system.first_row + e)
          diagonal[e] = system.value[k];
  }



  template <int dim>
  void
  SolidProblem<dim>::apply_correction(const double factor)
  {
    for (std::size_t i = 0; i < correction.size(); ++i)
      state->displacement[i] += factor * correction[i];
  }

  template class SolidProblem<2>;
  template class SolidProblem<3>;
} // namespace kedge
