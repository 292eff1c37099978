#ifndef kedge_solid_point_update_h
#define kedge_solid_point_update_h

#include <kedge/materials/material.h>
#include <kedge/solid/internal_force.h>
#include <kedge/stress/point_update.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  /**
   * Evaluates all points at the end of a step.
   *
   * @return the first slot that fails (see PointStatus), or PointStatus::none
   */
  template <int dim>
  unsigned int
  evaluate_point_updates(const std::vector<Material>   &materials,
                         const Patch<dim>              &patch,
                         const std::vector<double>     &displacement,
                         std::vector<PointUpdate<dim>> &updates);

  /**
   * Writes an update into the history: F, elastic frame, stress, energies, and the
   * law's columns into the @p columns of PointState::memory where they stand.
   */
  template <int dim>
  void
  apply_point_update(const PointUpdate<dim>          &update,
                     const std::vector<unsigned int> &columns,
                     PointState<dim>                 &state);
  /** The same for a point of which nothing but the core is stored. */
  template <int dim>
  void
  apply_point_update(const PointUpdate<dim>          &update,
                     const std::vector<unsigned int> &columns,
                     PointCore<dim>                  &state);

  /**
   * By which the edges of the points' GIMP domains, boxes along the axes, are scaled [-]: the
   * edges that Gram-Schmidt leaves of F's columns, taken in all orders, whose logarithms are
   * weighted by the inverse of how far the frame is turned, sum_k |q_k - e_k|^2. Volumes are those
   * of F; boxes of a body that is stretched or sheared along an axis tile it, whatever the shear;
   * where the body turns the boxes do not shrink, but no boxes along the axes tile it then.
   */
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  stretches_along_axes(const std::vector<dealii::Tensor<2, dim>> &deformation_gradients);
} // namespace kedge

#endif
