#include <kedge/transfer/velocity_mapping.h>

namespace kedge
{
  namespace
  {
    /**
     * Where points are too few to tell all nodal velocities apart the mass
     * matrix is singular, or nearly so. This part of the lumped mass is added
     * to its diagonal, and the solution is iterated back to the unchanged
     * matrix: momentum and energy stay exact, while what is undetermined
     * stays small. It must be the lumped mass: at a node that hardly any mass
     * reaches it is of the order m N, far above the diagonal's m N^2.
     */
    constexpr double lumped_shift = 1e-13;

    /** Corrections end at this part of the solution's energy, or at this number. */
    constexpr double       relative_tolerance = 1e-15;
    constexpr unsigned int most_corrections   = 7;

    /** Conjugate gradients end at this part of the defect's norm, first and later, or give up. */
    constexpr double       first_tolerance = 1e-9;
    constexpr double       later_tolerance = 1e-6;
    constexpr unsigned int most_iterations = 400;
    constexpr double       longest_step    = 1e3;
  } // namespace



  template <int dim>
  void
  VelocityMapping<dim>::reinit(const BackgroundGrid<dim> &grid,
                               const ActiveNodes<dim>    &nodes,
                               const NodeConditions<dim> &conditions,
                               const NodeTies<dim>       &ties,
                               const NodeMatrix<dim>     &mass,
                               const bool                 new_pattern)
  {
    if (new_pattern)
      {
        find_components(conditions, nodes, ties);
        neighbours = node_neighbours(mass, grid.window(), nodes);
      }
    set_scaling(nodes, ties, mass);
    is_hard = false;
    for (Component &component : components)
      component.is_factorised = false;
  }



