#include <kedge/equations/tied_rows.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  void
  TiedRows<dim>::add_couplings(const NodeTies<dim> &ties,
                               const unsigned int   slot,
                               const unsigned int   neighbour,
                               const Part          &part)
  {
    const Row         &row    = rows.back();
    const unsigned int number = rows.size();
    const auto         add    = [&](const unsigned int node, const double weight) {
      if (mark[node] != number)
        {
          mark[node]            = number;
          place_of_column[node] = columns.size() - row.first_column;
          columns.push_back(node);
        }
      couplings.push_back({slot, place_of_column[node], part.components, weight});
    };
    if (part.tie < 0)
      add(neighbour, 1.);
    else
      for (unsigned int k = 0; k < ties.ties()[part.tie].roots.size(); ++k)
        add(ties.ties()[part.tie].roots[k], ties.ties()[part.tie].weights[k]);
  }



  template <int dim>
  void
  TiedRows<dim>::add_row(const Patch<dim>         &patch,
                         const std::vector<Parts> &parts,
                         const NodeMatrix<dim>    &matrix,
                         const unsigned int        node,
                         const Part               &part)
  {
    const auto first_column   = static_cast<unsigned int>(columns.size());
    const auto first_coupling = static_cast<unsigned int>(couplings.size());
    rows.push_back({node, part.components, first_column, 0, first_coupling, 0});
    for_neighbours(patch, node, matrix, [&](const unsigned int slot, const unsigned int j) {
      for (const Part &other : parts[j])
        if (other.components != 0 && (part.tie >= 0 || other.tie >= 0))
          add_couplings(patch.ties, slot, j, other);
    });
    rows.back().end_column   = static_cast<unsigned int>(columns.size());
    rows.back().end_coupling = static_cast<unsigned int>(couplings.size());
    if (rows.back().end_column == first_column)
      {
        rows.pop_back();
        return;
      }
    const auto number = static_cast<unsigned int>(rows.size() - 1);
    if (part.tie < 0)
      all_feeds.push_back({node, number, 1.});
    else
      for (unsigned int k = 0; k < patch.ties.ties()[part.tie].roots.size(); ++k)
        all_feeds.push_back(
          {patch.ties.ties()[part.tie].roots[k], number, patch.ties.ties()[part.tie].weights[k]});
  }



  template <int dim>
  void
  TiedRows<dim>::reinit(const Patch<dim>               &patch,
                        const std::vector<NodalStatus> &status,
                        const NodeMatrix<dim>          &matrix)
  {
    n_components = matrix.n_components();
    rows.clear();
    columns.clear();
    couplings.clear();
    all_feeds.clear();
    if (patch.ties.empty())
      return;
    mark.assign(patch.nodes.n_local(), 0);
    place_of_column.resize(patch.nodes.n_local());
    std::vector<Parts> parts(patch.nodes.n_local(), Parts{{{-1, 0}, {-1, 0}, {-1, 0}}});
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      for (unsigned int c = 0; c < n_components; ++c)
        {
          const NodalStatus s = status[std::size_t(i) * n_components + c];
          if (s == NodalStatus::prescribed)
            continue;
          const int tie = s == NodalStatus::tied ? patch.ties.tie_of(i, static_cast<int>(c)) : -1;
          Part &part = *std::find_if(parts[i].begin(), parts[i].end() - 1, [&](const Part &other) {
            return other.components == 0 || other.tie == tie;
          });
          part.tie   = tie;
          part.components |= 1u << c;
        }
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      for (const Part &part : parts[i])
        if (part.components != 0)
          add_row(patch, parts, matrix, i, part);
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
              const Coupling &c     = couplings[k];
              const bool      whole = c.components + 1 == 1u << n_components;
              for (unsigned int m = 0; m < n_components; ++m)
                if (whole || (c.components >> m) & 1u)
                  ac[c.column * n_components + m] += c.weight * a[c.slot * n_components + m];
            }
        }
  }

  template class TiedRows<2>;
  template class TiedRows<3>;
} // namespace kedge
