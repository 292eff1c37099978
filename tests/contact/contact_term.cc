// Contact between the fields of small scenes: its tangent, its books, what it refuses.
#include "../equations/term_cloud.h"
#include "../scene/scene_text.h"

#include <kedge/contact/contact_term.h>
#include <kedge/simulation/step.h>

using namespace kedge;
using namespace scene_tests;

namespace
{
  std::string
  repeated(const std::string &a, const std::string &b, const std::string &c, const int dim)
  {
    return a + b + (dim == 3 ? c : "");
  }

  /** Two blocks one above the other that meet obliquely; the lower one stands askew to the grid. */
  template <int dim>
  std::string
  two_blocks(const std::string &law, const std::string &scheme, const std::string &gap = "0.01")
  {
    const std::string box_a =
      dim == 2 ? "box(0.13, 0.1; 1.4, 0.6)" : "box(0.13, 0.1, 0.2; 1.4, 0.6, 1.1)";
    const std::string box_b =
      dim == 2 ? "box(0.4, 0.6 + gap; 1.1, 1.2)" : "box(0.4, 0.6 + gap, 0.3; 1.1, 1.2, 0.9)";
    return "set Dimension = " + std::to_string(dim) + R"(
subsection Constants
  set gap = )" +
           gap + R"(
end
subsection Grid
  set Extent = )" +
           repeated("2", ", 1.6", ", 1.6", dim) + R"(
  set Cells  = )" +
           repeated("10", ", 8", ", 8", dim) + R"(
end
subsection Materials
  subsection soft
    set Density         = 1000
    set Young's modulus = 1e5
    set Poisson's ratio = 0.3
  end
  subsection stiff
    set Density         = 2000
    set Young's modulus = 4e5
    set Poisson's ratio = 0.2
  end
end
subsection Bodies
  subsection lower
    set Geometry = )" +
           box_a + R"(
    set Material = soft
    set Initial velocity = )" +
           repeated("0.3", "; 0.5 + 0.3*x", "; 0.1", dim) + R"(
    set Points per cell = 2
  end
  subsection upper
    set Geometry = )" +
           box_b + R"(
    set Material = stiff
    set Initial velocity = )" +
           repeated("-0.5 + 0.1*y", "; -1", "; 0.4*x", dim) + R"(
    set Points per cell = 2
  end
end
subsection Contact
  subsection blocks
    set First  = lower
    set Second = upper
)" + law + R"(
  end
end
subsection Time
  set Scheme = )" +
           scheme + R"(
  set End    = 1
  set Step   = 0.01
end
)";
  }

  template <int dim>
  struct Setting
  {
    explicit Setting(const std::string &text)
      : model(read_scene<dim>(parse(text)), MPI_COMM_SELF)
      , step(model)
    {
      model.create_points();
      step.initialise_points(0., false);
      step.book_state();
      model.ledger.set_start();
    }

    const ContactTerm<dim> &
    contact() const
    {
      return dynamic_cast<const ContactTerm<dim> &>(*model.terms.back());
    }

    void
    run(const unsigned int n, const double dt)
    {
      for (unsigned int k = 0; k < n; ++k)
        {
          const auto report = step.attempt({time, dt});
          ASSERT_TRUE(report.accepted) << report.cause;
          step.commit();
          time += dt;
        }
    }

    Model<dim> model;
    Step<dim>  step;
    double     time = 0.;
  };

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
        auto &model = setting.model;
        setting.step.activate();
        StepEquations<dim>        equations(model.patches(),
                                     model.unknowns,
                                     model.terms,
                                     model.scheme,
                                     model.scene.linear_solver);
        std::vector<unsigned int> n_nodes;
        std::vector<int>          radius;
        for (const auto &field : model.fields)
          {
            n_nodes.push_back(field->patch.nodes.n_local());
            radius.push_back(field->tangent_radius);
          }
        equations.reinit(radius);
        Trial<dim> trial;
        trial.begin({0.02, 0.01}, model.unknowns, n_nodes);
        for (const auto &field : model.fields)
          ASSERT_TRUE(field->transfer->to_nodes(trial).success);
        for (auto &term : model.terms)
          term->start(trial);
        equations.start(trial, 0.);
        // from where the bodies press each other, and directions follow them no more
        double norm = 0.;
        equations.evaluate();
        for (const double part : {0.9, 0.1, 0.1})
          {
            ASSERT_TRUE(equations.solve_correction(norm, false).success);
            equations.retract(part);
            equations.evaluate();
          }
        unsigned int n_closed = 0;
        equations.evaluate();
        for (const auto &half : setting.contact().halves())
          for (const auto &sample : half.samples())
            n_closed += half.response(sample).pressure > 0.;
        EXPECT_GT(n_closed, 4u);
        test::expect_slope_of_residual(equations);
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
  EXPECT_EQ(a.size(), 4u); // two surfaces, two halves
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
