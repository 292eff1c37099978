// Modified Cam Clay that hardens: against the conditions that define the
// return, and its slopes against differences of 113-bit evaluations.
#include <kedge/base/pack.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace kedge
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;
} // namespace kedge

#include "plastic_checks.h"

#include <kedge/materials/modified_cam_clay.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  /** p_r = 1, kappa 0.01 and lambda 0.1 by logarithmic strain, M 1, G 50. */
  ModifiedCamClay
  clay()
  {
    MaterialParameters parameters;
    parameters.young_modulus                   = 100.;
    parameters.poisson_ratio                   = 0.;
    parameters.swelling_slope                  = 0.02;
    parameters.compression_slope               = 0.2;
    parameters.initial_void_ratio              = 1.;
    parameters.critical_state_ratio            = 1.;
    parameters.reference_pressure              = 1.;
    parameters.start_preconsolidation_pressure = 2.;
    return ModifiedCamClay(parameters);
  }

  using Step = PrincipalStep<ModifiedCamClay>;

  template <typename Check>
  void
  for_random_steps(const Check &check)
  {
    std::mt19937                           generator(17);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const ModifiedCamClay                  law       = clay();
    int                                    n_plastic = 0, n_steps = 0;
    for (const double size : {0.002, 0.02})
      for (int repeat = 0; repeat < 100; ++repeat)
        {
          Step step;
          step.history        = {0.1, -0.1, 1. + 0.6 * uniform(generator)};
          const double volume = -0.01 * std::log(2.) * (1. + 0.5 * uniform(generator));
          for (int i = 0; i < 3; ++i)
            {
              // p of about half p_c, less to more
              step.strain[i]    = volume * -0.3 + 1e-3 * uniform(generator);
              step.increment[i] = size * (uniform(generator) - 0.2);
            }
          const auto response = law.respond(step.strain, step.increment, step.history);
          ASSERT_TRUE(response.valid);
          check(law, step, response);
          n_plastic += response.plastic_shear > 0.;
          ++n_steps;
        }
    EXPECT_GT(n_plastic, 0.5 * n_steps);
    EXPECT_LT(n_plastic, 0.98 * n_steps);
  }

  struct Invariants
  {
    double p, q;

    explicit Invariants(const double (&tau)[3])
      : p(-(tau[0] + tau[1] + tau[2]) / 3.)
      , q(std::sqrt(1.5) * deviator_norm(tau))
    {}
  };
} // namespace

TEST(MaterialsModifiedCamClay, EndsOnTheSurfaceThatHasHardened)
{
  for_random_steps([](const ModifiedCamClay &law, const Step &step, const auto &r) {
    const Invariants at(r.kirchhoff_stress);
    const auto       end      = law.updated(r, step.history);
    const double     p_c      = end.preconsolidation_pressure;
    const double     f        = at.q * at.q + at.p * (at.p - p_c);
    const double     rounding = 1e-12 * (1. + p_c * p_c); // the strain's over kappa
    EXPECT_LE(f, rounding);
    // p_c hardens by the plastic change of volume, lambda - kappa = 0.09
    EXPECT_NEAR(p_c / step.history.preconsolidation_pressure,
                std::exp(-(end.plastic_volume_strain - step.history.plastic_volume_strain) / 0.09),
                1e-13);
    EXPECT_GE(r.dissipation, 0.);
    if (r.plastic_shear == 0.)
      return;
    EXPECT_NEAR(f, 0., rounding);
    // associated: d eps_v^p / d eps_s^p = (2 p - p_c)/(2 q/M^2)
    EXPECT_NEAR(r.plastic_volume * 2. * at.q,
                r.plastic_shear * (2. * at.p - p_c),
                1e-13 * (1. + p_c));
    // what the elastic law says of the strain that is left
    double volume = 0.;
    for (int i = 0; i < 3; ++i)
      volume -= step.strain[i] + step.increment[i] - law.plastic_increment(r, i);
    EXPECT_NEAR(at.p, std::exp(volume / 0.01), 1e-12 * at.p);
    // D >= L (2 (p - p_c/2)^2 + 2 q^2/M^2), L from the shear
    const double L = r.plastic_shear / (2. * at.q);
    EXPECT_GE(r.dissipation * (1. + 1e-9) + 1e-15,
              L * (2. * std::pow(at.p - 0.5 * p_c, 2) + 2. * at.q * at.q));
  });
}

TEST(MaterialsModifiedCamClay, LanesAnswerAsPointsDo)
{
  std::vector<Step> steps;
  for_random_steps([&](const auto &, const auto &step, const auto &) {
    steps.push_back(step);
  });
  expect_lanes_alike(clay(), steps, 1e-11); // strains' round-off over kappa
}

TEST(MaterialsModifiedCamClay, SlopesAreThoseOf113BitDifferences)
{
  for_random_steps([](const ModifiedCamClay &law, const Step &step, const auto &r) {
    // stresses of order 1 to 10, moduli p/kappa of order 100 to 1000
    const double stress = 1. + Invariants(r.kirchhoff_stress).p, modulus = stress / 0.01;
    const Quad   h = 1e-10;
    for (int j = 0; j < 3; ++j)
      {
        const auto plus  = respond_exactly(law, step, j, h),
                   minus = respond_exactly(law, step, j, -h);
        EXPECT_NEAR(law.work_slope(r, j),
                    static_cast<double>((plus.work_increment - minus.work_increment) / (2 * h)),
                    1e-9 * stress);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(law.tangent(r, i, j),
                      static_cast<double>((plus.kirchhoff_stress[i] - minus.kirchhoff_stress[i]) /
                                          (2 * h)),
                      1e-9 * modulus);
      }
  });
}

TEST(MaterialsModifiedCamClay, WorkIsStoredOrDissipated)
{
  for_random_steps([](const ModifiedCamClay &law, const Step &step, const auto &r) {
    double end[3];
    for (int i = 0; i < 3; ++i)
      end[i] = step.strain[i] + step.increment[i] - law.plastic_increment(r, i);
    const auto   history = law.updated(r, step.history);
    const double growth  = law.energy(end, history) - law.energy(step.strain, step.history) +
                          law.hardening_energy(history) - law.hardening_energy(step.history);
    // energies of order kappa p and (lambda - kappa) p_c/2
    EXPECT_NEAR(r.work_increment, growth + r.dissipation, 1e-14 * (1. + law.energy(end, history)));
  });
}

TEST(MaterialsModifiedCamClay, VirginCompressionFollowsLambda)
{
  // isotropic from p_c = p_r to 2 p_r: eps_v = lambda ln 2 = .0693147
  const ModifiedCamClay law        = clay();
  const double          nothing[3] = {0., 0., 0.}, third = -0.1 * std::log(2.) / 3.;
  const double          strain[3] = {third, third, third};
  const auto            r         = law.respond(nothing, strain, {0., 0., 1.});
  ASSERT_TRUE(r.valid);
  EXPECT_NEAR(r.preconsolidation, 2., 1e-12);
  EXPECT_NEAR(Invariants(r.kirchhoff_stress).p, 2., 1e-12);
  // the modulus is p/lambda then
  double sum = 0.;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum += law.tangent(r, i, j) / 9.;
  EXPECT_NEAR(sum, 20., 1e-9);
}
