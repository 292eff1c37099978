// Contact between the fields of small scenes: its tangent, its books, what it refuses.
#include "../equations/term_cloud.h"
#include "two_blocks.h"

#include <kedge/contact/contact_term.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  template <typename Dimension>
  class ContactTermTest : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  const std::string rough  = "    set Friction coefficient = 0.3\n    set Surface spacing = 0.1";
  const std::string smooth = "    set Friction coefficient = 0\n    set Surface spacing = 0.1";
} // namespace

TYPED_TEST_SUITE(ContactTermTest, Dimensions);

TYPED_TEST(ContactTermTest, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : {smooth, rough, rough + "\n    set Adhesion = 100"})
    for (const char *scheme : {"clc-midpoint", "newmark"})
      {
        Setting<dim> setting(two_blocks<dim>(law, scheme));
        setting.run(2, 0.01); // closed and sliding in part
        setting.start_step(0.01);
        // from where the bodies press each other, and directions follow them no more
        setting.correct({0.9, 0.1, 0.1});
        unsigned int n_closed = 0;
        setting.equations->evaluate();
        const auto &contact = dynamic_cast<const ContactTerm<dim> &>(*setting.model.terms.back());
        for (const auto &half : contact.halves())
          for (const auto &sample : half.samples())
            n_closed += half.response(sample).pressure > 0.;
        EXPECT_GT(n_closed, 4u);
        test::expect_slope_of_residual(*setting.equations);
      }
}

/** Friction acts on what the grains carry: the tangent couples forces and pore pressures. */
TYPED_TEST(ContactTermTest, TangentOfSaturatedBodiesHasTheSlopeWithThePoreWater)
{
  constexpr int dim = TypeParam::value;
  for (const std::string dry : {"", "    set Saturated = false\n"})
    {
      std::string text = two_blocks<dim>(rough, "newmark") + R"(
subsection Pore fluid
  set Density                = 1000
  set Bulk modulus           = 1e6
  set Hydraulic conductivity = 1e-3
  set Reference gravity      = 10
end
)";
      for (const std::string ratio : {"0.3", "0.2"})
        {
          const std::string entry = "    set Poisson's ratio = " + ratio + "\n";
          text.insert(text.find(entry), "    set Initial porosity = 0.3\n");
        }
      text.insert(text.find("    set Material = stiff"), dry); // the upper one
      Setting<dim> setting(text);
      setting.run(2, 0.01);
      setting.start_step(0.01);
      setting.correct({0.9, 0.1, 0.1});
      setting.equations->evaluate();
      unsigned int n_wet = 0;
      for (const auto &term : setting.model.terms)
        if (const auto *contact = dynamic_cast<const ContactTerm<dim> *>(term.get()))
          for (const auto &half : contact->halves())
            for (const auto &sample : half.samples())
              n_wet += half.response(sample).traction_by_pore_pressure.norm() > 0.;
      EXPECT_GT(n_wet, 4u);
      test::expect_slope_of_residual(*setting.equations);
    }
}

TYPED_TEST(ContactTermTest, BooksCloseAndMomentumStays)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : {smooth, rough})
    {
      Setting<dim>  setting(two_blocks<dim>(law, "clc-midpoint"));
      const Ledger &ledger  = setting.model.ledger;
      const double  before  = ledger.value("linear_momentum_y");
      const double  of_part = ledger.value("linear_momentum_y_upper");
      const double  energy  = ledger.value("total_energy");
      setting.run(12, 0.01);
      // the method conserves to round-off; Newton's residual leaves 1e-12 of the forces
      EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11 * energy);
      EXPECT_NEAR(ledger.value("linear_momentum_y"), before, 1e-12 * std::abs(of_part));
      // and the bodies have met
      EXPECT_GT(ledger.value("linear_momentum_y_upper") - of_part, 0.1 * std::abs(of_part));
      EXPECT_GT(ledger.value("contact_duration_blocks"), 0.05);
      if (law == rough)
        EXPECT_GT(ledger.value("friction_dissipation"), 1e-3 * energy);
      else
        EXPECT_EQ(ledger.value("friction_dissipation"), 0.);
    }
}

TYPED_TEST(ContactTermTest, ARejectedStepLeavesNothing)
{
  constexpr int dim = TypeParam::value;
  Setting<dim>  once(two_blocks<dim>(rough, "clc-midpoint")),
    twice(two_blocks<dim>(rough, "clc-midpoint"));
  once.run(6, 0.01);
  twice.run(3, 0.01);
  twice.step.attempt({0.03, 0.02}); // an attempt that is not committed
  twice.run(3, 0.01);
  SavedState a, b;
  for (const auto &term : once.model.terms)
    term->save(a);
  for (const auto &term : twice.model.terms)
    term->save(b);
  EXPECT_EQ(a, b);         // bit for bit
  EXPECT_EQ(a.size(), 5u); // two surfaces, two halves, from where depth counts
}

TYPED_TEST(ContactTermTest, DeepOverlapAtTheStartIsTheUsersError)
{
  constexpr int dim = TypeParam::value;
  try
    {
      Setting<dim> setting(two_blocks<dim>(smooth, "clc-midpoint", "-0.15")); // of cells of 0.2
      FAIL();
    }
  catch (const UserError &error)
    {
      expect_parts(error.what(),
                   {"Contact 'blocks'",
                    "'lower' and 'upper'",
                    "overlap by",
                    "more than half a cell",
                    "Geometry"});
    }
}

TEST(ContactTermScene, MethodNoneRefusesALaw)
{
  expect_parts(message_of(two_blocks<2>(rough + "\n    set Method = none", "clc-midpoint")),
               {"Contact/blocks/", "Method = none", "Leave one"});
  expect_parts(message_of(two_blocks<2>("    set Friction coefficient = -1", "clc-midpoint")),
               {"Contact/blocks/Friction coefficient = -1", "at least 0"});
  expect_parts(message_of(two_blocks<2>("    set Penalty factor = 0", "clc-midpoint")),
               {"Contact/blocks/Penalty factor = 0", "greater than 0"});
  expect_parts(message_of(two_blocks<2>("    set Surface spacing = 0", "clc-midpoint")),
               {"Contact/blocks/Surface spacing = 0", "greater than 0"});
  expect_parts(message_of(two_blocks<2>("    set Method = surface pionts", "clc-midpoint")),
               {"Contact/blocks/Method", "surface points"});
}
