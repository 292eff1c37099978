#include <kedge/fields/node_filling.h>
#include <kedge/fields/node_ties.h>

namespace kedge
{
  namespace
  {
    /** Cells searched for a root, as distance in cells from the node. */
    constexpr int nearest_ring = 2, farthest_ring = 4;

    /** Calls visit(cell) for all cells, @p edge intervals wide, within @p ring cells of a node. */
    template <int dim, typename Visit>
    void
    for_cells_around(const LatticeWindow<dim> &window,
                     const LatticeIndex<dim>  &node,
                     const int                 ring,
                     const int                 edge,
                     const Visit              &visit)
    {
      LatticeIndex<dim> offset;
      offset.fill(-ring);
      while (true)
        {
          LatticeIndex<dim> cell;
          for (int d = 0; d < dim; ++d)
            cell[d] = node[d] + edge * offset[d];
          if (window.contains_cell(cell))
            visit(cell);
          int d = 0;
          while (d < dim && ++offset[d] == ring)
            offset[d++] = -ring;
          if (d == dim)
            return;
        }
    }

    template <int dim>
    unsigned int
    corner(const LatticeWindow<dim> &window,
           const LatticeIndex<dim>  &cell,
           const unsigned int        v,
           const int                 edge)
    {
      LatticeIndex<dim> node = cell;
      for (int d = 0; d < dim; ++d)
        node[d] += edge * static_cast<int>((v >> d) & 1u);
      return window.node_number(node);
    }

    /** Calls visit(even node, weight) for those between which a node lies. */
    template <int dim, typename Visit>
    void
    for_even_nodes(const LatticeWindow<dim> &window, const unsigned int node, const Visit &visit)
    {
      const auto here = window.node_index(node);
      for (unsigned int v = 0; v < (1u << dim); ++v)
        {
          LatticeIndex<dim> even   = here;
          double            weight = 1.;
          for (int d = 0; d < dim; ++d)
            {
              const bool is_upper = ((v >> d) & 1u) != 0;
              if (here[d] % 2 != 0)
                {
                  even[d] += is_upper ? 1 : -1;
                  weight *= 0.5;
                }
              else if (is_upper)
                weight = 0.;
            }
          if (weight > 0.)
            visit(window.node_number(even), weight);
        }
    }
  } // namespace



  template <int dim>
  std::vector<LatticeIndex<dim>>
  NodeTies<dim>::nearest_cells(const LatticeWindow<dim> &window,
                               const Filling            &filling,
                               const bool                of_same_body,
                               const unsigned int        tied_node) const
  {
    const auto                     node = window.node_index(tied_node);
    std::vector<LatticeIndex<dim>> nearest;
    for (int ring = nearest_ring; ring <= farthest_ring && nearest.empty(); ++ring)
      {
        int best = std::numeric_limits<int>::max();
        for_cells_around<dim>(window, node, ring, filling.edge, [&](const LatticeIndex<dim> &cell) {
          int distance = 0; // four times the square of the distance to the centre
          for (int d = 0; d < dim; ++d)
            {
              const int twice = 2 * (node[d] - cell[d]) / filling.edge - 1;
              distance += twice * twice;
            }
          if (distance > best)
            return;
          std::uint64_t shared = of_same_body ? filling.bodies[tied_node] : 1;
          for (unsigned int v = 0; v < (1u << dim); ++v)
            {
              const unsigned int root = corner<dim>(window, cell, v, filling.edge);
              if (filling.volume[root] < filling.threshold ||
                  (!filling.pieces.of_node.empty() &&
                   filling.pieces.of_node[root] != filling.pieces.of_node[tied_node]))
                return;
              if (of_same_body)
                shared &= filling.bodies[root];
            }
          if (shared == 0)
            return;
          if (distance < best)
            nearest.clear();
          best = distance;
          nearest.push_back(cell);
        });
      }
    return nearest;
  }



