#include <kedge/contact/coupling_sum.h>

namespace kedge
{
  template <int dim>
  void
  CouplingSum<dim>::add(const Coefficients &coefficients, const dealii::Tensor<2, dim> &matrix)
  {
    Nodes nodes;
    nodes.reserve(coefficients.size());
    for (const auto &[node, c] : coefficients)
      nodes.push_back(node);
    auto &sum = blocks[nodes];
    sum.resize(nodes.size() * nodes.size());
    auto block = sum.begin();
    for (const auto &[row, c_row] : coefficients)
      for (const auto &[column, c_column] : coefficients)
        *block++ += c_row * c_column * matrix;
  }



  template <int dim>
  void
  CouplingSum<dim>::add_to(Tangent<dim> &tangent) const
  {
    for (const auto &[nodes, sum] : blocks)
      {
        auto block = sum.begin();
        for (const auto &row : nodes)
          for (const auto &column : nodes)
            {
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = 0; j < dim; ++j)
                  tangent.add({row.first, row.second, i},
                              {column.first, column.second, j},
                              (*block)[i][j]);
              ++block;
            }
      }
  }

  template class CouplingSum<2>;
  template class CouplingSum<3>;
} // namespace kedge
