// The response of a saturated point in the conserving scheme: its balance of energy, in doubles and
// in 113 bits, and its slopes against differences.
#include <kedge/porous/mixture_response.h>

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <random>

using namespace kedge;

namespace
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;

  Soil
  soil(const double bulk_modulus, const double conductivity, const bool kozeny_carman)
  {
    PoreFluidParameters parameters;
    parameters.initial_porosity       = 0.4;
    parameters.fluid_density          = 1000.;
    parameters.fluid_bulk_modulus     = bulk_modulus;
    parameters.hydraulic_conductivity = conductivity;
    parameters.kozeny_carman          = kozeny_carman;
    parameters.reference_gravity      = 10.;
    return {PoreFluid(parameters), 2500., 3e-7, true};
  }

  /** Numbers of a point far from rest: strains of .2, velocities of 10 m/s. */
  template <int dim>
  struct RandomPoint
  {
    RandomPoint(const unsigned int seed, const double dt)
      : generator(seed)
      , dt(dt)
    {}

    template <typename Number>
    MixtureTrial<dim, Number>
    draw()
    {
      MixtureTrial<dim, Number> t;
      t.volume        = 0.3;
      t.determinant   = 1. + 0.1 * number();
      t.pressure_n    = 1e5 * number();
      t.fluctuation_n = 1e3 * number();
      double kinetic  = 0.;
      for (int i = 0; i < dim; ++i)
        {
          t.fluid_velocity_n[i]   = 10. * number();
          const double velocity   = 10. * number();
          t.velocity[i]           = velocity;
          t.constant_velocity[i]  = velocity + number();
          t.potential_gradient[i] = 1e5 * number();
          kinetic += velocity * velocity;
          for (int j = 0; j < dim; ++j)
            t.displacement[i][j] = 0.2 * number();
        }
      t.potential             = 1e5 * number() - 1000. * kinetic;
      t.potential_fluctuation = 2e4 * number();
      return t;
    }

    double
    number()
    {
      return uniform(generator);
    }

    std::mt19937                           generator;
    std::uniform_real_distribution<double> uniform{-1., 1.};
    const double                           dt;
  };

  template <int dim>
  MixtureStep<dim>
  step_of(const Soil &soil, const double dt)
  {
    MixtureStep<dim> step{soil, dt, 0.55, {}};
    for (int d = 0; d < dim; ++d)
      step.acceleration[d] = 3. - 5. * d;
    return step;
  }

  template <int dim, typename Number>
  ForceStress<dim, Number>
  no_stress()
  {
    ForceStress<dim, Number> stress;
    for (int i = 0; i < dim; ++i)
      for (int R = 0; R < dim; ++R)
        {
          stress.stress[i][R] = 0.;
          for (int m = 0; m < dim; ++m)
            for (int S = 0; S < dim; ++S)
              stress.tangent[i][R][m][S] = 0.;
        }
    stress.valid = Number(0.) <= Number(0.);
    return stress;
  }

  /** The work of the residual on the motion less what is stored, lost and supplied, over the sum of
   * all sizes. The energy per mass is K/rho_0 (1 - (1 + x) exp(-x)), x = p/K, (4.112). */
  template <int dim, typename Number>
  Number
  energy_error(const MixtureStep<dim> &step, const MixtureTrial<dim, Number> &t)
  {
    using std::abs;
    using std::exp;
    using std::expm1;
    MixtureResponse<dim, Number> r;
    evaluate_mixture_response<dim, false>(no_stress<dim, Number>(), step, t, r);
    EXPECT_TRUE(r.valid);
    const PoreFluid &fluid = step.soil.fluid;
    const double     rho0 = fluid.reference_density, K = fluid.bulk_modulus;
    const auto       stored = [&](const Number &content, const Number &p) -> Number {
      const Number x = p / K;
      return content * K / rho0 * (-expm1(-x) - x * exp(-x));
    };
    const double grains    = 1. - fluid.initial_porosity;
    const Number content_n = (t.determinant - grains) * rho0 * exp(t.pressure_n / K);
    Number       sum = 0., size = 0.;
    const auto   add = [&](const Number &x) {
      sum += x;
      size += abs(x);
    };
    for (int i = 0; i < dim; ++i)
      {
        for (int R = 0; R < dim; ++R)
          add(r.momentum_gradient[i][R] * t.displacement[i][R]);
        add(step.dt * r.momentum_value[i] * t.velocity[i]);
        add(r.fluid_gradient[i] * t.potential_gradient[i]);
        add(-0.5 * t.volume * r.end_content * r.end_fluid_velocity[i] * r.end_fluid_velocity[i]);
        add(0.5 * t.volume * content_n * t.fluid_velocity_n[i] * t.fluid_velocity_n[i]);
        add(r.stabilisation * 0.5 * rho0 *
            (t.velocity[i] * t.velocity[i] - t.constant_velocity[i] * t.constant_velocity[i]));
      }
    add(r.fluid_value * t.potential);
    add(-t.volume * stored(r.end_content, r.end_pressure));
    add(t.volume * stored(content_n, t.pressure_n));
    add(-t.volume * step.dt * r.darcy_power);
    add(t.volume * step.dt * r.weight_power);
    // of the stabilisation: tau f^2/2 stored, (theta - 1/2) tau (df)^2 lost
    const Number stiffness = t.volume * step.soil.stabilisation;
    const Number change    = r.end_fluctuation - t.fluctuation_n;
    add(r.stabilisation * t.potential_fluctuation);
    add(-0.5 * stiffness * r.end_fluctuation * r.end_fluctuation);
    add(0.5 * stiffness * t.fluctuation_n * t.fluctuation_n);
    add(-(step.theta - 0.5) * stiffness * change * change);
    EXPECT_GE(r.darcy_power, 0.);
    return abs(sum) / size;
  }

  template <int dim, typename Number>
  double
  worst_energy_error(const double conductivity)
  {
    double worst = 0.;
    for (const double bulk_modulus : {1e7, 2.2e9, 1e12})
      for (const double dt : {1e-5, 1e-3, 1e-1})
        for (unsigned int seed = 1; seed < 6; ++seed)
          {
            const Soil       s    = soil(bulk_modulus, conductivity, conductivity > 1e-3);
            const auto       step = step_of<dim>(s, dt);
            RandomPoint<dim> random(seed, dt);
            worst = std::max(worst,
                             static_cast<double>(
                               energy_error<dim, Number>(step, random.template draw<Number>())));
          }
    return worst;
  }

  /** The inputs one after the other, as MixtureInput counts them. */
  template <int dim>
  Pack *
  inputs(MixtureTrial<dim, Pack> &t, const int k)
  {
    using Input = MixtureInput<dim>;
    if (k < Input::velocity)
      return &t.displacement[k / dim][k % dim];
    if (k < Input::potential)
      return &t.velocity[k - Input::velocity];
    return k == Input::potential ? &t.potential : &t.potential_gradient[k - Input::gradient];
  }

  /** All outputs and the slopes of each by input k. */
  template <int dim>
  std::vector<std::pair<double, double>>
  outputs(const MixtureResponse<dim, Pack> &r, const int k)
  {
    std::vector<std::pair<double, double>> result;
    for (int i = 0; i < dim; ++i)
      {
        for (int R = 0; R < dim; ++R)
          result.push_back(
            {r.momentum_gradient[i][R][0], r.momentum_gradient_slope[i][R].of[k][0]});
        result.push_back({r.momentum_value[i][0], r.momentum_value_slope[i].of[k][0]});
        result.push_back({r.fluid_gradient[i][0], r.fluid_gradient_slope[i].of[k][0]});
      }
    result.push_back({r.fluid_value[0], r.fluid_value_slope.of[k][0]});
    return result;
  }

  template <int dim>
  double
  worst_slope_error(const double conductivity, const double dt)
  {
    const Soil       s    = soil(2.2e9, conductivity, true);
    const auto       step = step_of<dim>(s, dt);
    RandomPoint<dim> random(7, dt);
    const auto       trial  = random.template draw<Pack>();
    const auto       stress = no_stress<dim, Pack>();
    double           worst  = 0.;
    for (int k = 0; k < MixtureInput<dim>::n; ++k)
      {
        const double width = k < MixtureInput<dim>::velocity    ? 1e-5
                             : k < MixtureInput<dim>::potential ? 1e-3
                                                                : 1e3;
        const auto   at    = [&](const double shift) {
          MixtureTrial<dim, Pack> moved = trial;
          *inputs(moved, k) += shift;
          MixtureResponse<dim, Pack> r;
          evaluate_mixture_response<dim, true>(stress, step, moved, r);
          return outputs<dim>(r, k);
        };
        const auto here = at(0.), ahead = at(width), behind = at(-width), ahead_2 = at(2. * width),
                   behind_2 = at(-2. * width);
        for (std::size_t o = 0; o < here.size(); ++o)
          {
            const double slope =
              (8. * (ahead[o].first - behind[o].first) - (ahead_2[o].first - behind_2[o].first)) /
              (12. * width);
            const double size = std::abs(here[o].second) + 1e-6 * std::abs(here[o].first) / width;
            worst             = std::max(worst, std::abs(slope - here[o].second) / size);
          }
      }
    return worst;
  }
} // namespace

