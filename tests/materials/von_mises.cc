// Von Mises' return map in principal axes: against the conditions that define
// it, and its slopes against differences of 113-bit evaluations.
#include <kedge/materials/material.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace kedge;

namespace
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;

  constexpr double yield_stress = 0.2;

  VonMises
  metal(const double hardening)
  {
    MaterialParameters parameters;
    parameters.kind              = MaterialKind::von_mises;
    parameters.young_modulus     = 2.6; // G = 1
    parameters.poisson_ratio     = 0.3;
    parameters.yield_stress      = yield_stress;
    parameters.hardening_modulus = hardening;
    return VonMises(parameters);
  }

  struct Step
  {
    double                    strain[3], increment[3];
    VonMises::History<double> history;
  };

  /** Random steps from admissible states; about half of them yield. */
  template <typename Check>
  void
  for_random_steps(const Check &check)
  {
    std::mt19937                           generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int                                    n_plastic = 0, n_steps = 0;
    for (const double hardening : {0., 0.05, 2.})
      for (int repeat = 0; repeat < 60; ++repeat)
        {
          const VonMises material = metal(hardening);
          Step           step;
          step.history = {0.1 * (1. + uniform(generator)), yield_stress};
          double deviator[3], volume = 0., square = 0.;
          for (double &e : deviator)
            {
              e = uniform(generator);
              volume += e / 3.;
            }
          for (double &e : deviator)
            {
              e -= volume;
              square += e * e;
            }
          const double fraction = 0.5 * (1. + uniform(generator)); // of the yield radius
          const double factor   = fraction * material.radius(step.history) /
                                (2. * material.elastic.shear_modulus * std::sqrt(square));
          for (int i = 0; i < 3; ++i)
            {
              step.strain[i]    = factor * deviator[i] + 0.1 * volume;
              step.increment[i] = 0.15 * uniform(generator);
            }
          const auto response = material.respond(step.strain, step.increment, step.history);
          check(material, step, response);
          n_plastic += response.plastic_multiplier > 0.;
          ++n_steps;
        }
    EXPECT_GT(n_plastic, 0.3 * n_steps);
    EXPECT_LT(n_plastic, 0.9 * n_steps);
  }

  double
  pressure(const double (&stress)[3])
  {
    return (stress[0] + stress[1] + stress[2]) / 3.;
  }

  /** |s| of principal stresses. */
  double
  deviator_norm(const double (&stress)[3])
  {
    double square = 0.;
    for (const double principal : stress)
      square += (principal - pressure(stress)) * (principal - pressure(stress));
    return std::sqrt(square);
  }

  /** All of a step in 113 bits, the plastic multiplier being the root of f = 0 found by Newton. */
  struct Reference
  {
    Quad stress[3], elastic_energy, hardening_energy, dissipation;

    Reference(const VonMises &material, const Quad (&trial_strain)[3], const Quad alpha_n)
    {
      const Quad G = material.elastic.shear_modulus, K = material.elastic.bulk_modulus,
                 H = material.hardening_modulus, sigma_y = yield_stress;
      const Quad volume = trial_strain[0] + trial_strain[1] + trial_strain[2];
      Quad       norm   = 0;
      for (const Quad &strain : trial_strain)
        norm += (strain - volume / 3) * (strain - volume / 3);
      norm = sqrt(norm); // of the trial strain's deviator

      const Quad root  = sqrt(Quad(2) / 3);
      Quad       gamma = 0;
      const auto f     = [&]() {
        return 2 * G * (norm - gamma) - root * (sigma_y + H * (alpha_n + root * gamma));
      };
      if (f() > 0)
        for (int k = 0; k < 3; ++k)
          gamma += f() / (2 * G + 2 * H / 3);

      elastic_energy = K * volume * volume / 2 + G * (norm - gamma) * (norm - gamma);
      for (int i = 0; i < 3; ++i)
        stress[i] = K * volume + 2 * G * (trial_strain[i] - volume / 3) * (1 - gamma / norm);
      const Quad alpha = alpha_n + root * gamma;
      hardening_energy = H * alpha * alpha / 2;
      dissipation      = sigma_y * (alpha - alpha_n);
    }

    Quad
    total() const
    {
      return elastic_energy + hardening_energy + dissipation;
    }
  };

  Reference
  reference(const VonMises &material, const Step &step, const int direction, const double shift)
  {
    Quad trial[3];
    for (int i = 0; i < 3; ++i)
      trial[i] = Quad(step.strain[i]) + step.increment[i] + (i == direction ? Quad(shift) : 0);
    return Reference(material, trial, step.history.equivalent_plastic_strain);
  }
} // namespace

