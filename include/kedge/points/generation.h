#ifndef kedge_points_generation_h
#define kedge_points_generation_h

#include <kedge/base/expression.h>
#include <kedge/grid/grid_levels.h>
#include <kedge/points/parameters.h>
#include <kedge/points/point_state.h>

namespace kedge
{
  /** A newly made material point and the faces of its sub-cell that no neighbour of its body
   * covers. */
  template <int dim>
  struct GeneratedPoint
  {
    PointRecord<dim> record;
    unsigned int     exposed_sides; ///< bit 2*direction + (0: low, 1: high)
  };

  /** What the start of a run asks of a material point, of all points on all ranks. */
  template <int dim>
  struct PointOrigin
  {
    std::uint64_t          id;
    unsigned int           body;
    unsigned int           exposed_sides; ///< see GeneratedPoint
    dealii::Point<dim>     location;
    dealii::Tensor<1, dim> half_lengths; ///< of its sub-cell [m]
    double                 volume;       ///< [m^3; m^2 in 2D]

    explicit PointOrigin(const GeneratedPoint<dim> &point)
      : id(point.record.id)
      , body(static_cast<unsigned int>(point.record.state.body))
      , exposed_sides(point.exposed_sides)
      , location(point.record.location)
      , half_lengths(point.record.state.reference_half_lengths)
      , volume(point.record.state.reference_volume)
    {}
  };

  /**
   * Makes the material points of one body, at rest strain. Every cell of the background
   * grid, of the level it has, is divided into equal sub-cells. One that lies in the body as a
   * whole becomes a point at its centre, with its volume; of one that the surface cuts, the part
   * within the body becomes a point at that part's centre, with that part's volume, to 1e-6 of the
   * sub-cell's. Parts of less than a tenth join a neighbour in the same cell (of bodies with sides
   * along the axes also in the next one), whose centre moves accordingly, so that few points weigh
   * next to nothing. The points' mass and centre are thereby those of the body. Half-lengths l of a
   * cut point fulfil 2^dim l_1 l_2 (l_3) = volume and are as the part's radii of gyration, but for
   * what would lie beyond its cell. If body.clip is false, whole sub-cells whose centres lie in the
   * body become points. The mass is @p density [kg/m^3] times the volume. Ids count up from @p
   * first_id. In MPI runs every rank makes all points (the caller keeps its share).
   *
   * @throws UserError if the body lies outside the grid or gets no point.
   */
  template <int dim>
  std::vector<GeneratedPoint<dim>>
  generate_points(const BodyParameters<dim>           &body,
                  const unsigned int                   body_index,
                  const double                         density,
                  const GridLevels<dim>               &levels,
                  const std::map<std::string, double> &constants,
                  const std::uint64_t                  first_id);
} // namespace kedge

#endif