// Expected: the work of the residuals is what is stored, lost and supplied, exactly
// (theory_mixture.md 4). Tolerance: round-off of sums of 20 terms; of 113 bits what the series of
// Bernoulli's function leave.
TEST(MixtureResponse, WorkIsStoredLostOrSupplied)
{
  for (const double conductivity : {0., 1e-12, 1e-4, 1e-1})
    {
      EXPECT_LT((worst_energy_error<2, double>(conductivity)), 2e-14) << conductivity;
      EXPECT_LT((worst_energy_error<3, double>(conductivity)), 2e-14) << conductivity;
      EXPECT_LT((worst_energy_error<2, Quad>(conductivity)), 1e-21) << conductivity;
      EXPECT_LT((worst_energy_error<3, Quad>(conductivity)), 1e-21) << conductivity;
    }
}

// Expected: central differences of fourth order; their round-off is 1e-16 over 1e-5 of the inputs.
TEST(MixtureResponse, SlopesAreThoseOfTheResponse)
{
  for (const double conductivity : {0., 1e-6, 1e-3, 1e-1})
    for (const double dt : {1e-4, 1e-2})
      {
        EXPECT_LT(worst_slope_error<2>(conductivity, dt), 1e-7) << conductivity << " " << dt;
        EXPECT_LT(worst_slope_error<3>(conductivity, dt), 1e-7) << conductivity << " " << dt;
      }
}
