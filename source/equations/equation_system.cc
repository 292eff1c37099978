#include <kedge/equations/equation_system.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    constexpr int exchange_tag = 4712;
  }



  template <int dim>
  void
  EquationSystem<dim>::number_equations(const Patch<dim>               &patch,
                                        const std::vector<NodalStatus> &status)
  {
    number.assign(status.size(), -1);
    nodal_of_equation.clear();
    for (unsigned int i = 0; i < patch.nodes.n_owned() * n_components; ++i)
      if (status[i] == NodalStatus::free)
        nodal_of_equation.push_back(i);

    const std::int64_t n_own = nodal_of_equation.size();
    system_.communicator     = patch.nodes.communicator();
    system_.first_row        = 0;
    system_.n_global         = n_own;
    if (dealii::Utilities::MPI::n_mpi_processes(patch.nodes.communicator()) > 1)
      {
        MPI_Exscan(&n_own, &system_.first_row, 1, MPI_INT64_T, MPI_SUM, patch.nodes.communicator());
        if (dealii::Utilities::MPI::this_mpi_process(patch.nodes.communicator()) == 0)
          system_.first_row = 0;
        MPI_Allreduce(&n_own,
                      &system_.n_global,
                      1,
                      MPI_INT64_T,
                      MPI_SUM,
                      patch.nodes.communicator());
      }
    for (std::int64_t e = 0; e < n_own; ++e)
      number[nodal_of_equation[e]] = system_.first_row + e;
    patch.nodes.update_ghosts(number, n_components);

    n_free.assign(patch.nodes.n_local(), 0);
    for (unsigned int i = 0; i < number.size(); ++i)
      if (number[i] >= 0)
        ++n_free[i / n_components];
  }



  template <int dim>
  std::vector<std::int64_t>
  EquationSystem<dim>::neighbour_equations(const Patch<dim>      &patch,
                                           const NodeMatrix<dim> &matrix) const
  {
    const unsigned int        width = matrix.n_slots() * n_components;
    std::vector<std::int64_t> columns(std::size_t(patch.nodes.n_local()) * width, -1);
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      for_neighbours(patch, i, matrix, [&](const unsigned int slot, const unsigned int j) {
        for (unsigned int c = 0; c < n_components; ++c)
          columns[std::size_t(i) * width + slot * n_components + c] =
            number[std::size_t(j) * n_components + c];
      });
    if (dealii::Utilities::MPI::n_mpi_processes(patch.nodes.communicator()) == 1)
      return columns;
    // what other ranks know of the neighbours of nodes owned here
    auto own = columns;
    patch.nodes.send_to_owners(columns,
                               width,
                               [&](const unsigned int node, const std::int64_t *row) {
                                 for (unsigned int k = 0; k < width; ++k)
                                   if (own[std::size_t(node) * width + k] < 0)
                                     own[std::size_t(node) * width + k] = row[k];
                               });
    return own;
  }



  template <int dim>
  std::int64_t
  EquationSystem<dim>::first_equation(const unsigned int node) const
  {
    for (unsigned int c = 0; c < n_components; ++c)
      if (number[std::size_t(node) * n_components + c] >= 0)
        return number[std::size_t(node) * n_components + c];
    return -1;
  }



  template <int dim>
  void
  EquationSystem<dim>::find_fed_nodes(const Patch<dim> &patch)
  {
    fed_nodes.clear();
    places.clear();
    mark.assign(patch.nodes.n_local(), 0);
    offset_of.resize(patch.nodes.n_local());
    const auto  &feeds   = tied_rows.feeds();
    const auto   n_feeds = static_cast<unsigned int>(feeds.size());
    unsigned int next    = 0;
    for (unsigned int f = 0; f < n_feeds; f = next)
      {
        for (next = f; next < n_feeds && feeds[next].node == feeds[f].node;)
          ++next;
        if (n_free[feeds[f].node] > 0)
          fed_nodes.push_back({feeds[f].node, f, next, 0, 0, 0});
      }
  }



  template <int dim>
  void
  EquationSystem<dim>::add_tied_blocks(const FedNode &fed, Blocks &blocks)
  {
    for (unsigned int f = fed.first_feed; f < fed.end_feed; ++f)
      {
        const auto &row = tied_rows.row(tied_rows.feeds()[f].row);
        for (unsigned int c = row.first_column; c < row.end_column; ++c)
          {
            const unsigned int node = tied_rows.column(c);
            if (mark[node] == fed.node + 1)
              continue;
            mark[node] = fed.node + 1;
            if (n_free[node] > 0)
              blocks.push_back({first_equation(node), none, node, n_free[node]});
          }
      }
  }



  template <int dim>
  void
  EquationSystem<dim>::place_feeds(FedNode &fed, const Blocks &blocks)
  {
    fed.first_place = places.size();
    fed.row_length  = 0;
    for (const Block &block : blocks)
      {
        if (block.node != none)
          offset_of[block.node] = fed.row_length;
        fed.row_length += block.n_equations;
      }
    for (unsigned int f = fed.first_feed; f < fed.end_feed; ++f)
      {
        const auto &row = tied_rows.row(tied_rows.feeds()[f].row);
        for (unsigned int c = row.first_column; c < row.end_column; ++c)
          {
            const unsigned int node = tied_rows.column(c);
            places.push_back(n_free[node] > 0 ? offset_of[node] : none);
          }
      }
  }



  template <int dim>
  void
  EquationSystem<dim>::sort_and_merge(Blocks &blocks)
  {
    std::sort(blocks.begin(), blocks.end(), [](const Block &a, const Block &b) {
      return a.first < b.first;
    });
    std::size_t n = 0;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      if (n > 0 && blocks[n - 1].first == blocks[k].first)
        {
          blocks[n - 1].slot = std::min(blocks[n - 1].slot, blocks[k].slot);
          blocks[n - 1].node = std::min(blocks[n - 1].node, blocks[k].node);
        }
      else
        blocks[n++] = blocks[k];
    blocks.resize(n);
  }



  template <int dim>
  std::vector<typename EquationSystem<dim>::RemoteBlock>
  EquationSystem<dim>::exchange_remote_rows(const Patch<dim> &patch)
  {
    outgoing_ranges.clear();
    incoming_blocks.clear();
    incoming_targets.clear();
    std::map<unsigned int, std::vector<std::int64_t>> requests; // per node: row, n, n blocks
    std::size_t                                       n_values = 0;
    Blocks                                            blocks;
    for (FedNode &fed : fed_nodes)
      if (fed.node >= patch.nodes.n_owned())
        {
          blocks.clear();
          add_tied_blocks(fed, blocks);
          sort_and_merge(blocks);
          place_feeds(fed, blocks);
          const unsigned int owner = patch.grid().node_owner(patch.nodes.window_node(fed.node));
          fed.remote               = n_values;
          n_values += std::size_t(fed.row_length) * n_free[fed.node];
          auto &ranges = outgoing_ranges[owner];
          ranges.insert(ranges.end(), {fed.remote, n_values});
          auto &request = requests[owner];
          request.push_back(first_equation(fed.node));
          request.push_back(static_cast<std::int64_t>(blocks.size()));
          for (const Block &block : blocks)
            request.insert(request.end(), {block.first, block.n_equations});
        }
    remote_values.resize(n_values);
    std::vector<RemoteBlock> result;
    any_remote = false;
    if (dealii::Utilities::MPI::n_mpi_processes(patch.nodes.communicator()) > 1)
      any_remote =
        dealii::Utilities::MPI::logical_or(!requests.empty(), patch.nodes.communicator());
    if (!any_remote)
      return result;
    incoming_blocks = dealii::Utilities::MPI::some_to_some(patch.nodes.communicator(), requests);
    for (const auto &[rank, received] : incoming_blocks)
      for (std::size_t k = 0; k < received.size(); k += 2 + 2 * received[k + 1])
        for (std::int64_t b = 0; b < received[k + 1]; ++b)
          result.push_back({received[k],
                            {received[k + 2 + 2 * b],
                             none,
                             none,
                             static_cast<unsigned int>(received[k + 3 + 2 * b])}});
    std::stable_sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
      return a.row < b.row;
    });
    return result;
  }



  template <int dim>
  void
  EquationSystem<dim>::build_rows(const Patch<dim>                &patch,
                                  const std::vector<std::int64_t> &columns,
                                  const unsigned int               n_slots,
                                  const std::vector<RemoteBlock>  &remote)
  {
    system_.row_start.assign(1, 0);
    system_.column.clear();
    entry_source.clear();
    auto   from_others = remote.begin();
    auto   fed         = fed_nodes.begin();
    Blocks blocks;
    for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
      {
        if (n_free[i] == 0)
          continue;
        const std::int64_t *of_node = &columns[std::size_t(i) * n_slots * n_components];
        blocks.clear();
        for (unsigned int s = 0; s < n_slots; ++s)
          {
            Block block{-1, s, none, 0};
            for (unsigned int c = 0; c < n_components; ++c)
              if (of_node[s * n_components + c] >= 0)
                {
                  if (block.n_equations++ == 0)
                    block.first = of_node[s * n_components + c];
                }
            if (block.n_equations > 0)
              blocks.push_back(block);
          }
        const std::int64_t first = first_equation(i);
        for (; from_others != remote.end() && from_others->row == first; ++from_others)
          blocks.push_back(from_others->block);
        const bool is_fed = fed != fed_nodes.end() && fed->node == i;
        if (is_fed)
          add_tied_blocks(*fed, blocks);
        sort_and_merge(blocks);
        if (is_fed)
          place_feeds(*fed++, blocks);
        add_rows(n_free[i], of_node, blocks);
      }
    system_.value.resize(system_.column.size());
  }



  template <int dim>
  void
  EquationSystem<dim>::add_rows(const unsigned int  n_rows,
                                const std::int64_t *of_node,
                                const Blocks       &blocks)
  {
    for (unsigned int q = 0; q < n_rows; ++q)
      {
        for (const Block &block : blocks)
          if (block.slot == none)
            for (unsigned int k = 0; k < block.n_equations; ++k)
              {
                system_.column.push_back(static_cast<int>(block.first + k));
                entry_source.push_back(none);
              }
          else
            for (unsigned int k = block.slot * n_components; k < (block.slot + 1) * n_components;
                 ++k)
              if (of_node[k] >= 0)
                {
                  system_.column.push_back(static_cast<int>(of_node[k]));
                  entry_source.push_back(k);
                }
        system_.row_start.push_back(static_cast<std::int64_t>(system_.column.size()));
      }
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
  EquationSystem<dim>::find_incoming_targets()
  {
    for (const auto &[rank, received] : incoming_blocks)
      {
        auto &targets = incoming_targets[rank];
        for (std::size_t k = 0; k < received.size(); k += 2 + 2 * received[k + 1])
          {
            const auto         first  = received[k];
            const unsigned int node   = nodal_of_equation[first - system_.first_row] / n_components;
            const auto        *blocks = &received[k + 2];
            for (unsigned int q = 0; q < n_free[node]; ++q)
              for (std::int64_t b = 0; b < received[k + 1]; ++b)
                for (std::int64_t c = 0; c < blocks[2 * b + 1]; ++c)
                  targets.push_back(position(first + q, blocks[2 * b] + c));
          }
      }
    incoming_blocks.clear();
  }



  template <int dim>
  void
  EquationSystem<dim>::reinit(const Patch<dim>               &patch,
                              const std::vector<NodalStatus> &status,
                              const NodeMatrix<dim>          &matrix)
  {
    n_components = matrix.n_components();
    number_equations(patch, status);
    tied_rows.reinit(patch, status, matrix);
    find_fed_nodes(patch);
    const auto remote  = exchange_remote_rows(patch);
    const auto columns = neighbour_equations(patch, matrix);
    build_rows(patch, columns, matrix.n_slots(), remote);
    find_incoming_targets();
  }



  template <int dim>
  void
  EquationSystem<dim>::fill(const Patch<dim> &patch, const NodeMatrix<dim> &matrix)
  {
    const std::size_t width   = std::size_t(matrix.n_slots()) * n_components;
    const auto        add_row = [&](const std::int64_t e, const double *row) {
      for (std::int64_t k = system_.row_start[e]; k < system_.row_start[e + 1]; ++k)
        system_.value[k] += entry_source[k] == none ? 0. : row[entry_source[k]];
    };
    std::fill(system_.value.begin(), system_.value.end(), 0.);
    for (unsigned int e = 0; e < nodal_of_equation.size(); ++e)
      add_row(e, matrix.values().data() + nodal_of_equation[e] * width);
    const auto add_share = [&](const unsigned int node, const double *share) {
      for (unsigned int p = 0; p < n_components; ++p)
        if (number[node * n_components + p] >= 0)
          add_row(number[node * n_components + p] - system_.first_row, share + p * width);
    };
    patch.nodes.send_to_owners(matrix.values(), matrix.row_size(), add_share);
    tied_rows.multiply(matrix);
    std::fill(remote_values.begin(), remote_values.end(), 0.);
    for (const FedNode &fed : fed_nodes)
      add_fed_rows(fed, patch.nodes.n_owned());
    if (any_remote)
      add_remote_rows();
  }



  template <int dim>
  void
  EquationSystem<dim>::add_fed_rows(const FedNode &fed, const unsigned int n_owned)
  {
    const unsigned int *place = places.data() + fed.first_place;
    for (unsigned int f = fed.first_feed; f < fed.end_feed; ++f)
      {
        const auto        &feed      = tied_rows.feeds()[f];
        const auto        &row       = tied_rows.row(feed.row);
        const unsigned int n_columns = row.end_column - row.first_column;
        double            *sums =
          fed.node < n_owned
                       ? &system_.value[system_.row_start[first_equation(fed.node) - system_.first_row]]
                       : &remote_values[fed.remote];
        for (unsigned int p = 0; p < n_components; ++p)
          {
            if (number[std::size_t(fed.node) * n_components + p] < 0)
              continue;
            const double *value = tied_rows.values(row, p);
            if ((row.components >> p) & 1u)
              for (unsigned int c = 0; c < n_columns; ++c)
                if (place[c] != none)
                  {
                    const std::size_t node   = tied_rows.column(row.first_column + c);
                    const bool        whole  = n_free[node] == n_components;
                    double           *target = sums + place[c];
                    for (unsigned int m = 0; m < n_components; ++m)
                      if (whole || number[node * n_components + m] >= 0)
                        *target++ += feed.weight * value[c * n_components + m];
                  }
            sums += fed.row_length;
          }
        place += n_columns;
      }
  }



  template <int dim>
  void
  EquationSystem<dim>::add_remote_rows()
  {
    std::vector<std::vector<double>> buffers;
    std::vector<MPI_Request>         requests(incoming_targets.size() + outgoing_ranges.size());
    buffers.reserve(requests.size());
    const auto exchange = [&](const auto &mpi_call, const unsigned int rank) {
      MPI_Request   *request = &requests[buffers.size() - 1];
      auto          &values  = buffers.back();
      const MPI_Comm all     = system_.communicator;
      mpi_call(values.data(),
               int(values.size()),
               MPI_DOUBLE,
               int(rank),
               exchange_tag,
               all,
               request);
    };
    for (const auto &[rank, targets] : incoming_targets)
      {
        buffers.emplace_back(targets.size());
        exchange(MPI_Irecv, rank);
      }
    for (const auto &[rank, ranges] : outgoing_ranges)
      {
        buffers.emplace_back();
        for (std::size_t k = 0; k < ranges.size(); k += 2)
          buffers.back().insert(buffers.back().end(),
                                remote_values.begin() + ranges[k],
                                remote_values.begin() + ranges[k + 1]);
        exchange(MPI_Isend, rank);
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    auto received = buffers.begin();
    for (const auto &entry : incoming_targets)
      {
        for (std::size_t k = 0; k < entry.second.size(); ++k)
          system_.value[entry.second[k]] += (*received)[k];
        ++received;
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
