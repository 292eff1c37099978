#ifndef kedge_grid_grid_levels_h
#define kedge_grid_grid_levels_h

#include <kedge/grid/lattice.h>

namespace kedge
{
  /** A node or cell of one level of the background grid. */
  template <int dim>
  struct LevelNode
  {
    unsigned int      level;
    LatticeIndex<dim> index; ///< on the lattice of the level
  };

  /**
   * Levels of refinement of the background grid. Level 0 is the grid of the scene; the cells of
   * level l have 2^-l of its edge. Each cell of the scene's grid has a level, from which those of
   * its neighbours (also across edges and corners) differ by one at most.
   *
   * The nodes of each level are nodes of their own, also where a coarser one has the same place.
   * The numbers of all levels lie side by side in one window: behind the cells of level 0, in the
   * last direction, stand those parts of the finer lattices that can be needed, with a gap
   * between them that no stencil and no row of a matrix bridges. So a stencil, a node and a
   * cell of any level have a number in the window as if there were one lattice; only places and
   * sizes have to ask the level. Which node of which level moves freely says HangingNodes.
   */
  template <int dim>
  class GridLevels
  {
  public:
    explicit GridLevels(const Lattice<dim> &coarsest);

    /** All cells of the window of level 0 are of that level. */
    void
    cover(const LatticeWindow<dim> &cells);

    /**
     * Refines the cells of level 0, each as often as @p wanted says (one entry per cell of the
     * window that cover() got), and the neighbours as that asks.
     *
     * @return whether any cell has another level than before
     */
    bool
    refine(const std::vector<unsigned char> &wanted);

    /** Levels in use: 1 if nothing is refined. */
    unsigned int
    size() const
    {
      return static_cast<unsigned int>(levels.size());
    }

    const Lattice<dim> &
    lattice(const unsigned int level) const
    {
      return levels[level].lattice;
    }

    /** Of the finest cells in use. */
    const Lattice<dim> &
    finest() const
    {
      return levels.back().lattice;
    }

    /** What gives the nodes and cells of a level their numbers in the window. */
    const LatticeWindow<dim> &
    numbering(const unsigned int level) const
    {
      return levels[level].numbering;
    }

    /** The window that holds all numbers. */
    const LatticeWindow<dim> &
    window() const
    {
      return window_;
    }

    /** The cells of level 0. */
    const LatticeWindow<dim> &
    coarsest_cells() const
    {
      return base;
    }

    /** How often a cell of level 0 is refined; 0 outside the window. */
    unsigned int
    level_of_cell(const LatticeIndex<dim> &cell) const
    {
      return size() > 1 && base.contains_cell(cell) ? level_of_cell_[base.cell_number(cell)] : 0;
    }

    /**
     * The finest level of the cells that a box about @p x touches; it counts with no more than
     * half a cell of level 0, and its outermost part of @p slack cells does not count.
     */
    unsigned int
    level_at(const dealii::Point<dim>     &x,
             const dealii::Tensor<1, dim> &half_lengths,
             const double                  slack) const;

    /** The cells of a level that have numbers in the window. */
    const LatticeWindow<dim> &
    cells(const unsigned int level) const
    {
      return levels[level].cells;
    }

    /** The node or cell of its level that has an index in the window. */
    LevelNode<dim>
    on_level(const LatticeIndex<dim> &window_index) const;

    /** The index in the window of a node or cell of a level. */
    LatticeIndex<dim>
    in_window(const LevelNode<dim> &here) const
    {
      LatticeIndex<dim> result = here.index;
      for (int d = 0; d < dim; ++d)
        result[d] += window_.low[d] - levels[here.level].numbering.low[d];
      return result;
    }

    /** Whether an index in the window is that of a cell of the grid: not refined, nor a part of
     * one that is coarser. */
    bool
    is_cell(const LatticeIndex<dim> &window_index) const;

    /** The cell at a place, of the level that it has there, by its index in the window. */
    LatticeIndex<dim>
    cell_at(const dealii::Point<dim> &x) const;

    /** The node that has a number in the window. */
    LevelNode<dim>
    node(const unsigned int window_node) const
    {
      return on_level(window_.node_index(window_node));
    }

    /** Place of a node [m]. */
    dealii::Point<dim>
    position(const unsigned int window_node) const
    {
      const LevelNode<dim> here = node(window_node);
      return levels[here.level].lattice.node_position(here.index);
    }

    /** Index of a node's place on the finest lattice in use. */
    LatticeIndex<dim>
    finest_index(const unsigned int window_node) const
    {
      return finest_index(node(window_node));
    }

    LatticeIndex<dim>
    finest_index(LevelNode<dim> node) const
    {
      for (int &index : node.index)
        index <<= size() - 1 - node.level;
      return node.index;
    }

    /**
     * The level on which the value at a node's place is free: the coarsest of the cells around it.
     */
    unsigned int
    free_level(const LevelNode<dim> &node) const;

  private:
    struct Level
    {
      Lattice<dim>       lattice;
      LatticeWindow<dim> numbering, cells;
      int                first_row = 0; ///< of the window's last direction
    };

    std::vector<unsigned char>
    graded(std::vector<unsigned char> wanted) const;
    LatticeWindow<dim>
    needed_cells(const unsigned int level) const;
    void
    lay_out();

    std::vector<Level>         levels;
    LatticeWindow<dim>         base, window_;
    std::vector<unsigned char> level_of_cell_; ///< of the cells of level 0
  };
} // namespace kedge

#endif
