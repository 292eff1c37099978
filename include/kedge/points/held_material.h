#ifndef kedge_points_held_material_h
#define kedge_points_held_material_h

#include <kedge/points/generation.h>
#include <kedge/points/material_points.h>
#include <kedge/points/node_region.h>

namespace kedge
{
  // Node conditions stay with the nodes of the grid, material does not, and places are not nodes.

  /** The nodes of the cells that hold material points, sorted, each once, on the finest lattice. */
  template <int dim>
  std::vector<LatticeIndex<dim>>
  nodes_of_cells_with_points(const GridLevels<dim>               &levels,
                             const std::vector<PointOrigin<dim>> &points);

  /**
   * How far a region reaches beyond the nodes that it holds, on the edges from these to
   * others of @p nodes: the largest part of an edge, 0 if it ends at nodes. A region that ends
   * just before the next node leaves that one out on purpose and counts as 0, and so does an
   * interval around a single row of nodes.
   *
   * @param nodes those of cells with material points, sorted
   */
  template <int dim>
  double
  reach_beyond_nodes(const NodeRegion<dim>                &region,
                     const Lattice<dim>                   &lattice,
                     const std::vector<LatticeIndex<dim>> &nodes);

  /**
   * The part of the held ones among @p nodes whose material is no more at nodes that the
   * region holds once it has moved by @p travel [m]; 0 if none is held.
   */
  template <int dim>
  double
  part_carried_away(const NodeRegion<dim>                &region,
                    const Lattice<dim>                   &lattice,
                    const std::vector<LatticeIndex<dim>> &nodes,
                    const dealii::Tensor<1, dim>         &travel);

  /**
   * How much of the material that node conditions held at the start they hold still. A condition
   * holds of a material point at x the part
   *   w(x) = sum of the held nodes' hat functions at x,
   * and of what it held the part
   *   1 - sum m max(0, w(X) - w(x)) / sum m w(X),
   * with the masses m and the places X at the start. What has come instead does not count.
   */
  template <int dim>
  class HeldMaterial
  {
  public:
    struct Condition
    {
      NodeRegion<dim>   region;
      std::vector<bool> holds_body; ///< one per body
    };

    HeldMaterial(const std::vector<Condition> &conditions, const Lattice<dim> &lattice);

    /** The part of each condition, from 0 to 1; 1 if it held nothing at the start (collective). */
    std::vector<double>
    parts(const MaterialPoints<dim> &cloud, const MPI_Comm communicator);

  private:
    double
    weight(const std::size_t condition, const dealii::Point<dim> &x);
    bool
    holds(const std::size_t condition, const LatticeIndex<dim> &node);

    std::vector<Condition>   conditions;
    const Lattice<dim>       lattice;
    const LatticeWindow<dim> all;
    /** Per condition and node of the grid, where these are not too many: what is known of it. */
    std::vector<std::vector<unsigned char>> known;
  };
} // namespace kedge

#endif
