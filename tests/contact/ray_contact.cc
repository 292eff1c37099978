// Contact by ray tracing: against its printed equations, its slopes, its books.
#include "../equations/term_cloud.h"
#include "two_blocks.h"

#include <kedge/contact/ray_contact_term.h>

#include <random>

using namespace kedge;
using namespace contact_tests;

namespace
{
  /** A face of each body, the second one a little ahead, both moved at random. */
  template <int dim>
  struct Faces
  {
    explicit Faces(const unsigned int seed)
    {
      std::mt19937                           generator(seed);
      std::uniform_real_distribution<double> number(-1., 1.);
      for (unsigned int a = 0; a < n_face_corners<dim>; ++a)
        {
          // faces across y, whose normal is -y before it is turned outward
          place.first[a][0] = a & 1u;
          if (dim == 3)
            place.first[a][dim - 1] = (a >> 1) & 1u;
          place.second[a] = place.first[a];
          place.second[a][1] += 0.05 * number(generator);
          place.value[a] =
            dim == 2 ? (a == 0 ? 0.7 : 0.3) : (a & 1u ? 0.3 : 0.7) * (a & 2u ? 0.4 : 0.6);
          place.slope[0][a] = (a & 1u ? 1. : -1.) * (dim == 2 ? 1. : a & 2u ? 0.4 : 0.6);
          if constexpr (dim == 3)
            place.slope[1][a] = (a & 1u ? 0.3 : 0.7) * (a & 2u ? 1. : -1.);
          for (int d = 0; d < dim; ++d)
            {
              state.first[a][d]      = 0.1 * number(generator);
              state.second[a][d]     = 0.1 * number(generator);
              state.multiplier[a][d] = 0.3 * number(generator);
            }
        }
      place.outward = -1.;
    }

    RayPlace<dim>         place;
    RayState<dim, double> state;
  };

  RayLaw
  some_law(const double friction)
  {
    return {3., friction, 0.5};
  }

  template <typename Dimension>
  class RayContact : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
} // namespace

TYPED_TEST_SUITE(RayContact, Dimensions);

/** (5.83): y = x + g n lies on the second face; Coulomb's limit; C = lambda - F. */
TYPED_TEST(RayContact, MeetsThePartnerAndKeepsCoulombsLaw)
{
  constexpr int dim       = TypeParam::value;
  unsigned int  counts[3] = {};
  for (unsigned int seed = 0; seed < 200; ++seed)
    {
      const Faces<dim> f(seed);
      const RayLaw     law    = some_law(1.);
      const auto       here   = ray_contact<dim, double>(law, f.place, f.state);
      double           square = 0., normal = 0., force = 0.;
      for (int d = 0; d < dim; ++d)
        {
          double x = 0., y = 0., lambda = 0.;
          for (unsigned int a = 0; a < n_face_corners<dim>; ++a)
            {
              x += f.place.value[a] * (f.place.first[a][d] + 0.5 * f.state.first[a][d]);
              y += here.partner[a] * (f.place.second[a][d] + 0.5 * f.state.second[a][d]);
              lambda += f.place.value[a] * f.state.multiplier[a][d];
            }
          EXPECT_NEAR(x + here.gap * here.normal[d], y, 1e-13);
          EXPECT_NEAR(here.constraint[d], lambda - here.force[d], 1e-14);
          normal += here.normal[d] * here.normal[d];
          force += here.force[d] * here.normal[d];
        }
      EXPECT_NEAR(normal, 1., 1e-14);
      for (int d = 0; d < dim; ++d)
        square += std::pow(here.force[d] - force * here.normal[d], 2);
      EXPECT_LE(force, 0.);
      EXPECT_LE(std::sqrt(square), -law.friction * force + 1e-14);
      ++counts[!here.closed ? 0 : std::sqrt(square) < -law.friction * force - 1e-12 ? 1 : 2];
    }
  for (const unsigned int n : counts) // open, sticking and sliding were there
    EXPECT_GT(n, 10u);
}