TEST(MaterialsVonMises, ReturnsToTheSurfaceAlongTheDeviator)
{
  for_random_steps(
    [](const VonMises &material, const Step &step, const VonMises::Response<double> &r) {
      const auto trial = material.elastic.respond(step.strain, step.increment);
      const auto end   = material.updated(r, step.history);
      // stresses of order 1 (G = 1) with a few roundings
      const double tolerance = 2e-15;
      EXPECT_NEAR(pressure(r.kirchhoff_stress), pressure(trial.kirchhoff_stress), tolerance);
      const double excess = deviator_norm(trial.kirchhoff_stress) - material.radius(step.history);
      if (excess <= 0.)
        {
          EXPECT_EQ(r.plastic_multiplier, 0.);
          EXPECT_EQ(end.equivalent_plastic_strain, step.history.equivalent_plastic_strain);
          for (int i = 0; i < 3; ++i)
            EXPECT_EQ(r.kirchhoff_stress[i], trial.kirchhoff_stress[i]);
          return;
        }
      // f = 0 at the end
      EXPECT_NEAR(deviator_norm(r.kirchhoff_stress), material.radius(end), tolerance);
      // the flow has the end's deviator for its direction, the multiplier for its
      // norm, and is what the elastic law lacks
      double elastic_strain[3], flow_norm = 0.;
      for (int i = 0; i < 3; ++i)
        {
          const double flow = material.plastic_increment(r, i);
          flow_norm += flow * flow;
          EXPECT_NEAR(flow * deviator_norm(r.kirchhoff_stress),
                      r.plastic_multiplier * (r.kirchhoff_stress[i] - pressure(r.kirchhoff_stress)),
                      tolerance);
          elastic_strain[i] = step.strain[i] + step.increment[i] - flow;
        }
      EXPECT_NEAR(std::sqrt(flow_norm), r.plastic_multiplier, tolerance);
      const auto elastic = material.elastic.respond(elastic_strain, {0., 0., 0.});
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(r.kirchhoff_stress[i], elastic.kirchhoff_stress[i], tolerance);
      EXPECT_NEAR(end.equivalent_plastic_strain - step.history.equivalent_plastic_strain,
                  std::sqrt(2. / 3.) * r.plastic_multiplier,
                  tolerance);
    });
}

TEST(MaterialsVonMises, WorkIsStoredOrDissipated)
{
  for_random_steps(
    [](const VonMises &material, const Step &step, const VonMises::Response<double> &r) {
      Quad strain_n[3];
      for (int i = 0; i < 3; ++i)
        strain_n[i] = step.strain[i];
      Step begin = step;
      for (double &increment : begin.increment)
        increment = 0.;
      const Reference end   = reference(material, step, 0, 0.);
      const Reference start = reference(material, begin, 0, 0.);
      // energies of order 0.1 with a few roundings
      const double tolerance = 1e-16;
      EXPECT_NEAR(r.work_increment,
                  static_cast<double>(end.total() - start.elastic_energy - start.hardening_energy),
                  tolerance);
      EXPECT_NEAR(material.hardening_energy(material.updated(r, step.history)),
                  static_cast<double>(end.hardening_energy),
                  tolerance);
      EXPECT_NEAR(material.dissipation(r), static_cast<double>(end.dissipation), tolerance);
      // (3.137): no H in it
      EXPECT_EQ(material.dissipation(r), std::sqrt(2. / 3.) * 0.2 * r.plastic_multiplier);
    });
}

