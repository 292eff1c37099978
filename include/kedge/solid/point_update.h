#ifndef kedge_solid_point_update_h
#define kedge_solid_point_update_h

#include <kedge/materials/material.h>
#include <kedge/solid/internal_force.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  /** The history of a material point at the end of a converged step, not yet committed. */
  template <int dim>
  struct PointUpdate
  {
    double relative_gradient[dim][dim];        ///< A = d(Delta u)/dx_n
    double elastic_frame[dim][dim];            ///< B_{n+1}
    double kirchhoff_stress[n_symmetric<dim>]; ///< tau_{n+1} [Pa]
    double out_of_plane_stress;                ///< [Pa]
    double out_of_plane_stretch_factor;        ///< of the elastic stretch, plane strain
    double strain_energy;                      ///< per V0 [J/m^3]
    // of a material with a history
    double hardening_energy;          ///< per V0 [J/m^3]
    double dissipation;               ///< of this step, per V0 [J/m^3]
    double equivalent_plastic_strain; ///< at the end of the step
  };

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

  /** Writes an update into the history: F, elastic frame, stress, energies, GIMP domain. */
  template <int dim>
  void
  apply_point_update(const PointUpdate<dim> &update, PointState<dim> &state);
} // namespace kedge

#endif
