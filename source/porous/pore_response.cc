#include <kedge/porous/gradient_inverse.h>
#include <kedge/porous/pore_response.h>

namespace kedge
{
  namespace
  {
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



  namespace
  {
    /** The state of balance and what the rows of a PoreResponse share. */
    template <int dim>
    struct Balance
    {
      Pack G[dim][dim], G_end[dim][dim]; ///< inverse dF at balance and at the end
      Pack excess, excess_end;           ///< det dF - 1 there
      Pack J, phi, n;                    ///< determinant, pores per V0, porosity
      Pack rho, mobility;                ///< of the fluid
      Pack K;                            ///< V J mobility dt/rho_0
      Pack push[dim];                    ///< a - f
      Pack gradient[dim], w[dim]; ///< grad p, and what drives the flow: grad p - rho_f (f - a)
      Pack Gw[dim];               ///< w as a factor of gradients by x_n
      Pack J_end, rho_end;        ///< at the end
    };

    template <int dim>
    inline void
    find_kinematics(const PoreStep<dim> &step, const PoreTrial<dim> &trial, Balance<dim> &b)
    {
      b.excess     = internal::invert_gradient<dim>(trial.displacement, step.alpha, b.G);
      b.excess_end = internal::invert_gradient<dim>(trial.displacement, 1., b.G_end);
    }

    inline Pack
    density(const PoreFluid &fluid, const Pack &pressure)
    {
      return internal::of_each(pressure, [&fluid](const double x) {
        return fluid.density(x);
      });
    }

    /** The fluid and its flow at balance. */
    template <int dim>
    inline void
    find_flow(const PoreStep<dim> &step, const PoreTrial<dim> &trial, Balance<dim> &b)
    {
      const PoreFluid &fluid  = step.soil.fluid;
      const double     grains = 1. - fluid.initial_porosity;
      b.J                     = trial.determinant * (1. + b.excess);
      b.phi                   = b.J - grains;
      b.rho                   = density(fluid, trial.pressure);
      b.n                     = 1. - grains / b.J;
      b.mobility              = internal::of_each(b.n, [&](const double x) {
        return fluid.mass_mobility(x);
      });
      b.K                     = trial.volume * b.J * b.mobility * step.dt / fluid.reference_density;
      for (int i = 0; i < dim; ++i)
        {
          b.push[i]     = trial.acceleration[i] - step.acceleration[i];
          b.gradient[i] = 0.;
          for (int R = 0; R < dim; ++R)
            b.gradient[i] += trial.pressure_gradient[R] * b.G[R][i];
          b.w[i] = b.gradient[i] + b.rho * b.push[i];
        }
      pull_back<dim>(b.G, b.w, b.Gw);
    }

    /** Pressure and content of fluid at the end of the step. */
    template <int dim>
    inline void
    find_end(const PoreStep<dim>  &step,
             const PoreTrial<dim> &trial,
             Balance<dim>         &b,
             PoreResponse<dim>    &r)
    {
      const PoreFluid &fluid = step.soil.fluid;
      r.end_pressure = trial.pressure_n + (trial.pressure - trial.pressure_n) / step.scheme.theta;
      b.J_end        = trial.determinant * (1. + b.excess_end);
      r.end_determinant = b.J_end;
      const Pack phi_n  = trial.determinant - (1. - fluid.initial_porosity);
      b.rho_end         = density(fluid, r.end_pressure);
      const Pack rho_grown =
        density(fluid, trial.pressure_n) *
        internal::of_each((r.end_pressure - trial.pressure_n) / fluid.bulk_modulus,
                          [](const double x) {
                            return std::expm1(x);
                          });
      r.content_increment = b.rho_end * trial.determinant * b.excess_end + phi_n * rho_grown;
    }

