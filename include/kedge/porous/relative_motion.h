#ifndef kedge_porous_relative_motion_h
#define kedge_porous_relative_motion_h

#include <kedge/base/bernoulli.h>
#include <kedge/porous/gradient_inverse.h>
#include <kedge/porous/mixture_trial.h>

namespace kedge
{
  /** The motion of a point's skeleton in a step. */
  template <int dim, typename Number>
  struct MixtureKinematics
  {
    MixtureKinematics(const MixtureTrial<dim, Number> &trial, const double grains)
      : grains(grains)
    {
      const Number excess = internal::invert_gradient<dim>(trial.displacement, 0.5, inverse);
      growth              = internal::invert_gradient<dim>(trial.displacement, 1., end_inverse);
      middle_determinant  = trial.determinant * (1. + excess);
      pores_n             = trial.determinant - grains;
      end_pores           = trial.determinant * (1. + growth) - grains;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          middle[i][j] = (i == j ? 1. : 0.) + 0.5 * trial.displacement[i][j];
    }

    double grains;                ///< 1 - n_0
    Number growth;                ///< det(I + A) - 1
    Number middle_determinant;    ///< J at the middle
    Number middle[dim][dim];      ///< I + A/2
    Number inverse[dim][dim];     ///< G = (I + A/2)^-1
    Number end_inverse[dim][dim]; ///< (I + A)^-1
    Number pores_n, end_pores;    ///< phi = J - (1 - n_0)
  };

  /** Fluid per V0 [kg/m^3]. */
  template <typename Number>
  struct FluidContent
  {
    Number at_n, end;    ///< m_n, m_{n+1}
    Number change, mean; ///< dm, mb
  };

  /**
   * The fluid of a point in a trial state of the conserving balance: its pressure, its content and
   * its velocity beside the skeleton's, from the local equations (theory_mixture.md 3)
   *   C w = b (f - a - grad mu),           1 - B(d) = rho_n (mu - mu_n)/K,
   *   C = [1 + b 2/dt (1 - dm/(4 mb))] I + b A G/dt,   a = 2/dt m_n/mb (U - v_fn),
   * found in turn: each depends weakly on the other.
   */
  template <int dim, typename Number>
  class RelativeMotion
  {
  public:
    RelativeMotion(const MixtureStep<dim> &step, const MixtureTrial<dim, Number> &trial)
      : step(step)
      , trial(trial)
      , at(trial, 1. - step.soil.fluid.initial_porosity)
    {}

    /** Whether a solution can be looked for: volumes and pores are left. */
    Condition<Number>
    is_possible() const
    {
      return at.growth > -1. && at.middle_determinant > at.grains && at.end_pores > 0. &&
             at.pores_n > 0.;
    }

    /** @return where it was found */
    Condition<Number>
    solve()
    {
      using std::abs;
      prepare();
      const double tolerance = negligible_change<Number>();
      Number       change    = 0., last;
      for (int k = 0; k < most_iterations; ++k)
        {
          last   = change;
          change = density_growth;
          iterate();
          change = abs(density_growth - change);
          // until nothing changes, or round-off alone
          if (k > 1 && !any(change > tolerance * abs(density_growth) && change < last))
            break;
        }
      finish();
      return change <= loose_tolerance * abs(density_growth) + negligible_growth &&
             gap < largest_gap && density_growth > -largest_thinning;
    }

    const MixtureStep<dim>              &step;
    const MixtureTrial<dim, Number>     &trial;
    const MixtureKinematics<dim, Number> at;

    FluidContent<Number> content;
    Number               density_growth;         ///< d = ln rho_{n+1}/rho_n
    Number               pressure, end_pressure; ///< ph, p_{n+1} [Pa]
    Number               relative[dim];          ///< w of the fluid against the skeleton [m/s]
    Number               drive[dim];             ///< w/b, finite for b = 0 [m/s^2]
    Number               velocity[dim];          ///< vh = U + w [m/s]
    Number               flux_n[dim];            ///< G mb w, through configuration n

    // what the equations consist of
    Number density_n, porosity, mobility; ///< mobility b = kappa/(g n) [s]
    Number gradient[dim];                 ///< grad mu at the middle [m/s^2]
    Number rate[dim][dim];                ///< A G/dt [1/s]
    Number potential_gap;                 ///< rho_0 (mu - mu_n) but for the kinetic part [Pa]
    Number kinetic;                       ///< c [m^2/s^2]
    Number gap;                           ///< 1 - B(d)
    Number C_inverse[dim][dim];

