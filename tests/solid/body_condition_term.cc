// Motion prescribed on bodies by multipliers: the tangent, the books, and what the faces do.
#include "../equations/term_cloud.h"
#include "../scene/scene_text.h"

#include <kedge/simulation/equilibrium.h>
#include <kedge/simulation/step.h>

#include <cmath>

using namespace kedge;
using namespace scene_tests;

namespace
{
  std::string
  per_dimension(const std::string &a, const std::string &b, const std::string &c, const int dim)
  {
    return a + b + (dim == 3 ? c : "");
  }

  /** A block off the lines of the grid, with conditions on its left side and on a section. */
  template <int dim>
  std::string
  held_block(const std::string &scheme, const std::string &basis, const std::string &conditions)
  {
    return "set Dimension = " + std::to_string(dim) + R"(
subsection Grid
  set Extent = )" +
           per_dimension("3", ", 2", ", 1.6", dim) + R"(
  set Cells  = )" +
           per_dimension("15", ", 10", ", 8", dim) + R"(
end
subsection Materials
  subsection soft
    set Density         = 1000
    set Young's modulus = 1e5
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  subsection block
    set Geometry = )" +
           (dim == 2 ? "box(0.33, 0.5; 1.46, 1.25)" : "box(0.33, 0.5, 0.45; 1.46, 1.25, 1.08)") +
           R"(
    set Material = soft
    set Basis    = )" +
           basis + R"(
    set Initial velocity = )" +
           per_dimension("0.3 + 0.4*y", "; 0.2*x", "; 0.1", dim) + R"(
  end
end
subsection Body conditions
)" + conditions +
           R"(
end
subsection Time
  set Scheme = )" +
           scheme + R"(
  set End    = 1
  set Step   = 0.01
end
)";
  }

  /** A moved side, and a section that a force moves and that is held along an oblique direction. */
  template <int dim>
  std::string
  several()
  {
    return R"(
  subsection press
    set Body        = block
    set Side        = left
    set Component x = displacement(0.5*t^2 + 0.3*t)
    set Component y = velocity(0.4*t)
    set Reaction    = true
  end
  subsection middle
    set Body            = block
    set Section         = x, 1.0
    set Component x     = force(300*t)
    set Direction       = )" +
           per_dimension("0.2", ", 1", ", 0.3", dim) + R"(
    set Along direction = motion(0.1*x*dt)
    set Reaction        = true
  end)";
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
  class BodyConditions : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
} // namespace

TYPED_TEST_SUITE(BodyConditions, Dimensions);

TYPED_TEST(BodyConditions, TangentIsTheSlopeOfTheResidual)
{
  constexpr int dim = TypeParam::value;
  for (const char *basis : {"linear", "gimp"})
    for (const char *scheme : {"clc-midpoint", "newmark", "quasi-static"})
      {
        Setting<dim> setting(held_block<dim>(scheme, basis, several<dim>()));
        setting.run(2, 0.01);
        auto &model = setting.model;
        setting.step.activate();
        StepEquations<dim> equations(model.patches(),
                                     model.unknowns,
                                     model.terms,
                                     model.scheme,
                                     model.scene.linear_solver);
        equations.reinit({model.fields[0]->tangent_radius});
        Trial<dim> trial;
        trial.begin({0.02, 0.01}, model.unknowns, {model.fields[0]->patch.nodes.n_local()});
        if (model.fields[0]->transfer)
          {
            ASSERT_TRUE(model.fields[0]->transfer->to_nodes(trial).success);
          }
        for (auto &term : model.terms)
          term->start(trial);
        equations.start(trial, 0.);
        double norm = 0.;
        equations.evaluate();
        ASSERT_TRUE(equations.solve_correction(norm, false).success);
        equations.retract(0.7); // multipliers and displacements of some size
        test::expect_slope_of_residual(equations);
      }
}

// With the conserving scheme the work of the multipliers is all that changes the energy, though
// the block does not fit the conditions at the start: to Newton's residual of 1e-12 of the terms.
TYPED_TEST(BodyConditions, BooksClose)
{
  constexpr int dim = TypeParam::value;
  Setting<dim>  setting(held_block<dim>("clc-midpoint", "gimp", several<dim>()));
  const Ledger &ledger = setting.model.ledger;
  const double  energy = ledger.value("total_energy");
  setting.run(20, 0.01);
  EXPECT_GT(std::abs(ledger.value("external_work")), 0.05 * energy);
  EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11 * energy);
}

