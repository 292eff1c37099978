#ifndef kedge_transfer_node_ties_h
#define kedge_transfer_node_ties_h

#include <kedge/grid/node_conditions.h>
#include <kedge/transfer/step_points.h>

namespace kedge
{
  /**
   * Ties of badly filled nodes to well-filled cells (aggregated unfitted finite
   * elements, Badia et al. 2018). A node whose share of material is below a
   * threshold does not move by itself: its value is the linear extrapolation
   *   u_t = sum_j w_tj u_j
   * from the nodes j of the nearest cell whose nodes are all well filled and
   * reached by a body that reaches the tied node too; only where there is none
   * nearby, of any well-filled cell. In matrix form u = C u^; residuals become C^T r, matrices C^T
   * A C. As C reproduces linear fields, both momenta are conserved, and as mass, residual and
   * motion use the same C, so is energy.
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
    };

    /**
     * Finds the ties of the nodes that this rank's points reach and flags
     * their roots in @p reached (collective).
     *
     * @param threshold smallest volume of material, in cells, that carries a
     *                  node; 0 ties nothing
     */
    void
    find(const BackgroundGrid<dim>  &grid,
         const StepPoints<dim>      &points,
         const double                threshold,
         std::vector<unsigned char> &reached);

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

    /** Position in ties() of a local node, or -1. */
    int
    tie_of(const unsigned int local_node) const
    {
      return tie_numbers.empty() ? -1 : tie_numbers[local_node];
    }

    bool
    empty() const
    {
      return local_ties.empty();
    }

  private:
    std::vector<LatticeIndex<dim>>
    nearest_cells(const LatticeWindow<dim>         &window,
                  const std::vector<double>        &filling,
                  const double                      threshold,
                  const std::vector<std::uint64_t> &bodies,
                  const unsigned int                tied_node) const;
    bool
    tie_to_nearest_cell(const LatticeWindow<dim>         &window,
                        const std::vector<double>        &filling,
                        const double                      threshold,
                        const std::vector<std::uint64_t> &bodies,
                        Tie                              &tie) const;

    std::vector<Tie> window_ties, local_ties;
    std::vector<int> tie_numbers;
    bool             changed_ = false;
  };
} // namespace kedge

#endif