  template <int dim>
  void
  VelocityMapping<dim>::find_components(const NodeConditions<dim> &conditions,
                                        const ActiveNodes<dim>    &nodes,
                                        const NodeTies<dim>       &ties)
  {
    components.clear();
    for (int d = 0; d < dim; ++d)
      {
        std::vector<NodalStatus> status(nodes.n_local());
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          status[i] = conditions.prescribed(i, d) ? NodalStatus::prescribed
                      : ties.tie_of(i, d) >= 0    ? NodalStatus::tied
                                                  : NodalStatus::free;
        unsigned int c = 0;
        int          same;
        for (; c < components.size(); ++c)
          {
            same = components[c].status == status;
            MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_MIN, nodes.communicator());
            if (same)
              break;
          }
        component_of_direction[d] = c;
        if (c == components.size())
          {
            components.emplace_back();
            components[c].status = std::move(status);
          }
      }
  }



  template <int dim>
  void
  VelocityMapping<dim>::set_scaling(const ActiveNodes<dim> &nodes,
                                    const NodeTies<dim>    &ties,
                                    const NodeMatrix<dim>  &mass)
  {
    std::vector<double> lumped(nodes.n_local(), 0.);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      for (unsigned int s = 0; s < mass.n_slots(); ++s)
        lumped[i] += std::abs(mass.row(i, 0)[s]);
    for (unsigned int t = 0; t < ties.ties().size(); ++t)
      {
        const auto &tie = ties.ties()[t];
        if (ties.tie_of(tie.node) == static_cast<int>(t)) // not of pressures alone
          for (unsigned int k = 0; k < tie.roots.size(); ++k)
            lumped[tie.roots[k]] += std::abs(tie.weights[k]) * lumped[tie.node];
      }
    nodes.add_to_owners(lumped, 1);
    inverse_lumped.assign(lumped.size() * dim, 0.);
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        if (components[component_of_direction[d]].status[i] == NodalStatus::free && lumped[i] > 0.)
          inverse_lumped[std::size_t(i) * dim + d] = 1. / lumped[i];
  }



  /** C^T M~ C of values at the free nodes; what is tied or a ghost in @p nodal is set here. */
  template <int dim>
  void
  VelocityMapping<dim>::apply_mass(const ActiveNodes<dim> &nodes,
                                   const NodeTies<dim>    &ties,
                                   const NodeMatrix<dim>  &mass,
                                   std::vector<double>    &nodal,
                                   std::vector<double>    &product) const
  {
    nodes.update_ghosts(nodal, dim);
    ties.prolong(nodal);
    multiply(mass, neighbours, nodal, product);
    ties.restrict_sums(product);
    nodes.add_to_owners(product, dim);
  }



  /**
   * Conjugate gradients for C^T M~ C correction = defect with the lumped mass
   * as preconditioner, which leaves small what the points do not determine;
   * false if they do not get there (collective).
   *
   * @param energy correction . defect, over all ranks
   */
  template <int dim>
  bool
  VelocityMapping<dim>::iterate(const ActiveNodes<dim> &nodes,
                                const NodeTies<dim>    &ties,
                                const NodeMatrix<dim>  &mass,
                                const double            tolerance,
                                std::vector<double>     residual,
                                std::vector<double>    &correction,
                                double                 &energy) const
  {
    const std::size_t   n_owned = std::size_t(nodes.n_owned()) * dim;
    std::vector<double> direction(residual.size(), 0.), product(residual.size());
    correction.assign(residual.size(), 0.);
    const auto squared_norm = [&](const std::vector<double> &r) {
      double sum = 0.;
      for (std::size_t i = 0; i < n_owned; ++i)
        sum += r[i] * r[i] * inverse_lumped[i];
      return dealii::Utilities::MPI::sum(sum, nodes.communicator());
    };
    energy             = 0.;
    const double first = squared_norm(residual);
    double       norm = first, before = 1.;
    for (unsigned int k = 0; k < most_iterations && norm > 0.; ++k)
      {
        if (norm <= tolerance * tolerance * first)
          break;
        const double beta = k == 0 ? 0. : norm / before;
        for (std::size_t i = 0; i < n_owned; ++i)
          direction[i] = inverse_lumped[i] * residual[i] + beta * direction[i];
        apply_mass(nodes, ties, mass, direction, product);
        double curvature = 0.;
        for (std::size_t i = 0; i < n_owned; ++i)
          if (inverse_lumped[i] != 0.)
            curvature += direction[i] * product[i];
        curvature = dealii::Utilities::MPI::sum(curvature, nodes.communicator());
        if (!(curvature > 0.))
          return false;
        // its inverse lies among the eigenvalues of the scaled matrix: none may be tiny
        const double alpha = norm / curvature;
        if (alpha > longest_step)
          return false;
        for (std::size_t i = 0; i < n_owned; ++i)
          if (inverse_lumped[i] != 0.)
            {
              correction[i] += alpha * direction[i];
              residual[i] -= alpha * product[i];
            }
        energy += alpha * norm;
        before = norm;
        norm   = squared_norm(residual);
      }
    return norm <= tolerance * tolerance * first;
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::factorise_all(const BackgroundGrid<dim> &grid,
                                      const ActiveNodes<dim>    &nodes,
                                      const NodeTies<dim>       &ties,
                                      const NodeMatrix<dim>     &mass)
  {
    LinearSolverParameters parameters;
    parameters.tolerance      = 1e-10; // the corrections do the rest
    parameters.max_iterations = 2000;
    MatrixTraits traits;
    traits.space_dimension      = dim;
    traits.positive_definite    = true;
    traits.dominated_by_inertia = true;
    for (Component &component : components)
      if (!component.is_factorised)
        {
          if (!component.has_pattern)
            {
              component.equations.reinit(grid, nodes, ties, component.status, mass);
              component.solver      = std::make_unique<LinearSolver>(parameters, traits);
              component.has_pattern = true;
            }
          component.equations.fill(nodes, mass);
          const LinearStatus status = factorise(component);
          if (!status.success)
            return status;
        }
    return {};
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::factorise(Component &component)
  {
    SparseSystem &raised = component.raised;
    raised               = component.equations.system();
    for (unsigned int i = 0; i < raised.n_rows(); ++i)
      {
        double lumped = 0.;
        for (std::int64_t k = raised.row_start[i]; k < raised.row_start[i + 1]; ++k)
          lumped += std::abs(raised.value[k]);
        for (std::int64_t k = raised.row_start[i]; k < raised.row_start[i + 1]; ++k)
          if (raised.column[k] == raised.first_row + i)
            raised.value[k] += lumped_shift * lumped;
      }
    const LinearStatus status = component.solver->factorise(raised);
    component.is_factorised   = status.success;
    return status;
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::correct(const std::vector<double> &defect,
                                std::vector<double>       &nodal,
                                double                    &energy)
  {
    energy = 0.;
    std::vector<double> right_side, correction;
    for (int d = 0; d < dim; ++d)
      {
        Component  &component = components[component_of_direction[d]];
        const auto &equations = component.equations;
        right_side.resize(equations.system().n_rows());
        for (unsigned int e = 0; e < right_side.size(); ++e)
          right_side[e] = defect[std::size_t(equations.nodal_index(e)) * dim + d];
        const LinearStatus status = component.solver->solve(right_side, correction);
        if (!status.success)
          return status;
        for (unsigned int e = 0; e < right_side.size(); ++e)
          {
            nodal[std::size_t(equations.nodal_index(e)) * dim + d] += correction[e];
            energy += correction[e] * right_side[e];
          }
      }
    return {};
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::solve(const BackgroundGrid<dim> &grid,
                              const ActiveNodes<dim>    &nodes,
                              const NodeTies<dim>       &ties,
                              const NodeMatrix<dim>     &mass,
                              const std::vector<double> &momentum,
                              std::vector<double>       &nodal)
  {
    // start from zero where nothing is prescribed
    for (int d = 0; d < dim; ++d)
      {
        const auto &status = components[component_of_direction[d]].status;
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          if (status[i] != NodalStatus::prescribed)
            nodal[std::size_t(i) * dim + d] = 0.;
      }

    double              whole = 0.;
    std::vector<double> defect(nodal.size()), correction;
    for (unsigned int k = 0; k < most_corrections; ++k)
      {
        apply_mass(nodes, ties, mass, nodal, defect);
        for (std::size_t i = 0; i < defect.size(); ++i)
          defect[i] = momentum[i] - defect[i];

        const double tolerance = k == 0 ? first_tolerance : later_tolerance;
        double       energy    = 0.;
        is_hard = is_hard || !iterate(nodes, ties, mass, tolerance, defect, correction, energy);
        if (is_hard)
          {
            LinearStatus status = factorise_all(grid, nodes, ties, mass);
            if (status.success)
              status = correct(defect, nodal, energy);
            if (!status.success)
              return status;
            energy = dealii::Utilities::MPI::sum(energy, nodes.communicator());
          }
        else
          for (std::size_t i = 0; i < std::size_t(nodes.n_owned()) * dim; ++i)
            nodal[i] += correction[i];
        if (k == 0)
          whole = energy;
        if (whole == 0. || (k > 0 && !(energy > relative_tolerance * whole)))
          break;
      }
    nodes.update_ghosts(nodal, dim);
    ties.prolong(nodal);
    return {};
  }

  template class VelocityMapping<2>;
  template class VelocityMapping<3>;
} // namespace kedge
