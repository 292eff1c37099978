#ifndef kedge_transfer_equation_system_h
#define kedge_transfer_equation_system_h

#include <kedge/grid/active_nodes.h>
#include <kedge/solvers/sparse_system.h>
#include <kedge/transfer/node_matrix.h>
#include <kedge/transfer/node_ties.h>

namespace kedge
{
  /** Where the value of a nodal component comes from. */
  enum class NodalStatus : unsigned char
  {
    prescribed, ///< by a node condition: no equation
    free,       ///< an equation of its own
    tied        ///< extrapolated from others (NodeTies): no equation
  };

  /**
   * The linear equations of the free components at the active nodes: numbers
   * them, finds the sparsity pattern from the lattice and the ties, and fills
   * it from a NodeMatrix A with the entries of C^T A C.
   */
  template <int dim>
  class EquationSystem
  {
  public:
    /**
     * Numbers the equations and builds the pattern (collective).
     *
     * @param status one entry per local node and component, ghosts included
     * @param matrix gives components and slots; its values are not read
     */
    void
    reinit(const BackgroundGrid<dim>      &grid,
           const ActiveNodes<dim>         &nodes,
           const NodeTies<dim>            &ties,
           const std::vector<NodalStatus> &status,
           const NodeMatrix<dim>          &matrix);

    /** Copies the values into system(), shares of all ranks added up (collective). */
    void
    fill(const ActiveNodes<dim> &nodes, const NodeMatrix<dim> &matrix);

    /** Equations owned here of a nodal vector. */
    void
    gather(const std::vector<double> &nodal, std::vector<double> &equations) const;

    /** Writes a solution to the owned free nodes; all other values become zero. */
    void
    scatter(const std::vector<double> &equations, std::vector<double> &nodal) const;

    const SparseSystem &
    system() const
    {
      return system_;
    }

    /** Node and component of a local equation: node * n_components + component. */
    unsigned int
    nodal_index(const unsigned int equation) const
    {
      return nodal_of_equation[equation];
    }

  private:
    /** An entry of A that contributes, through a tie, to an entry elsewhere. */
    struct Contribution
    {
      std::int64_t row, column; ///< equations
      std::size_t  source;      ///< place in the values of the NodeMatrix
      double       weight;
    };

    using Row = std::vector<std::pair<int, unsigned int>>; ///< column and place in A's row

    void
    number_equations(const ActiveNodes<dim> &nodes, const std::vector<NodalStatus> &status);
    std::vector<std::int64_t>
    neighbour_equations(const BackgroundGrid<dim> &grid,
                        const ActiveNodes<dim>    &nodes,
                        const NodeMatrix<dim>     &matrix) const;
    std::vector<std::pair<std::int64_t, double>>
    expand(const NodeTies<dim>            &ties,
           const std::vector<NodalStatus> &status,
           const unsigned int              node,
           const unsigned int              component) const;
    std::vector<Contribution>
    tied_contributions(const BackgroundGrid<dim>      &grid,
                       const ActiveNodes<dim>         &nodes,
                       const NodeTies<dim>            &ties,
                       const std::vector<NodalStatus> &status,
                       const NodeMatrix<dim>          &matrix) const;
    std::vector<std::pair<std::int64_t, std::int64_t>>
    share_contributions(const std::vector<Contribution> &contributions);
    std::size_t
    position(const std::int64_t row, const std::int64_t column) const;

    /** Place of an entry of A that has no counterpart of its own in the equations. */
    static constexpr unsigned int no_source = static_cast<unsigned int>(-1);

    unsigned int              n_components = 0;
    std::vector<std::int64_t> number;            ///< of each local nodal component, or -1
    std::vector<unsigned int> nodal_of_equation; ///< owned equations
    std::vector<unsigned int> entry_source;      ///< place in A's row of each entry, or no_source
    SparseSystem              system_;

    /** Through ties: to entries owned here, to those of other ranks, from other ranks. */
    struct Addition
    {
      std::size_t target, source;
      double      weight;
    };
    std::vector<Addition>                                                      own_additions;
    std::map<unsigned int, std::vector<std::pair<std::size_t, double>>>        outgoing_additions;
    std::map<unsigned int, std::vector<std::size_t>>                           incoming_targets;
    bool                                                                       any_remote = false;
    std::map<unsigned int, std::vector<std::pair<std::int64_t, std::int64_t>>> received_entries;
  };
} // namespace kedge

#endif