  template <int dim>
  bool
  NodeTies<dim>::tie_to_nearest_cell(const LatticeWindow<dim> &window,
                                     const Filling            &filling,
                                     Tie                      &tie) const
  {
    const auto node    = window.node_index(tie.node);
    auto       nearest = nearest_cells(window, filling, !filling.bodies.empty(), tie.node);
    if (nearest.empty() && !filling.bodies.empty()) // none that a body of this node fills
      nearest = nearest_cells(window, filling, false, tie.node);
    // cells at the same distance share the tie, so that symmetry is kept
    std::map<unsigned int, double> weights;
    for (const auto &cell : nearest)
      for (unsigned int v = 0; v < (1u << dim); ++v)
        {
          double weight = 1. / static_cast<double>(nearest.size());
          for (int d = 0; d < dim; ++d)
            {
              const double xi = (node[d] - cell[d]) / filling.edge;
              weight *= (v >> d) & 1u ? xi : 1. - xi;
            }
          weights[corner<dim>(window, cell, v, filling.edge)] += weight;
        }
    for (const auto &[root, weight] : weights)
      if (weight != 0.)
        {
          tie.roots.push_back(root);
          tie.weights.push_back(weight);
        }
    return !nearest.empty();
  }



  /** Interpolates between even nodes and ties those with little around them to whole cells. */
  template <int dim>
  void
  NodeTies<dim>::tie_pressures(const BackgroundGrid<dim>        &grid,
                               const Filling                    &filling,
                               const std::vector<unsigned char> &reached)
  {
    const auto        &window  = grid.window();
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
    const unsigned int n_nodes = static_cast<unsigned int>(reached.size());
    Filling            whole{std::vector<double>(n_nodes, 0.),
                  std::vector<std::uint64_t>(filling.bodies.size(), 0),
                  filling.threshold,
                  2,
                  {}};
    std::vector<bool>  used(n_nodes, false);
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        if (filling.volume[node] == 0.)
          continue;
        const bool is_here = reached[node] || grid.node_owner(node) == rank;
        Tie        tie{node, {}, {}, 1u << dim, true};
        for_even_nodes<dim>(window, node, [&](const unsigned int even, const double weight) {
          tie.roots.push_back(even);
          tie.weights.push_back(weight);
          whole.volume[even] += weight * filling.volume[node] / (1 << dim);
          if (!filling.bodies.empty())
            whole.bodies[even] |= filling.bodies[node];
          if (is_here)
            used[even] = true;
        });
        if (is_here && tie.roots.front() != node)
          window_ties.push_back(std::move(tie));
      }
    for (unsigned int node = 0; node < n_nodes; ++node)
      if (whole.volume[node] > 0. && whole.volume[node] < filling.threshold &&
          (used[node] || grid.node_owner(node) == rank))
        {
          Tie tie{node, {}, {}, 1u << dim};
          if (tie_to_nearest_cell(window, whole, tie))
            window_ties.push_back(std::move(tie));
        }
  }



  /** Ties nodes with too little around them; all ranks find the same ties and keep their own. */
  template <int dim>
  void
  NodeTies<dim>::tie_badly_filled(const BackgroundGrid<dim>        &grid,
                                  const Filling                    &filling,
                                  const std::vector<unsigned char> &reached,
                                  const unsigned int                components)
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
    const auto         keep = [&](Tie &&tie) {
      // the owner of a tied node must know it too, even if none of its points reach it
      if (reached[tie.node] || grid.node_owner(tie.node) == rank)
        window_ties.push_back(std::move(tie));
    };
    std::vector<bool>         is_tied(reached.size(), false);
    std::vector<unsigned int> left;
    for (unsigned int node = 0; node < reached.size(); ++node)
      if (filling.volume[node] > 0. && filling.volume[node] < filling.threshold)
        {
          Tie tie{node, {}, {}, components};
          is_tied[node] = tie_to_nearest_cell(grid.window(), filling, tie);
          if (is_tied[node])
            keep(std::move(tie));
          else
            left.push_back(node);
        }
    if (left.empty())
      return;
    for (NodeSum &sum : tie_small_pieces(grid.window(),
                                         filling.volume,
                                         filling.pieces,
                                         is_tied,
                                         left,
                                         filling.edge,
                                         farthest_ring))
      keep({sum.node, std::move(sum.roots), std::move(sum.weights), components});
    std::sort(window_ties.begin(), window_ties.end(), [](const Tie &a, const Tie &b) {
      return a.node < b.node;
    });
  }



  /** Ties hanging nodes to their roots, or to what these are tied to. */
  template <int dim>
  void
  NodeTies<dim>::tie_hanging(const std::vector<NodeSum> &hanging, const unsigned int components)
  {
    if (hanging.empty())
      return;
    std::map<unsigned int, std::size_t> tie_of_root;
    for (std::size_t i = 0; i < window_ties.size(); ++i)
      tie_of_root.emplace(window_ties[i].node, i);
    for (const NodeSum &sum : hanging)
      {
        std::map<unsigned int, double> weights;
        for (unsigned int k = 0; k < sum.roots.size(); ++k)
          {
            const auto tied = tie_of_root.find(sum.roots[k]);
            if (tied == tie_of_root.end())
              {
                weights[sum.roots[k]] += sum.weights[k];
                continue;
              }
            const Tie &tie = window_ties[tied->second];
            for (unsigned int r = 0; r < tie.roots.size(); ++r)
              weights[tie.roots[r]] += sum.weights[k] * tie.weights[r];
          }
        Tie tie{sum.node, {}, {}, components, false, true};
        for (const auto &[root, weight] : weights)
          {
            tie.roots.push_back(root);
            tie.weights.push_back(weight);
          }
        window_ties.push_back(std::move(tie));
      }
    std::sort(window_ties.begin(), window_ties.end(), [](const Tie &a, const Tie &b) {
      return a.node < b.node;
    });
  }



  template <int dim>
  void
  NodeTies<dim>::find(const BackgroundGrid<dim>  &grid,
                      const StepPoints<dim>      &points,
                      const double                threshold,
                      std::vector<unsigned char> &reached,
                      const bool                  coarse_pressure)
  {
    const std::vector<Tie>  ties_before  = std::move(window_ties);
    const std::vector<bool> moves_before = std::move(moves);
    window_ties.clear();
    moves.clear();
    const std::vector<NodeSum> hanging    = hanging_nodes(grid.levels(), reached);
    const unsigned int         components = (1u << (coarse_pressure ? dim : dim + 1)) - 1;
    for (const NodeSum &sum : hanging)
      for (const unsigned int root : sum.roots)
        reached[root] = 1;
    if (threshold > 0. || coarse_pressure)
      {
        Filling filling{nodal_filling(grid, points, reached),
                        bodies_at_nodes(grid, points),
                        threshold,
                        1,
                        {}};
        give_to_roots(grid.levels(), hanging, filling.volume, filling.bodies);
        const auto is_low = [&](const double volume) {
          return volume > 0. && volume < threshold;
        };
        if (std::any_of(filling.volume.begin(), filling.volume.end(), is_low))
          {
            filling.pieces = find_pieces(grid, points, hanging);
            tie_badly_filled(grid, filling, reached, components);
          }
        if (coarse_pressure)
          {
            tie_pressures(grid, filling, reached);
            moves.resize(reached.size());
            for (unsigned int node = 0; node < reached.size(); ++node)
              moves[node] = filling.volume[node] != 0.;
          }
      }
    tie_hanging(hanging, components);
    for (const Tie &tie : window_ties)
      for (const unsigned int root : tie.roots)
        reached[root] = 1;
    changed_ = window_ties.size() != ties_before.size() || moves != moves_before;
    for (unsigned int i = 0; i < window_ties.size() && !changed_; ++i)
      changed_ = window_ties[i].node != ties_before[i].node ||
                 window_ties[i].components != ties_before[i].components ||
                 window_ties[i].roots != ties_before[i].roots ||
                 window_ties[i].weights != ties_before[i].weights;
    if (dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      changed_ = dealii::Utilities::MPI::logical_or(changed_, grid.communicator());
  }



  /** Corners that no point reaches are there for the pressure: their displacement stays zero. */
  template <int dim>
  void
  NodeTies<dim>::tie_corners_without_motion(const ActiveNodes<dim> &nodes)
  {
    for (unsigned int i = 0; i < nodes.n_local() && !moves.empty(); ++i)
      if (!moves[nodes.window_node(i)])
        {
          tie_numbers[2 * std::size_t(i)] = static_cast<int>(local_ties.size());
          local_ties.push_back({i, {}, {}, (1u << dim) - 1});
        }
  }



  /** Puts the roots of tied corners in the place of the corners. */
  template <int dim>
  void
  NodeTies<dim>::follow_tied_corners(Tie &tie) const
  {
    std::map<unsigned int, double> weights;
    for (unsigned int k = 0; k < tie.roots.size(); ++k)
      if (!is_tied(tie.roots[k], dim))
        weights[tie.roots[k]] += tie.weights[k];
      else
        {
          const Tie &corner = local_ties[tie_of(tie.roots[k], dim)];
          for (unsigned int r = 0; r < corner.roots.size(); ++r)
            weights[corner.roots[r]] += tie.weights[k] * corner.weights[r];
        }
    tie.roots.clear();
    tie.weights.clear();
    for (const auto &[root, weight] : weights)
      {
        tie.roots.push_back(root);
        tie.weights.push_back(weight);
      }
  }



  template <int dim>
  void
  NodeTies<dim>::localise(const ActiveNodes<dim> &nodes, const NodeConditions<dim> &conditions)
  {
    local_ties = window_ties;
    tie_numbers.clear();
    if (!local_ties.empty() || !moves.empty())
      tie_numbers.assign(2 * std::size_t(nodes.n_local()), -1);
    for (unsigned int i = 0; i < local_ties.size(); ++i)
      {
        Tie &tie = local_ties[i];
        tie.node = nodes.local(tie.node);
        for (unsigned int &root : tie.roots)
          root = nodes.local(root);
        if ((tie.components & 1u) != 0)
          tie_numbers[2 * std::size_t(tie.node)] = static_cast<int>(i);
        if (((tie.components >> dim) & 1u) != 0)
          tie_numbers[2 * std::size_t(tie.node) + 1] = static_cast<int>(i);
        for (int d = 0; d < dim; ++d)
          if (!tie.hangs && conditions.prescribed(tie.node, d))
            tie.components &= ~(1u << d);
        if (!tie.interpolates && !tie.hangs && conditions.pressure_prescribed(tie.node))
          tie.components &= ~(1u << dim);
      }
    for (Tie &tie : local_ties)
      if (tie.interpolates)
        follow_tied_corners(tie);
    tie_corners_without_motion(nodes);
  }



  template <int dim>
  void
  NodeTies<dim>::prolong(std::vector<double> &nodal, const unsigned int n_components) const
  {
    for (const Tie &tie : local_ties)
      for (unsigned int d = 0; d < n_components; ++d)
        if ((tie.components >> d) & 1u)
          {
            double value = 0.;
            for (unsigned int k = 0; k < tie.roots.size(); ++k)
              value += tie.weights[k] * nodal[std::size_t(tie.roots[k]) * n_components + d];
            nodal[std::size_t(tie.node) * n_components + d] = value;
          }
  }



  template <int dim>
  void
  NodeTies<dim>::restrict_sums(std::vector<double> &sums, const unsigned int n_components) const
  {
    for (const Tie &tie : local_ties)
      for (unsigned int d = 0; d < n_components; ++d)
        if ((tie.components >> d) & 1u)
          {
            double &value = sums[std::size_t(tie.node) * n_components + d];
            for (unsigned int k = 0; k < tie.roots.size(); ++k)
              sums[std::size_t(tie.roots[k]) * n_components + d] += tie.weights[k] * value;
            value = 0.;
          }
  }

  template class NodeTies<2>;
  template class NodeTies<3>;
} // namespace kedge
