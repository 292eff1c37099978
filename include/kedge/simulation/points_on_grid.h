#ifndef kedge_simulation_points_on_grid_h
#define kedge_simulation_points_on_grid_h

#include <kedge/points/material_points.h>

namespace kedge
{
  /** The background grid and the material points in its cells, which it follows. */
  template <int dim>
  class PointsOnGrid
  {
  public:
    /** @param layout what the points store */
    PointsOnGrid(const GridParameters<dim> &parameters,
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

    /** After points have moved: sorts them into cells and ranks, takes a new window if needed. */
    void
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

    const MPI_Comm            communicator;
    BackgroundGrid<dim>       background;
    MaterialPoints<dim>       cloud;
    LatticeWindow<dim>        covered;
    std::vector<unsigned int> weights; ///< points per covered cell, on several ranks
  };
} // namespace kedge

#endif
