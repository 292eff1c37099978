#include "lattice_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace kedge
{
  namespace
  {
    using Node = LatticeLevel::Node;

    /** Directions with a spacing above this multiple of the smallest are not coarsened yet. */
    constexpr double stretched = 1.5;

    /** Coordinates closer than this part of their range are the same. */
    constexpr double same_place = 1e-7;

    /** x runs first. */
    bool
    comes_before(const Node &a, const Node &b)
    {
      return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
    }

    /** The smallest coordinate in a direction, and the smallest distance. */
    std::pair<double, double>
    origin_and_spacing(const MixedBlocks &blocks, const int d)
    {
      std::vector<double> x;
      for (std::size_t row = 0; row < blocks.component.size(); ++row)
        x.push_back(blocks.position[row * blocks.dim + d]);
      std::sort(x.begin(), x.end());
      const double range   = x.back() - x.front();
      double       spacing = range > 0. ? range : 1.;
      for (std::size_t k = 1; k < x.size(); ++k)
        if (x[k] - x[k - 1] > same_place * range)
          spacing = std::min(spacing, x[k] - x[k - 1]);
      return {x.front(), spacing};
    }

    std::array<bool, 3>
    coarsened_directions(const LatticeLevel &level)
    {
      const double smallest =
        *std::min_element(level.spacing.begin(), level.spacing.begin() + level.dim);
      std::array<bool, 3> result = {};
      for (int d = 0; d < level.dim; ++d)
        result[d] = level.spacing[d] <= stretched * smallest;
      return result;
    }

    /** Calls visit(coarse node, weight) for the nodes between which a fine one stands. */
    template <typename Visit>
    void
    for_parents(const Node &fine, const std::array<bool, 3> &coarsened, const Visit &visit)
    {
      for (int corner = 0; corner < 8; ++corner)
        {
          Node   coarse = fine;
          double weight = 1.;
          for (int d = 0; d < 3; ++d)
            {
              const int  upper   = (corner >> d) & 1;
              const bool between = coarsened[d] && fine[d] % 2 == 1;
              weight *= between ? 0.5 : (upper ? 0. : 1.);
              if (coarsened[d])
                coarse[d] = fine[d] / 2 + (between ? upper : 0);
            }
          if (weight > 0.)
            visit(coarse, weight);
        }
    }
  } // namespace



  std::optional<LatticeLevel>
  find_lattice(const MixedBlocks &blocks)
  {
    LatticeLevel level;
    level.dim     = blocks.dim;
    level.spacing = {{1., 1., 1.}};
    if (blocks.component.empty() ||
        std::count(blocks.component.begin(), blocks.component.end(), blocks.dim) > 0)
      return {};
    std::array<double, 3> origin = {};
    for (int d = 0; d < level.dim; ++d)
      std::tie(origin[d], level.spacing[d]) = origin_and_spacing(blocks, d);
    for (std::size_t row = 0; row < blocks.component.size(); ++row)
      {
        Node node = {};
        for (int d = 0; d < level.dim; ++d)
          node[d] = static_cast<int>(
            std::lround((blocks.position[row * blocks.dim + d] - origin[d]) / level.spacing[d]));
        if (level.node.empty() || level.node.back() != node ||
            level.row[level.row.size() - level.dim + blocks.component[row]] >= 0)
          {
            level.node.push_back(node);
            level.row.resize(level.row.size() + level.dim, -1);
          }
        level.node_of_row.push_back(static_cast<int>(level.node.size()) - 1);
        level.row[level.row.size() - level.dim + blocks.component[row]] = static_cast<int>(row);
      }
    std::vector<Node> sorted = level.node;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return {};
    return level;
  }



  LatticeTransfer::LatticeTransfer(const LatticeLevel &fine, LatticeLevel &coarse)
  {
    const auto coarsened = coarsened_directions(fine);
    coarse               = LatticeLevel();
    coarse.dim           = fine.dim;
    coarse.spacing       = fine.spacing;
    for (int d = 0; d < fine.dim; ++d)
      coarse.spacing[d] *= coarsened[d] ? 2. : 1.;
    for (const Node &node : fine.node)
      for_parents(node, coarsened, [&](const Node &parent, const double) {
        coarse.node.push_back(parent);
      });
    std::sort(coarse.node.begin(), coarse.node.end(), comes_before);
    coarse.node.erase(std::unique(coarse.node.begin(), coarse.node.end()), coarse.node.end());
    find_parents(fine, coarse);
    find_children(coarse.n_nodes());
  }



  /** And which coarse components have an equation: those of which a child's has. */
  void
  LatticeTransfer::find_parents(const LatticeLevel &fine, LatticeLevel &coarse)
  {
    const int  dim       = fine.dim;
    const auto coarsened = coarsened_directions(fine);
    coarse.row.assign(coarse.node.size() * dim, -1);
    for (unsigned int i = 0; i < fine.n_nodes(); ++i)
      {
        for_parents(fine.node[i], coarsened, [&](const Node &parent, const double weight) {
          const auto place =
            std::lower_bound(coarse.node.begin(), coarse.node.end(), parent, comes_before);
          const int I = static_cast<int>(place - coarse.node.begin());
          parents.link.push_back({I, weight});
          for (int c = 0; c < dim; ++c)
            if (fine.row[i * dim + c] >= 0)
              coarse.row[I * dim + c] = 0;
        });
        parents.first.push_back(parents.link.size());
      }
    for (std::size_t k = 0; k < coarse.row.size(); ++k)
      if (coarse.row[k] >= 0)
        {
          coarse.row[k] = static_cast<int>(coarse.node_of_row.size());
          coarse.node_of_row.push_back(static_cast<int>(k) / dim);
        }
  }



  void
  LatticeTransfer::find_children(const unsigned int n_coarse)
  {
    children.first.assign(n_coarse + 1, 0);
    for (const Link &link : parents.link)
      ++children.first[link.node + 1];
    for (unsigned int I = 0; I < n_coarse; ++I)
      children.first[I + 1] += children.first[I];
    children.link.resize(parents.link.size());
    auto next = children.first;
    for (unsigned int i = 0; i + 1 < parents.first.size(); ++i)
      for (std::size_t k = parents.first[i]; k < parents.first[i + 1]; ++k)
        children.link[next[parents.link[k].node]++] = {static_cast<int>(i), parents.link[k].weight};
  }



  void
  LatticeTransfer::restrict_sums(const LatticeLevel        &fine,
                                 const std::vector<double> &x,
                                 const LatticeLevel        &coarse,
                                 std::vector<double>       &r) const
  {
    const int dim = fine.dim;
    r.assign(coarse.n_rows(), 0.);
    for (unsigned int i = 0; i < fine.n_nodes(); ++i)
      for (std::size_t k = parents.first[i]; k < parents.first[i + 1]; ++k)
        for (int c = 0; c < dim; ++c)
          if (fine.row[i * dim + c] >= 0)
            r[coarse.row[parents.link[k].node * dim + c]] +=
              parents.link[k].weight * x[fine.row[i * dim + c]];
  }



  void
  LatticeTransfer::prolong(const LatticeLevel        &fine,
                           const LatticeLevel        &coarse,
                           const std::vector<double> &y,
                           std::vector<double>       &x) const
  {
    const int dim = fine.dim;
    x.assign(fine.n_rows(), 0.);
    for (unsigned int i = 0; i < fine.n_nodes(); ++i)
      for (std::size_t k = parents.first[i]; k < parents.first[i + 1]; ++k)
        for (int c = 0; c < dim; ++c)
          if (fine.row[i * dim + c] >= 0)
            x[fine.row[i * dim + c]] +=
              parents.link[k].weight * y[coarse.row[parents.link[k].node * dim + c]];
  }



  namespace
  {
    /** The rows of a node of a matrix as they are summed up, over the columns of few nodes. */
    class NodeRows
    {
    public:
      explicit NodeRows(const LatticeLevel &level)
        : level(level)
        , is_marked(level.n_nodes(), 0)
        , sums(std::size_t(level.n_rows()) * 3, 0.)
      {}

      void
      mark(const int node)
      {
        if (is_marked[node])
          return;
        is_marked[node] = 1;
        marked.push_back(node);
      }

      /** The sums at a column, one per component of the row's node. */
      double *
      at(const int column)
      {
        return sums.data() + std::size_t(column) * 3;
      }

      /** Columns of a node's components, or -1. */
      const int *
      columns(const int node) const
      {
        return level.row.data() + std::size_t(node) * level.dim;
      }

      /** Calls visit(node) for all marked nodes in order and starts again from zero. */
      template <typename Visit>
      void
      take(const Visit &visit)
      {
        std::sort(marked.begin(), marked.end());
        for (const int node : marked)
          {
            visit(node);
            is_marked[node] = 0;
            for (int c = 0; c < level.dim; ++c)
              if (columns(node)[c] >= 0)
                std::fill_n(at(columns(node)[c]), 3, 0.);
          }
        marked.clear();
      }

    private:
      const LatticeLevel        &level;
      std::vector<unsigned char> is_marked;
      std::vector<int>           marked;
      std::vector<double>        sums;
    };

    /** Appends the rows of a node to a matrix. */
    void
    append_rows(NodeRows &sums, const int dim, const int *rows, SparseSystem &matrix)
    {
      std::vector<int>    columns;
      std::vector<double> values[3];
      sums.take([&](const int node) {
        for (int d = 0; d < dim; ++d)
          {
            const int column = sums.columns(node)[d];
            if (column < 0)
              continue;
            columns.push_back(column);
            for (int c = 0; c < dim; ++c)
              values[c].push_back(sums.at(column)[c]);
          }
      });
      for (int c = 0; c < dim; ++c)
        if (rows[c] >= 0)
          {
            matrix.column.insert(matrix.column.end(), columns.begin(), columns.end());
            matrix.value.insert(matrix.value.end(), values[c].begin(), values[c].end());
            matrix.row_start.push_back(static_cast<std::int64_t>(matrix.column.size()));
          }
    }
  } // namespace



  /** Node by node of the coarse level: the rows of its children are summed, then their columns. */
  SparseSystem
  LatticeTransfer::coarse_matrix(const LatticeLevel &fine,
                                 const SparseSystem &matrix,
                                 const LatticeLevel &coarse) const
  {
    const int    dim = fine.dim;
    NodeRows     over_fine(fine), over_coarse(coarse);
    SparseSystem result;
    result.n_global = coarse.n_rows();
    for (unsigned int I = 0; I < coarse.n_nodes(); ++I)
      {
        for (std::size_t k = children.first[I]; k < children.first[I + 1]; ++k)
          for (int c = 0; c < dim; ++c)
            {
              const int row = fine.row[children.link[k].node * dim + c];
              if (row < 0)
                continue;
              for (std::int64_t e = matrix.row_start[row]; e < matrix.row_start[row + 1]; ++e)
                {
                  over_fine.mark(fine.node_of_row[matrix.column[e]]);
                  over_fine.at(matrix.column[e])[c] += children.link[k].weight * matrix.value[e];
                }
            }
        over_fine.take([&](const int j) {
          for (std::size_t k = parents.first[j]; k < parents.first[j + 1]; ++k)
            {
              over_coarse.mark(parents.link[k].node);
              const int *to = over_coarse.columns(parents.link[k].node);
              for (int d = 0; d < dim; ++d)
                if (over_fine.columns(j)[d] >= 0)
                  for (int c = 0; c < dim; ++c)
                    over_coarse.at(to[d])[c] +=
                      parents.link[k].weight * over_fine.at(over_fine.columns(j)[d])[c];
            }
        });
        append_rows(over_coarse, dim, over_coarse.columns(static_cast<int>(I)), result);
      }
    return result;
  }
} // namespace kedge
