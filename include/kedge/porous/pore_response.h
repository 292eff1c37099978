#ifndef kedge_porous_pore_response_h
#define kedge_porous_pore_response_h

#include <kedge/porous/pore_points.h>
#include <kedge/stress/force_stress.h>

namespace kedge
{
  /** What is the same for all points of a body in a step of the u-p balance. */
  template <int dim>
  struct PoreStep
  {
    const Soil            &soil;
    PoreScheme             scheme;
    double                 dt;             ///< [s]
    double                 alpha;          ///< fraction of u at which balance is stated
    double                 inertia;        ///< d a/d u [1/s^2]; 0 in quasi-static runs
    double                 inverse_length; ///< of a cell [1/m]
    double                 stabilisation;  ///< tau of stabilisation_of_step() [1/Pa]
    dealii::Tensor<1, dim> acceleration;   ///< of the body force, f [m/s^2]
  };

  /**
   * tau of (4.179) in a step: that of the statics, tau_0 = Soil::stabilisation, in
   * series with the inertia of a cell,
   *   1/tau = 1/tau_0 + rho h^2/12 d a/d u,  rho = (1 - n_0) rho_s + n_0 rho_0,
   * so that short steps, in which inertia alone answers to pressure, are not given a
   * storage that the soil does not have (theory_soil.md 3) [1/Pa].
   *
   * @param inertia        d a/d u [1/s^2]
   * @param inverse_length 1/h [1/m]
   */
  double
  stabilisation_of_step(const Soil &soil, const double inertia, const double inverse_length);

  /** Points in a trial state, one in each lane: the nodal fields there, gradients by x_n. */
  template <int dim>
  struct PoreTrial
  {
    Pack volume;      ///< V0 [m^3]
    Pack determinant; ///< J_n
    Pack pressure_n;
    Pack fluctuation_n;
    Pack known_rate;             ///< of the fluid content, PoreScheme::known_rate()
    Pack displacement[dim][dim]; ///< A = du/dx_n, of the whole step
    Pack pressure;               ///< p_e
    Pack pressure_gradient[dim]; ///< dp_e/dx_n
    Pack fluctuation;            ///< (N - N^0) p_e
    Pack acceleration[dim];      ///< a of the skeleton
  };

  /**
   * The points' parts of the residuals (4.154), (4.155) and of their Jacobian,
   * as factors of the basis functions N_A, of their gradients g_A = dN_A/dx_n
   * and of (N_A - N^0_A). The balance of mass is that of volume over the step:
   * (4.155) times dt/rho_0, with the change of the fluid content in place of
   * its rate. Row i of momentum, column u_m or p of node B:
   *   e_Ai = momentum_gradient[i][R] g_AR + momentum_value[i] N_A
   *   d_A  = fluid_gradient[R] g_AR + fluid_value N_A + fluid_fluctuation (N_A - N^0_A)
   *
   *   de_Ai/du_Bm = g_AR uu[i][R][m][S] g_BS + N_A uu_value[i][m][S] g_BS
   *                 + delta_im mass_inertia N_A N_B
   *
   *   de_Ai/dp_B  = (g_AR up[i][R] + N_A up_value[i]) N_B
   *
   *   dd_A/du_Bm  = g_AR pu[R][m][S] g_BS + N_A pu_value[m][S] g_BS
   *                 + g_AR pu_inertia[R][m] N_B
   *
   *   dd_A/dp_B   = g_AR pp[R][S] g_BS + g_AR pp_weight[R] N_B + N_A pp_value N_B
   *                 + pp_fluctuation (N_A - N^0_A)(N_B - N^0_B)
   */
  template <int dim>
  struct PoreResponse
  {
    PackMask valid;

    Pack momentum_gradient[dim][dim], momentum_value[dim];
    Pack fluid_gradient[dim], fluid_value, fluid_fluctuation;

    Pack uu[dim][dim][dim][dim], uu_value[dim][dim][dim], mass, mass_inertia;
    Pack up[dim][dim], up_value[dim];
    Pack pu[dim][dim][dim], pu_value[dim][dim], pu_inertia[dim][dim];
    Pack pp[dim][dim], pp_weight[dim], pp_value, pp_fluctuation;

    // for the update of the point
    Pack end_determinant;     ///< J_{n+1}
    Pack end_pressure;        ///< p_{n+1} [Pa]
    Pack content_increment;   ///< m_{n+1} - m_n per V0 [kg/m^3]
    Pack darcy_velocity[dim]; ///< q/rho_f at balance [m/s]
    Pack darcy_power;         ///< dissipated, per V0 [W/m^3]
    Pack flow_work_rate;      ///< of f on the flow through the skeleton, per V0 [W/m^3]
    Pack inertia_work_rate;   ///< of -a on it, which no energy stands against, per V0 [W/m^3]
  };

  /**
   * The responses of the points in the lanes, with the Kirchhoff stress tau' - J p I. It
   * knows no material and no nodes.
   *
   * Corrections to the print: dp/dx in (B.52) is of p; (4.155) sums over p_C.
   *
   * @param stress effective, of StressRule::at_configuration at the displacement alpha A;
   *               its tangent is read if with_tangent
   */
  template <int dim, bool with_tangent>
  void
  evaluate_pore_response(const ForceStress<dim, Pack> &stress,
                         const PoreStep<dim>          &step,
                         const PoreTrial<dim>         &trial,
                         PoreResponse<dim>            &r);
} // namespace kedge

#endif
