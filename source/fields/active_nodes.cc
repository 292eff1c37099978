#include <kedge/fields/active_nodes.h>

#include <numeric>

namespace kedge
{
  namespace
  {
    constexpr int exchange_tag = 4711;

    template <typename T>
    MPI_Datatype
    mpi_type()
    {
      return std::is_same_v<T, double> ? MPI_DOUBLE : MPI_INT64_T;
    }

    /**
     * Sorts nodes so that the direction in which they extend least runs
     * fastest: it keeps the bandwidth of matrices small.
     */
    template <int dim>
    void
    sort_by_extent(const GridLevels<dim> &levels, std::vector<unsigned int> &nodes)
    {
      if (nodes.empty())
        return;
      LatticeIndex<dim> low = levels.finest_index(nodes[0]), high = low;
      for (const unsigned int node : nodes)
        {
          const auto index = levels.finest_index(node);
          for (int d = 0; d < dim; ++d)
            {
              low[d]  = std::min(low[d], index[d]);
              high[d] = std::max(high[d], index[d]);
            }
        }
      std::array<int, dim> order;
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](const int a, const int b) {
        return high[a] - low[a] < high[b] - low[b];
      });
      if (levels.size() == 1 && std::is_sorted(order.begin(), order.end()))
        {
          std::sort(nodes.begin(), nodes.end());
          return;
        }

