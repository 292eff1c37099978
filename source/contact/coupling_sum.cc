#include <kedge/contact/coupling_sum.h>

namespace kedge
{
  template <int dim>
  typename CouplingSum<dim>::Nodes
  CouplingSum<dim>::nodes_of(const Coefficients &coefficients)
  {
    Nodes nodes;
    nodes.reserve(coefficients.size());
    for (const auto &[node, c] : coefficients)
      nodes.push_back(node);
    return nodes;
  }



  template <int dim>
  void
  CouplingSum<dim>::add(const Coefficients &coefficients, const dealii::Tensor<2, dim> &matrix)
  {
    auto &sum = blocks[nodes_of(coefficients)];
    sum.resize(coefficients.size() * coefficients.size());
    auto block = sum.begin();
    for (const auto &[row, c_row] : coefficients)
      for (const auto &[column, c_column] : coefficients)
        *block++ += c_row * c_column * matrix;
  }



  template <int dim>
  void
  CouplingSum<dim>::add_by_pressure(const Coefficients           &forces,
                                    const Coefficients           &pressures,
                                    const dealii::Tensor<1, dim> &vector)
  {
    auto &sum = by_pressure[{nodes_of(forces), nodes_of(pressures)}];
    sum.resize(forces.size() * pressures.size());
    auto block = sum.begin();
    for (const auto &[row, c] : forces)
      for (const auto &[column, e] : pressures)
        *block++ += c * e * vector;
  }



  template <int dim>
  void
  CouplingSum<dim>::add_to(Tangent<dim> &tangent) const
  {
    using Node = std::pair<unsigned int, unsigned int>;
    std::map<std::pair<Node, Node>, dealii::Tensor<2, dim>> pairs; // fewer than in all blocks
    for (const auto &[nodes, sum] : blocks)
      {
        auto block = sum.begin();
        for (const auto &row : nodes)
          for (const auto &column : nodes)
            pairs[{row, column}] += *block++;
      }
    for (const auto &[pair, sum] : pairs)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          tangent.add({pair.first.first, pair.first.second, i},
                      {pair.second.first, pair.second.second, j},
                      sum[i][j]);
    for (const auto &[nodes, sum] : by_pressure)
      {
        auto block = sum.begin();
        for (const auto &row : nodes.first)
          for (const auto &column : nodes.second)
            {
              for (unsigned int i = 0; i < dim; ++i)
                tangent.add({row.first, row.second, i},
                            {column.first, column.second, dim},
                            (*block)[i]);
              ++block;
            }
      }
  }

  template class CouplingSum<2>;
  template class CouplingSum<3>;
} // namespace kedge
