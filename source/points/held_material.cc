#include <kedge/points/held_material.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** Nodes of a grid of which is noted whether a condition holds them; evaluating a Where takes
     * ten times as long. */
    constexpr double most_noted = 4e6;

    enum Note : unsigned char
    {
      unknown,
      is_free,
      is_held
    };

    /** Of an edge: nearer to a node a region's limit is taken to stand at it. */
    constexpr double at_node = 0.01;

    /** Where on the edge from a held node to one that is not a region ends, as part of the edge. */
    template <int dim>
    double
    end_of_region(const NodeRegion<dim>    &region,
                  const dealii::Point<dim> &held,
                  const dealii::Point<dim> &other)
    {
      double in = 0., out = 1.;
      while (out - in > 1e-4)
        {
          const double middle                                             = 0.5 * (in + out);
          (region.holds_place(held + middle * (other - held)) ? in : out) = middle;
        }
      return in;
    }
  } // namespace



  template <int dim>
  std::vector<LatticeIndex<dim>>
  nodes_of_cells_with_points(const GridLevels<dim>               &levels,
                             const std::vector<PointOrigin<dim>> &points)
  {
    const auto make_unique = [](std::vector<LatticeIndex<dim>> &indices) {
      std::sort(indices.begin(), indices.end());
      indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    };
    std::vector<LatticeIndex<dim>> cells, nodes;
    for (const auto &point : points)
      if (const auto cell = levels.cell_at(point.location); cells.empty() || cells.back() != cell)
        cells.push_back(cell); // points of a cell often stand together
    make_unique(cells);
    for (const auto &cell : cells)
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          LevelNode<dim> node = levels.on_level(cell);
          for (int d = 0; d < dim; ++d)
            node.index[d] += static_cast<int>((corner >> d) & 1u);
          nodes.push_back(levels.finest_index(node));
        }
    make_unique(nodes);
    return nodes;
  }



  template <int dim>
  double
  reach_beyond_nodes(const NodeRegion<dim>                &region,
                     const Lattice<dim>                   &lattice,
                     const std::vector<LatticeIndex<dim>> &nodes)
  {
    double largest = 0.;
    if (!region.has_limits())
      return largest;
    for (const LatticeIndex<dim> &node : nodes)
      if (region.holds(lattice, node))
        for (int d = 0; d < dim; ++d)
          for (const int step : {-1, 1})
            {
              LatticeIndex<dim> other = node, before = node;
              other[d] += step;
              before[d] -= step;
              const auto is_held = [&](const LatticeIndex<dim> &index) {
                return std::binary_search(nodes.begin(), nodes.end(), index) &&
                       region.holds(lattice, index);
              };
              if (!is_held(before) || !std::binary_search(nodes.begin(), nodes.end(), other) ||
                  region.holds(lattice, other))
                continue;
              const double end =
                end_of_region(region, lattice.node_position(node), lattice.node_position(other));
              if (end > at_node && end < 1. - at_node)
                largest = std::max(largest, end);
            }
    return largest;
  }



  template <int dim>
  double
  part_carried_away(const NodeRegion<dim>                &region,
                    const Lattice<dim>                   &lattice,
                    const std::vector<LatticeIndex<dim>> &nodes,
                    const dealii::Tensor<1, dim>         &travel)
  {
    unsigned int n_held = 0, n_away = 0;
    for (const LatticeIndex<dim> &node : nodes)
      if (region.holds(lattice, node))
        {
          LatticeIndex<dim> end = node;
          for (int d = 0; d < dim; ++d)
            end[d] += static_cast<int>(std::lround(travel[d] / lattice.h[d]));
          ++n_held;
          n_away += region.holds(lattice, end) ? 0 : 1;
        }
    return n_held == 0 ? 0. : double(n_away) / n_held;
  }



  template <int dim>
  HeldMaterial<dim>::HeldMaterial(const std::vector<Condition> &conditions,
                                  const Lattice<dim>           &lattice)
    : conditions(conditions)
    , lattice(lattice)
    , all{{}, lattice.n_cells}
    , known(conditions.size())
  {
    double n_nodes = 1.;
    for (const int n : lattice.n_cells)
      n_nodes *= n + 1.;
    for (std::size_t c = 0; c < conditions.size() && n_nodes <= most_noted; ++c)
      if (conditions[c].region.has_limits())
        known[c].assign(all.n_nodes_total(), unknown);
  }



  template <int dim>
  bool
  HeldMaterial<dim>::holds(const std::size_t condition, const LatticeIndex<dim> &node)
  {
    const NodeRegion<dim> &region = conditions[condition].region;
    for (int d = 0; d < dim; ++d)
      if (node[d] < 0 || node[d] > lattice.n_cells[d])
        return region.holds(lattice, node);
    if (known[condition].empty())
      return region.holds(lattice, node);
    unsigned char &note = known[condition][all.node_number(node)];
    if (note == unknown)
      note = region.holds(lattice, node) ? is_held : is_free;
    return note == is_held;
  }



  template <int dim>
  double
  HeldMaterial<dim>::weight(const std::size_t condition, const dealii::Point<dim> &x)
  {
    const LatticeIndex<dim> cell = lattice.cell_of(x);
    double                  sum  = 0.;
    for (unsigned int corner = 0; corner < (1u << dim); ++corner)
      {
        LatticeIndex<dim> node  = cell;
        double            value = 1.;
        for (int d = 0; d < dim; ++d)
          {
            const double xi    = lattice.scaled(x[d], d) - cell[d];
            const bool   upper = (corner >> d) & 1u;
            node[d] += upper ? 1 : 0;
            value *= upper ? xi : 1. - xi;
          }
        if (holds(condition, node))
          sum += value;
      }
    return sum;
  }



  template <int dim>
  std::vector<double>
  HeldMaterial<dim>::parts(const MaterialPoints<dim> &cloud, const MPI_Comm communicator)
  {
    const std::size_t   n = conditions.size();
    std::vector<double> sums(2 * n, 0.); // held at the start, lost since
    cloud.for_each_core([&](const unsigned int,
                            const std::uint64_t,
                            const dealii::Point<dim> &x,
                            const PointCore<dim>     &point) {
      for (std::size_t c = 0; c < n; ++c)
        if (conditions[c].holds_body[static_cast<unsigned int>(point.body)])
          {
            const double before = weight(c, dealii::Point<dim>(point.reference_position));
            if (before == 0.)
              continue;
            sums[2 * c] += point.mass * before;
            sums[2 * c + 1] += point.mass * std::max(0., before - weight(c, x));
          }
    });
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    std::vector<double> result(n, 1.);
    for (std::size_t c = 0; c < n; ++c)
      if (sums[2 * c] > 0.)
        result[c] = 1. - sums[2 * c + 1] / sums[2 * c];
    return result;
  }

#define KEDGE_INSTANTIATE(dim)                                                     \
  template std::vector<LatticeIndex<dim>> nodes_of_cells_with_points<dim>(         \
    const GridLevels<dim> &,                                                       \
    const std::vector<PointOrigin<dim>> &);                                        \
  template double reach_beyond_nodes<dim>(const NodeRegion<dim> &,                 \
                                          const Lattice<dim> &,                    \
                                          const std::vector<LatticeIndex<dim>> &); \
  template double part_carried_away<dim>(const NodeRegion<dim> &,                  \
                                         const Lattice<dim> &,                     \
                                         const std::vector<LatticeIndex<dim>> &,   \
                                         const dealii::Tensor<1, dim> &);          \
  template class HeldMaterial<dim>;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
