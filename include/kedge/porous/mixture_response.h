#ifndef kedge_porous_mixture_response_h
#define kedge_porous_mixture_response_h

#include <kedge/porous/relative_motion_slopes.h>
#include <kedge/stress/force_stress.h>

namespace kedge
{
  /**
   * The points' parts of the residuals of the conserving balance and of their Jacobian, as factors
   * of the basis functions N_A, of their gradients g_A = dN_A/dx_n and of (N_A - N^0_A):
   *   e_Ai = momentum_gradient[i][R] g_AR + momentum_value[i] N_A
   *          + stabilisation (U + U^0)_i rho_0/(2 dt) (N_A - N^0_A)              [N]
   *   d_A  = fluid_gradient[R] g_AR + fluid_value N_A
   *          + stabilisation (N_A - N^0_A)                                      [m^3]
   * with the inertia of the skeleton left to InertiaTerm. Equations in theory_mixture.md.
   */
  template <int dim, typename Number>
  struct MixtureResponse
  {
    using Slopes = MixtureSlopes<dim, Number>;

    Condition<Number> valid, has_stress; ///< whether there is an answer; from the law
    Number            momentum_gradient[dim][dim], momentum_value[dim];
    Number            fluid_gradient[dim], fluid_value, stabilisation;
    Slopes            momentum_gradient_slope[dim][dim], momentum_value_slope[dim];
    Slopes            fluid_gradient_slope[dim], fluid_value_slope;
    Number            stabilisation_slope; ///< by its fluctuation [m^3/Pa]

    // for the update of the point
    Number end_determinant;         ///< J_{n+1}
    Number pressure;                ///< of the balance [Pa]
    Number end_pressure;            ///< p_{n+1} [Pa]
    Number end_content;             ///< fluid per V0 [kg/m^3]
    Number end_fluid_velocity[dim]; ///< [m/s]
    Number end_fluctuation;         ///< [Pa]
    Number fluctuation;             ///< of the balance [Pa]
    Number darcy_velocity[dim];     ///< [m/s]
    Number relative[dim];           ///< w, of the fluid against the skeleton [m/s]
    Number darcy_power;             ///< dissipated, per V0 [W/m^3]
    Number weight_power;            ///< of the body force on the fluid, per V0 [W/m^3]
  };

  namespace internal
  {
    /** The exact change of volume as a stress: D and its slope by A. */
    template <int dim, typename Number>
    struct VolumeStress
    {
      Number D[dim][dim], E[dim][dim], F[dim][dim];

      explicit VolumeStress(const Number (&A)[dim][dim])
      {
        Number trace = 0.;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              F[i][j] = (i == j ? 1. : 0.) + A[i][j];
              E[i][j] = A[i][j] + A[j][i];
              for (int k = 0; k < dim; ++k)
                E[i][j] += A[k][i] * A[k][j];
            }
        for (int i = 0; i < dim; ++i)
          trace += E[i][i];
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            D[i][j] = (i == j ? 1. + 0.5 * trace : Number(0.)) - 0.5 * E[i][j];
        if constexpr (dim == 3)
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              D[i][j] += (1. / Number(3.)) * mixed_minors(E, E, i, j, 0.5);
      }

      /** Of cof: weight (X_ac Y_bd + Y_ac X_bd - X_ad Y_bc - Y_ad X_bc), a, b the others of i. */
      static Number
      mixed_minors(const Number (&X)[dim][dim],
                   const Number (&Y)[dim][dim],
                   const int    i,
                   const int    j,
                   const double weight)
      {
        const int a = (i + 1) % dim, b = (i + 2) % dim, c = (j + 1) % dim, d = (j + 2) % dim;
        return weight *
               (X[a][c] * Y[b][d] + Y[a][c] * X[b][d] - X[a][d] * Y[b][c] - Y[a][d] * X[b][c]);
      }

