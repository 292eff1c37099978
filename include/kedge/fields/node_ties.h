#ifndef kedge_fields_node_ties_h
#define kedge_fields_node_ties_h

#include <kedge/fields/hanging_nodes.h>
#include <kedge/fields/node_conditions.h>
#include <kedge/fields/step_points.h>

namespace kedge
{
  /**
   * Ties of badly filled nodes to well-filled cells (aggregated unfitted finite
   * elements, Badia et al. 2018). A node whose share of material is below a
   * threshold does not move by itself: its value is the linear extrapolation
   *   u_t = sum_j w_tj u_j
   * from the nodes j of the nearest cell whose nodes are all well filled and
   * reached by a body that reaches the tied node too; only where there is none
   * nearby, of any well-filled cell; always of the same piece of material (Pieces). Nodes of pieces
   * that are too small to fill a cell well are tied by tie_small_pieces(). In matrix form u = C u^;
   * residuals become C^T r, matrices C^T A C. As C reproduces linear fields, both momenta are
   * conserved, and as mass, residual and motion use the same C, so is energy.
   *
   * In a refined grid the hanging nodes (hanging_nodes()) are tied likewise, whatever is around
   * them and whatever is prescribed there, or functions would jump; what they hold counts for
   * their roots, whose own ties they follow.
   *
   * On a lattice with two intervals along a cell's edge the pore pressure may
   * live at the corners of whole cells alone, the even nodes. It is bilinear
   * over them: at the other nodes it is tied to their mean, whatever is
   * prescribed there, and badly filled corners are tied to whole cells. Corners
   * that only the pressure needs have displacement ties without roots.
   */
  template <int dim>
  class NodeTies
  {
  public:
    struct Tie
    {
      unsigned int              node; ///< local number (window number before localise())
      std::vector<unsigned int> roots;
      std::vector<double>       weights;
      unsigned int components; ///< bit d: component d is tied (not prescribed); dim: the pressure
      bool         interpolates = false; ///< the pressure between the corners of whole cells
      bool         hangs        = false; ///< in a refined grid
    };

    /**
     * Finds the ties of the nodes that this rank's points reach and flags
     * their roots in @p reached (collective).
     *
     * @param threshold smallest volume of material, in cells, that carries a
     *                  node; 0 ties nothing
     * @param coarse_pressure whether the pressure lives at even nodes alone
     */
    void
    find(const BackgroundGrid<dim>  &grid,
         const StepPoints<dim>      &points,
         const double                threshold,
         std::vector<unsigned char> &reached,
         const bool                  coarse_pressure = false);

    /** Goes over to local node numbers and leaves prescribed components alone. */
    void
    localise(const ActiveNodes<dim> &nodes, const NodeConditions<dim> &conditions);

    /** True if the ties differ from those of the last call of find() (collective). */
    bool
    changed() const
    {
      return changed_;
    }

    /**
     * v <- C v: gives tied nodes the value of their roots; all roots must be up
     * to date. Of @p n_components = dim + 1 the last one is the pore pressure.
     */
    void
    prolong(std::vector<double> &nodal, const unsigned int n_components = dim) const;

    /** r <- C^T r for partial sums, before they are added to the owners. */
    void
    restrict_sums(std::vector<double> &sums, const unsigned int n_components = dim) const;

    /** The ties in local numbers. */
    const std::vector<Tie> &
    ties() const
    {
      return local_ties;
    }

    /**
     * Position in ties() of a local node's component, or -1; of the components
     * with a tie those are tied that are not prescribed, see is_tied().
     */
    int
    tie_of(const unsigned int local_node, const int component = 0) const
    {
      return tie_numbers.empty() ? -1
                                 : tie_numbers[2 * std::size_t(local_node) + (component == dim)];
    }

    bool
    is_tied(const unsigned int local_node, const int component) const
    {
      const int tie = tie_of(local_node, component);
      return tie >= 0 && ((local_ties[tie].components >> component) & 1u) != 0;
    }

    bool
    empty() const
    {
      return local_ties.empty();
    }

  private:
    /** Where well-filled cells are, one array entry per node of the window. */
    struct Filling
    {
      std::vector<double>        volume; ///< of material, in cells; not 0 if any rank reaches it
      std::vector<std::uint64_t> bodies; ///< that reach it; empty if there is only one
      double                     threshold;
      int                        edge; ///< of a cell, in intervals of the lattice
      Pieces                     pieces;
    };

    std::vector<LatticeIndex<dim>>
    nearest_cells(const LatticeWindow<dim> &window,
                  const Filling            &filling,
                  const bool                of_same_body,
                  const unsigned int        tied_node) const;
    bool
    tie_to_nearest_cell(const LatticeWindow<dim> &window, const Filling &filling, Tie &tie) const;
    void
    tie_badly_filled(const BackgroundGrid<dim>        &grid,
                     const Filling                    &filling,
                     const std::vector<unsigned char> &reached,
                     const unsigned int                components);
    void
    tie_pressures(const BackgroundGrid<dim>        &grid,
                  const Filling                    &filling,
                  const std::vector<unsigned char> &reached);
    void
    tie_hanging(const std::vector<NodeSum> &hanging, const unsigned int components);
    void
    tie_corners_without_motion(const ActiveNodes<dim> &nodes);
    void
    follow_tied_corners(Tie &tie) const;

    std::vector<Tie>  window_ties, local_ties;
    std::vector<int>  tie_numbers; ///< of each local node's displacement and pressure, or -1
    std::vector<bool> moves;       ///< window nodes that any rank reaches; empty: all nodes in use
    bool              changed_ = false;
  };
} // namespace kedge

#endif
