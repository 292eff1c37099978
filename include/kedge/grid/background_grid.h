#ifndef kedge_grid_background_grid_h
#define kedge_grid_background_grid_h

#include <kedge/grid/grid_levels.h>

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
   * outside the window costs nothing. Cells may be refined (GridLevels): the triangulation, and
   * with it the cells that points are sorted into, stays that of the scene's cells.
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
     * Refines cells, see GridLevels::refine(): one entry per cell of levels().coarsest_cells().
     * Only on one process.
     *
     * @return whether the grid is another than before
     */
    bool
    refine(const std::vector<unsigned char> &wanted);

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
      return cell_iterators[coarsest().cell_number(cell)];
    }

    /** Of the scene's cells. */
    const Lattice<dim> &
    lattice() const
    {
      return levels_.lattice(0);
    }

    /** What the nodes and cells of all levels have their numbers in. */
    const LatticeWindow<dim> &
    window() const
    {
      return levels_.window();
    }

    const GridLevels<dim> &
    levels() const
    {
      return levels_;
    }

    /** Whether some cells are finer than others. */
    bool
    is_refined() const
    {
      return levels_.size() > 1;
    }

    /** Whether the window holds a cell of the scene. */
    bool
    covers(const LatticeIndex<dim> &cell) const
    {
      return coarsest().contains_cell(cell);
    }

    /** Place of a node of the window [m]. */
    dealii::Point<dim>
    node_position(const unsigned int window_node) const
    {
      return levels_.position(window_node);
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

    /** Rank that owns a cell of the window, of any level. */
    unsigned int
    cell_owner(const LatticeIndex<dim> &cell) const
    {
      return cell_owners[window().cell_number(cell)];
    }

    /** Rank that owns a node of the window. */
    unsigned int
    node_owner(const unsigned int window_node) const
    {
      return node_owners[window_node];
    }

    /** Counts the windows; what depends on the numbers in them watches it. */
    unsigned int
    generation() const
    {
      return generation_;
    }

  private:
    const LatticeWindow<dim> &
    coarsest() const
    {
      return levels_.coarsest_cells();
    }
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

    GridLevels<dim>                             levels_;
    const MPI_Comm                              communicator_;
    const dealii::MappingCartesian<dim>         mapping_;
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