  private:
    static constexpr int    most_iterations   = 30;
    static constexpr double negligible_growth = 1e-12;
    static constexpr double loose_tolerance   = 1e-9;
    static constexpr double largest_gap       = 0.9; ///< of the inverse: the density times 37
    static constexpr double largest_thinning  = 20.; ///< the density over e^20

    /** What the iteration does not change. */
    void
    prepare()
    {
      using std::exp;
      const PoreFluid &fluid = step.soil.fluid;
      density_n              = fluid.reference_density * exp(trial.pressure_n / fluid.bulk_modulus);
      content.at_n           = at.pores_n * density_n;
      porosity               = 1. - at.grains / at.middle_determinant;
      mobility               = internal::of_each(porosity, [&](const double n) {
        return fluid.mass_mobility(n) / n;
      });
      Number pull[dim]; // grad mu by x_n
      for (int i = 0; i < dim; ++i)
        {
          pull[i] = trial.potential_gradient[i] / fluid.reference_density;
          for (int j = 0; j < dim; ++j)
            pull[i] += trial.displacement[j][i] * trial.velocity[j] / step.dt;
        }
      Number square = 0.;
      for (int i = 0; i < dim; ++i)
        {
          gradient[i] = 0.;
          for (int R = 0; R < dim; ++R)
            gradient[i] += at.inverse[R][i] * pull[R];
          square += trial.velocity[i] * trial.velocity[i];
          for (int j = 0; j < dim; ++j)
            {
              rate[i][j] = 0.;
              for (int k = 0; k < dim; ++k)
                rate[i][j] += trial.displacement[i][k] * at.inverse[k][j] / step.dt;
            }
        }
      // rho_0 mu_n = K (1 - exp(-p/K)), without cancellation
      using std::expm1;
      potential_gap = trial.potential + 0.5 * fluid.reference_density * square +
                      fluid.bulk_modulus * expm1(-trial.pressure_n / fluid.bulk_modulus);
      content.end    = at.end_pores * density_n;
      density_growth = 0.;
      change_content();
    }

    void
    change_content()
    {
      using std::expm1;
      const Number densified   = expm1(density_growth); // rho_{n+1}/rho_n - 1
      const Number end_density = density_n + density_n * densified;
      content.end              = at.end_pores * end_density;
      content.change =
        end_density * (trial.determinant * at.growth) + at.pores_n * density_n * densified;
      content.mean = content.at_n + 0.5 * content.change;
    }

    /** w of the present content, then the content of that w. */
    void
    iterate()
    {
      const PoreFluid &fluid   = step.soil.fluid;
      const Number     share   = content.at_n / content.mean;
      const Number     slowing = Number(2.) / step.dt * (1. - content.change / (4. * content.mean));
      Number           C[dim][dim], right[dim];
      for (int i = 0; i < dim; ++i)
        {
          right[i] = step.acceleration[i] - gradient[i] -
                     Number(2.) / step.dt * share * (trial.velocity[i] - trial.fluid_velocity_n[i]);
          for (int j = 0; j < dim; ++j)
            C[i][j] = mobility * rate[i][j] + (i == j ? mobility * slowing : Number(0.));
        }
      internal::invert_gradient<dim>(C, 1., C_inverse); // of I + C
      Number square = 0.;
      for (int i = 0; i < dim; ++i)
        {
          drive[i] = 0.;
          for (int j = 0; j < dim; ++j)
            drive[i] += C_inverse[i][j] * right[j];
          relative[i]         = mobility * drive[i];
          velocity[i]         = trial.velocity[i] + relative[i];
          const Number change = velocity[i] - trial.fluid_velocity_n[i];
          square += change * change;
        }
      kinetic = 0.5 * content.at_n / content.end * square;
      gap = density_n / fluid.bulk_modulus * (potential_gap / fluid.reference_density + kinetic);
      density_growth = invert_bernoulli_gap(select(gap < largest_gap, gap, Number(largest_gap)));
      pressure       = trial.pressure_n + fluid.bulk_modulus * gap;
      change_content();
    }

    void
    finish()
    {
      end_pressure = trial.pressure_n + step.soil.fluid.bulk_modulus * density_growth;
      for (int R = 0; R < dim; ++R)
        {
          flux_n[R] = 0.;
          for (int i = 0; i < dim; ++i)
            flux_n[R] += at.inverse[R][i] * content.mean * relative[i];
        }
    }
  };
} // namespace kedge

#endif
