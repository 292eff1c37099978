#ifndef kedge_simulation_points_on_grid_h
#define kedge_simulation_points_on_grid_h

#include <kedge/grid/open_sides.h>
#include <kedge/points/material_points.h>

namespace kedge
{
  /** The background grid and the material points in its cells, which it follows. */
  template <int dim>
  class PointsOnGrid
  {
  public:
    /**
     * @param layout     what the points store
     * @param open_sides of the grid, through which points leave it for good
     */
    PointsOnGrid(const GridParameters<dim> &parameters,
                 const OpenSides<dim>      &open_sides,
                 const PointLayout<dim>    &layout,
                 const MPI_Comm             communicator);

    /**
     * Starts anew with these points, of which every rank has all: the first hands them
     * out (collective).
     */
    void
    begin(std::vector<PointRecord<dim>> records);

    /** Goes on from other points, each rank's share of them (collective). */
    void
    replace(const std::vector<PointRecord<dim>> &records);

    /** Goes on from the points of a checkpoint in the same cells of the grid (collective). */
    void
    restore(const std::vector<PointRecord<dim>> &records,
            const LatticeWindow<dim>            &covered,
            const std::vector<unsigned int>     &weights);

    /**
     * After points have moved: sorts them into cells and ranks, takes a new window if needed.
     *
     * @return those of this rank that have left through open sides, in the order of their
     * ids; they are no more in the cloud
     */
    std::vector<PointRecord<dim>>
    follow();

    const BackgroundGrid<dim> &
    grid() const
    {
      return background;
    }

    const MaterialPoints<dim> &
    points() const
    {
      return cloud;
    }

    MaterialPoints<dim> &
    points()
    {
      return cloud;
    }

    /** What grid().cover() was last called with. */
    const LatticeWindow<dim> &
    covered_cells() const
    {
      return covered;
    }

    const std::vector<unsigned int> &
    covered_weights() const
    {
      return weights;
    }

  private:
    void
    cover(const std::vector<PointRecord<dim>> &records);

    /** Takes the points out that have left; true if there was any, on whichever rank. */
    bool
    take_out(std::vector<PointRecord<dim>> &gone);

    const MPI_Comm            communicator;
    const OpenSides<dim>      open_sides;
    BackgroundGrid<dim>       background;
    MaterialPoints<dim>       cloud;
    LatticeWindow<dim>        covered;
    std::vector<unsigned int> weights; ///< points per covered cell, on several ranks
  };
} // namespace kedge

#endif