// Faces go with their points, x_p + F_p (X_f - X_p), by the functions in which they are moved: of
// the linear basis exactly, but for products of the offset's components in cells that twist. So
// their mean place moves as prescribed while the block is pressed and crosses cells: to 1e-4 of the
// way for offsets that shear by less than a tenth of half a point's width, 0.025 cells. The
// increments of a velocity linear in time are exact.
TYPED_TEST(BodyConditions, FacesMoveAsPrescribed)
{
  constexpr int     dim        = TypeParam::value;
  const std::string conditions = R"(
  subsection press
    set Body        = block
    set Side        = left
    set Component x = displacement(3*t)
    set Component y = velocity(4*t)
  end
  subsection middle
    set Body        = block
    set Section     = x, 1.0
    set Component x = displacement(2*t)
    set Component y = fixed
  end)";
  Setting<dim>      setting(held_block<dim>("quasi-static", "linear", conditions));
  setting.run(12, 0.01); // by 1.8 cells
  const auto mean_of_section = [&](const double section) {
    double                 area = 0.;
    dealii::Tensor<1, dim> sum;
    setting.model.points.points().for_each([&](const unsigned int,
                                               const std::uint64_t,
                                               const dealii::Point<dim> &location,
                                               const PointState<dim>    &state) {
      const double           half = state.reference_half_lengths[0];
      dealii::Tensor<1, dim> offset;
      offset[0] = section - state.reference_position[0];
      if (std::abs(offset[0]) > half * (1. + 1e-6))
        return;
      const double of_point = state.reference_volume / (2. * half);
      area += of_point;
      sum += of_point *
             (location + state.deformation_gradient * offset - (state.reference_position + offset));
    });
    return sum / area;
  };
  const auto left = mean_of_section(0.33), middle = mean_of_section(1.);
  EXPECT_NEAR(left[0], 3. * 0.12, 1e-4 * 0.36);
  EXPECT_NEAR(left[1], 2. * 0.12 * 0.12, 1e-4 * 0.36);
  EXPECT_NEAR(middle[0], 2. * 0.12, 1e-4 * 0.36);
  EXPECT_NEAR(middle[1], 0., 1e-4 * 0.36);
}

// A block of one cell whose sides are set in motion at once: all of its nodes have the prescribed
// velocity at the end of the first step and keep it, and so do the points, whose first
// velocity the nodes can represent. (The mean of a step's velocities alone would leave 2 v - v_0,
// v_0 ..)
TYPED_TEST(BodyConditions, AStartAtOnceDoesNotSwing)
{
  constexpr int dim        = TypeParam::value;
  std::string   conditions = "";
  for (const char *side : {"left", "right"})
    {
      conditions += std::string("  subsection ") + side +
                    "\n    set Body = block\n    set Side = " + side +
                    "\n    set Component x = velocity(1)\n    set Component y = fixed\n";
      conditions += dim == 3 ? "    set Component z = fixed\n  end\n" : "  end\n";
    }
  std::string       text  = held_block<dim>("clc-midpoint", "gimp", conditions);
  const std::size_t begin = text.find("box("), end = text.find(')', begin) + 1;
  text.replace(begin,
               end - begin,
               dim == 2 ? "box(0.4, 0.4; 0.6, 0.6)" : "box(0.4, 0.4, 0.4; 0.6, 0.6, 0.6)");
  Setting<dim>  setting(text);
  const Ledger &ledger = setting.model.ledger;
  for (unsigned int k = 0; k < 6; ++k)
    {
      setting.run(1, 0.01);
      EXPECT_NEAR(ledger.value("linear_momentum_x"),
                  ledger.value("mass"),
                  1e-11 * ledger.value("mass"));
      EXPECT_NEAR(ledger.value("linear_momentum_y"), 0., 1e-11 * ledger.value("mass"));
    }
}

// A block at rest under its weight that the stage of equilibrium has left in balance: the reaction
// stays its weight, although of schemes that carry it the acceleration at the start does not know
// the support (it would swing between 0 and twice the weight). Tolerance: what the change from the
// balance of the stage to that of the run leaves swinging in the block, 0.7 %.
TYPED_TEST(BodyConditions, ReactionsOfBodiesAtRestStandStill)
{
  constexpr int     dim        = TypeParam::value;
  const std::string conditions = R"(
  subsection clamp
    set Body        = block
    set Side        = left
    set Component x = fixed
    set Component y = fixed)" + std::string(dim == 3 ? "\n    set Component z = fixed" : "") +
                                 R"(
    set Reaction    = true
  end)";
  std::string text = held_block<dim>("newmark", "gimp", conditions);
  text += "subsection Body force\n  set Acceleration = " + per_dimension("0", "; -1", "; 0", dim) +
          "\nend\nsubsection Equilibrium\n  set Steps = 2\nend\n";
  const std::size_t begin = text.find("    set Initial velocity");
  text.replace(begin, text.find('\n', begin) - begin, "");
  const Scene<dim>            scene = read_scene<dim>(parse(text));
  std::ostringstream          log;
  const EquilibriumState<dim> state = find_equilibrium<dim>(scene, MPI_COMM_SELF, log);
  Model<dim>                  model(scene, MPI_COMM_SELF);
  Step<dim>                   step(model);
  model.create_points();
  model.points.replace(state.points);
  step.points_changed();
  step.initialise_points(0., true);
  step.book_state();
  const double weight = model.ledger.value("mass");
  for (unsigned int k = 0; k < 6; ++k)
    {
      ASSERT_TRUE(step.attempt({0.01 * k, 0.01}).accepted);
      step.commit();
      EXPECT_NEAR(model.ledger.value("reaction_clamp_y"), weight, 0.02 * weight);
    }
}

