#ifndef kedge_simulation_nodal_means_h
#define kedge_simulation_nodal_means_h

#include <kedge/fields/patch.h>
#include <kedge/io/grid_output.h>

namespace kedge
{
  /**
   * Fields of material points as means at the nodes of the grid,
   *   f_A = sum_p N_A V_p f_p / sum_p N_A V_p,
   * with the volumes V_p as they are: smooth where the points' own values speckle. Adds to
   * @p snapshot a vector or a scalar per component for each of the local nodes of @p patch,
   * in their order; 0 at nodes that no point reaches. Numbers of bodies and points have no
   * mean and are left out. The patch must be that of the points' present places. Collective.
   *
   * @param records the points of this rank
   * @param names   of point fields, see point_field()
   */
  template <int dim>
  void
  add_nodal_means(const Patch<dim>                    &patch,
                  const std::vector<PointRecord<dim>> &records,
                  const std::vector<std::string>      &names,
                  GridSnapshot<dim>                   &snapshot);
} // namespace kedge

#endif
