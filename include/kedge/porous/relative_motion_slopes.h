#ifndef kedge_porous_relative_motion_slopes_h
#define kedge_porous_relative_motion_slopes_h

#include <kedge/porous/relative_motion.h>

namespace kedge
{
  /** The slopes of a RelativeMotion that has been found, by the inputs of a MixtureTrial. */
  template <int dim, typename Number>
  class RelativeMotionSlopes
  {
  public:
    using Input  = MixtureInput<dim>;
    using Slopes = MixtureSlopes<dim, Number>;

    explicit RelativeMotionSlopes(const RelativeMotion<dim, Number> &flow)
      : flow(flow)
    {
      const PoreFluid &fluid = flow.step.soil.fluid;
      end_density            = flow.content.end / flow.at.end_pores;
      mobility_slope         = internal::of_each(flow.porosity, [&](const double n) {
        return (fluid.mass_mobility_slope(n) - fluid.mass_mobility(n) / n) / n;
      });
      Number       along     = 0.;
      const Number factor =
        flow.mobility / flow.step.dt * flow.content.at_n / (flow.content.mean * flow.content.mean);
      for (int i = 0; i < dim; ++i)
        by_content[i] = factor * (flow.trial.velocity[i] - flow.trial.fluid_velocity_n[i] +
                                  0.5 * flow.relative[i]);
      multiply_by_inverse(by_content);
      for (int i = 0; i < dim; ++i)
        {
          by_relative[i] = flow.content.at_n / flow.content.end *
                           (flow.velocity[i] - flow.trial.fluid_velocity_n[i]);
          along += by_relative[i] * by_content[i];
        }
      const Number stiffness = BernoulliGap<Number>(flow.density_growth).slope;
      const Number beta      = flow.density_n / fluid.bulk_modulus;
      by_source       = beta / (stiffness + beta * (flow.kinetic - flow.content.end * along));
      pressure_growth = fluid.bulk_modulus * stiffness;
      differentiate_by_displacement();
      differentiate_by_others();
    }

    /** d vh_i by input k. */
    Number
    velocity(const int i, const int k) const
    {
      return relative[i].of[k] + (k == Input::velocity + i ? 1. : 0.);
    }

    Slopes relative[dim], content, pressure; ///< of w, m_{n+1}, ph

  private:
    void
    multiply_by_inverse(Number (&x)[dim]) const
    {
      Number y[dim];
      for (int i = 0; i < dim; ++i)
        {
          y[i] = 0.;
          for (int j = 0; j < dim; ++j)
            y[i] += flow.C_inverse[i][j] * x[j];
        }
      for (int i = 0; i < dim; ++i)
        x[i] = y[i];
    }

    /**
     * Slopes by input k from what it does to the right sides of the two equations.
     *
     * @param right  of C w, changed
     * @param source of rho_0 mu/rho_0 without w
     * @param pores  d phi_{n+1}
     */
    void
    set_slopes(const int k, Number (&right)[dim], const Number &source, const Number &pores)
    {
      multiply_by_inverse(right);
      Number sum = source - flow.kinetic / flow.content.end * end_density * pores;
      for (int i = 0; i < dim; ++i)
        sum += by_relative[i] * right[i];
      const Number growth_slope = by_source * sum;
      content.of[k]             = end_density * pores + flow.content.end * growth_slope;
      pressure.of[k]            = pressure_growth * growth_slope;
      for (int i = 0; i < dim; ++i)
        relative[i].of[k] = right[i] + by_content[i] * (flow.content.end * growth_slope);
    }

    void
    differentiate_by_displacement()
    {
      const Number end_determinant = flow.trial.determinant * (1. + flow.at.growth);
      const Number by_porosity     = 0.5 * (1. - flow.porosity) * mobility_slope;
      Number       carried[dim], pulled[dim];
      for (int i = 0; i < dim; ++i)
        {
          pulled[i]  = flow.trial.velocity[i] / flow.step.dt - 0.5 * flow.gradient[i];
          carried[i] = 0.;
          for (int j = 0; j < dim; ++j)
            carried[i] += flow.at.inverse[i][j] * flow.relative[j] / flow.step.dt;
        }
      for (int m = 0; m < dim; ++m)
        for (int S = 0; S < dim; ++S)
          {
            const Number pores = end_determinant * flow.at.end_inverse[S][m];
            Number       right[dim];
            for (int i = 0; i < dim; ++i)
              right[i] = by_porosity * flow.at.inverse[S][m] * flow.drive[i] -
                         flow.mobility *
                           (flow.at.inverse[S][i] * pulled[m] + flow.at.inverse[i][m] * carried[S]);
            add_content(end_density * pores, right);
            set_slopes(m * dim + S, right, 0., pores);
          }
    }

    /** A content that grows by itself changes the flow; see by_content. */
    void
    add_content(const Number &change, Number (&right)[dim]) const
    {
      const Number factor = flow.mobility / flow.step.dt * flow.content.at_n /
                            (flow.content.mean * flow.content.mean) * change;
      for (int i = 0; i < dim; ++i)
        right[i] += factor * (flow.trial.velocity[i] - flow.trial.fluid_velocity_n[i] +
                              0.5 * flow.relative[i]);
    }

    void
    differentiate_by_others()
    {
      const double rho0 = flow.step.soil.fluid.reference_density;
      Number       right[dim];
      for (int m = 0; m < dim; ++m)
        {
          for (int i = 0; i < dim; ++i)
            {
              Number sum = i == m ? 2. * flow.content.at_n / flow.content.mean : Number(0.);
              for (int R = 0; R < dim; ++R)
                sum += flow.at.inverse[R][i] * flow.trial.displacement[m][R];
              right[i] = -flow.mobility / flow.step.dt * sum;
            }
          set_slopes(Input::velocity + m, right, flow.trial.velocity[m] + by_relative[m], 0.);
          for (int i = 0; i < dim; ++i)
            right[i] = -flow.mobility / rho0 * flow.at.inverse[m][i];
          set_slopes(Input::gradient + m, right, 0., 0.);
        }
      for (int i = 0; i < dim; ++i)
        right[i] = 0.;
      set_slopes(Input::potential, right, 1. / rho0, 0.);
    }

    const RelativeMotion<dim, Number> &flow;

    Number end_density, mobility_slope, pressure_growth;
    Number by_content[dim];  ///< dw/dm_{n+1}
    Number by_relative[dim]; ///< dc/dw [m/s]
    Number by_source;        ///< d d/d mu [s^2/m^2]
  };
} // namespace kedge

#endif
