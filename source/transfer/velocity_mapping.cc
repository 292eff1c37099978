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

    /**
     * Well conditioned systems need little more than these iterations. Others are factorised then,
     * if that is expected to take less time than as many more as the second number. (What decides
     * is counted, not measured: the same run takes the same way.)
     */
    constexpr unsigned int few_iterations   = 40;
    constexpr double       usual_iterations = 60.;

    /** Seconds of an iteration for each entry of the matrix and component, as in LinearSolver. */
    constexpr double time_of_entry = 8e-10;
    constexpr double longest_step  = 1e3;
  } // namespace



  template <int dim>
  void
  VelocityMapping<dim>::reinit(const Patch<dim> &patch, const NodeMatrix<dim> &mass)
  {
    this->patch = &patch;
    this->mass  = &mass;
    if (patch.new_pattern() || components.empty())
      find_components();
    std::vector<NodalStatus> status(std::size_t(patch.nodes.n_local()) * dim);
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
        status[std::size_t(i) * dim + d] = components[component_of_direction[d]].status[i];
    system.reinit(patch, mass, status, patch.new_pattern());
    is_hard = false;
    for (Component &component : components)
      component.is_factorised = false;
  }



  template <int dim>
  void
  VelocityMapping<dim>::find_components()
  {
    components.clear();
    for (int d = 0; d < dim; ++d)
      {
        std::vector<NodalStatus> status = patch->constraints.status_of(d);
        unsigned int             c      = 0;
        int                      same;
        for (; c < components.size(); ++c)
          {
            same = components[c].status == status;
            MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_MIN, patch->nodes.communicator());
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
  VelocityMapping<dim>::find_pattern(Component &component)
  {
    if (component.solver)
      return;
    LinearSolverParameters parameters;
    parameters.tolerance      = 1e-10; // the corrections do the rest
    parameters.max_iterations = 2000;
    MatrixTraits traits;
    traits.space_dimension      = dim;
    traits.positive_definite    = true;
    traits.dominated_by_inertia = true;
    component.solver            = std::make_unique<LinearSolver>(parameters, traits);
    component.equations.reinit(*patch, component.status, *mass);
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::factorise_all()
  {
    for (Component &component : components)
      if (!component.is_factorised)
        {
          find_pattern(component);
          component.equations.fill(*patch, *mass);
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



  /** Conjugate gradients; false where the system is to be factorised instead (collective). */
  template <int dim>
  bool
  VelocityMapping<dim>::iterate(const double               tolerance,
                                const std::vector<double> &defect,
                                std::vector<double>       &correction,
                                double                    &energy)
  {
    const auto is_cheaper = [&]() {
      double direct_time = 0.;
      for (Component &component : components)
        {
          find_pattern(component);
          direct_time += component.solver->direct_time(component.equations.system());
        }
      const double entries =
        dealii::Utilities::MPI::sum(static_cast<double>(mass->values().size()) * dim,
                                    patch->nodes.communicator());
      return direct_time > usual_iterations * time_of_entry * entries;
    };
    return system.iterate(
      {tolerance * system.norm(defect), most_iterations, longest_step, few_iterations, is_cheaper},
      defect,
      correction,
      energy);
  }



  template <int dim>
  LinearStatus
  VelocityMapping<dim>::solve(const std::vector<double> &momentum, std::vector<double> &nodal)
  {
    // start from zero where nothing is prescribed
    for (int d = 0; d < dim; ++d)
      {
        const auto &status = components[component_of_direction[d]].status;
        for (unsigned int i = 0; i < patch->nodes.n_local(); ++i)
          if (status[i] != NodalStatus::prescribed)
            nodal[std::size_t(i) * dim + d] = 0.;
      }

    double              whole = 0.;
    std::vector<double> defect(nodal.size()), correction;
    for (unsigned int k = 0; k < most_corrections; ++k)
      {
        system.apply(nodal, defect);
        for (std::size_t i = 0; i < defect.size(); ++i)
          defect[i] = momentum[i] - defect[i];

        const double tolerance = k == 0 ? first_tolerance : later_tolerance;
        double       energy    = 0.;
        is_hard                = is_hard || !iterate(tolerance, defect, correction, energy);
        if (is_hard)
          {
            LinearStatus status = factorise_all();
            if (status.success)
              status = correct(defect, nodal, energy);
            if (!status.success)
              return status;
            energy = dealii::Utilities::MPI::sum(energy, patch->nodes.communicator());
          }
        else
          for (std::size_t i = 0; i < std::size_t(patch->nodes.n_owned()) * dim; ++i)
            nodal[i] += correction[i];
        if (k == 0)
          whole = energy;
        if (whole == 0. || (k > 0 && !(energy > relative_tolerance * whole)))
          break;
      }
    patch->nodes.update_ghosts(nodal, dim);
    patch->ties.prolong(nodal);
    return {};
  }

  template class VelocityMapping<2>;
  template class VelocityMapping<3>;
} // namespace kedge