TEST(MaterialsVonMises, StressIsTheSlopeOfTheWorkAndTheTangentThatOfTheStress)
{
  for_random_steps(
    [](const VonMises &material, const Step &step, const VonMises::Response<double> &r) {
      // central differences of 113 bits err by h^2 = 1e-20 and 1e-34/h
      const double h = 1e-10;
      for (int j = 0; j < 3; ++j)
        {
          const Reference plus  = reference(material, step, j, h),
                          minus = reference(material, step, j, -h);
          EXPECT_NEAR(r.kirchhoff_stress[j],
                      static_cast<double>((plus.total() - minus.total()) / (2 * Quad(h))),
                      2e-15);
          for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(material.tangent(r, i, j),
                        static_cast<double>((plus.stress[i] - minus.stress[i]) / (2 * Quad(h))),
                        4e-15);
        }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j)
          {
            const double difference =
              step.strain[i] + step.increment[i] - step.strain[j] - step.increment[j];
            EXPECT_NEAR(material.secant_shear(r, i, j) * difference,
                        r.kirchhoff_stress[i] - r.kirchhoff_stress[j],
                        2e-15);
          }
    });
}

TEST(MaterialsVonMises, TinyStepsOnTheSurfaceKeepTheirDigits)
{
  // dPsi + dD = tau : deps to first order, however small the step
  const VonMises                  material = metal(0.05);
  const VonMises::History<double> history{0.03, yield_stress};
  const double                    e = material.radius(history) / (2. * std::sqrt(1.5));
  const double strain[3]            = {e + 0.02, -0.5 * e + 0.02, -0.5 * e + 0.02}; // |s| = radius
  for (const double size : {1e-6, 1e-9, 1e-12})
    {
      const double increment[3] = {size, -0.3 * size, 0.1 * size};
      const auto   r            = material.respond(strain, increment, history);
      double       work         = 0.;
      for (int i = 0; i < 3; ++i)
        work += r.kirchhoff_stress[i] * increment[i];
      EXPECT_GT(r.plastic_multiplier, 0.1 * size);
      EXPECT_NEAR(r.work_increment, work, (10. * size + 1e-15) * size);
    }
}

TEST(MaterialsVonMises, YieldsInTensionAtTheUniaxialYieldStress)
{
  // eps = (e, -nu e, -nu e): tau = (E e, 0, 0), |s| = sqrt(2/3) E e
  const VonMises material = metal(0.);
  const double   yield = 0.2 / 2.6, nothing[3] = {0, 0, 0};
  const double   before[3] = {0.999 * yield, -0.3 * 0.999 * yield, -0.3 * 0.999 * yield};
  const double   after[3]  = {1.001 * yield, -0.3 * 1.001 * yield, -0.3 * 1.001 * yield};
  EXPECT_EQ(material.respond(nothing, before, {0., yield_stress}).plastic_multiplier, 0.);
  EXPECT_GT(material.respond(nothing, after, {0., yield_stress}).plastic_multiplier, 0.);
  // rho_y = |s| = sqrt(2/3) sigma_y = sqrt(2) tau_y: in pure shear |s| = 2 G gamma/sqrt(2)
  EXPECT_NEAR(material.radius(VonMises::History<double>{0., yield_stress}),
              0.2 * std::sqrt(2. / 3.),
              1e-16);
  const double gamma    = 0.2 / std::sqrt(3.); // tau_y / G
  const double shear[3] = {0.5 * gamma, 0., -0.5 * gamma};
  const auto   sheared  = material.elastic.respond(nothing, shear);
  EXPECT_NEAR(deviator_norm(sheared.kirchhoff_stress),
              material.radius(VonMises::History<double>{0., yield_stress}),
              1e-16);
  // it needs a history, which the elastic law does not
  EXPECT_TRUE(has_history(Material(material)));
  EXPECT_FALSE(has_history(Material(material.elastic)));
  EXPECT_EQ(p_wave_modulus(Material(material)), material.elastic.p_wave_modulus());
}
