#ifndef kedge_porous_mixture_points_h
#define kedge_porous_mixture_points_h

#include <kedge/fields/step_points.h>
#include <kedge/points/material_points.h>

namespace kedge
{
  /**
   * What the points know of their fluid at the start of a step of the conserving balance, in the
   * slots of StepPoints. None of it goes through the grid.
   */
  template <int dim>
  struct MixturePoints
  {
    std::vector<double>                 pressure;       ///< of the last step's balance [Pa]
    std::vector<double>                 end_pressure;   ///< p_n, at its end [Pa]
    std::vector<double>                 fluctuation;    ///< of the stabilisation [Pa]
    std::vector<dealii::Tensor<1, dim>> fluid_velocity; ///< v_fn [m/s]

    /** Reads the cloud in the order of @p points. */
    void
    reinit(const MaterialPoints<dim> &cloud, const StepPoints<dim> &points);
  };

  /** The fluid of a material point at the end of a step, not yet committed. */
  template <int dim>
  struct MixtureUpdate
  {
    double                 pressure;        ///< of the balance [Pa]
    double                 end_pressure;    ///< [Pa]
    double                 fluctuation;     ///< of the stabilisation [Pa]
    double                 porosity;        ///< n_{n+1} [-]
    dealii::Tensor<1, dim> fluid_velocity;  ///< [m/s]
    dealii::Tensor<1, dim> darcy_velocity;  ///< of the balance [m/s]
    dealii::Tensor<1, dim> relative;        ///< w, of the fluid against the skeleton [m/s]
    double                 mass;            ///< of the fluid at the end [kg]
    dealii::Tensor<1, dim> skeleton_change; ///< of the skeleton's velocity, by the filter [m/s]
    // of the step
    double darcy_dissipation;       ///< with what a dry point swallows [J]
    double swallowed;               ///< volume of fluid that a dry point takes away [m^3]
    double weight_work;             ///< of the body force on the fluid [J]
    double weight_impulse;          ///< over the body force: mean mass times dt [kg s]
    double filter_loss;             ///< by the filter of velocities [J]
    double stabilisation_loss;      ///< [J]
    double stabilisation_torque[3]; ///< what it takes of the angular momentum [kg m^2/s]
  };

  /** Writes it into the history. */
  template <int dim>
  void
  apply_mixture_update(const MixtureUpdate<dim> &update, PointState<dim> &state);
} // namespace kedge

#endif
