#include <kedge/grid/grid_levels.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** Rows between the numbers of two levels: more than a matrix row or a search reaches. */
    constexpr int gap = 8;

    /** Cells of the next coarser lattice about refined ones that stencils may reach. */
    constexpr int margin = 2;

    /** Calls visit(index) for all indices of a box [low, low + n). */
    template <int dim, typename Visit>
    void
    for_box(const LatticeIndex<dim> &low, const LatticeIndex<dim> &n, const Visit &visit)
    {
      for (int d = 0; d < dim; ++d)
        if (n[d] <= 0)
          return;
      LatticeIndex<dim> index = low;
      while (true)
        {
          visit(index);
          int d = 0;
          while (d < dim && ++index[d] == low[d] + n[d])
            {
              index[d] = low[d];
              ++d;
            }
          if (d == dim)
            return;
        }
    }
  } // namespace



  template <int dim>
  GridLevels<dim>::GridLevels(const Lattice<dim> &coarsest)
    : levels{{coarsest, {}, {}, 0}}
  {}



  template <int dim>
  void
  GridLevels<dim>::cover(const LatticeWindow<dim> &cells)
  {
    base = cells;
    level_of_cell_.assign(base.n_cells_total(), 0);
    lay_out();
  }



  /** Raises levels until neighbours differ by one at most. */
  template <int dim>
  std::vector<unsigned char>
  GridLevels<dim>::graded(std::vector<unsigned char> wanted) const
  {
    const unsigned char deepest =
      wanted.empty() ? 0 : *std::max_element(wanted.begin(), wanted.end());
    LatticeIndex<dim> three;
    three.fill(3);
    for (unsigned int level = deepest; level > 1; --level)
      for (unsigned int c = 0; c < wanted.size(); ++c)
        {
          if (wanted[c] != level)
            continue;
          LatticeIndex<dim> low = base.cell_index(c);
          for (int d = 0; d < dim; ++d)
            --low[d];
          for_box<dim>(low, three, [&](const LatticeIndex<dim> &cell) {
            if (base.contains_cell(cell))
              {
                unsigned char &other = wanted[base.cell_number(cell)];
                other                = std::max(other, static_cast<unsigned char>(level - 1));
              }
          });
        }
    return wanted;
  }



  template <int dim>
  bool
  GridLevels<dim>::refine(const std::vector<unsigned char> &wanted)
  {
    std::vector<unsigned char> level = graded(wanted);
    if (level == level_of_cell_)
      return false;
    level_of_cell_ = std::move(level);
    lay_out();
    return true;
  }



  /** The box of cells of a lattice that stencils of its level can reach, in its own cells. */
  template <int dim>
  LatticeWindow<dim>
  GridLevels<dim>::needed_cells(const unsigned int level) const
  {
    LatticeIndex<dim> low, high;
    low.fill(std::numeric_limits<int>::max());
    high.fill(std::numeric_limits<int>::min());
    for (unsigned int c = 0; c < level_of_cell_.size(); ++c)
      if (level_of_cell_[c] >= level)
        {
          const auto cell = base.cell_index(c);
          for (int d = 0; d < dim; ++d)
            {
              low[d]  = std::min(low[d], cell[d]);
              high[d] = std::max(high[d], cell[d]);
            }
        }
    LatticeWindow<dim> result;
    for (int d = 0; d < dim; ++d)
      {
        result.low[d] = std::max(base.low[d], low[d] - margin);
        result.n_cells[d] =
          (std::min(base.low[d] + base.n_cells[d], high[d] + 1 + margin) - result.low[d]) << level;
        result.low[d] <<= level;
      }
    return result;
  }



  template <int dim>
  void
  GridLevels<dim>::lay_out()
  {
    const unsigned int deepest =
      level_of_cell_.empty() ? 0 : *std::max_element(level_of_cell_.begin(), level_of_cell_.end());
    levels.resize(1, levels.front());
    levels.front().first_row = base.low[dim - 1];
    levels.front().cells     = base;
    window_                  = base;
    for (unsigned int level = 1; level <= deepest; ++level)
      {
        Lattice<dim> lattice = levels.back().lattice;
        for (int d = 0; d < dim; ++d)
          {
            lattice.n_cells[d] *= 2;
            lattice.h[d] *= 0.5;
          }
        window_.n_cells[dim - 1] += gap;
        levels.push_back(
          {lattice, {}, needed_cells(level), window_.low[dim - 1] + window_.n_cells[dim - 1]});
        const LatticeIndex<dim> &n = levels.back().cells.n_cells;
        window_.n_cells[dim - 1] += n[dim - 1];
        for (int d = 0; d < dim - 1; ++d)
          window_.n_cells[d] = std::max(window_.n_cells[d], n[d]);
      }
    for (Level &level : levels)
      {
        level.numbering.n_cells = window_.n_cells;
        level.numbering.low     = level.cells.low;
        level.numbering.low[dim - 1] -= level.first_row - window_.low[dim - 1];
      }
  }



  template <int dim>
  LevelNode<dim>
  GridLevels<dim>::on_level(const LatticeIndex<dim> &window_index) const
  {
    LevelNode<dim> result{0, window_index};
    while (result.level + 1 < size() && window_index[dim - 1] >= levels[result.level + 1].first_row)
      ++result.level;
    for (int d = 0; d < dim; ++d)
      result.index[d] += levels[result.level].numbering.low[d] - window_.low[d];
    return result;
  }



  template <int dim>
  bool
  GridLevels<dim>::is_cell(const LatticeIndex<dim> &window_index) const
  {
    LevelNode<dim> here = on_level(window_index);
    if (!cells(here.level).contains_cell(here.index))
      return false;
    for (int d = 0; d < dim; ++d)
      here.index[d] >>= here.level;
    return level_of_cell(here.index) == here.level;
  }



  template <int dim>
  LatticeIndex<dim>
  GridLevels<dim>::cell_at(const dealii::Point<dim> &x) const
  {
    const LatticeIndex<dim> coarsest = levels[0].lattice.cell_of(x);
    const unsigned int      level    = level_of_cell(coarsest);
    if (level == 0)
      return coarsest;
    return in_window({level, levels[level].lattice.cell_of(x)});
  }



  template <int dim>
  unsigned int
  GridLevels<dim>::level_at(const dealii::Point<dim>     &x,
                            const dealii::Tensor<1, dim> &half_lengths,
                            const double                  slack) const
  {
    if (size() == 1)
      return 0;
    const Lattice<dim> &lattice = levels[0].lattice;
    LatticeIndex<dim>   low, n;
    const auto          cell = lattice.cell_of(x);
    for (int d = 0; d < dim; ++d)
      {
        const double s    = lattice.scaled(x[d], d);
        const double half = std::max(0., std::min(half_lengths[d] / lattice.h[d], 0.5) - slack);
        low[d]            = std::min(cell[d], static_cast<int>(std::floor(s - half)));
        n[d]              = std::max(cell[d], static_cast<int>(std::floor(s + half))) + 1 - low[d];
      }
    unsigned int level = 0;
    for_box<dim>(low, n, [&](const LatticeIndex<dim> &other) {
      level = std::max(level, level_of_cell(other));
    });
    return level;
  }



  template <int dim>
  unsigned int
  GridLevels<dim>::free_level(const LevelNode<dim> &node) const
  {
    LatticeIndex<dim> low, n;
    for (int d = 0; d < dim; ++d)
      {
        const int  size_of_cell = 1 << node.level;
        const bool on_line      = node.index[d] % size_of_cell == 0;
        low[d]                  = node.index[d] / size_of_cell - (on_line ? 1 : 0);
        n[d]                    = on_line ? 2 : 1;
      }
    unsigned int level = size() - 1;
    bool         any   = false;
    for_box<dim>(low, n, [&](const LatticeIndex<dim> &cell) {
      if (!base.contains_cell(cell))
        return;
      any   = true;
      level = std::min(level, level_of_cell(cell));
    });
    return any ? level : node.level;
  }

  template class GridLevels<2>;
  template class GridLevels<3>;
} // namespace kedge
