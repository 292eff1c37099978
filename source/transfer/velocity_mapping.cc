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
    constexpr unsigned int most_corrections   = 6;
  } // namespace



  template <int dim>
  void
  VelocityMapping<dim>::reinit(const BackgroundGrid<dim> &grid,
                               const ActiveNodes<dim>    &nodes,
                               const NodeConditions<dim> &conditions,
                               const NodeTies<dim>       &ties,
                               NodeMatrix<dim>           &mass,
                               const bool                 new_pattern)
  {
    if (new_pattern)
      {
        components.clear();
        LinearSolverParameters parameters;
        parameters.tolerance      = 1e-10; // the corrections do the rest
        parameters.max_iterations = 2000;
        MatrixTraits traits;
        traits.space_dimension      = dim;
        traits.positive_definite    = true;
        traits.dominated_by_inertia = true;
        for (int d = 0; d < dim; ++d)
          {
            std::vector<NodalStatus> status(nodes.n_local());
            for (unsigned int i = 0; i < nodes.n_local(); ++i)
              status[i] = conditions.prescribed(i, d) ? NodalStatus::prescribed
                          : ties.tie_of(i) >= 0       ? NodalStatus::tied
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
                components[c].equations.reinit(grid, nodes, ties, components[c].status, mass);
                components[c].solver = std::make_unique<LinearSolver>(parameters, traits);
              }
          }
      }
    for (Component &component : components)
      {
        component.equations.fill(nodes, mass);
        component.is_factorised = false;
      }
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::factorise(Component &component)
  {
    if (component.is_factorised)
      return {};
    SparseSystem &raised = component.raised;
    raised               = component.equations.system();
    for (unsigned int i = 0; i < raised.n_rows(); ++i)
      {
        double lumped = 0.;
        for (std::int64_t k = raised.row_start[i]; k < raised.row_start[i + 1]; ++k)
          lumped += raised.value[k];
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
  VelocityMapping<dim>::solve_component(const BackgroundGrid<dim> &grid,
                                        const ActiveNodes<dim>    &nodes,
                                        const NodeTies<dim>       &ties,
                                        const NodeMatrix<dim>     &mass,
                                        const int                  direction,
                                        Component                 &component,
                                        const std::vector<double> &right_side,
                                        std::vector<double>       &solution)
  {
    LinearStatus        status = component.solver->solve(right_side, solution);
    std::vector<double> nodal(std::size_t(nodes.n_local()) * dim, 0.), product(nodal.size());
    std::vector<double> defect(right_side.size()), correction;
    const auto          index = [&](const unsigned int equation) {
      return std::size_t(component.equations.nodal_index(equation)) * dim + direction;
    };
    for (unsigned int k = 0; status.success && k < most_corrections; ++k)
      {
        // C^T M~ C, as the equations have it
        for (unsigned int e = 0; e < solution.size(); ++e)
          nodal[index(e)] = solution[e];
        nodes.update_ghosts(nodal, dim);
        ties.prolong(nodal);
        multiply(mass, grid.window(), nodes, dim, nodal, product);
        ties.restrict_sums(product);
        nodes.add_to_owners(product, dim);
        for (unsigned int e = 0; e < defect.size(); ++e)
          defect[e] = right_side[e] - product[index(e)];
        status = component.solver->solve(defect, correction);

        double energies[2] = {0., 0.}; // of the correction and of the whole
        for (unsigned int e = 0; e < defect.size(); ++e)
          {
            solution[e] += correction[e];
            energies[0] += correction[e] * defect[e];
            energies[1] += solution[e] * right_side[e];
          }
        MPI_Allreduce(MPI_IN_PLACE, energies, 2, MPI_DOUBLE, MPI_SUM, nodes.communicator());
        if (!(std::abs(energies[0]) > relative_tolerance * std::abs(energies[1])))
          break;
      }
    return status;
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
    // the prescribed values go to the right-hand side
    std::vector<double> known(nodal.size(), 0.);
    bool                any_known = false;
    for (int d = 0; d < dim; ++d)
      {
        const auto &status = components[component_of_direction[d]].status;
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          if (status[i] == NodalStatus::prescribed && nodal[std::size_t(i) * dim + d] != 0.)
            {
              known[std::size_t(i) * dim + d] = nodal[std::size_t(i) * dim + d];
              any_known                       = true;
            }
      }
    std::vector<double> of_known(nodal.size(), 0.);
    if (dealii::Utilities::MPI::logical_or(any_known, nodes.communicator()))
      {
        ties.prolong(known);
        multiply(mass, grid.window(), nodes, dim, known, of_known);
        ties.restrict_sums(of_known);
        nodes.add_to_owners(of_known, dim);
      }

    for (unsigned int c = 0; c < components.size(); ++c)
      {
        Component   &component = components[c];
        LinearStatus status    = factorise(component);
        for (int d = 0; d < dim && status.success; ++d)
          if (component_of_direction[d] == c)
            {
              std::vector<double> right_side(component.equations.system().n_rows()), solution;
              for (unsigned int e = 0; e < right_side.size(); ++e)
                {
                  const std::size_t i = std::size_t(component.equations.nodal_index(e)) * dim + d;
                  right_side[e]       = momentum[i] - of_known[i];
                }
              status = solve_component(grid, nodes, ties, mass, d, component, right_side, solution);
              for (unsigned int e = 0; e < right_side.size(); ++e)
                nodal[std::size_t(component.equations.nodal_index(e)) * dim + d] = solution[e];
            }
        if (!status.success)
          return status;
      }
    nodes.update_ghosts(nodal, dim);
    ties.prolong(nodal);
    return {};
  }

  template class VelocityMapping<2>;
  template class VelocityMapping<3>;
} // namespace kedge