      std::vector<std::pair<std::uint64_t, unsigned int>> keyed;
      keyed.reserve(nodes.size());
      for (const unsigned int node : nodes)
        {
          const auto    index = levels.finest_index(node);
          std::uint64_t key   = 0;
          for (int k = dim - 1; k >= 0; --k)
            key = key * (high[order[k]] - low[order[k]] + 1) + (index[order[k]] - low[order[k]]);
          keyed.emplace_back(key, node);
        }
      std::sort(keyed.begin(), keyed.end());
      for (unsigned int i = 0; i < nodes.size(); ++i)
        nodes[i] = keyed[i].second;
    }
  } // namespace



  template <int dim>
  bool
  ActiveNodes<dim>::reinit(const BackgroundGrid<dim>        &grid,
                           const std::vector<unsigned char> &reached)
  {
    communicator_                     = grid.communicator();
    const unsigned int        rank    = dealii::Utilities::MPI::this_mpi_process(communicator_);
    const unsigned int        n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator_);
    std::vector<unsigned int> owned;
    std::map<unsigned int, std::vector<unsigned int>> ghosts; // by owner
    for (unsigned int node = 0; node < reached.size(); ++node)
      if (reached[node])
        {
          if (n_ranks == 1 || grid.node_owner(node) == rank)
            owned.push_back(node);
          else
            ghosts[grid.node_owner(node)].push_back(node);
        }

    const std::vector<unsigned int> nodes_before   = std::move(window_nodes);
    const unsigned int              n_owned_before = n_owned_;
    if (n_ranks > 1)
      find_neighbours(grid, ghosts, owned);
    sort_by_extent(grid.levels(), owned);

    n_owned_     = owned.size();
    window_nodes = std::move(owned);
    for (const auto &[owner, nodes] : ghosts)
      window_nodes.insert(window_nodes.end(), nodes.begin(), nodes.end());

    bool changed =
      generation != grid.generation() || nodes_before != window_nodes || n_owned_before != n_owned_;
    if (n_ranks > 1)
      changed = dealii::Utilities::MPI::logical_or(changed, communicator_);
    if (changed)
      {
        generation = grid.generation();
        local_numbers.assign(reached.size(), -1);
        for (unsigned int i = 0; i < window_nodes.size(); ++i)
          local_numbers[window_nodes[i]] = i;
        n_global_ = n_ranks > 1
                      ? dealii::Utilities::MPI::sum<std::uint64_t>(n_owned_, communicator_)
                      : n_owned_;
      }
    for (auto &neighbour : neighbours) // window numbers become local ones
      {
        for (unsigned int &node : neighbour.ghosts)
          node = local_numbers[node];
        for (unsigned int &node : neighbour.owned)
          node = local_numbers[node];
      }
    return changed;
  }



  template <int dim>
  void
  ActiveNodes<dim>::find_neighbours(
    const BackgroundGrid<dim>                               &grid,
    const std::map<unsigned int, std::vector<unsigned int>> &ghost_nodes,
    std::vector<unsigned int>                               &owned_nodes)
  {
    const auto requests = dealii::Utilities::MPI::some_to_some(grid.communicator(), ghost_nodes);

    std::map<unsigned int, Neighbour> by_rank;
    for (const auto &[rank, nodes] : ghost_nodes)
      by_rank[rank].ghosts = nodes;
    for (const auto &[rank, nodes] : requests)
      {
        by_rank[rank].owned = nodes;
        owned_nodes.insert(owned_nodes.end(), nodes.begin(), nodes.end());
      }
    std::sort(owned_nodes.begin(), owned_nodes.end());
    owned_nodes.erase(std::unique(owned_nodes.begin(), owned_nodes.end()), owned_nodes.end());

    neighbours.clear();
    for (auto &[rank, neighbour] : by_rank)
      {
        neighbour.rank = rank;
        neighbours.push_back(std::move(neighbour));
      }
  }



  template <int dim>
  template <typename T>
  void
  ActiveNodes<dim>::exchange(const std::vector<T>                               &values,
                             const unsigned int                                  width,
                             const bool                                          to_owners,
                             const std::function<void(unsigned int, const T *)> &receive) const
  {
    std::vector<std::vector<T>> outgoing(neighbours.size()), incoming(neighbours.size());
    std::vector<MPI_Request>    requests(2 * neighbours.size());
    for (unsigned int n = 0; n < neighbours.size(); ++n)
      {
        const auto &from = to_owners ? neighbours[n].ghosts : neighbours[n].owned;
        const auto &to   = to_owners ? neighbours[n].owned : neighbours[n].ghosts;
        incoming[n].resize(to.size() * width);
        MPI_Irecv(incoming[n].data(),
                  incoming[n].size(),
                  mpi_type<T>(),
                  neighbours[n].rank,
                  exchange_tag,
                  communicator_,
                  &requests[2 * n]);
        outgoing[n].reserve(from.size() * width);
        for (const unsigned int node : from)
          outgoing[n].insert(outgoing[n].end(),
                             values.begin() + std::size_t(node) * width,
                             values.begin() + std::size_t(node + 1) * width);
        MPI_Isend(outgoing[n].data(),
                  outgoing[n].size(),
                  mpi_type<T>(),
                  neighbours[n].rank,
                  exchange_tag,
                  communicator_,
                  &requests[2 * n + 1]);
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    for (unsigned int n = 0; n < neighbours.size(); ++n)
      {
        const auto &to = to_owners ? neighbours[n].owned : neighbours[n].ghosts;
        for (unsigned int i = 0; i < to.size(); ++i)
          receive(to[i], incoming[n].data() + std::size_t(i) * width);
      }
  }



  template <int dim>
  void
  ActiveNodes<dim>::add_to_owners(std::vector<double> &values, const unsigned int width) const
  {
    if (!neighbours.empty())
      exchange<double>(values, width, true, [&](const unsigned int node, const double *row) {
        for (unsigned int k = 0; k < width; ++k)
          values[std::size_t(node) * width + k] += row[k];
      });
  }



  template <int dim>
  void
  ActiveNodes<dim>::update_ghosts(std::vector<double> &values, const unsigned int width) const
  {
    if (!neighbours.empty())
      exchange<double>(values, width, false, [&](const unsigned int node, const double *row) {
        std::copy(row, row + width, values.begin() + std::size_t(node) * width);
      });
  }



  template <int dim>
  void
  ActiveNodes<dim>::update_ghosts(std::vector<std::int64_t> &values, const unsigned int width) const
  {
    if (!neighbours.empty())
      exchange<std::int64_t>(values,
                             width,
                             false,
                             [&](const unsigned int node, const std::int64_t *row) {
                               std::copy(row,
                                         row + width,
                                         values.begin() + std::size_t(node) * width);
                             });
  }



  template <int dim>
  void
  ActiveNodes<dim>::send_to_owners(
    const std::vector<std::int64_t>                               &values,
    const unsigned int                                             width,
    const std::function<void(unsigned int, const std::int64_t *)> &receive) const
  {
    if (!neighbours.empty())
      exchange<std::int64_t>(values, width, true, receive);
  }



  template <int dim>
  void
  ActiveNodes<dim>::send_to_owners(
    const std::vector<double>                               &values,
    const unsigned int                                       width,
    const std::function<void(unsigned int, const double *)> &receive) const
  {
    if (!neighbours.empty())
      exchange<double>(values, width, true, receive);
  }

  template class ActiveNodes<2>;
  template class ActiveNodes<3>;
} // namespace kedge