    /** Rows of momentum and of the fluid. */
    template <int dim>
    inline void
    find_residual(const ForceStress<dim, Pack> &stress,
                  const PoreStep<dim>          &step,
                  const PoreTrial<dim>         &trial,
                  const Balance<dim>           &b,
                  PoreResponse<dim>            &r)
    {
      const PoreFluid &fluid = step.soil.fluid;
      const Pack       V = trial.volume, Jp = V * b.J * trial.pressure;
      r.mass     = V * (step.soil.grain_density * (1. - fluid.initial_porosity) + b.rho * b.phi);
      Pack power = 0., flow_work = 0., inertia_work = 0.;
      for (int i = 0; i < dim; ++i)
        {
          r.momentum_value[i] = r.mass * b.push[i];
          for (int R = 0; R < dim; ++R)
            r.momentum_gradient[i][R] = V * stress.stress[i][R] - Jp * b.G[R][i];
          r.darcy_velocity[i] = -b.mobility / b.rho * b.w[i];
          power -= r.darcy_velocity[i] * b.w[i];
          flow_work += b.rho * step.acceleration[i] * r.darcy_velocity[i];
          inertia_work -= b.rho * trial.acceleration[i] * r.darcy_velocity[i];
        }
      r.darcy_power       = b.J * power;
      r.flow_work_rate    = b.J * flow_work;
      r.inertia_work_rate = b.J * inertia_work;
      for (int R = 0; R < dim; ++R)
        r.fluid_gradient[R] = b.K * b.Gw[R];
      r.fluid_value =
        V / fluid.reference_density *
        (step.scheme.content_factor() * r.content_increment + step.dt * trial.known_rate);
      // the stabilisation at the volume of step n, where it is linear
      r.pp_fluctuation    = V * trial.determinant * step.stabilisation / step.scheme.theta;
      r.fluid_fluctuation = r.pp_fluctuation * (trial.fluctuation - trial.fluctuation_n);
    }

    /** Slopes of the rows of momentum. */
    template <int dim>
    inline void
    find_momentum_slopes(const ForceStress<dim, Pack> &stress,
                         const PoreStep<dim>          &step,
                         const PoreTrial<dim>         &trial,
                         const Balance<dim>           &b,
                         PoreResponse<dim>            &r)
    {
      const auto &G = b.G;
      const Pack  V = trial.volume, Jp = V * b.J * trial.pressure;
      for (int i = 0; i < dim; ++i)
        {
          r.up_value[i] = V * b.push[i] * b.phi * b.rho / step.soil.fluid.bulk_modulus;
          for (int R = 0; R < dim; ++R)
            {
              r.up[i][R] = -V * b.J * G[R][i];
              for (int m = 0; m < dim; ++m)
                for (int S = 0; S < dim; ++S)
                  r.uu[i][R][m][S] = V * stress.tangent[i][R][m][S] -
                                     step.alpha * Jp * (G[R][i] * G[S][m] - G[R][m] * G[S][i]);
            }
          for (int m = 0; m < dim; ++m)
            for (int S = 0; S < dim; ++S)
              r.uu_value[i][m][S] = step.alpha * V * b.rho * b.J * b.push[i] * G[S][m];
        }
      r.mass_inertia = r.mass * step.inertia;
    }