      /** dD/dA_mS. */
      void
      slope(const int m, const int S, Number (&dD)[dim][dim]) const
      {
        Number H[dim][dim]; // dE
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            H[i][j] = (i == S ? F[m][j] : Number(0.)) + (j == S ? F[m][i] : Number(0.));
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              dD[i][j] = (i == j ? F[m][S] : Number(0.)) - 0.5 * H[i][j];
              if constexpr (dim == 3)
                dD[i][j] += (1. / Number(3.)) * mixed_minors(E, H, i, j, 1.);
            }
      }
    };

    /** The rows of momentum and fluid, and their slopes, of points whose flow is known. */
    template <int dim, bool with_tangent, typename Number>
    class MixtureRows
    {
    public:
      using Input = MixtureInput<dim>;

      MixtureRows(const ForceStress<dim, Number>    &stress,
                  const MixtureStep<dim>            &step,
                  const MixtureTrial<dim, Number>   &trial,
                  const RelativeMotion<dim, Number> &flow,
                  MixtureResponse<dim, Number>      &r)
        : stress(stress)
        , step(step)
        , trial(trial)
        , flow(flow)
        , r(r)
        , volume_stress(trial.displacement)
      {}

      void
      fill()
      {
        find_rows();
        find_stabilisation();
        if constexpr (with_tangent)
          {
            const RelativeMotionSlopes<dim, Number> slopes(flow);
            find_pressure_slopes(slopes);
            find_flow_slopes(slopes);
            find_value_slopes(slopes);
          }
      }

    private:
      /** The fluid's stress over -V ph: J_n (I + A/2) 2 D/(1 + det(I + A)). */
      Number
      unit_stress(const int i, const int R) const
      {
        Number sum = 0.;
        for (int Q = 0; Q < dim; ++Q)
          sum += flow.at.middle[i][Q] * volume_stress.D[Q][R];
        return 2. * trial.determinant / (2. + flow.at.growth) * sum;
      }

      void
      find_rows()
      {
        const Number V    = trial.volume;
        const double rho0 = step.soil.fluid.reference_density;
        r.weight_power = r.darcy_power = 0.;
        for (int i = 0; i < dim; ++i)
          {
            const double f = step.acceleration[i];
            for (int R = 0; R < dim; ++R)
              {
                unit[i][R]                = unit_stress(i, R);
                r.momentum_gradient[i][R] = V * (stress.stress[i][R] - flow.pressure * unit[i][R] -
                                                 flow.velocity[i] * flow.flux_n[R]);
              }
            r.momentum_value[i] = V * (Number(2.) / step.dt *
                                         (flow.content.mean * flow.velocity[i] -
                                          flow.content.at_n * trial.fluid_velocity_n[i]) -
                                       flow.content.mean * f);
            r.fluid_gradient[i] = -V * step.dt / rho0 * flow.flux_n[i];
            r.weight_power += flow.content.mean * flow.velocity[i] * f;
            r.darcy_power += flow.content.mean * flow.drive[i] * flow.relative[i];
          }
        r.fluid_value = V / rho0 * flow.content.change;
      }

      void
      find_stabilisation()
      {
        const double rho0    = step.soil.fluid.reference_density;
        Number       kinetic = 0.;
        for (int i = 0; i < dim; ++i)
          kinetic += (trial.velocity[i] - trial.constant_velocity[i]) *
                     (trial.velocity[i] + trial.constant_velocity[i]);
        r.fluctuation         = trial.potential_fluctuation + 0.5 * rho0 * kinetic;
        r.stabilisation_slope = trial.volume * step.soil.stabilisation / step.theta;
        r.stabilisation       = r.stabilisation_slope * (r.fluctuation - trial.fluctuation_n);
        r.end_fluctuation =
          trial.fluctuation_n + (r.fluctuation - trial.fluctuation_n) / step.theta;
      }

      void
      find_pressure_slopes(const RelativeMotionSlopes<dim, Number> &slopes)
      {
        const Number V      = trial.volume;
        const Number factor = 2. * trial.determinant / (2. + flow.at.growth);
        for (int m = 0; m < dim; ++m)
          for (int S = 0; S < dim; ++S)
            {
              Number dD[dim][dim];
              volume_stress.slope(m, S, dD);
              const Number grows =
                (1. + flow.at.growth) / (2. + flow.at.growth) * flow.at.end_inverse[S][m];
              for (int i = 0; i < dim; ++i)
                for (int R = 0; R < dim; ++R)
                  {
                    Number sum = i == m ? 0.5 * volume_stress.D[S][R] : Number(0.);
                    for (int Q = 0; Q < dim; ++Q)
                      sum += flow.at.middle[i][Q] * dD[Q][R];
                    r.momentum_gradient_slope[i][R].of[m * dim + S] =
                      V * (stress.tangent[i][R][m][S] -
                           flow.pressure * (factor * sum - grows * unit[i][R]));
                  }
            }
        for (int i = 0; i < dim; ++i)
          for (int R = 0; R < dim; ++R)
            {
              for (int k = Input::velocity; k < Input::n; ++k)
                r.momentum_gradient_slope[i][R].of[k] = 0.;
              const Number by_pressure = -V * unit[i][R];
              for (int k = 0; k < Input::n; ++k)
                r.momentum_gradient_slope[i][R].of[k] += by_pressure * slopes.pressure.of[k];
            }
      }

      /** Of the flux through configuration n, and what it carries of momentum. */
      void
      find_flow_slopes(const RelativeMotionSlopes<dim, Number> &slopes)
      {
        const Number V    = trial.volume;
        const double rho0 = step.soil.fluid.reference_density;
        for (int R = 0; R < dim; ++R)
          for (int k = 0; k < Input::n; ++k)
            {
              Number flux = 0.;
              for (int i = 0; i < dim; ++i)
                flux += flow.at.inverse[R][i] * (0.5 * slopes.content.of[k] * flow.relative[i] +
                                                 flow.content.mean * slopes.relative[i].of[k]);
              if (k < Input::velocity)
                flux -= 0.5 * flow.at.inverse[R][k / dim] * flow.flux_n[k % dim];
              r.fluid_gradient_slope[R].of[k] = -V * step.dt / rho0 * flux;
              for (int i = 0; i < dim; ++i)
                r.momentum_gradient_slope[i][R].of[k] -=
                  V * (slopes.velocity(i, k) * flow.flux_n[R] + flow.velocity[i] * flux);
            }
      }

      void
      find_value_slopes(const RelativeMotionSlopes<dim, Number> &slopes)
      {
        const Number V    = trial.volume;
        const double rho0 = step.soil.fluid.reference_density;
        for (int k = 0; k < Input::n; ++k)
          {
            r.fluid_value_slope.of[k] = V / rho0 * slopes.content.of[k];
            for (int i = 0; i < dim; ++i)
              r.momentum_value_slope[i].of[k] =
                V * (Number(2.) / step.dt *
                       (0.5 * slopes.content.of[k] * flow.velocity[i] +
                        flow.content.mean * slopes.velocity(i, k)) -
                     0.5 * slopes.content.of[k] * step.acceleration[i]);
          }
      }

      const ForceStress<dim, Number>    &stress;
      const MixtureStep<dim>            &step;
      const MixtureTrial<dim, Number>   &trial;
      const RelativeMotion<dim, Number> &flow;
      MixtureResponse<dim, Number>      &r;
      const VolumeStress<dim, Number>    volume_stress;
      Number                             unit[dim][dim];
    };
  } // namespace internal



  /**
   * The responses of points, of the conserving stress of the skeleton at the displacement A; its
   * tangent is read if with_tangent. It knows no material and no nodes.
   */
  template <int dim, bool with_tangent, typename Number>
  inline void
  evaluate_mixture_response(const ForceStress<dim, Number>  &stress,
                            const MixtureStep<dim>          &step,
                            const MixtureTrial<dim, Number> &trial,
                            MixtureResponse<dim, Number>    &r)
  {
    RelativeMotion<dim, Number> flow(step, trial);
    r.has_stress = stress.valid;
    r.valid      = stress.valid && flow.is_possible();
    if (!any(r.valid))
      return;
    r.valid = r.valid && flow.solve();
    internal::MixtureRows<dim, with_tangent, Number>(stress, step, trial, flow, r).fill();
    r.end_determinant = trial.determinant * (1. + flow.at.growth);
    r.pressure        = flow.pressure;
    r.end_pressure    = flow.end_pressure;
    r.end_content     = flow.content.end;
    const Number n    = 1. - (1. - step.soil.fluid.initial_porosity) / flow.at.middle_determinant;
    for (int i = 0; i < dim; ++i)
      {
        r.end_fluid_velocity[i] = (2. * flow.content.mean * flow.velocity[i] -
                                   flow.content.at_n * trial.fluid_velocity_n[i]) /
                                  flow.content.end;
        r.darcy_velocity[i] = n * flow.relative[i];
        r.relative[i]       = flow.relative[i];
      }
  }
} // namespace kedge

#endif
