#ifndef kedge_transfer_equation_system_h
#define kedge_transfer_equation_system_h

#include <kedge/grid/active_nodes.h>
#include <kedge/solvers/sparse_system.h>
#include <kedge/transfer/node_matrix.h>

namespace kedge
{
  /**
   * The linear equations of the free components at the active nodes: numbers
   * them, finds the sparsity pattern from the lattice and fills it from a
   * NodeMatrix. Prescribed components have no equation.
   */
  template <int dim>
  class EquationSystem
  {
  public:
    /**
     * Numbers the equations and builds the pattern (collective).
     *
     * @param is_free one entry per local node and component, ghosts included
     * @param matrix  gives components and slots; its values are not read
     */
    void
    reinit(const BackgroundGrid<dim>        &grid,
           const ActiveNodes<dim>           &nodes,
           const std::vector<unsigned char> &is_free,
           const NodeMatrix<dim>            &matrix);

    /** Copies the values into system(), shares of all ranks added up (collective). */
    void
    fill(const ActiveNodes<dim> &nodes, NodeMatrix<dim> &matrix);

    /** Equations owned here of a nodal vector. */
    void
    gather(const std::vector<double> &nodal, std::vector<double> &equations) const;

    /** Writes a solution to the owned nodes; prescribed components become zero. */
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
    void
    number_equations(const ActiveNodes<dim> &nodes, const std::vector<unsigned char> &is_free);
    std::vector<std::int64_t>
    neighbour_equations(const BackgroundGrid<dim> &grid,
                        const ActiveNodes<dim>    &nodes,
                        const NodeMatrix<dim>     &matrix) const;

    unsigned int              n_components = 0;
    std::vector<std::int64_t> number;            ///< of each local nodal component, or -1
    std::vector<unsigned int> nodal_of_equation; ///< owned equations
    std::vector<unsigned int> entry_position;    ///< place in the matrix row of each CSR entry
    SparseSystem              system_;
  };
} // namespace kedge

#endif
