#include <kedge/transfer/velocity_mapping.h>

namespace kedge
{
  namespace
  {
    /**
     * Where points are too few to tell all nodal velocities apart the mass
     * matrix is singular. Its diagonal is then raised by this part, and the
     * solution is iterated back to the unchanged matrix: momentum and energy
     * stay exact, the undetermined part stays small.
     */
    constexpr double       diagonal_shift      = 1e-12;
    constexpr unsigned int n_shift_corrections = 4;

    std::vector<double>
    multiply(const SparseSystem &system, const std::vector<double> &x)
    {
      // direct methods only: rows of one rank see the whole vector when there is one rank
      std::vector<double> all(system.n_global, 0.);
      std::copy(x.begin(), x.end(), all.begin() + system.first_row);
      int n_ranks;
      MPI_Comm_size(system.communicator, &n_ranks);
      if (n_ranks > 1)
        MPI_Allreduce(MPI_IN_PLACE,
                      all.data(),
                      static_cast<int>(all.size()),
                      MPI_DOUBLE,
                      MPI_SUM,
                      system.communicator);
      std::vector<double> y(system.n_rows(), 0.);
      for (unsigned int i = 0; i < y.size(); ++i)
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          y[i] += system.value[k] * all[system.column[k]];
      return y;
    }
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
        parameters.tolerance      = 1e-15;
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
      component.equations.fill(nodes, mass);
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::factorise(Component &component)
  {
    component.is_shifted = false;
    LinearStatus status  = component.solver->factorise(component.equations.system());
    if (status.success)
      return status;

    component.is_shifted = true;
    return component.solver->factorise(component.equations.system(), diagonal_shift);
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::solve_component(Component                 &component,
                                        const std::vector<double> &right_side,
                                        std::vector<double>       &solution)
  {
    LinearStatus status = component.solver->solve(right_side, solution);
    if (component.is_shifted)
      for (unsigned int k = 0; status.success && k < n_shift_corrections; ++k)
        {
          std::vector<double> defect = multiply(component.equations.system(), solution);
          for (unsigned int i = 0; i < defect.size(); ++i)
            defect[i] = right_side[i] - defect[i];
          std::vector<double> correction;
          status = component.solver->solve(defect, correction);
          for (unsigned int i = 0; i < defect.size(); ++i)
            solution[i] += correction[i];
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
              status = solve_component(component, right_side, solution);
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
