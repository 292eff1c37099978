// The largest shear stress of a contact, of the place: where it comes from, what it refuses.
#include "../equations/term_cloud.h"
#include "two_blocks.h"

#include <kedge/contact/contact_term.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  template <typename Dimension>
  class ShearLimitTest : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  std::string
  with_limit(const std::string &limit)
  {
    return "    set Friction coefficient = 3\n    set Surface spacing = 0.1\n"
           "    set Shear limit = " +
           limit;
  }

  /** The two blocks; the lower one of clay, with a strength of @p strength. */
  template <int dim>
  std::string
  on_clay(const std::string &limit,
          const std::string &strength,
          const std::string &scheme = "clc-midpoint")
  {
    std::string       text = two_blocks<dim>(with_limit(limit), scheme);
    const std::string law  = "set Young's modulus = 1e5\n    set Poisson's ratio = 0.3";
    return text.replace(
      text.find(law),
      law.size(),
      "set Model = tresca\n    set Bulk modulus = 1e5\n    set Shear modulus = 4e4\n"
      "    set Undrained strength = " +
        strength);
  }

  /** As the other way round, a plane in place of the upper block. */
  std::string
  on_wall(const std::string &limit)
  {
    std::string       text   = two_blocks<2>(with_limit(limit), "clc-midpoint");
    const std::string second = "set Second = upper";
    return text.replace(text.find(second), second.size(), "set Wall = bottom");
  }
} // namespace

TYPED_TEST_SUITE(ShearLimitTest, Dimensions);

/** Strengths that are linear in the place come to the surface exactly. */
TYPED_TEST(ShearLimitTest, IsThatOfTheSoilUnderneath)
{
  constexpr int dim = TypeParam::value;
  Setting<dim>  setting(on_clay<dim>("0.5*s_u", "2e4 + 3e3*x + 4e3*depth"));
  setting.run(2, 0.001);
  setting.start_step(0.001);
  const auto  &contact = dynamic_cast<const ContactTerm<dim> &>(*setting.model.terms.back());
  unsigned int n       = 0;
  for (const auto &half : contact.halves())
    for (const auto &sample : half.samples())
      {
        // displacements are small: nearly the reference place, depth nearly 0
        EXPECT_NEAR(sample.shear_limit,
                    0.5 * (2e4 + 3e3 * half.place(sample)[0] + 4e3 * (0.6 - half.place(sample)[1])),
                    20.);
        ++n;
      }
  EXPECT_GT(n, 4u);
  // exactly so before anything has moved
  Setting<dim> fresh(on_clay<dim>("s_u", "2e4 + 3e3*x + 4e3*depth"));
  fresh.step.activate();
  const auto &term = dynamic_cast<const ContactTerm<dim> &>(*fresh.model.terms.back());
  const auto &clay = term.halves().front().sampled;
  ASSERT_EQ(clay.strengths.size(), clay.surface.n_vertices());
  for (unsigned int v = 0; v < clay.surface.n_vertices(); ++v)
    {
      const auto &x = clay.surface.mesh().vertices[v];
      EXPECT_NEAR(clay.strengths[v], 2e4 + 3e3 * x[0] + 4e3 * (0.6 - x[1]), 1e-6);
    }
}

TYPED_TEST(ShearLimitTest, TangentIsTheSlopeOfTheResidualAndBooksClose)
{
  constexpr int dim = TypeParam::value;
  for (const std::string limit : {"20 + 30*x", "0.001*s_u + 10*depth"})
    {
      Setting<dim> setting(on_clay<dim>(limit, "2e4 + 3e3*x"));
      const double energy = setting.model.ledger.value("total_energy");
      setting.run(2, 0.01);
      EXPECT_GT(setting.model.ledger.value("friction_dissipation"), 0.);
      EXPECT_NEAR(setting.model.ledger.value("energy_error"), 0., 1e-11 * energy);
      setting.start_step(0.01);
      setting.correct({0.9, 0.1, 0.1});
      test::expect_slope_of_residual(*setting.equations);
    }
}

TEST(ShearLimitScene, DepthIsBelowTheSecondGroup)
{
  Setting<2> setting(on_clay<2>("1 + x + 10*depth", "2e4"));
  setting.step.activate();
  setting.start_step(0.01);
  const auto  &contact = dynamic_cast<const ContactTerm<2> &>(*setting.model.terms.back());
  unsigned int n       = 0;
  for (const auto &half : contact.halves())
    for (const auto &sample : half.samples())
      {
        const auto place = half.place(sample);
        EXPECT_NEAR(sample.shear_limit, 1. + place[0] + 10. * (1.2 - place[1]), 1e-12);
        ++n;
      }
  EXPECT_GT(n, 4u);
}

TEST(ShearLimitScene, RefusesWhatIsNoLimit)
{
  const auto started = [](const std::string &text) {
    try
      {
        Setting<2> setting(text);
      }
    catch (const UserError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  expect_parts(message_of(on_clay<2>("0", "1")), {"Contact/blocks/Shear limit", "greater than 0"});
  expect_parts(message_of(on_clay<2>("s_v", "1")), {"Contact/blocks/Shear limit", "s_v"});
  expect_parts(started(on_clay<2>("10 - 20*x", "1e4")),
               {"Contact/blocks/Shear limit", "is -", "body 'lower' at (", "must be >= 0"});
  EXPECT_EQ(started(on_clay<2>("0.3*s_u", "1e4")), "");
  expect_parts(started(two_blocks<2>(with_limit("0.3*s_u"), "clc-midpoint")),
               {"asks for s_u", "'lower'", "no undrained strength"});
  expect_parts(started(on_wall("s_u")), {"asks for s_u", "'lower'", "no undrained strength"});
  EXPECT_EQ(started(on_wall("1 + depth")), "");
}
