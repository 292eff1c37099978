#ifndef kedge_grid_background_grid_h
#define kedge_grid_background_grid_h

#include <kedge/grid/lattice.h>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_cartesian.h>

#include <memory>

namespace kedge
{
  /**
   * The background grid: a triangulation, on several ranks distributed by
   * p4est with the element of the displacement (vector Q1) on it, which numbers
   * the nodes across ranks. The scene's box may be large and empty;
   * the triangulation covers only a window of it around the material points
   * and is built anew, larger, when they come near its border. Whatever lies
   * outside the window costs nothing.
   */
  template <int dim>
  class BackgroundGrid
  {
  public:
    using CellIterator = typename dealii::Triangulation<dim>::active_cell_iterator;

    BackgroundGrid(const GridParameters<dim> &parameters, const MPI_Comm communicator);

    /**
     * Builds the triangulation for a window that contains the given cells
     * and a margin around them (collective; all ranks pass the same window).
     *
     * @param cells   the cells that hold material points: lowest cell and
     *                number per direction
     * @param weights points per cell of the *same* cells in lexicographic
     *                order; ranks get shares of about equal weight
     */
    void
    cover(const LatticeWindow<dim> &cells, const std::vector<unsigned int> &weights);

    /**
     * True if a stencil around a point of @p cell would leave the window
     * although the box goes on there.
     */
    bool
    too_close_to_border(const LatticeIndex<dim> &cell) const;

    /** The iterator of a locally owned or ghost cell. @p cell must lie in the window. */
    const CellIterator &
    cell_iterator(const LatticeIndex<dim> &cell) const
    {
      return cell_iterators[window_.cell_number(cell)];
    }

    const Lattice<dim> &
    lattice() const
    {
      return lattice_;
    }

    const LatticeWindow<dim> &
    window() const
    {
      return window_;
    }

    const dealii::Triangulation<dim> &
    triangulation() const
    {
      return *triangulation_;
    }

    const dealii::Mapping<dim> &
    mapping() const
    {
      return mapping_;
    }

    MPI_Comm
    communicator() const
    {
      return communicator_;
    }

    /** Rank that owns a cell of the window. */
    unsigned int
    cell_owner(const LatticeIndex<dim> &cell) const
    {
      return cell_owners[window_.cell_number(cell)];
    }

    /** Rank that owns a node of the window. */
    unsigned int
    node_owner(const unsigned int window_node) const
    {
      return node_owners[window_node];
    }

    /** Counts the calls of cover(); what depends on the window watches it. */
    unsigned int
    generation() const
    {
      return generation_;
    }

  private:
    bool
    parallel() const
    {
      return dealii::Utilities::MPI::n_mpi_processes(communicator_) > 1;
    }
    void
    create_triangulation(const std::vector<unsigned int> &weights,
                         const LatticeWindow<dim>        &weighted_cells);
    void
    share_out_cells(dealii::parallel::distributed::Triangulation<dim> &cells,
                    const std::vector<unsigned int>                   &weights,
                    const LatticeWindow<dim>                          &weighted_cells) const;
    void
    tabulate_cells();
    void
    tabulate_node_owners();

    const Lattice<dim>                          lattice_;
    const MPI_Comm                              communicator_;
    const dealii::MappingCartesian<dim>         mapping_;
    LatticeWindow<dim>                          window_;
    unsigned int                                n_refinements = 0;
    unsigned int                                generation_   = 0;
    dealii::FESystem<dim>                       element;
    std::vector<CellIterator>                   cell_iterators;
    std::vector<unsigned int>                   cell_owners;
    std::vector<unsigned int>                   node_owners;
    std::unique_ptr<dealii::Triangulation<dim>> triangulation_;
    std::unique_ptr<dealii::DoFHandler<dim>>    dof_handler; ///< on several ranks
  };
} // namespace kedge

#endif
