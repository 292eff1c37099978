#ifndef kedge_porous_mixture_trial_h
#define kedge_porous_mixture_trial_h

#include <kedge/porous/pore_points.h>

#include <deal.II/base/tensor.h>

namespace kedge
{
  /** What is the same for all points of a body in a step of the conserving balance. */
  template <int dim>
  struct MixtureStep
  {
    const Soil            &soil;
    double                 dt;           ///< [s]
    double                 theta;        ///< of the stabilisation, in [1/2, 1]
    dealii::Tensor<1, dim> acceleration; ///< of the body force, f [m/s^2]
  };

  /**
   * Points in a trial state: the nodal fields there, gradients by x_n. The nodes' potential is
   * that of theory_mixture.md 2, rho_0 mu less the kinetic energies of the nodes.
   */
  template <int dim, typename Number>
  struct MixtureTrial
  {
    Number volume;                  ///< V0 [m^3]
    Number determinant;             ///< J_n
    Number pressure_n;              ///< of the fluid at the end of the last step [Pa]
    Number fluctuation_n;           ///< of the stabilisation [Pa]
    Number fluid_velocity_n[dim];   ///< [m/s]
    Number displacement[dim][dim];  ///< A = du/dx_n, of the whole step
    Number velocity[dim];           ///< U, of the skeleton in the step [m/s]
    Number constant_velocity[dim];  ///< with N^0 in place of N
    Number potential;               ///< lambda [Pa]
    Number potential_gradient[dim]; ///< [Pa/m]
    Number potential_fluctuation;   ///< (N - N^0) lambda [Pa]
  };

  /** Where what a point answers depends on: places in a row of slopes. */
  template <int dim>
  struct MixtureInput
  {
    static constexpr int velocity  = dim * dim; ///< after the displacement, [m][S]
    static constexpr int potential = velocity + dim;
    static constexpr int gradient  = potential + 1;
    static constexpr int n         = gradient + dim;
  };

  /** A quantity of a point and its slopes by all inputs. */
  template <int dim, typename Number>
  struct MixtureSlopes
  {
    Number of[MixtureInput<dim>::n];
  };
} // namespace kedge

#endif
