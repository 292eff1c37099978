#include <kedge/fields/hanging_nodes.h>

namespace kedge
{
  namespace
  {
    /** Adds the free nodes that the value at a node is a sum of. */
    template <int dim>
    void
    add_free_nodes(const GridLevels<dim>          &levels,
                   const LevelNode<dim>           &node,
                   const double                    weight,
                   std::map<unsigned int, double> &sum)
    {
      const unsigned int free = levels.free_level(node);
      if (free == node.level)
        sum[levels.numbering(free).node_number(node.index)] += weight;
      else if (free > node.level)
        {
          LevelNode<dim> finer{node.level + 1, node.index};
          for (int &index : finer.index)
            index *= 2;
          add_free_nodes(levels, finer, weight, sum);
        }
      else
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            LevelNode<dim> coarser{node.level - 1, {}};
            double         share = weight;
            for (int d = 0; d < dim; ++d)
              {
                const int upper  = static_cast<int>((v >> d) & 1u);
                coarser.index[d] = node.index[d] / 2 + upper;
                if (node.index[d] % 2 != 0)
                  share *= 0.5;
                else if (upper != 0)
                  share = 0.;
              }
            if (share != 0.)
              add_free_nodes(levels, coarser, share, sum);
          }
    }
  } // namespace



  template <int dim>
  std::vector<NodeSum>
  hanging_nodes(const GridLevels<dim> &levels, const std::vector<unsigned char> &reached)
  {
    std::vector<NodeSum> result;
    if (levels.size() == 1)
      return result;
    std::map<unsigned int, double> sum;
    for (unsigned int number = 0; number < reached.size(); ++number)
      {
        if (!reached[number])
          continue;
        const LevelNode<dim> node = levels.node(number);
        if (levels.free_level(node) == node.level)
          continue;
        sum.clear();
        add_free_nodes(levels, node, 1., sum);
        NodeSum follows{number, {}, {}};
        for (const auto &[root, weight] : sum)
          {
            follows.roots.push_back(root);
            follows.weights.push_back(weight);
          }
        result.push_back(std::move(follows));
      }
    return result;
  }

  template std::vector<NodeSum>
  hanging_nodes(const GridLevels<2> &, const std::vector<unsigned char> &);
  template std::vector<NodeSum>
  hanging_nodes(const GridLevels<3> &, const std::vector<unsigned char> &);
} // namespace kedge
