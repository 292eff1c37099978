#include <kedge/transfer/equation_system.h>

namespace kedge
{
  template <int dim>
  void
  EquationSystem<dim>::number_equations(const ActiveNodes<dim>           &nodes,
                                        const std::vector<unsigned char> &is_free)
  {
    number.assign(is_free.size(), -1);
    nodal_of_equation.clear();
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      if (is_free[i])
        nodal_of_equation.push_back(i);

    const std::int64_t n_own = nodal_of_equation.size();
    system_.communicator     = nodes.communicator();
    system_.first_row        = 0;
    system_.n_global         = n_own;
    if (dealii::Utilities::MPI::n_mpi_processes(nodes.communicator()) > 1)
      {
        MPI_Exscan(&n_own, &system_.first_row, 1, MPI_INT64_T, MPI_SUM, nodes.communicator());
        if (dealii::Utilities::MPI::this_mpi_process(nodes.communicator()) == 0)
          system_.first_row = 0;
        MPI_Allreduce(&n_own, &system_.n_global, 1, MPI_INT64_T, MPI_SUM, nodes.communicator());
      }
    for (std::int64_t e = 0; e < n_own; ++e)
      number[nodal_of_equation[e]] = system_.first_row + e;
    nodes.update_ghosts(number, n_components);
  }



  template <int dim>
  std::vector<std::int64_t>
  EquationSystem<dim>::neighbour_equations(const BackgroundGrid<dim> &grid,
                                           const ActiveNodes<dim>    &nodes,
                                           const NodeMatrix<dim>     &matrix) const
  {
    const unsigned int        width  = matrix.n_slots() * n_components;
    const auto               &window = grid.window();
    std::vector<std::int64_t> columns(std::size_t(nodes.n_local()) * width, -1);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        const auto here = grid.window().node_index(nodes.window_node(i));
        for (unsigned int s = 0; s < matrix.n_slots(); ++s)
          {
            const auto offset = matrix.offset(s);
            auto       there  = here;
            bool       inside = true;
            for (int d = 0; d < dim; ++d)
              {
                there[d] += offset[d];
                inside = inside && there[d] >= window.low[d] &&
                         there[d] <= window.low[d] + window.n_cells[d];
              }
            const int neighbour = inside ? nodes.local(window.node_number(there)) : -1;
            if (neighbour >= 0)
              for (unsigned int c = 0; c < n_components; ++c)
                columns[std::size_t(i) * width + s * n_components + c] =
                  number[std::size_t(neighbour) * n_components + c];
          }
      }
    // what other ranks know of the neighbours of nodes owned here
    auto own = columns;
    nodes.send_to_owners(columns, width, [&](const unsigned int node, const std::int64_t *row) {
      for (unsigned int k = 0; k < width; ++k)
        if (own[std::size_t(node) * width + k] < 0)
          own[std::size_t(node) * width + k] = row[k];
    });
    return own;
  }



  template <int dim>
  void
  EquationSystem<dim>::reinit(const BackgroundGrid<dim>        &grid,
                              const ActiveNodes<dim>           &nodes,
                              const std::vector<unsigned char> &is_free,
                              const NodeMatrix<dim>            &matrix)
  {
    n_components = matrix.n_components();
    number_equations(nodes, is_free);
    const auto         columns = neighbour_equations(grid, nodes, matrix);
    const unsigned int width   = matrix.n_slots() * n_components;

    system_.row_start.assign(1, 0);
    system_.column.clear();
    entry_position.clear();
    std::vector<std::pair<int, unsigned int>> row;
    for (const unsigned int nodal : nodal_of_equation)
      {
        const std::int64_t *of_node = &columns[std::size_t(nodal / n_components) * width];
        row.clear();
        for (unsigned int k = 0; k < width; ++k)
          if (of_node[k] >= 0)
            row.emplace_back(static_cast<int>(of_node[k]), k);
        std::sort(row.begin(), row.end());
        for (const auto &[column, position] : row)
          {
            system_.column.push_back(column);
            entry_position.push_back(position);
          }
        system_.row_start.push_back(system_.column.size());
      }
    system_.value.resize(system_.column.size());
  }



  template <int dim>
  void
  EquationSystem<dim>::fill(const ActiveNodes<dim> &nodes, NodeMatrix<dim> &matrix)
  {
    const std::vector<double> *values = &matrix.values();
    std::vector<double>        summed;
    if (dealii::Utilities::MPI::n_mpi_processes(nodes.communicator()) > 1)
      {
        summed = matrix.values();
        nodes.add_to_owners(summed, matrix.row_size());
        values = &summed;
      }
    const std::size_t width = std::size_t(matrix.n_slots()) * n_components;
    for (unsigned int e = 0; e < nodal_of_equation.size(); ++e)
      {
        const double *row = values->data() + nodal_of_equation[e] * width;
        for (std::int64_t k = system_.row_start[e]; k < system_.row_start[e + 1]; ++k)
          system_.value[k] = row[entry_position[k]];
      }
  }



  template <int dim>
  void
  EquationSystem<dim>::gather(const std::vector<double> &nodal,
                              std::vector<double>       &equations) const
  {
    equations.resize(nodal_of_equation.size());
    for (unsigned int e = 0; e < equations.size(); ++e)
      equations[e] = nodal[nodal_of_equation[e]];
  }



  template <int dim>
  void
  EquationSystem<dim>::scatter(const std::vector<double> &equations,
                               std::vector<double>       &nodal) const
  {
    nodal.assign(number.size(), 0.);
    for (unsigned int e = 0; e < equations.size(); ++e)
      nodal[nodal_of_equation[e]] = equations[e];
  }

  template class EquationSystem<2>;
  template class EquationSystem<3>;
} // namespace kedge
