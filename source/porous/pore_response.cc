#include <kedge/porous/pore_response.h>

namespace kedge
{
  namespace
  {
    /** A function of one double in each lane. */
    template <typename Function>
    inline Pack
    in_lanes(const Pack &x, const Function &function)
    {
      Pack result;
      for (unsigned int lane = 0; lane < pack_width; ++lane)
        result.set(lane, function(x[lane]));
      return result;
    }

    /** Inverse of I + A, and det(I + A) - 1 without cancellation. */
    template <int dim>
    inline Pack
    invert(const Pack (&A)[dim][dim], Pack (&inverse)[dim][dim])
    {
      Pack F[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          F[i][j] = (i == j ? 1. : 0.) + A[i][j];
      Pack excess;
      if constexpr (dim == 2)
        {
          excess           = A[0][0] + A[1][1] + (A[0][0] * A[1][1] - A[0][1] * A[1][0]);
          const Pack scale = 1. / (1. + excess);
          inverse[0][0]    = scale * F[1][1];
          inverse[0][1]    = -scale * F[0][1];
          inverse[1][0]    = -scale * F[1][0];
          inverse[1][1]    = scale * F[0][0];
        }
      else
        {
          const auto minor = [](const Pack(&M)[dim][dim], const int i, const int j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            return M[a][c] * M[b][d] - M[a][d] * M[b][c];
          };
          excess = A[0][0] + A[1][1] + A[2][2] + minor(A, 0, 0) + minor(A, 1, 1) + minor(A, 2, 2);
          for (int j = 0; j < dim; ++j)
            excess += A[0][j] * minor(A, 0, j);
          const Pack scale = 1. / (1. + excess);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              inverse[j][i] = scale * minor(F, i, j);
        }
      return excess;
    }

    /** x_R = G_Ri v_i: a vector at balance becomes a factor of gradients by x_n. */
    template <int dim>
    inline void
    pull_back(const Pack (&G)[dim][dim], const Pack (&v)[dim], Pack (&x)[dim])
    {
      for (int R = 0; R < dim; ++R)
        {
          x[R] = 0.;
          for (int i = 0; i < dim; ++i)
            x[R] += G[R][i] * v[i];
        }
    }
  } // namespace



  template <int dim, bool with_tangent>
  void
  evaluate_pore_response(const ForceStress<dim, Pack> &stress,
                         const PoreStep<dim>          &step,
                         const PoreTrial<dim>         &trial,
                         PoreResponse<dim>            &r)
  {
    const PoreFluid &fluid = step.soil.fluid;

    Pack at[dim][dim], G[dim][dim], G_end[dim][dim]; // inverse dF at balance and at the end
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        at[i][j] = step.alpha * trial.displacement[i][j];
    const Pack excess     = invert<dim>(at, G);
    const Pack excess_end = invert<dim>(trial.displacement, G_end);
    r.valid               = stress.valid && excess > -1. && excess_end > -1.;
    if (!any(r.valid))
      return;

    const Pack   V  = trial.volume;
    const double dt = step.dt, K_f = fluid.bulk_modulus;
    const double grains = 1. - fluid.initial_porosity;
    const double rho_0  = fluid.reference_density;

    const auto density = [&fluid](const Pack &pressure) {
      return in_lanes(pressure, [&fluid](const double x) {
        return fluid.density(x);
      });
    };

    // at balance
    const Pack J   = trial.determinant * (1. + excess);
    const Pack phi = J - grains; // pores per V0
    const Pack p = trial.pressure, rho = density(p), n = 1. - grains / J;
    const Pack Jp       = V * J * p;
    const Pack mobility = in_lanes(n, [&](const double x) {
      return fluid.mass_mobility(x);
    });
    const Pack K        = V * J * mobility * dt / rho_0;
    // at the end
    r.end_pressure     = trial.pressure_n + (p - trial.pressure_n) / step.scheme.theta;
    const Pack J_end   = trial.determinant * (1. + excess_end);
    r.end_determinant  = J_end;
    const Pack phi_n   = trial.determinant - grains;
    const Pack rho_n   = density(trial.pressure_n);
    const Pack rho_end = density(r.end_pressure);
    const Pack rho_grown =
      rho_n * in_lanes((r.end_pressure - trial.pressure_n) / K_f, [](const double x) {
        return std::expm1(x);
      });
    r.content_increment = rho_end * trial.determinant * excess_end + phi_n * rho_grown;

    // momentum
    Pack push[dim]; // a - f
    r.mass = V * (step.soil.grain_density * grains + rho * phi);
    for (int i = 0; i < dim; ++i)
      {
        push[i]             = trial.acceleration[i] - step.acceleration[i];
        r.momentum_value[i] = r.mass * push[i];
        for (int R = 0; R < dim; ++R)
          r.momentum_gradient[i][R] = V * stress.stress[i][R] - Jp * G[R][i];
      }

    // fluid: w = grad p - rho_f (f - a) drives the flow
    Pack gradient[dim], w[dim], Gw[dim], power = 0., flow_work = 0.;
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
    pull_back<dim>(G, w, Gw);
    for (int R = 0; R < dim; ++R)
      r.fluid_gradient[R] = K * Gw[R];
    const double c = step.scheme.content_factor();
    r.fluid_value  = V / rho_0 * (c * r.content_increment + dt * trial.known_rate);
    // the stabilisation at the volume of step n, where it is linear
    r.pp_fluctuation    = V * trial.determinant * step.soil.stabilisation / step.scheme.theta;
    r.fluid_fluctuation = r.pp_fluctuation * (trial.fluctuation - trial.fluctuation_n);

    if constexpr (with_tangent)
      {
        Pack GG[dim][dim], Gp[dim];
        pull_back<dim>(G, push, Gp);
        for (int R = 0; R < dim; ++R)
          pull_back<dim>(G, G[R], GG[R]);
        // J d(J kappa)/dJ / (J kappa) = 1 + (1 - n) kappa'/kappa, kappa = 0 allowed
        const Pack K_slope = K + V * J * (1. - n) *
                                   in_lanes(n,
                                            [&](const double x) {
                                              return fluid.mass_mobility_slope(x);
                                            }) *
                                   dt / rho_0;
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
  }

#define KEDGE_INSTANTIATE(dim, with_tangent)                                              \
  template void evaluate_pore_response<dim, with_tangent>(const ForceStress<dim, Pack> &, \
                                                          const PoreStep<dim> &,          \
                                                          const PoreTrial<dim> &,         \
                                                          PoreResponse<dim> &);
  KEDGE_INSTANTIATE(2, false)
  KEDGE_INSTANTIATE(2, true)
  KEDGE_INSTANTIATE(3, false)
  KEDGE_INSTANTIATE(3, true)
} // namespace kedge
