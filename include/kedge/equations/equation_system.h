#ifndef kedge_equations_equation_system_h
#define kedge_equations_equation_system_h

#include <kedge/equations/node_matrix.h>
#include <kedge/equations/tied_rows.h>
#include <kedge/fields/patch.h>
#include <kedge/solvers/sparse_system.h>

namespace kedge
{
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
    reinit(const Patch<dim>               &patch,
           const std::vector<NodalStatus> &status,
           const NodeMatrix<dim>          &matrix);

    /** Copies the values into system(), shares of all ranks added up (collective). */
    void
    fill(const Patch<dim> &patch, const NodeMatrix<dim> &matrix);

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

    /** nodal_index() of all of this rank's equations. */
    const std::vector<unsigned int> &
    nodal_indices() const
    {
      return nodal_of_equation;
    }

    /** Node and component of a local equation: node * n_components + component. */
    unsigned int
    nodal_index(const unsigned int equation) const
    {
      return nodal_of_equation[equation];
    }

  private:
    /** Marks what a nodal block does not have. */
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /** A nodal block of a node's rows: the equations of one other node, consecutive. */
    struct Block
    {
      std::int64_t first; ///< equation
      unsigned int slot;  ///< in A's row, or none
      unsigned int node;  ///< local number, or none
      unsigned int n_equations;
    };
    using Blocks = std::vector<Block>;

    /** A block of which another rank fills a part, in the rows that begin at an equation. */
    struct RemoteBlock
    {
      std::int64_t row;
      Block        block;
    };

    /** Rows that this rank adds to through ties: its own and those of other ranks. */
    struct FedNode
    {
      unsigned int node;
      unsigned int first_feed, end_feed; ///< in TiedRows::feeds()
      std::size_t  first_place;          ///< in places, of its first feed
      std::size_t  remote;               ///< start in remote_values; unused for owned nodes
      unsigned int row_length;
    };

    void
    number_equations(const Patch<dim> &patch, const std::vector<NodalStatus> &status);
    std::vector<std::int64_t>
    neighbour_equations(const Patch<dim> &patch, const NodeMatrix<dim> &matrix) const;
    void
    find_fed_nodes(const Patch<dim> &patch);
    void
    add_tied_blocks(const FedNode &fed, Blocks &blocks);
    void
    place_feeds(FedNode &fed, const Blocks &blocks);
    static void
    sort_and_merge(Blocks &blocks);
    std::vector<RemoteBlock>
    exchange_remote_rows(const Patch<dim> &patch);
    void
    build_rows(const Patch<dim>                &patch,
               const std::vector<std::int64_t> &columns,
               const unsigned int               n_slots,
               const std::vector<RemoteBlock>  &remote);
    void
    add_rows(const unsigned int n_rows, const std::int64_t *of_node, const Blocks &blocks);
    void
    find_incoming_targets();
    void
    add_fed_rows(const FedNode &fed, const unsigned int n_owned);
    void
    add_remote_rows();
    std::int64_t
    first_equation(const unsigned int node) const;
    std::size_t
    position(const std::int64_t row, const std::int64_t column) const;

    unsigned int              n_components = 0;
    std::vector<std::int64_t> number;            ///< of each local nodal component, or -1
    std::vector<unsigned int> n_free;            ///< equations of each local node
    std::vector<unsigned int> nodal_of_equation; ///< owned equations
    std::vector<unsigned int> entry_source;      ///< place in A's row of each entry, or none
    SparseSystem              system_;

    TiedRows<dim>                                     tied_rows;
    std::vector<FedNode>                              fed_nodes;
    std::vector<unsigned int>                         places; ///< of each feed's columns in a row
    std::vector<unsigned int>                         mark, offset_of; ///< by local node
    std::vector<double>                               remote_values;
    std::map<unsigned int, std::vector<std::int64_t>> incoming_blocks;
    std::map<unsigned int, std::vector<std::size_t>>  outgoing_ranges; ///< begin, end ..
    std::map<unsigned int, std::vector<std::size_t>>  incoming_targets;
    bool                                              any_remote = false;
  };
} // namespace kedge

#endif
