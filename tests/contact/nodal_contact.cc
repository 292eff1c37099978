// Contact at common nodes of two fields: normals, tangents, books, what it refuses.
#include "../equations/term_cloud.h"
#include "two_blocks.h"

#include <kedge/contact/nodal_law_term.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  template <typename Dimension>
  class NodalContact : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  std::string
  method(const std::string &name, const std::string &more = "")
  {
    return "    set Method = " + name + "\n" + more;
  }

  const std::string rough = "    set Friction coefficient = 0.3\n";

  /**
   * All methods, with and without friction; but for multipliers with friction, which go to and fro
   * between states at the edge of a block: their slopes are those of the law (NodalLawTest).
   */
  std::vector<std::string>
  all_methods()
  {
    return {method("augmented lagrangian"),
            method("augmented lagrangian", rough),
            method("lagrange multipliers"),
            method("penalty"),
            method("penalty", rough),
            method("non-linear penalty"),
            method("non-linear penalty", rough),
            method("contact velocity"),
            method("contact velocity", rough)};
  }

  template <int dim>
  const NodalContactTerm<dim> &
  contact_of(const Setting<dim> &setting)
  {
    return dynamic_cast<const NodalContactTerm<dim> &>(*setting.model.terms.back());
  }
} // namespace

TYPED_TEST_SUITE(NodalContact, Dimensions);

/** Normals (5.77) of a flat interface: from the lower block to the upper one. */
TYPED_TEST(NodalContact, NormalsPointFromTheFirstToTheSecondBody)
{
  constexpr int dim = TypeParam::value;
  Setting<dim>  setting(two_blocks<dim>(method("augmented lagrangian", rough), "clc-midpoint"));
  setting.step.activate();
  const auto &nodes = contact_of(setting).nodes();
  // cells of 0.2 with points of both in rows next to y = 0.6, the upper one's x from 0.4 to 1.1:
  // in x the nodes 0.4 to 1.2, in y 0.6; in space z from 0.2 to 1
  EXPECT_EQ(nodes.size(), dim == 2 ? 5u : 25u);
  for (const auto &node : nodes)
    {
      EXPECT_EQ(node.n_directions, unsigned(dim));
      EXPECT_GT(node.direction[0][1], 0.7);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          EXPECT_NEAR(node.direction[i] * node.direction[j], i == j ? 1. : 0., 1e-14);
    }
}

TYPED_TEST(NodalContact, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : all_methods())
    {
      SCOPED_TRACE(law);
      Setting<dim> setting(two_blocks<dim>(law, "clc-midpoint"));
      setting.run(1, 0.005);
      setting.start_step(0.005);
      setting.correct({0.9, 0.4, 0.3});
      unsigned int n_loaded = 0;
      for (const auto &force : contact_of(setting).forces(setting.trial))
        n_loaded += force.norm() > 0.;
      EXPECT_GT(n_loaded, 2u);
      test::expect_slope_of_residual(*setting.equations);
    }
}

/** What the methods dissipate is booked, and forces are opposite. */
TYPED_TEST(NodalContact, BooksCloseAndMomentumStays)
{
  constexpr int dim = TypeParam::value;
  for (const std::string &law : all_methods())
    {
      if (law.find("multipliers") != std::string::npos)
        continue; // the edges of the blocks part at once
      SCOPED_TRACE(law);
      Setting<dim>  setting(two_blocks<dim>(law, "clc-midpoint"));
      const Ledger &ledger  = setting.model.ledger;
      const double  before  = ledger.value("linear_momentum_y");
      const double  of_part = ledger.value("linear_momentum_y_upper");
      const double  energy  = ledger.value("total_energy");
      setting.run_until(dim == 2 ? 0.03 : 0.015, 0.005);
      EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11 * energy);
      EXPECT_NEAR(ledger.value("linear_momentum_y"), before, 1e-12 * std::abs(of_part));
      EXPECT_GT(ledger.value("linear_momentum_y_upper") - of_part, 0.05 * std::abs(of_part));
      const bool exact = law.find("lagrang") != std::string::npos;
      EXPECT_EQ(std::abs(ledger.value("contact_dissipation")) < 1e-11 * energy, exact);
      if (law.find("Friction") == std::string::npos)
        EXPECT_EQ(ledger.value("friction_dissipation"), 0.);
      else
        EXPECT_GT(ledger.value("friction_dissipation"), 1e-5 * energy);
    }
}

/** Where both bodies stand on a side that holds them, contact acts along the side. */
TEST(NodalContactScene, HeldNodesHaveNoDirectionAcross)
{
  std::string text = two_blocks<2>(method("augmented lagrangian", rough), "clc-midpoint");
  text += R"(
subsection Node conditions
  subsection all
    set Where       = y > 0.5
    set Component y = fixed
  end
end
)";
  Setting<2> setting(text);
  setting.step.activate();
  const auto &nodes = contact_of(setting).nodes();
  EXPECT_GT(nodes.size(), 0u); // at the edges, where n is oblique
  for (const auto &node : nodes)
    {
      EXPECT_EQ(node.n_directions, 1u);
      EXPECT_EQ(std::abs(node.direction[0][0]), 1.);
    }
}

TEST(NodalContactScene, RefusesWhatTheMethodDoesNotKnow)
{
  const auto refusal = [](const std::string &name, const std::string &entry) {
    return message_of(two_blocks<2>(method(name, "    set " + entry + "\n"), "clc-midpoint"));
  };
  expect_parts(refusal("penalty", "Adhesion = 3"),
               {"Contact/blocks/Adhesion", "Method = penalty", "surface points"});
  expect_parts(refusal("penalty", "Shear limit = 3"),
               {"Contact/blocks/Shear limit", "Method = penalty", "surface points"});
  expect_parts(refusal("augmented lagrangian", "Surface spacing = 0.1"),
               {"Contact/blocks/Surface spacing", "does not know"});
  expect_parts(refusal("contact velocity", "Penalty factor = 2"),
               {"Contact/blocks/Penalty factor", "has no penalty"});
  expect_parts(refusal("lagrange multipliers", "Penalty factor = 2"),
               {"Contact/blocks/Penalty factor", "has no penalty"});
  // frictionless is what they are
  EXPECT_NO_THROW(read_scene<2>(
    parse(two_blocks<2>(method("contact velocity", "    set Friction coefficient = 0\n"),
                        "clc-midpoint"))));
  EXPECT_THROW(Setting<2>(two_blocks<2>(method("contact velocity"), "quasi-static")), UserError);
}
