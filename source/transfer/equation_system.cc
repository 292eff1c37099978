#include <kedge/transfer/equation_system.h>

namespace kedge
{
  namespace
  {
    /** Local number of the node at a lattice offset from another, or -1. */
    template <int dim>
    int
    neighbour(const LatticeWindow<dim> &window,
              const ActiveNodes<dim>   &nodes,
              LatticeIndex<dim>         node,
              const LatticeIndex<dim>  &offset)
    {
      for (int d = 0; d < dim; ++d)
        {
          node[d] += offset[d];
          if (node[d] < window.low[d] || node[d] > window.low[d] + window.n_cells[d])
            return -1;
        }
      return nodes.local(window.node_number(node));
    }
  } // namespace



  template <int dim>
  void
  EquationSystem<dim>::number_equations(const ActiveNodes<dim>         &nodes,
                                        const std::vector<NodalStatus> &status)
  {
    number.assign(status.size(), -1);
    nodal_of_equation.clear();
    for (unsigned int i = 0; i < nodes.n_owned() * n_components; ++i)
      if (status[i] == NodalStatus::free)
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
    const unsigned int        width = matrix.n_slots() * n_components;
    std::vector<std::int64_t> columns(std::size_t(nodes.n_local()) * width, -1);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        const auto here = grid.window().node_index(nodes.window_node(i));
        for (unsigned int s = 0; s < matrix.n_slots(); ++s)
          {
            const int j = neighbour<dim>(grid.window(), nodes, here, matrix.offset(s));
            if (j >= 0)
              for (unsigned int c = 0; c < n_components; ++c)
                columns[std::size_t(i) * width + s * n_components + c] =
                  number[std::size_t(j) * n_components + c];
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
  std::vector<std::pair<std::int64_t, double>>
  EquationSystem<dim>::expand(const NodeTies<dim>            &ties,
                              const std::vector<NodalStatus> &status,
                              const unsigned int              node,
                              const unsigned int              component) const
  {
    const std::size_t                            i = std::size_t(node) * n_components + component;
    std::vector<std::pair<std::int64_t, double>> result;
    if (status[i] == NodalStatus::free)
      result.emplace_back(number[i], 1.);
    else if (status[i] == NodalStatus::tied)
      {
        const auto &tie = ties.ties()[ties.tie_of(node)];
        for (unsigned int k = 0; k < tie.roots.size(); ++k)
          {
            const std::size_t j = std::size_t(tie.roots[k]) * n_components + component;
            if (number[j] >= 0)
              result.emplace_back(number[j], tie.weights[k]);
          }
      }
    return result;
  }



  template <int dim>
  std::vector<typename EquationSystem<dim>::Contribution>
  EquationSystem<dim>::tied_contributions(const BackgroundGrid<dim>      &grid,
                                          const ActiveNodes<dim>         &nodes,
                                          const NodeTies<dim>            &ties,
                                          const std::vector<NodalStatus> &status,
                                          const NodeMatrix<dim>          &matrix) const
  {
    std::vector<Contribution> result;
    if (ties.empty())
      return result;
    const auto is_tied = [&](const unsigned int node, const unsigned int c) {
      return status[std::size_t(node) * n_components + c] == NodalStatus::tied;
    };
    const auto &window = grid.window();
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        const auto here = window.node_index(nodes.window_node(i));
        for (unsigned int s = 0; s < matrix.n_slots(); ++s)
          {
            const int j = neighbour<dim>(window, nodes, here, matrix.offset(s));
            if (j < 0 || (ties.tie_of(i) < 0 && ties.tie_of(j) < 0))
              continue;
            for (unsigned int p = 0; p < n_components; ++p)
              for (unsigned int m = 0; m < n_components; ++m)
                if (is_tied(i, p) || is_tied(j, m))
                  {
                    const std::size_t source =
                      ((std::size_t(i) * n_components + p) * matrix.n_slots() + s) * n_components +
                      m;
                    for (const auto &[row, row_weight] : expand(ties, status, i, p))
                      for (const auto &[column, column_weight] : expand(ties, status, j, m))
                        result.push_back({row, column, source, row_weight * column_weight});
                  }
          }
      }
    return result;
  }



  template <int dim>
  std::vector<std::pair<std::int64_t, std::int64_t>>
  EquationSystem<dim>::share_contributions(const std::vector<Contribution> &contributions)
  {
    own_additions.clear();
    outgoing_additions.clear();
    incoming_targets.clear();
    std::vector<std::pair<std::int64_t, std::int64_t>> entries;
    const std::int64_t                                 end =
      system_.first_row + static_cast<std::int64_t>(nodal_of_equation.size());
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(system_.communicator);

    std::vector<std::int64_t> first_rows(1, 0);
    if (n_ranks > 1)
      first_rows = dealii::Utilities::MPI::all_gather(system_.communicator, system_.first_row);
    std::map<unsigned int, std::vector<std::pair<std::int64_t, std::int64_t>>> requests;
    for (const Contribution &c : contributions)
      if (c.row >= system_.first_row && c.row < end)
        entries.emplace_back(c.row, c.column);
      else
        {
          const auto owner = static_cast<unsigned int>(
            std::upper_bound(first_rows.begin(), first_rows.end(), c.row) - first_rows.begin() - 1);
          requests[owner].emplace_back(c.row, c.column);
          outgoing_additions[owner].emplace_back(c.source, c.weight);
        }
    any_remote = false;
    if (n_ranks > 1)
      {
        any_remote = dealii::Utilities::MPI::logical_or(!requests.empty(), system_.communicator);
        if (any_remote)
          received_entries = dealii::Utilities::MPI::some_to_some(system_.communicator, requests);
        else
          received_entries.clear();
        for (const auto &[rank, pairs] : received_entries)
          {
            (void)rank;
            entries.insert(entries.end(), pairs.begin(), pairs.end());
          }
      }
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    return entries;
  }



  template <int dim>
  std::size_t
  EquationSystem<dim>::position(const std::int64_t row, const std::int64_t column) const
  {
    const auto begin = system_.column.begin() + system_.row_start[row - system_.first_row];
    const auto end   = system_.column.begin() + system_.row_start[row - system_.first_row + 1];
    return std::lower_bound(begin, end, static_cast<int>(column)) - system_.column.begin();
  }



  template <int dim>
  void
  EquationSystem<dim>::reinit(const BackgroundGrid<dim>      &grid,
                              const ActiveNodes<dim>         &nodes,
                              const NodeTies<dim>            &ties,
                              const std::vector<NodalStatus> &status,
                              const NodeMatrix<dim>          &matrix)
  {
    n_components = matrix.n_components();
    number_equations(nodes, status);
    const auto         columns       = neighbour_equations(grid, nodes, matrix);
    const auto         contributions = tied_contributions(grid, nodes, ties, status, matrix);
    const auto         through_ties  = share_contributions(contributions);
    const unsigned int width         = matrix.n_slots() * n_components;

    system_.row_start.assign(1, 0);
    system_.column.clear();
    entry_source.clear();
    Row  row;
    auto tied = through_ties.begin();
    for (unsigned int e = 0; e < nodal_of_equation.size(); ++e)
      {
        const std::int64_t *of_node =
          &columns[std::size_t(nodal_of_equation[e] / n_components) * width];
        row.clear();
        for (unsigned int k = 0; k < width; ++k)
          if (of_node[k] >= 0)
            row.emplace_back(static_cast<int>(of_node[k]), k);
        for (; tied != through_ties.end() && tied->first == system_.first_row + e; ++tied)
          row.emplace_back(static_cast<int>(tied->second), no_source);
        std::sort(row.begin(), row.end()); // of equal columns the one with a source comes first
        for (std::size_t k = 0; k < row.size(); ++k)
          if (k == 0 || row[k].first != row[k - 1].first)
            {
              system_.column.push_back(row[k].first);
              entry_source.push_back(row[k].second);
            }
        system_.row_start.push_back(system_.column.size());
      }
    system_.value.resize(system_.column.size());

    const std::int64_t end = system_.first_row + static_cast<std::int64_t>(system_.n_rows());
    for (const Contribution &c : contributions)
      if (c.row >= system_.first_row && c.row < end)
        own_additions.push_back({position(c.row, c.column), c.source, c.weight});
    for (const auto &[rank, pairs] : received_entries)
      for (const auto &[r, c] : pairs)
        incoming_targets[rank].push_back(position(r, c));
    received_entries.clear();
  }



  template <int dim>
  void
  EquationSystem<dim>::fill(const ActiveNodes<dim> &nodes, const NodeMatrix<dim> &matrix)
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
          system_.value[k] = entry_source[k] == no_source ? 0. : row[entry_source[k]];
      }
    for (const Addition &addition : own_additions)
      system_.value[addition.target] += addition.weight * matrix.values()[addition.source];
    if (!any_remote)
      return;
    std::map<unsigned int, std::vector<double>> outgoing;
    for (const auto &[rank, additions] : outgoing_additions)
      for (const auto &[source, weight] : additions)
        outgoing[rank].push_back(weight * matrix.values()[source]);
    const auto incoming = dealii::Utilities::MPI::some_to_some(nodes.communicator(), outgoing);
    for (const auto &[rank, received] : incoming)
      for (std::size_t k = 0; k < received.size(); ++k)
        system_.value[incoming_targets.at(rank)[k]] += received[k];
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
