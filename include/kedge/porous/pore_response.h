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
    dealii::Tensor<1, dim> acceleration;   ///< of the body force, f [m/s^2]
  };

  /** A point in a trial state: the nodal fields there, gradients by x_n. */
  template <int dim>
  struct PoreTrial
  {
    double volume;      ///< V0 [m^3]
    double determinant; ///< J_n
    double pressure_n;
    double fluctuation_n;
    double known_rate;             ///< of the fluid content, PoreScheme::known_rate()
    double displacement[dim][dim]; ///< A = du/dx_n, of the whole step
    double pressure;               ///< p_e
    double pressure_gradient[dim]; ///< dp_e/dx_n
    double fluctuation;            ///< (N - N^0) p_e
    double acceleration[dim];      ///< a of the skeleton
  };

  /**
   * A point's part of the residuals (4.154), (4.155) and of their Jacobian,
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
    bool valid;

    double momentum_gradient[dim][dim], momentum_value[dim];
    double fluid_gradient[dim], fluid_value, fluid_fluctuation;

    double uu[dim][dim][dim][dim], uu_value[dim][dim][dim], mass, mass_inertia;
    double up[dim][dim], up_value[dim];
    double pu[dim][dim][dim], pu_value[dim][dim], pu_inertia[dim][dim];
    double pp[dim][dim], pp_weight[dim], pp_value, pp_fluctuation;

    // for the update of the point
    double end_pressure;        ///< p_{n+1} [Pa]
    double content_increment;   ///< m_{n+1} - m_n per V0 [kg/m^3]
    double darcy_velocity[dim]; ///< q/rho_f at balance [m/s]
    double darcy_power;         ///< dissipated, per V0 [W/m^3]
    double flow_work_rate;      ///< of f - a on the flow through the skeleton, per V0 [W/m^3]
  };

  namespace internal
  {
    /** Inverse of I + A, and det(I + A) - 1 without cancellation. */
    template <int dim>
    inline double
    invert(const double (&A)[dim][dim], double (&inverse)[dim][dim])
    {
      double F[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          F[i][j] = (i == j ? 1. : 0.) + A[i][j];
      double excess;
      if constexpr (dim == 2)
        {
          excess             = A[0][0] + A[1][1] + (A[0][0] * A[1][1] - A[0][1] * A[1][0]);
          const double scale = 1. / (1. + excess);
          inverse[0][0]      = scale * F[1][1];
          inverse[0][1]      = -scale * F[0][1];
          inverse[1][0]      = -scale * F[1][0];
          inverse[1][1]      = scale * F[0][0];
        }
      else
        {
          const auto minor = [](const double(&M)[dim][dim], const int i, const int j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            return M[a][c] * M[b][d] - M[a][d] * M[b][c];
          };
          excess = A[0][0] + A[1][1] + A[2][2] + minor(A, 0, 0) + minor(A, 1, 1) + minor(A, 2, 2);
          for (int j = 0; j < dim; ++j)
            excess += A[0][j] * minor(A, 0, j);
          const double scale = 1. / (1. + excess);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              inverse[j][i] = scale * minor(F, i, j);
        }
      return excess;
    }

    /** x_R = G_Ri v_i: a vector at balance becomes a factor of gradients by x_n. */
    template <int dim>
    inline void
    pull_back(const double (&G)[dim][dim], const double (&v)[dim], double (&x)[dim])
    {
      for (int R = 0; R < dim; ++R)
        {
          x[R] = 0.;
          for (int i = 0; i < dim; ++i)
            x[R] += G[R][i] * v[i];
        }
    }
  } // namespace internal

  /**
   * The response of a point, with effective stress by @p material at the
   * displacement alpha A and Kirchhoff stress tau' - J p I.
   *
   * Corrections to the print: dp/dx in (B.52) is of p; (4.155) sums over p_C.
   */
  template <int dim, bool with_tangent, class Material>
  inline PoreResponse<dim>
  evaluate_pore_response(const Material            &material,
                         const StressState<dim>    &state,
                         const HistoryOf<Material> &history,
                         const PoreStep<dim>       &step,
                         const PoreTrial<dim>      &trial)
  {
    const PoreFluid  &fluid = step.soil.fluid;
    PoreResponse<dim> r;

    double at[dim][dim], G[dim][dim], G_end[dim][dim]; // inverse dF at balance and at the end
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        at[i][j] = step.alpha * trial.displacement[i][j];
    const ForceStress<dim> stress =
      evaluate_force_stress<dim, with_tangent, StressRule::at_configuration>(material,
                                                                             state,
                                                                             trial.displacement,
                                                                             step.alpha,
                                                                             history);
    const double excess     = internal::invert<dim>(at, G);
    const double excess_end = internal::invert<dim>(trial.displacement, G_end);
    r.valid                 = stress.valid && excess > -1. && excess_end > -1.;
    if (!r.valid)
      return r;

    const double V = trial.volume, dt = step.dt, K_f = fluid.bulk_modulus;
    const double grains = 1. - fluid.initial_porosity;
    const double rho_0  = fluid.reference_density;

    // at balance
    const double J   = trial.determinant * (1. + excess);
    const double phi = J - grains; // pores per V0
    const double p = trial.pressure, rho = fluid.density(p), n = fluid.porosity(J);
    const double Jp       = V * J * p;
    const double mobility = fluid.mass_mobility(n);
    const double K        = V * J * mobility * dt / rho_0;
    // at the end
    r.end_pressure         = trial.pressure_n + (p - trial.pressure_n) / step.scheme.theta;
    const double J_end     = trial.determinant * (1. + excess_end);
    const double phi_n     = trial.determinant - grains;
    const double rho_n     = fluid.density(trial.pressure_n);
    const double rho_end   = fluid.density(r.end_pressure);
    const double rho_grown = rho_n * std::expm1((r.end_pressure - trial.pressure_n) / K_f);
    r.content_increment    = rho_end * trial.determinant * excess_end + phi_n * rho_grown;

    // momentum
    double push[dim]; // a - f
    r.mass = V * (step.soil.grain_density * grains + rho * phi);
    for (int i = 0; i < dim; ++i)
      {
        push[i]             = trial.acceleration[i] - step.acceleration[i];
        r.momentum_value[i] = r.mass * push[i];
        for (int R = 0; R < dim; ++R)
          r.momentum_gradient[i][R] = V * stress.stress[i][R] - Jp * G[R][i];
      }

    // fluid: w = grad p - rho_f (f - a) drives the flow
    double gradient[dim], w[dim], Gw[dim], power = 0., flow_work = 0.;
    for (int i = 0; i < dim; ++i)
      {
        gradient[i] = 0.;
        for (int R = 0; R < dim; ++R)
          gradient[i] += trial.pressure_gradient[R] * G[R][i];
        w[i]                = gradient[i] + rho * push[i];
        r.darcy_velocity[i] = -mobility / rho * w[i];
        power -= r.darcy_velocity[i] * w[i];
        flow_work -= rho * push[i] * r.darcy_velocity[i];
      }
    r.darcy_power    = J * power;
    r.flow_work_rate = J * flow_work;
    internal::pull_back<dim>(G, w, Gw);
    for (int R = 0; R < dim; ++R)
      r.fluid_gradient[R] = K * Gw[R];
    const double c = step.scheme.content_factor();
    r.fluid_value  = V / rho_0 * (c * r.content_increment + dt * trial.known_rate);
    // the stabilisation at the volume of step n, where it is linear
    r.pp_fluctuation    = V * trial.determinant * step.soil.stabilisation / step.scheme.theta;
    r.fluid_fluctuation = r.pp_fluctuation * (trial.fluctuation - trial.fluctuation_n);

    if constexpr (with_tangent)
      {
        double GG[dim][dim], Gp[dim];
        internal::pull_back<dim>(G, push, Gp);
        for (int R = 0; R < dim; ++R)
          internal::pull_back<dim>(G, G[R], GG[R]);
        // J d(J kappa)/dJ / (J kappa) = 1 + (1 - n) kappa'/kappa, kappa = 0 allowed
        const double K_slope = K + V * J * (1. - n) * fluid.mass_mobility_slope(n) * dt / rho_0;
        for (int i = 0; i < dim; ++i)
          {
            r.up_value[i] = V * push[i] * phi * rho / K_f;
            for (int R = 0; R < dim; ++R)
              {
                r.up[i][R] = -V * J * G[R][i];
                for (int m = 0; m < dim; ++m)
                  for (int S = 0; S < dim; ++S)
                    r.uu[i][R][m][S] = V * stress.tangent[i][R][m][S] -
                                       step.alpha * Jp * (G[R][i] * G[S][m] - G[R][m] * G[S][i]);
              }
            for (int m = 0; m < dim; ++m)
              for (int S = 0; S < dim; ++S)
                r.uu_value[i][m][S] = step.alpha * V * rho * J * push[i] * G[S][m];
          }
        for (int m = 0; m < dim; ++m)
          for (int S = 0; S < dim; ++S)
            r.pu_value[m][S] = V / rho_0 * c * rho_end * J_end * G_end[S][m];
        for (int R = 0; R < dim; ++R)
          {
            r.pp_weight[R] = K * Gp[R] * rho / K_f;
            for (int m = 0; m < dim; ++m)
              {
                r.pu_inertia[R][m] = K * rho * step.inertia * G[R][m];
                for (int S = 0; S < dim; ++S)
                  r.pu[R][m][S] = step.alpha * (K_slope * Gw[R] * G[S][m] -
                                                K * (G[R][m] * Gw[S] + gradient[m] * GG[R][S]));
              }
            for (int S = 0; S < dim; ++S)
              r.pp[R][S] = K * GG[R][S];
          }
        r.pp_value     = V / rho_0 * c * rho_end * (J_end - grains) / (K_f * step.scheme.theta);
        r.mass_inertia = r.mass * step.inertia;
      }
    return r;
  }
} // namespace kedge

#endif
