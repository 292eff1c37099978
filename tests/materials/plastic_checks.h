// Checks of laws in principal axes whose code also runs in 113 bits. A test
// declares kedge::Quad before it includes this file.
#ifndef kedge_tests_materials_plastic_checks_h
#define kedge_tests_materials_plastic_checks_h

#include <kedge/materials/material.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace kedge::test
{
  /** A committed state and a step from it, in principal axes. */
  template <class Law>
  struct PrincipalStep
  {
    double         strain[3], increment[3];
    HistoryOf<Law> history;
  };

  inline double
  deviator_norm(const double (&stress)[3])
  {
    const double mean   = (stress[0] + stress[1] + stress[2]) / 3.;
    double       square = 0.;
    for (const double principal : stress)
      square += (principal - mean) * (principal - mean);
    return std::sqrt(square);
  }

  /** What the law answers in 113 bits, the trial strain shifted in one direction. */
  template <class Law>
  auto
  respond_exactly(const Law                &law,
                  const PrincipalStep<Law> &step,
                  const int                 direction,
                  const Quad                shift)
  {
    Quad strain[3], increment[3];
    for (int i = 0; i < 3; ++i)
      {
        strain[i]    = step.strain[i];
        increment[i] = Quad(step.increment[i]) + (i == direction ? shift : Quad(0));
      }
    double               values[most_law_columns] = {};
    HistoryOf<Law, Quad> history;
    write_history<Law>(step.history, values);
    for (unsigned int c = 0; c < n_columns<Law>; ++c)
      reinterpret_cast<Quad *>(&history)[c] = values[c];
    return law.respond(strain, increment, history);
  }

  /**
   * Tangent, slope of the work and secants against central differences of the
   * stress and of stored and dissipated energy, which err by h^2 = 1e-20 and
   * 1e-34/h. Steps within h of a kink of the law are no matter: random ones are not.
   * @p tolerance is relative to the elastic tangent, of order 1, and the stress.
   */
  template <class Law>
  void
  expect_slopes(const Law &law, const PrincipalStep<Law> &step, const double tolerance)
  {
    const auto r     = law.respond(step.strain, step.increment, step.history);
    const auto exact = respond_exactly(law, step, 0, Quad(0));
    // the work of the step, cancelled nowhere
    Quad before[3], after[3];
    for (int i = 0; i < 3; ++i)
      {
        before[i] = step.strain[i];
        after[i]  = Quad(step.strain[i]) + step.increment[i] - exact.plastic_strain[i];
      }
    HistoryOf<Law, Quad> history;
    double               columns[most_law_columns] = {};
    write_history<Law>(step.history, columns);
    for (unsigned int c = 0; c < n_columns<Law>; ++c)
      reinterpret_cast<Quad *>(&history)[c] = columns[c];
    const Quad stored = law.energy(after, history) - law.energy(before, history);
    Quad       lost   = 0;
    for (int i = 0; i < 3; ++i)
      lost += exact.kirchhoff_stress[i] * exact.plastic_strain[i];
    EXPECT_NEAR(r.work_increment, static_cast<double>(stored + lost), 1e-2 * tolerance);
    EXPECT_NEAR(r.dissipation, static_cast<double>(lost), 1e-2 * tolerance);

    const Quad h = 1e-10;
    for (int j = 0; j < 3; ++j)
      {
        const auto plus  = respond_exactly(law, step, j, h),
                   minus = respond_exactly(law, step, j, -h);
        EXPECT_NEAR(law.work_slope(r, j),
                    static_cast<double>((plus.work_increment - minus.work_increment) / (2 * h)),
                    tolerance);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(law.tangent(r, i, j),
                      static_cast<double>((plus.kirchhoff_stress[i] - minus.kirchhoff_stress[i]) /
                                          (2 * h)),
                      tolerance);
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j)
        {
          const double difference =
            step.strain[i] + step.increment[i] - step.strain[j] - step.increment[j];
          EXPECT_NEAR(law.secant_shear(r, i, j) * difference,
                      r.kirchhoff_stress[i] - r.kirchhoff_stress[j],
                      tolerance);
        }
  }
  /** A pack whose lanes hold the steps from @p first on, or all of them that step alone. */
  template <class Law>
  auto
  respond_in_lanes(const Law                             &law,
                   const std::vector<PrincipalStep<Law>> &steps,
                   const std::size_t                      first,
                   const bool                             alone)
  {
    Pack                 strain[3], increment[3];
    HistoryOf<Law, Pack> history;
    for (unsigned int lane = 0; lane < pack_width; ++lane)
      {
        const PrincipalStep<Law> &step = steps[first + (alone ? 0 : lane)];
        for (int i = 0; i < 3; ++i)
          {
            strain[i].set(lane, step.strain[i]);
            increment[i].set(lane, step.increment[i]);
          }
        double values[most_law_columns] = {};
        write_history<Law>(step.history, values);
        for (unsigned int c = 0; c < n_columns<Law>; ++c)
          reinterpret_cast<Pack *>(&history)[c].set(lane, values[c]);
      }
    return law.respond(strain, increment, history);
  }

  /**
   * Several points at once: each lane bit for bit as if all others were like it, and to
   * @p tolerance, relative to stresses and moduli, as a point alone.
   */
  template <class Law>
  void
  expect_lanes_alike(const Law                             &law,
                     const std::vector<PrincipalStep<Law>> &steps,
                     const double                           tolerance)
  {
    ASSERT_GE(steps.size(), pack_width);
    for (std::size_t first = 0; first + pack_width <= steps.size(); ++first)
      {
        const auto mixed = respond_in_lanes(law, steps, first, false);
        const auto equal = respond_in_lanes(law, steps, first, true);
        const auto alone =
          law.respond(steps[first].strain, steps[first].increment, steps[first].history);
        EXPECT_TRUE(mixed.valid[0] && equal.valid[0] && alone.valid);
        double stress = 0.;
        for (const double value : alone.kirchhoff_stress)
          stress += std::abs(value);
        for (int i = 0; i < 3; ++i)
          {
            EXPECT_EQ(mixed.kirchhoff_stress[i][0], equal.kirchhoff_stress[i][0]);
            EXPECT_EQ(law.plastic_increment(mixed, i)[0], law.plastic_increment(equal, i)[0]);
            EXPECT_NEAR(mixed.kirchhoff_stress[i][0],
                        alone.kirchhoff_stress[i],
                        tolerance * stress);
            for (int j = 0; j < 3; ++j)
              {
                EXPECT_EQ(law.tangent(mixed, i, j)[0], law.tangent(equal, i, j)[0]);
                EXPECT_NEAR(law.tangent(mixed, i, j)[0],
                            law.tangent(alone, i, j),
                            1e2 * tolerance * law.p_wave_modulus());
              }
          }
      }
  }
} // namespace kedge::test

#endif
