#ifndef kedge_fields_node_filling_h
#define kedge_fields_node_filling_h

#include <kedge/fields/small_pieces.h>

namespace kedge
{
  /**
   * Volume of material at each node of the window, in cells; more than zero at
   * every node that any rank reaches (collective).
   */
  template <int dim>
  std::vector<double>
  nodal_filling(const BackgroundGrid<dim>        &grid,
                const StepPoints<dim>            &points,
                const std::vector<unsigned char> &reached);

  /**
   * Which bodies reach each node of the window: bit b modulo 64 for body b;
   * empty if there is only one body (collective).
   */
  template <int dim>
  std::vector<std::uint64_t>
  bodies_at_nodes(const BackgroundGrid<dim> &grid, const StepPoints<dim> &points);

  /** What hanging nodes hold goes to their roots: volumes in the cells of these, and bodies. */
  template <int dim>
  void
  give_to_roots(const GridLevels<dim>      &levels,
                const std::vector<NodeSum> &hanging,
                std::vector<double>        &filling,
                std::vector<std::uint64_t> &bodies);
} // namespace kedge

#endif
