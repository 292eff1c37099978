#include <kedge/equations/tangent.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  Tangent<dim>::Tangent(const std::vector<const Patch<dim> *> &patches,
                        const Unknowns<dim>                   &unknowns)
    : patches(patches)
    , unknowns(unknowns)
    , blocks(patches.size())
  {}



  template <int dim>
  void
  Tangent<dim>::reinit(const std::vector<int> &radius)
  {
    bool any = false;
    for (unsigned int f = 0; f < blocks.size(); ++f)
      {
        const Patch<dim> &patch = *patches[f];
        if (!patch.new_pattern() && !rank_begin.empty())
          continue;
        any = true;
        blocks[f].matrix.reinit(patch.nodes.n_local(), unknowns.fields[f].n_components, radius[f]);
        blocks[f].equations.reinit(patch, patch.constraints.status(), blocks[f].matrix);
      }
    if (!any)
      return;
    new_pattern = to_build = true;
    number_equations();
  }



  template <int dim>
  unsigned int
  Tangent<dim>::n_own_others() const
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator()) == 0 ? unknowns.n_others() : 0;
  }



  template <int dim>
  unsigned int
  Tangent<dim>::n_own_equations() const
  {
    unsigned int n = n_own_others();
    for (const Block &block : blocks)
      n += block.equations.system().n_rows();
    return n;
  }



  template <int dim>
  void
  Tangent<dim>::number_equations()
  {
    const unsigned int        n_fields = blocks.size();
    std::vector<std::int64_t> own;
    unsigned int              first = 0;
    for (Block &block : blocks)
      {
        block.first = first;
        own.push_back(block.equations.system().n_rows());
        first += block.equations.system().n_rows();
      }
    own.push_back(n_own_others());
    if (blocks.size() == 1 && unknowns.n_others() == 0)
      {
        const SparseSystem &system = blocks.front().equations.system();
        joint.n_global             = system.n_global;
        joint.first_row            = system.first_row;
      }
    const auto counts = dealii::Utilities::MPI::all_gather(communicator(), own);
    rank_begin.assign(1, 0);
    field_begin.assign(n_fields, 0); // of rank 0
    for (const auto &of_rank : counts)
      {
        std::int64_t n = 0;
        for (unsigned int f = 0; f < n_fields; ++f)
          {
            field_begin.push_back(field_begin[field_begin.size() - n_fields] + of_rank[f]);
            n += of_rank[f];
          }
        rank_begin.push_back(rank_begin.back() + n + of_rank[n_fields]);
      }
    first_other = 0;
    for (unsigned int f = 0; f < n_fields; ++f)
      first_other += counts[0][f];
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator());
    for (unsigned int f = 0; f < n_fields; ++f)
      {
        Block &block = blocks[f];
        block.number.assign(std::size_t(patches[f]->nodes.n_local()) *
                              unknowns.fields[f].n_components,
                            -1);
        const auto &nodal = block.equations.nodal_indices();
        for (unsigned int e = 0; e < nodal.size(); ++e)
          block.number[nodal[e]] = rank_begin[rank] + block.first + e;
        patches[f]->nodes.update_ghosts(block.number, unknowns.fields[f].n_components);
      }
    joint.communicator = communicator();
    joint.n_global     = rank_begin.back();
    joint.first_row    = rank_begin[rank];
  }



  template <int dim>
  std::int64_t
  Tangent<dim>::joint_column(const unsigned int field, const std::int64_t column) const
  {
    const unsigned int n_fields = blocks.size();
    unsigned int       rank     = 0;
    while (rank + 2 < rank_begin.size() && column >= field_begin[(rank + 1) * n_fields + field])
      ++rank;
    std::int64_t result = rank_begin[rank] + column - field_begin[rank * n_fields + field];
    for (unsigned int f = 0; f < field; ++f)
      result += field_begin[(rank + 1) * n_fields + f] - field_begin[rank * n_fields + f];
    return result;
  }



  template <int dim>
  void
  Tangent<dim>::set_zero()
  {
    for (Block &block : blocks)
      block.matrix.set_zero();
    entries.clear();
  }



  template <int dim>
  void
  Tangent<dim>::add_to_diagonal_blocks(const unsigned int     field,
                                       const double           coefficient,
                                       const NodeMatrix<dim> &matrix,
                                       const int              first,
                                       const int              end)
  {
    NodeMatrix<dim>          &sum          = blocks[field].matrix;
    const unsigned int        n_components = unknowns.fields[field].n_components;
    std::vector<unsigned int> slots(matrix.n_slots()); // of the matrix, in the wider tangent
    for (unsigned int s = 0; s < slots.size(); ++s)
      slots[s] = sum.slot(matrix.offset(s));
    for (unsigned int i = 0; i < patches[field]->nodes.n_local(); ++i)
      {
        const double *matrix_row = matrix.row(i, 0);
        for (int p = first; p < end; ++p)
          {
            double *row = sum.row(i, p);
            for (unsigned int s = 0; s < slots.size(); ++s)
              row[slots[s] * n_components + p] += coefficient * matrix_row[s];
          }
      }
  }



  /** Calls visit(joint equation, weight) for the equations of which an unknown is the sum. */
  template <int dim>
  template <typename Visit>
  void
  Tangent<dim>::for_equations(const UnknownIndex &unknown, const Visit &visit) const
  {
    if (unknown.field == UnknownIndex::no_field)
      return visit(first_other + unknown.node, 1.);
    const Block       &block        = blocks[unknown.field];
    const unsigned int n_components = unknowns.fields[unknown.field].n_components;
    patches[unknown.field]->constraints.for_free(
      unknown.node,
      unknown.component,
      [&](const unsigned int node, const double weight) {
        visit(block.number[std::size_t(node) * n_components + unknown.component], weight);
      });
  }



  template <int dim>
  void
  Tangent<dim>::add(const UnknownIndex &row, const UnknownIndex &column, const double value)
  {
    for_equations(row, [&](const std::int64_t i, const double of_row) {
      for_equations(column, [&](const std::int64_t j, const double of_column) {
        entries.push_back({i, j, of_row * of_column * value});
      });
    });
  }



  template <int dim>
  void
  Tangent<dim>::send_entries_to_owners()
  {
    if (rank_begin.size() == 2)
      return;
    std::map<unsigned int, std::vector<double>> outgoing; // row, column, value ..
    std::vector<Entry>                          own;
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator());
    for (const Entry &entry : entries)
      {
        const auto owner = static_cast<unsigned int>(
          std::upper_bound(rank_begin.begin(), rank_begin.end() - 1, entry.row) -
          rank_begin.begin() - 1);
        if (owner == rank)
          own.push_back(entry);
        else
          outgoing[owner].insert(outgoing[owner].end(),
                                 {static_cast<double>(entry.row),
                                  static_cast<double>(entry.column),
                                  entry.value});
      }
    for (const auto &[from, values] :
         dealii::Utilities::MPI::some_to_some(communicator(), outgoing))
      for (std::size_t k = 0; k < values.size(); k += 3)
        own.push_back({std::llround(values[k]), std::llround(values[k + 1]), values[k + 2]});
    entries.swap(own);
  }



  /** Sorts the entries by rows and columns, and adds up those at the same place. */
  template <int dim>
  void
  Tangent<dim>::sum_entries()
  {
    std::stable_sort(entries.begin(), entries.end(), [](const Entry &a, const Entry &b) {
      return a.row < b.row || (a.row == b.row && a.column < b.column);
    });
    std::size_t n = 0;
    for (const Entry &entry : entries)
      if (n > 0 && entries[n - 1].row == entry.row && entries[n - 1].column == entry.column)
        entries[n - 1].value += entry.value;
      else
        entries[n++] = entry;
    entries.resize(n);

    std::vector<std::pair<std::int64_t, std::int64_t>> pattern;
    for (const Entry &entry : entries)
      pattern.emplace_back(entry.row, entry.column);
    const bool changed = pattern != entry_pattern;
    entry_pattern.swap(pattern);
    if (dealii::Utilities::MPI::logical_or(changed, communicator()))
      to_build = true;
  }



  template <int dim>
  void
  Tangent<dim>::build_joint_rows()
  {
    joint.row_start.assign(1, 0);
    joint.column.clear();
    place_of_lattice.clear();
    place_of_entry.resize(entries.size());
    std::size_t next       = 0; // entry
    const auto  finish_row = [&](const std::vector<int> &lattice_columns) {
      const std::int64_t row = joint.first_row + joint.n_rows();
      std::size_t        k   = 0;
      while (k < lattice_columns.size() || (next < entries.size() && entries[next].row == row))
        {
          const bool has_entry = next < entries.size() && entries[next].row == row;
          const int  column =
            !has_entry || (k < lattice_columns.size() && lattice_columns[k] <= entries[next].column)
                ? lattice_columns[k]
                : static_cast<int>(entries[next].column);
          if (has_entry && entries[next].column == column)
            place_of_entry[next++] = joint.column.size();
          if (k < lattice_columns.size() && lattice_columns[k] == column)
            {
              place_of_lattice.push_back(joint.column.size());
              ++k;
            }
          joint.column.push_back(column);
        }
      joint.row_start.push_back(static_cast<std::int64_t>(joint.column.size()));
    };
    std::vector<int> columns;
    for (unsigned int f = 0; f < blocks.size(); ++f)
      {
        const SparseSystem &system = blocks[f].equations.system();
        for (unsigned int e = 0; e < system.n_rows(); ++e)
          {
            columns.clear();
            for (std::int64_t k = system.row_start[e]; k < system.row_start[e + 1]; ++k)
              columns.push_back(static_cast<int>(joint_column(f, system.column[k])));
            finish_row(columns);
          }
      }
    columns.clear();
    for (unsigned int k = 0; k < n_own_others(); ++k)
      {
        columns.assign(1, static_cast<int>(first_other + k)); // a diagonal, be it zero
        finish_row(columns);
      }
    joint.value.resize(joint.column.size());
  }



  template <int dim>
  void
  Tangent<dim>::fill_joint_rows()
  {
    std::fill(joint.value.begin(), joint.value.end(), 0.);
    auto place = place_of_lattice.begin();
    for (const Block &block : blocks)
      for (const double value : block.equations.system().value)
        joint.value[*place++] = value;
    for (std::size_t k = 0; k < entries.size(); ++k)
      joint.value[place_of_entry[k]] += entries[k].value;
  }



  template <int dim>
  void
  Tangent<dim>::assemble()
  {
    for (unsigned int f = 0; f < blocks.size(); ++f)
      blocks[f].equations.fill(*patches[f], blocks[f].matrix);
    const bool was_single = is_single();
    has_entries           = dealii::Utilities::MPI::logical_or(!entries.empty(), communicator());
    if (is_single())
      {
        new_pattern = new_pattern || !was_single;
        return;
      }
    send_entries_to_owners();
    sum_entries();
    if (to_build || was_single)
      {
        build_joint_rows();
        new_pattern = true;
      }
    to_build = false;
    fill_joint_rows();
  }



  template <int dim>
  std::vector<double>
  Tangent<dim>::diagonal(const unsigned int field) const
  {
    const SparseSystem &all   = system();
    const unsigned int  first = blocks[field].first;
    std::vector<double> result(blocks[field].equations.system().n_rows(), 0.);
    for (unsigned int e = 0; e < result.size(); ++e)
      for (std::int64_t k = all.row_start[first + e]; k < all.row_start[first + e + 1]; ++k)
        if (all.column[k] == all.first_row + first + e)
          result[e] = all.value[k];
    return result;
  }



  template <int dim>
  std::vector<double>
  Tangent<dim>::gather(const UnknownVector &x) const
  {
    std::vector<double> result;
    result.reserve(joint.n_rows());
    for (unsigned int f = 0; f < blocks.size(); ++f)
      for (const unsigned int k : equations_of_field(f))
        result.push_back(x.fields[f][k]);
    result.insert(result.end(), x.others.begin(), x.others.begin() + n_own_others());
    return result;
  }



  template <int dim>
  void
  Tangent<dim>::scatter(const std::vector<double> &equations, UnknownVector &x) const
  {
    auto next = equations.begin();
    x.fields.resize(blocks.size());
    for (unsigned int f = 0; f < blocks.size(); ++f)
      {
        x.fields[f].assign(blocks[f].number.size(), 0.);
        for (const unsigned int k : equations_of_field(f))
          x.fields[f][k] = *next++;
        patches[f]->nodes.update_ghosts(x.fields[f], unknowns.fields[f].n_components);
        patches[f]->constraints.prolong(x.fields[f]);
      }
    x.others.resize(unknowns.n_others());
    std::copy_n(next, n_own_others(), x.others.begin());
    if (!x.others.empty())
      MPI_Bcast(x.others.data(), static_cast<int>(x.others.size()), MPI_DOUBLE, 0, communicator());
  }



  template <int dim>
  UnknownIndex
  Tangent<dim>::unknown(const unsigned int equation) const
  {
    unsigned int rest = equation;
    for (unsigned int f = 0; f < blocks.size(); ++f)
      {
        const auto &nodal = equations_of_field(f);
        if (rest < nodal.size())
          {
            const unsigned int n_components = unknowns.fields[f].n_components;
            return {f, nodal[rest] / n_components, nodal[rest] % n_components};
          }
        rest -= nodal.size();
      }
    return UnknownIndex::other(rest);
  }



  template <int dim>
  double
  Tangent<dim>::weight_of_equation(const unsigned int equation) const
  {
    const UnknownIndex index = unknown(equation);
    return index.field == UnknownIndex::no_field
             ? 1.
             : unknowns.fields[index.field].weight[index.component];
  }

  template class Tangent<2>;
  template class Tangent<3>;
} // namespace kedge