/** All slopes against differences: those of normal, ray and functions at the partner too. */
TYPED_TEST(RayContact, SlopesAreThoseOfForceAndConstraint)
{
  constexpr int          dim      = TypeParam::value;
  constexpr unsigned int n        = n_face_corners<dim>;
  constexpr unsigned int n_values = 3 * n * dim;
  for (unsigned int seed = 0; seed < 30; ++seed)
    for (const double mu : {0., 0.5, 20.})
      {
        const Faces<dim> f(seed);
        const RayLaw     law = some_law(mu);
        const auto       at  = [&](RayState<dim, double> &state, const unsigned int i) -> double        &{
          auto &block = i < n * dim       ? state.first
                               : i < 2 * n * dim ? state.second
                                                 : state.multiplier;
          return block[i % (n * dim) / dim][i % dim];
        };
        RayState<dim, SlopedNumber<n_values>> sloped;
        for (unsigned int i = 0; i < n * dim; ++i)
          for (const unsigned int k : {0u, 1u, 2u})
            {
              auto &block = k == 0 ? sloped.first : k == 1 ? sloped.second : sloped.multiplier;
              RayState<dim, double> plain = f.state;
              block[i / dim][i % dim] =
                SlopedNumber<n_values>::variable(at(plain, k * n * dim + i), k * n * dim + i);
            }
        const auto   here = ray_contact<dim, SlopedNumber<n_values>>(law, f.place, sloped);
        const double e    = 1e-6;
        for (unsigned int i = 0; i < n_values; ++i)
          {
            RayState<dim, double> plus = f.state, minus = f.state;
            at(plus, i) += e;
            at(minus, i) -= e;
            const auto above = ray_contact<dim, double>(law, f.place, plus),
                       below = ray_contact<dim, double>(law, f.place, minus);
            if (above.closed != below.closed)
              continue;
            for (int d = 0; d < dim; ++d) // e^2 times third derivatives, round-off 1e-16/e
              {
                EXPECT_NEAR(here.force[d].slope[i],
                            (above.force[d] - below.force[d]) / (2 * e),
                            1e-7);
                EXPECT_NEAR(here.constraint[d].slope[i],
                            (above.constraint[d] - below.constraint[d]) / (2 * e),
                            1e-7);
              }
            for (unsigned int a = 0; a < n; ++a)
              EXPECT_NEAR(here.partner[a].slope[i],
                          (above.partner[a] - below.partner[a]) / (2 * e),
                          1e-7);
          }
      }
}

TYPED_TEST(RayContact, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const std::string law : {"", "    set Friction coefficient = 0.3\n"})
    {
      Setting<dim> setting(two_blocks<dim>("    set Method = ray tracing\n" + law, "clc-midpoint"));
      setting.run(1, 0.005);
      setting.start_step(0.005);
      setting.correct({0.9, 0.4, 0.3});
      const auto &term = dynamic_cast<const RayContactTerm<dim> &>(*setting.model.terms.back());
      EXPECT_GT(term.n_faces(), 2u);
      test::expect_slope_of_residual(*setting.equations);
    }
}

/** What the method dissipates is booked, and forces are opposite. */
TYPED_TEST(RayContact, BooksCloseAndMomentumStays)
{
  constexpr int dim = TypeParam::value;
  Setting<dim>  setting(two_blocks<dim>("    set Method = ray tracing\n", "clc-midpoint"));
  const Ledger &ledger  = setting.model.ledger;
  const double  before  = ledger.value("linear_momentum_y");
  const double  of_part = ledger.value("linear_momentum_y_upper");
  const double  energy  = ledger.value("total_energy");
  setting.run_until(0.015, 0.005);
  EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11 * energy);
  EXPECT_NEAR(ledger.value("linear_momentum_y"), before, 1e-12 * std::abs(of_part));
  EXPECT_GT(ledger.value("linear_momentum_y_upper") - of_part, 0.02 * std::abs(of_part));
}
