#ifndef kedge_fields_hanging_nodes_h
#define kedge_fields_hanging_nodes_h

#include <kedge/fields/small_pieces.h>

namespace kedge
{
  /**
   * The nodes of a refined grid, of those in @p reached (one entry per node of the window), whose
   * values follow from others: those that are not of the level that is free at their place
   * (GridLevels::free_level()). A node in or beside coarser cells has the value that these
   * interpolate there, one of a coarser level among finer cells that of the finer node at its
   * place. The roots are free nodes. Constant and linear fields are exact; linear and GIMP
   * functions are continuous across levels, for the functions of a coarse cell are sums of those
   * of the finer ones in it.
   */
  template <int dim>
  std::vector<NodeSum>
  hanging_nodes(const GridLevels<dim> &levels, const std::vector<unsigned char> &reached);
} // namespace kedge

#endif
