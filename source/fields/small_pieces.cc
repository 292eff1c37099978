#include <kedge/fields/small_pieces.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

namespace kedge
{
  namespace
  {
    /** Sets of nodes that are joined pair by pair. */
    class UnionOfNodes
    {
    public:
      explicit UnionOfNodes(const std::size_t n)
        : parent(n)
      {
        std::iota(parent.begin(), parent.end(), 0u);
      }

      /** The least node of a set. */
      unsigned int
      find(unsigned int node)
      {
        while (parent[node] != node)
          node = parent[node] = parent[parent[node]];
        return node;
      }

      void
      join(const unsigned int a, const unsigned int b)
      {
        const unsigned int of_a = find(a), of_b = find(b);
        parent[std::max(of_a, of_b)] = std::min(of_a, of_b);
      }

    private:
      std::vector<unsigned int> parent;
    };

    /** Calls visit(node) for the nodes at which a stencil is not zero. */
    template <int dim, typename Strides, typename Visit>
    void
    for_nodes(const Stencil<dim> &s, const Strides &strides, const Visit &visit)
    {
      for (int k = 0; k < (dim == 3 ? stencil_width(s.pattern, 2) : 1); ++k)
        for (int j = 0; j < stencil_width(s.pattern, 1); ++j)
          for (int i = 0; i < stencil_width(s.pattern, 0); ++i)
            if (s.value[0][i] != 0. && s.value[1][j] != 0. &&
                (dim == 2 || s.value[dim - 1][k] != 0.))
              visit(s.first_node + i * strides[0] + j * strides[1] +
                    (dim == 3 ? k * strides[dim - 1] : 0));
    }

    /** Corner @p v of a cell whose lowest corner is given. */
    template <int dim>
    LatticeIndex<dim>
    corner_of(const LatticeIndex<dim> &cell, const unsigned int v, const int edge)
    {
      LatticeIndex<dim> node = cell;
      for (int d = 0; d < dim; ++d)
        node[d] += edge * static_cast<int>((v >> d) & 1u);
      return node;
    }

    template <int dim>
    class Roots
    {
    public:
      Roots(const LatticeWindow<dim>        &window,
            const std::vector<double>       &volume,
            const Pieces                    &pieces,
            const std::vector<bool>         &is_tied,
            const std::vector<unsigned int> &left,
            const int                        edge)
        : window(window)
        , volume(volume)
        , pieces(pieces)
        , is_tied(is_tied)
        , left(left.begin(), left.end())
        , edge(edge)
      {}

      /** The fullest cell that has a node among those left; none if there is none. */
      std::optional<LatticeIndex<dim>>
      fullest() const
      {
        std::optional<LatticeIndex<dim>> result;
        double                           best = 0.;
        for (const unsigned int node : left)
          for (unsigned int v = 0; v < (1u << dim); ++v)
            {
              LatticeIndex<dim> cell = window.node_index(node);
              for (int d = 0; d < dim; ++d)
                cell[d] -= edge * static_cast<int>((v >> d) & 1u);
              const double least = least_volume(cell, pieces.of_node[node]);
              if (least > best)
                {
                  best   = least;
                  result = cell;
                }
            }
        return result;
      }

      /** Makes a cell a root: its corners are free, or sums of some of them; and who is near
       * follows. */
      void
      take(const LatticeIndex<dim> &cell, const int reach, std::vector<NodeSum> &sums)
      {
        const unsigned int piece  = pieces.of_node[window.node_number(cell)];
        const bool         affine = pieces.n_points[piece] < (1u << dim);
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            const unsigned int node   = window.node_number(corner_of<dim>(cell, v, edge));
            const bool         is_own = left.erase(node) > 0;
            if (is_own && affine && (v & (v - 1)) != 0) // more than one step from the first
              sums.push_back(sum_at(cell, node, affine));
          }
        for (auto node = left.begin(); node != left.end();)
          if (pieces.of_node[*node] == piece && distance(cell, *node) <= reach)
            {
              sums.push_back(sum_at(cell, *node, affine));
              node = left.erase(node);
            }
          else
            ++node;
      }

    private:
      /** The least volume at the corners; 0 for cells that cannot be roots. */
      double
      least_volume(const LatticeIndex<dim> &cell, const unsigned int piece) const
      {
        for (int d = 0; d < dim; ++d)
          if (cell[d] < window.low[d] || cell[d] + edge > window.low[d] + window.n_cells[d])
            return 0.;
        double least = std::numeric_limits<double>::max();
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            const unsigned int node = window.node_number(corner_of<dim>(cell, v, edge));
            if (is_tied[node] || pieces.of_node[node] != piece)
              return 0.;
            least = std::min(least, volume[node]);
          }
        return least;
      }

      /** In cells, from a cell's nearest corner in the worst direction. */
      int
      distance(const LatticeIndex<dim> &cell, const unsigned int node) const
      {
        const auto here   = window.node_index(node);
        int        result = 0;
        for (int d = 0; d < dim; ++d)
          result = std::max({result, cell[d] - here[d], here[d] - cell[d] - edge});
        return (result + edge - 1) / edge;
      }

