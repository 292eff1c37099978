// The law of contact at a single place, by its identities.
#include <kedge/contact/contact_law.h>

#include <gtest/gtest.h>

#include <random>

using namespace kedge;

namespace
{
  ContactLaw
  some_law(const bool conserving)
  {
    ContactLaw law;
    law.normal_stiffness  = 3.;
    law.tangent_stiffness = 2.;
    law.friction          = 0.4;
    law.adhesion          = 0.1;
    law.alpha             = conserving ? 0.5 : 1.;
    law.conserving        = conserving;
    return law;
  }

  template <int dim>
  struct State
  {
    explicit State(const unsigned int seed)
    {
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> number(-1., 1.);
      for (int d = 0; d < dim; ++d)
        {
          normal[d] = number(generator);
          slip[d]   = 0.3 * number(generator);
          D[d]      = number(generator);
        }
      normal /= normal.norm();
      slip -= (slip * normal) * normal;
      slope = normal;
      slope[0] += 0.05 * number(generator); // tilted
      gap        = 0.5 * number(generator);
      multiplier = seed % 3 == 0 ? 0.4 : 0.;
    }

    dealii::Tensor<1, dim> normal, slope, slip, D;
    double                 gap, multiplier;
  };

  template <int dim>
  ContactResponse<dim>
  respond(const ContactLaw &law, const State<dim> &s, const dealii::Tensor<1, dim> &D)
  {
    return contact_response(law, s.normal, s.slope, s.gap, s.slip, s.multiplier, D);
  }
} // namespace

template <typename Dimension>
class ContactLawTest : public testing::Test
{};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ContactLawTest, Dimensions);

TYPED_TEST(ContactLawTest, WorkIsWhatIsStoredLessWhatIsDissipated)
{
  constexpr int    dim    = TypeParam::value;
  const ContactLaw law    = some_law(true);
  unsigned int     n_open = 0, n_closing = 0, n_opening = 0, n_sliding = 0, n_sticking = 0;
  for (unsigned int seed = 1; seed < 400; ++seed)
    {
      const State<dim>           s(seed);
      const ContactResponse<dim> r = respond(law, s, s.D);
      const auto stored            = [&](const double gap, const dealii::Tensor<1, dim> &slip) {
        return stored_in_contact(law, gap, s.multiplier, slip);
      };
      // p (g_1 - g_0) = -(W_1 - W_0), and the same of the slip: numbers of order one, to round-off
      EXPECT_NEAR(r.pressure * (r.gap_end - s.gap),
                  stored(s.gap, {}) - stored(r.gap_end, {}),
                  1e-14);
      EXPECT_NEAR(-(r.traction * s.D),
                  stored(r.gap_end, r.slip_end) - stored(s.gap, s.slip) + r.dissipation,
                  1e-14);
      EXPECT_GE(r.pressure, 0.);
      EXPECT_GE(r.dissipation, 0.);
      EXPECT_NEAR(r.slip_end * s.normal, 0., 1e-14);
      const dealii::Tensor<1, dim> t = r.traction - r.pressure * s.slope;
      if (r.pressure > 0.)
        {
          EXPECT_LE(t.norm(), law.friction * r.pressure + law.adhesion + 1e-14);
        }
      n_open += r.pressure == 0.;
      n_closing += s.gap > 0. && r.gap_end < 0.;
      n_opening += s.gap < 0. && r.gap_end > 0.;
      n_sliding += r.pressure > 0. && !r.sticks;
      n_sticking += r.sticks;
    }
  for (const unsigned int n : {n_open, n_closing, n_opening, n_sliding, n_sticking})
    EXPECT_GT(n, 10u); // all branches were there
}

