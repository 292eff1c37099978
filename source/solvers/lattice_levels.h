#ifndef kedge_source_solvers_lattice_levels_h
#define kedge_source_solvers_lattice_levels_h

#include <kedge/solvers/mixed_blocks.h>

#include <array>
#include <optional>

namespace kedge
{
  /** The nodes of a lattice that have equations, and which. */
  struct LatticeLevel
  {
    /** Integer coordinates, those of directions that are not there zero. */
    using Node = std::array<int, 3>;

    int                   dim = 2;
    std::vector<Node>     node;
    std::vector<int>      row; ///< dim per node: its equation, or -1
    std::vector<int>      node_of_row;
    std::array<double, 3> spacing; ///< [m]

    unsigned int
    n_nodes() const
    {
      return static_cast<unsigned int>(node.size());
    }

    unsigned int
    n_rows() const
    {
      return static_cast<unsigned int>(node_of_row.size());
    }
  };

  /**
   * The lattice of the equations of one rank, as their nodes' positions show it: the spacing is the
   * smallest distance in each direction. None if several nodes are at the same place, as those of
   * different fields, or if there are pressures.
   */
  std::optional<LatticeLevel>
  find_lattice(const MixedBlocks &blocks);

  /**
   * Interpolation P from a lattice to one with nodes half as dense: u_i = sum_I w_iI u_I,
   * multilinear, component by component. Coarse nodes exist where they matter to a fine one,
   * outside of the body too, so that P keeps all linear fields, rigid motions among them, wherever
   * the body ends. Supports have no equations and stay where they are: P is zero there.
   */
  class LatticeTransfer
  {
  public:
    /**
     * Finds the coarse level. Directions whose spacing is much larger than the smallest
     * one keep theirs.
     */
    LatticeTransfer(const LatticeLevel &fine, LatticeLevel &coarse);

    /** P^T A P of a matrix of the fine level, rows and columns in the coarse level's order. */
    SparseSystem
    coarse_matrix(const LatticeLevel &fine,
                  const SparseSystem &matrix,
                  const LatticeLevel &coarse) const;

    /** r = P^T x. */
    void
    restrict_sums(const LatticeLevel        &fine,
                  const std::vector<double> &x,
                  const LatticeLevel        &coarse,
                  std::vector<double>       &r) const;

    /** x = P y. */
    void
    prolong(const LatticeLevel        &fine,
            const LatticeLevel        &coarse,
            const std::vector<double> &y,
            std::vector<double>       &x) const;

  private:
    /** Another level's node and its weight. */
    struct Link
    {
      int    node;
      double weight;
    };

    /** Links of each node of a level, one node after the other. */
    struct Links
    {
      std::vector<std::size_t> first = {0};
      std::vector<Link>        link;
    };

    void
    find_parents(const LatticeLevel &fine, LatticeLevel &coarse);
    void
    find_children(const unsigned int n_coarse);

    Links parents;  ///< of each fine node
    Links children; ///< of each coarse node
  };
} // namespace kedge

#endif