    /** Slopes of the row of the fluid. */
    template <int dim>
    inline void
    find_fluid_slopes(const PoreStep<dim>  &step,
                      const PoreTrial<dim> &trial,
                      const Balance<dim>   &b,
                      PoreResponse<dim>    &r)
    {
      const PoreFluid &fluid = step.soil.fluid;
      const auto      &G     = b.G;
      const Pack       V     = trial.volume;
      const double     rho_0 = fluid.reference_density, K_f = fluid.bulk_modulus;
      const double     c = step.scheme.content_factor();
      Pack             GG[dim][dim], Gp[dim];
      pull_back<dim>(G, b.push, Gp);
      for (int R = 0; R < dim; ++R)
        pull_back<dim>(G, G[R], GG[R]);
      // J d(J kappa)/dJ / (J kappa) = 1 + (1 - n) kappa'/kappa, kappa = 0 allowed
      const Pack K_slope = b.K + V * b.J * (1. - b.n) *
                                   internal::of_each(b.n,
                                                     [&](const double x) {
                                                       return fluid.mass_mobility_slope(x);
                                                     }) *
                                   step.dt / rho_0;
      for (int m = 0; m < dim; ++m)
        for (int S = 0; S < dim; ++S)
          r.pu_value[m][S] = V / rho_0 * c * b.rho_end * b.J_end * b.G_end[S][m];
      for (int R = 0; R < dim; ++R)
        {
          r.pp_weight[R] = b.K * Gp[R] * b.rho / K_f;
          for (int m = 0; m < dim; ++m)
            {
              r.pu_inertia[R][m] = b.K * b.rho * step.inertia * G[R][m];
              for (int S = 0; S < dim; ++S)
                r.pu[R][m][S] = step.alpha * (K_slope * b.Gw[R] * G[S][m] -
                                              b.K * (G[R][m] * b.Gw[S] + b.gradient[m] * GG[R][S]));
            }
          for (int S = 0; S < dim; ++S)
            r.pp[R][S] = b.K * GG[R][S];
        }
      r.pp_value = V / rho_0 * c * b.rho_end * (b.J_end - (1. - fluid.initial_porosity)) /
                   (K_f * step.scheme.theta);
    }
  } // namespace



  double
  stabilisation_of_step(const Soil &soil, const double inertia, const double inverse_length)
  {
    if (soil.stabilisation == 0.)
      return 0.;
    const double n   = soil.fluid.initial_porosity;
    const double rho = (1. - n) * soil.grain_density + n * soil.fluid.reference_density;
    return 1. / (1. / soil.stabilisation + rho * inertia / (12. * inverse_length * inverse_length));
  }



  namespace
  {
    /** The skeleton alone, of a dry body. */
    template <int dim, bool with_tangent>
    void
    respond_dry(const ForceStress<dim, Pack> &stress,
                const PoreStep<dim>          &step,
                const PoreTrial<dim>         &trial,
                const Balance<dim>           &b,
                PoreResponse<dim>            &r)
    {
      const PackMask valid = r.valid;
      r                    = PoreResponse<dim>(); // all zero
      r.valid              = valid;
      const Pack V         = trial.volume;
      r.mass            = V * (step.soil.grain_density * (1. - step.soil.fluid.initial_porosity));
      r.mass_inertia    = r.mass * step.inertia;
      r.end_determinant = trial.determinant * (1. + b.excess_end);
      for (int i = 0; i < dim; ++i)
        {
          r.momentum_value[i] = r.mass * (trial.acceleration[i] - step.acceleration[i]);
          for (int R = 0; R < dim; ++R)
            {
              r.momentum_gradient[i][R] = V * stress.stress[i][R];
              for (int m = 0; m < dim && with_tangent; ++m)
                for (int S = 0; S < dim; ++S)
                  r.uu[i][R][m][S] = V * stress.tangent[i][R][m][S];
            }
        }
      r.fluid_value = V * (step.soil.dry_storage * trial.pressure);
      r.pp_value    = V * step.soil.dry_storage;
    }
  } // namespace



  template <int dim, bool with_tangent>
  void
  evaluate_pore_response(const ForceStress<dim, Pack> &stress,
                         const PoreStep<dim>          &step,
                         const PoreTrial<dim>         &trial,
                         PoreResponse<dim>            &r)
  {
    Balance<dim> balance;
    find_kinematics(step, trial, balance);
    r.valid = stress.valid && balance.excess > -1. && balance.excess_end > -1.;
    if (!any(r.valid))
      return;
    if (step.soil.dry_storage > 0.)
      return respond_dry<dim, with_tangent>(stress, step, trial, balance, r);
    find_flow(step, trial, balance);
    find_end(step, trial, balance, r);
    find_residual(stress, step, trial, balance, r);
    if constexpr (with_tangent)
      {
        find_momentum_slopes(stress, step, trial, balance, r);
        find_fluid_slopes(step, trial, balance, r);
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
#undef KEDGE_INSTANTIATE
} // namespace kedge