TYPED_TEST(ContactLawTest, FrictionActsOnWhatTheGrainsCarryUpToItsLimit)
{
  constexpr int dim   = TypeParam::value;
  unsigned int  n_wet = 0, n_limited = 0, n_lifted = 0;
  for (unsigned int seed = 1; seed < 400; ++seed)
    {
      ContactLaw law  = some_law(true);
      law.shear_limit = 0.25;
      const State<dim> s(seed);
      const double     p_w   = 0.002 * seed;
      const auto       under = [&](const double pore_pressure) {
        return contact_response(law,
                                s.normal,
                                s.slope,
                                s.gap,
                                s.slip,
                                s.multiplier,
                                s.D,
                                pore_pressure);
      };
      const ContactResponse<dim> r = under(p_w), dry = under(0.);
      EXPECT_EQ(r.pressure, dry.pressure); // the surfaces carry all of it
      const dealii::Tensor<1, dim> t = r.traction - r.pressure * s.slope;
      const double                 bound =
        std::min(law.friction * std::max(r.pressure - p_w, 0.) + law.adhesion, law.shear_limit);
      if (r.pressure > 0. && !r.sticks)
        {
          EXPECT_NEAR(t.norm(), bound, 1e-14);
        }
      // the books, whatever the bound is; numbers of order one, to round-off
      EXPECT_NEAR(-(r.traction * s.D),
                  stored_in_contact(law, r.gap_end, s.multiplier, r.slip_end) -
                    stored_in_contact(law, s.gap, s.multiplier, s.slip) + r.dissipation,
                  1e-14);
      const double e = 1e-6;
      if (r.sticks == under(p_w + e).sticks && r.sticks == under(p_w - e).sticks)
        {
          const auto slope = (under(p_w + e).traction - under(p_w - e).traction) / (2. * e);
          // of central differences: round-off 1e-16/e
          EXPECT_LT((r.traction_by_pore_pressure - slope).norm(), 1e-9);
        }
      n_wet += r.traction_by_pore_pressure.norm() > 0.;
      n_limited += r.pressure > 0. && bound == law.shear_limit;
      n_lifted += r.pressure > 0. && r.pressure < p_w;
    }
  for (const unsigned int n : {n_wet, n_limited, n_lifted})
    EXPECT_GT(n, 10u); // all branches were there
}

TYPED_TEST(ContactLawTest, MultipliersOfAStateOfRestStoreNothing)
{
  constexpr int dim = TypeParam::value;
  ContactLaw    law = some_law(false);
  law.at_rest       = true;
  dealii::Tensor<1, dim> slip;
  slip[0] = 0.3;
  // forces of constraint do no work, whatever they are; a gap that is left is a spring's
  EXPECT_EQ(stored_in_contact(law, 0., 0.4, slip), 0.);
  EXPECT_EQ(stored_in_contact(law, 0.1, 0.4, slip), 0.);
  EXPECT_DOUBLE_EQ(stored_in_contact(law, -0.1, 0.4, slip), 0.5 * law.normal_stiffness * 0.01);
}

TYPED_TEST(ContactLawTest, SlopeIsThatOfTheTraction)
{
  constexpr int dim = TypeParam::value;
  for (const bool conserving : {true, false})
    for (unsigned int seed = 1; seed < 100; ++seed)
      {
        const ContactLaw           law = some_law(conserving);
        const State<dim>           s(seed);
        const ContactResponse<dim> r = respond(law, s, s.D);
        const double               e = 1e-6;
        for (int j = 0; j < dim; ++j)
          {
            dealii::Tensor<1, dim> plus = s.D, minus = s.D;
            plus[j] += e;
            minus[j] -= e;
            const auto above = respond(law, s, plus), below = respond(law, s, minus);
            if (above.sticks != below.sticks || (above.pressure > 0.) != (below.pressure > 0.))
              continue; // a kink in between
            const auto slope = (above.traction - below.traction) / (2. * e);
            for (int i = 0; i < dim; ++i) // e^2 times third derivatives, and round-off 1e-16/e
              EXPECT_NEAR(r.slope[i][j], slope[i], 1e-7) << seed;
          }
      }
}

TYPED_TEST(ContactLawTest, SlipTurnsWithTheNormal)
{
  constexpr int dim = TypeParam::value;
  for (unsigned int seed = 1; seed < 20; ++seed)
    {
      const State<dim> a(seed);
      State<dim>       b(seed + 100);
      if (a.normal * b.normal < 0.)
        b.normal *= -1.;
      const auto slip = turned(a.slip, a.normal, b.normal);
      EXPECT_NEAR(slip.norm(), a.slip.norm(), 1e-15);
      EXPECT_NEAR(slip * b.normal, 0., 1e-15);
      EXPECT_NEAR((turned(slip, b.normal, a.normal) - a.slip).norm(), 0., 1e-14);
    }
}

TEST(ContactLawAtRest, PressureIsThatOfTheEndWithItsMultiplier)
{
  const ContactLaw law = some_law(false);
  // p = lambda - eps g_1
  EXPECT_NEAR(contact_pressure(law, 0.2, -0.3, 1.).value, 1. + 3. * 0.1, 1e-15);
  EXPECT_EQ(contact_pressure(law, 0.2, 0.3, 1.).value, 0.);
}