// As many equations as multipliers: of a body that is free the force decides alone.
TYPED_TEST(BodyConditions, AForceIsTheReaction)
{
  constexpr int     dim       = TypeParam::value;
  const std::string condition = R"(
  subsection press
    set Body        = block
    set Section     = x, 0.93
    set Component x = force(2*t)
    set Reaction    = true
  end)";
  for (const char *scheme : {"clc-midpoint", "newmark"})
    {
      Setting<dim>  setting(held_block<dim>(scheme, "gimp", condition));
      const Ledger &ledger = setting.model.ledger;
      const double  before = ledger.value("linear_momentum_x");
      setting.run(5, 0.01);
      const double of_step = 2. * (0.04 + setting.model.scheme.alpha_f * 0.01);
      EXPECT_NEAR(ledger.value("reaction_press_x"), of_step, 1e-9 * of_step);
      if (setting.model.scheme.conserving_stress) // the integral of 2 t to 0.05 s, by mid-points
        {
          EXPECT_NEAR(ledger.value("linear_momentum_x") - before, 0.05 * 0.05, 1e-12 * before);
        }
    }
}

TEST(BodyConditionScene, WrongEntriesAreRefused)
{
  const auto message = [](const std::string &entries) {
    return message_of(
      held_block<2>("quasi-static",
                    "gimp",
                    "  subsection press\n    set Body = block\n" + entries + "\n  end"));
  };
  const std::string fixed = "\n    set Component x = fixed", side = "    set Side = left";
  expect_parts(message(side), {"Body conditions/press/", "does nothing"});
  expect_parts(message(side + "\n    set Section = x, 1" + fixed),
               {"Only one of Side and Section"});
  expect_parts(message(fixed), {"Either Side or Section"});
  expect_parts(message("    set Section = z, 1" + fixed), {"Section = z, 1", "such as x, 5"});
  expect_parts(message("    set Section = x" + fixed), {"Section = x", "such as x, 5"});
  expect_parts(message(side + "\n    set Component x = forse(3)"), {"Did you mean 'force'?"});
  expect_parts(message(side + "\n    set Component x = force(x)"), {"Component x", "\"x\""});
  expect_parts(message(side + "\n    set Along direction = fixed"), {"needs a Direction"});
  expect_parts(message(side + "\n    set Direction = 1, 1"), {"Nothing is prescribed along"});
  expect_parts(message(side + "\n    set Direction = 0, 0\n    set Along direction = fixed"),
               {"must not be zero"});
  expect_parts(message(side + fixed + "\n    set Component y = fixed\n    set Direction = 1, 1" +
                       "\n    set Along direction = fixed"),
               {"All components are prescribed already"});
  expect_parts(message(side + fixed + "\n    set Where = t > 1"), {"Where", "\"t\""});
  expect_parts(message_of(held_block<2>("quasi-static", "gimp", several<2>()),
                          {"Linear solver/Method = krylov-ilu"}),
               {"Linear solver/Method = krylov-ilu", "Body conditions", "take auto or direct"});
}

TEST(BodyConditionScene, PlacesWithoutMaterialAreTheUsersError)
{
  const auto message = [](const std::string &entries) {
    try
      {
        Setting<2> setting(held_block<2>("quasi-static",
                                         "gimp",
                                         "  subsection press\n    set Body = block\n    set "
                                         "Component x = fixed\n" +
                                           entries + "\n  end"));
      }
    catch (const UserError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  expect_parts(message("    set Section = x, 2"),
               {"Body condition 'press'", "no material point of body 'block' on its Section"});
  expect_parts(message("    set Side = left\n    set Where = y > 5"),
               {"Body condition 'press'", "no exposed face"});
}
