#ifndef kedge_simulation_points_on_grid_h
#define kedge_simulation_points_on_grid_h

#include <kedge/grid/open_sides.h>
#include <kedge/grid/refinement_rule.h>
#include <kedge/points/material_points.h>

#include <functional>

namespace kedge
{
  /** The background grid and the material points in its cells, which it follows. */
  template <int dim>
  class PointsOnGrid
  {
  public:
    /**
     * @param refinement of the grid's cells
     * @param layout     what the points store
     * @param open_sides of the grid, through which points leave it for good
     */
    PointsOnGrid(const GridParameters<dim> &parameters,
                 const OpenSides<dim>      &open_sides,
                 const RefinementRule<dim> &refinement,
                 const PointLayout<dim>    &layout,
                 const MPI_Comm             communicator);

    /** How far places are from what the rule of refinement calls the distance [m]. */
    using Distances =
      std::function<std::vector<double>(const std::vector<dealii::Point<dim>> &places)>;

    void
    set_distances(const Distances &distances)
    {
      this->distances = distances;
    }

    /** Refines the cells for what distances are now. */
    void
    renew_refinement();

    /**
     * Starts anew with these points, of which every rank has all: the first hands them
     * out (collective). @p t is the time [s].
     */
    void
    begin(std::vector<PointRecord<dim>> records, const double t);

    /** Goes on from other points, each rank's share of them (collective). */
    void
    replace(const std::vector<PointRecord<dim>> &records);

    /** Goes on from the points of a checkpoint in the same cells of the grid (collective). */
    void
    restore(const std::vector<PointRecord<dim>> &records,
            const LatticeWindow<dim>            &covered,
            const std::vector<unsigned int>     &weights,
            const double                         t);

    /**
     * After points have moved: sorts them into cells and ranks, takes a new window if needed, and
     * splits points that have come into refined cells smaller than they are. @p t is the time [s].
     *
     * @return those of this rank that have left through open sides, in the order of their
     * ids; they are no more in the cloud
     */
    std::vector<PointRecord<dim>>
    follow(const double t);

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
    /** True if a point was too large for the cell it has come into; goes on from its parts. */
    bool
    split_large_points();
    /** Refines the cells as the rule says; of the points only their strains are asked. */
    template <class Points>
    void
    refine(const Points &points);

    /** Takes the points out that have left; true if there was any, on whichever rank. */
    bool
    take_out(std::vector<PointRecord<dim>> &gone);

    const MPI_Comm            communicator;
    const OpenSides<dim>      open_sides;
    const RefinementRule<dim> refinement;
    BackgroundGrid<dim>       background;
    MaterialPoints<dim>       cloud;
    Distances                 distances;
    double                    time = 0.; ///< that the rule of refinement is asked for [s]
    LatticeWindow<dim>        covered;
    std::vector<unsigned int> weights; ///< points per covered cell, on several ranks
  };
} // namespace kedge

#endif
