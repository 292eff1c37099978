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
                         const StepPoints<dim>         &points,
                         const LatticeWindow<dim>      &window,
                         const ActiveNodes<dim>        &nodes,
                         const std::vector<double>     &displacement,
                         std::vector<PointUpdate<dim>> &updates);

  /** Writes an update into the history: F, elastic frame, stress, energies. */
  template <int dim>
  void
  apply_point_update(const PointUpdate<dim> &update, PointState<dim> &state);

  /**
   * Scales the points' GIMP domains by the diagonal of the right stretch
   * U = (F^T F)^{1/2} (Coombs et al. 2020).
   */
  template <int dim>
  void
  update_domains(const std::vector<PointState<dim> *> &states);
} // namespace kedge

#endif
