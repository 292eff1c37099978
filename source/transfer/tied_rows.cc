#include <kedge/transfer/tied_rows.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  void
  TiedRows<dim>::add_couplings(const NodeTies<dim> &ties,
                               const unsigned int   slot,
                               const unsigned int   neighbour,
                               const unsigned int   components)
  {
    const Row &row = rows.back();
    const auto add = [&](const unsigned int node, const double weight) {
      if (mark[node] != row.node + 1)
        {
          mark[node]            = row.node + 1;
          place_of_column[node] = columns.size() - row.first_column;
          columns.push_back(node);
        }
      couplings.push_back({slot, place_of_column[node], components, weight});
    };
    const int tie = ties.tie_of(neighbour);
    if (tie < 0)
      add(neighbour, 1.);
    else
      for (unsigned int k = 0; k < ties.ties()[tie].roots.size(); ++k)
        add(ties.ties()[tie].roots[k], ties.ties()[tie].weights[k]);
  }



  template <int dim>
  void
  TiedRows<dim>::reinit(const LatticeWindow<dim>       &window,
                        const ActiveNodes<dim>         &nodes,
                        const NodeTies<dim>            &ties,
                        const std::vector<NodalStatus> &status,
                        const NodeMatrix<dim>          &matrix)
  {
    n_components = matrix.n_components();
    rows.clear();
    columns.clear();
    couplings.clear();
    all_feeds.clear();
    if (ties.empty())
      return;
    mark.assign(nodes.n_local(), 0);
    place_of_column.resize(nodes.n_local());
    std::vector<unsigned int> components(nodes.n_local(), 0);
    for (unsigned int i = 0; i < nodes.n_local() * n_components; ++i)
      if (status[i] != NodalStatus::prescribed)
        components[i / n_components] |= 1u << (i % n_components);

    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        const auto first_column   = static_cast<unsigned int>(columns.size());
        const auto first_coupling = static_cast<unsigned int>(couplings.size());
        const int  tie            = ties.tie_of(i);
        rows.push_back({i, components[i], first_column, 0, first_coupling, 0});
        for_neighbours(window,
                       nodes,
                       i,
                       matrix,
                       [&](const unsigned int slot, const unsigned int j) {
                         if (tie >= 0 || ties.tie_of(j) >= 0)
                           add_couplings(ties, slot, j, components[j]);
                       });
        rows.back().end_column   = static_cast<unsigned int>(columns.size());
        rows.back().end_coupling = static_cast<unsigned int>(couplings.size());
        if (rows.back().end_column == first_column || components[i] == 0)
          {
            columns.resize(first_column);
            couplings.resize(first_coupling);
            rows.pop_back();
            continue;
          }
        const auto number = static_cast<unsigned int>(rows.size() - 1);
        if (tie < 0)
          all_feeds.push_back({i, number, 1.});
        else
          for (unsigned int k = 0; k < ties.ties()[tie].roots.size(); ++k)
            all_feeds.push_back({ties.ties()[tie].roots[k], number, ties.ties()[tie].weights[k]});
      }
    std::stable_sort(all_feeds.begin(), all_feeds.end(), [](const Feed &a, const Feed &b) {
      return a.node < b.node;
    });
  }



  template <int dim>
  void
  TiedRows<dim>::multiply(const NodeMatrix<dim> &matrix)
  {
    product.assign(columns.size() * n_components * n_components, 0.);
    for (const Row &row : rows)
      for (unsigned int p = 0; p < n_components; ++p)
        {
          const double *a  = matrix.row(row.node, p);
          double       *ac = &product[first_value(row, p)];
          for (unsigned int k = row.first_coupling; k < row.end_coupling; ++k)
            {
              const Coupling &c = couplings[k];
              for (unsigned int m = 0; m < n_components; ++m)
                if ((c.components >> m) & 1u)
                  ac[c.column * n_components + m] += c.weight * a[c.slot * n_components + m];
            }
        }
  }

  template class TiedRows<2>;
  template class TiedRows<3>;
} // namespace kedge