      /** The cell's field, continued to a node. */
      NodeSum
      sum_at(const LatticeIndex<dim> &cell, const unsigned int node, const bool affine) const
      {
        const auto              here = window.node_index(node);
        std::array<double, dim> xi;
        double                  rest = 1.;
        for (int d = 0; d < dim; ++d)
          {
            xi[d] = double(here[d] - cell[d]) / edge;
            rest -= xi[d];
          }
        NodeSum sum{node, {}, {}};
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            double weight = 1.;
            if (!affine)
              for (int d = 0; d < dim; ++d)
                weight *= (v >> d) & 1u ? xi[d] : 1. - xi[d];
            else if (v == 0)
              weight = rest;
            else if ((v & (v - 1)) != 0)
              weight = 0.;
            else
              for (int d = 0; d < dim; ++d)
                if (v == 1u << d)
                  weight = xi[d];
            if (weight != 0.)
              {
                sum.roots.push_back(window.node_number(corner_of<dim>(cell, v, edge)));
                sum.weights.push_back(weight);
              }
          }
        return sum;
      }

      const LatticeWindow<dim>  &window;
      const std::vector<double> &volume;
      const Pieces              &pieces;
      const std::vector<bool>   &is_tied;
      std::set<unsigned int>     left;
      const int                  edge;
    };
  } // namespace



  namespace
  {
    /** The least node of the piece of each node; joins what the points of any rank join
     * (collective). */
    std::vector<unsigned int>
    least_nodes(UnionOfNodes &sets, const unsigned int n, const MPI_Comm communicator)
    {
      const bool                alone = dealii::Utilities::MPI::n_mpi_processes(communicator) == 1;
      std::vector<unsigned int> least(n);
      for (bool changed = true; changed;)
        {
          for (unsigned int node = 0; node < n; ++node)
            least[node] = sets.find(node);
          if (alone)
            return least;
          const std::vector<unsigned int> own = least;
          MPI_Allreduce(MPI_IN_PLACE,
                        least.data(),
                        static_cast<int>(n),
                        MPI_UNSIGNED,
                        MPI_MIN,
                        communicator);
          for (unsigned int node = 0; node < n; ++node)
            sets.join(node, least[node]);
          changed = dealii::Utilities::MPI::logical_or(own != least, communicator);
        }
      return least;
    }

    /** Numbers the pieces in the order of their least nodes. */
    Pieces
    number_pieces(const std::vector<unsigned char> &reached, const std::vector<unsigned int> &least)
    {
      Pieces                    result{std::vector<unsigned int>(reached.size(), Pieces::none), {}};
      std::vector<unsigned int> number(reached.size(), Pieces::none); // of a least node
      for (unsigned int node = 0; node < reached.size(); ++node)
        if (reached[node])
          {
            if (number[least[node]] == Pieces::none)
              {
                number[least[node]] = static_cast<unsigned int>(result.n_points.size());
                result.n_points.push_back(0);
              }
            result.of_node[node] = number[least[node]];
          }
      return result;
    }
  } // namespace



  template <int dim>
  Pieces
  find_pieces(const BackgroundGrid<dim>  &grid,
              const StepPoints<dim>      &points,
              const std::vector<NodeSum> &hanging)
  {
    const auto                 strides = grid.window().node_strides();
    const unsigned int         n       = grid.window().n_nodes_total();
    UnionOfNodes               sets(n);
    std::vector<unsigned char> reached(n, 0);
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        unsigned int first = Pieces::none;
        for_nodes<dim>(points.stencil[slot], strides, [&](const unsigned int node) {
          reached[node] = 1;
          first         = first == Pieces::none ? node : first;
          sets.join(first, node);
        });
      }
    for (const NodeSum &sum : hanging)
      for (const unsigned int root : sum.roots)
        {
          reached[root] = 1;
          sets.join(sum.node, root);
        }
    const auto sum_up = [&](auto &values, const MPI_Datatype type, const MPI_Op operation) {
      if (dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
        MPI_Allreduce(MPI_IN_PLACE,
                      values.data(),
                      static_cast<int>(values.size()),
                      type,
                      operation,
                      grid.communicator());
    };
    sum_up(reached, MPI_UNSIGNED_CHAR, MPI_MAX);
    Pieces result = number_pieces(reached, least_nodes(sets, n, grid.communicator()));
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        unsigned int piece = Pieces::none;
        for_nodes<dim>(points.stencil[slot], strides, [&](const unsigned int node) {
          piece = result.of_node[node];
        });
        ++result.n_points[piece];
      }
    sum_up(result.n_points, MPI_UNSIGNED, MPI_SUM);
    return result;
  }



  template <int dim>
  std::vector<NodeSum>
  tie_small_pieces(const LatticeWindow<dim>        &window,
                   const std::vector<double>       &volume,
                   const Pieces                    &pieces,
                   const std::vector<bool>         &is_tied,
                   const std::vector<unsigned int> &left,
                   const int                        edge,
                   const int                        reach)
  {
    std::vector<NodeSum> sums;
    Roots<dim>           roots(window, volume, pieces, is_tied, left, edge);
    while (const auto cell = roots.fullest())
      roots.take(*cell, reach, sums);
    return sums;
  }

#define KEDGE_INSTANTIATE(dim)                                                      \
  template Pieces               find_pieces(const BackgroundGrid<dim> &,            \
                                            const StepPoints<dim> &,                \
                                            const std::vector<NodeSum> &);          \
  template std::vector<NodeSum> tie_small_pieces(const LatticeWindow<dim> &,        \
                                                 const std::vector<double> &,       \
                                                 const Pieces &,                    \
                                                 const std::vector<bool> &,         \
                                                 const std::vector<unsigned int> &, \
                                                 const int,                         \
                                                 const int);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
