// Rigid bodies and lines: tangents, books, what they refuse.
#include "../contact/two_blocks.h"
#include "../equations/term_cloud.h"

#include <kedge/rigid/rigid_bodies.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  /** Two bodies that tumble in space: one hangs on a moving anchor, the other on it. */
  std::string
  two_bodies(const std::string &lines)
  {
    return R"(
set Dimension = 3
subsection Rigid bodies
  subsection upper
    set Mass             = 2
    set Centre           = 0, 0, -1
    set Inertia          = 0.1, 0.2, 0.25, 0.01, 0.02, 0
    set Angular velocity = 1, -2, 0.5
    set Velocity         = 1, 0, 0
    set Rotation y       = force(0.3*t)
  end
  subsection lower
    set Geometry    = box(-0.2, -0.1, -2.3; 0.3, 0.1, -2)
    set Density     = 50
    set Velocity    = 0, 1, -0.2
    set Component x = displacement(0.1*t^2)
  end
end
subsection Lines
)" + lines +
           R"(
end
subsection Body force
  set Acceleration = 0; 0; -9.81
end
subsection Time
  set End    = 1
  set Step   = 0.05
end
)";
  }

  const std::string elastic = R"(
  subsection hook
    set Body       = upper
    set Attachment = 0.1, 0.2, -0.8
    set Anchor     = 0.1*t; 0; 0.05*sin(t)
    set Length     = 0.8 - 0.1*t
    set Stiffness  = 300
  end
  subsection between
    set Body             = lower
    set Attachment       = 0.3, 0.1, -2
    set Other body       = upper
    set Other attachment = -0.1, 0, -1.1
    set Length           = 0.9
    set Stiffness        = 200
  end
)",
                    stiff   = R"(
  subsection hook
    set Body       = upper
    set Attachment = 0.1, 0.2, -0.8
    set Anchor     = 0.1*t; 0; 0.05*sin(t)
    set Pushes     = true
  end
  subsection between
    set Body             = lower
    set Attachment       = 0.3, 0.1, -2
    set Other body       = upper
    set Other attachment = -0.1, 0, -1.1
    set Pushes           = true
  end
)";

  std::string
  with_line(const std::string &entries)
  {
    return two_bodies("  subsection hook\n    set Body = upper\n" + entries + "\n  end\n");
  }

  std::string
  error_of_model(const std::string &text)
  {
    try
      {
        Setting<3> setting(text);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(RigidTerms, TangentIsTheSlopeOfTheResidual)
{
  for (const std::string &lines : {elastic, stiff})
    {
      Setting<3> setting(two_bodies(lines));
      setting.run(2, 0.05);
      setting.start_step(0.2);
      setting.correct({0.5, 0.3});
      test::expect_slope_of_residual(*setting.equations);
    }
}

TEST(RigidTerms, BooksCloseWhateverActs)
{
  for (const std::string &lines : {elastic, stiff})
    for (const double dt : {0.01, 0.1})
      {
        Setting<3> setting(two_bodies(lines));
        setting.run(10, dt);
        const Ledger &ledger = setting.model.ledger;
        EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11);
        EXPECT_GT(std::abs(ledger.value("external_work")), 0.01);
        EXPECT_NEAR(ledger.value("position_lower_x"), 0.05 + 0.1 * std::pow(10 * dt, 2), 1e-12);
      }
}

TEST(RigidTerms, MassPropertiesOfAShape)
{
  Setting<3>  setting(two_bodies(elastic));
  const auto &bodies = *setting.model.rigid();
  EXPECT_NEAR(bodies[1].mass, 50 * 0.5 * 0.2 * 0.3, 1e-13);
  EXPECT_NEAR(bodies[1].inertia[0][0], bodies[1].mass * (0.2 * 0.2 + 0.3 * 0.3) / 12, 1e-14);
  EXPECT_NEAR(bodies[1].inertia[2][2], bodies[1].mass * (0.5 * 0.5 + 0.2 * 0.2) / 12, 1e-14);
  EXPECT_NEAR(bodies[1].inertia[0][1], 0., 1e-14);
}

TEST(RigidTerms, ALineWithoutStretchStopsWhatItHolds)
{
  const std::string rope = R"(
  subsection hook
    set Body   = upper
    set Anchor = 0; 0; 0
    set Length = 1.1
  end
)";
  Setting<3>        setting(two_bodies(rope));
  setting.run(40, 0.01);
  const Ledger &ledger = setting.model.ledger;
  EXPECT_LE(ledger.value("stretch_hook"), 1e-12);
  EXPECT_GT(ledger.value("tension_hook"), 0.);
  EXPECT_GT(ledger.value("line_dissipation"), 0.1);
  EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-11);
}

TEST(RigidScene, RefusesWhatCannotBe)
{
  expect_parts(message_of<3>(with_line("")), {"Lines/hook/Anchor", "Either Anchor or Other body"});
  expect_parts(message_of<3>(with_line("    set Other body = upper")),
               {"Lines/hook/Other body", "the same body"});
  expect_parts(message_of<3>(with_line("    set Anchor = 0;0;0\n    set Other attachment = 0,0,0")),
               {"Lines/hook/Other attachment", "no Other body"});
  expect_parts(message_of<3>(with_line("    set Other body = lowe")),
               {"Lines/hook/Other body", "lower"});
  const auto body = [](const std::string &entry) {
    return message_of<3>(two_bodies(elastic), {"Rigid bodies/upper/" + entry});
  };
  expect_parts(body("Inertia = 1, 2"), {"Rigid bodies/upper/Inertia", "3 numbers"});
  expect_parts(body("Angular velocity = 1, 2"), {"Angular velocity", "3 numbers"});
  expect_parts(body("Component x = motion(x)"), {"Component x", "moves as a whole"});
  expect_parts(body("Mass = 0"), {"Rigid bodies/upper/Mass", "greater than 0"});
  expect_parts(error_of_model(with_line("    set Anchor = 0;0;-1\n    set Length = t")),
               {"Lines/hook/Length", "no length"});
  expect_parts(error_of_model(with_line("    set Anchor = 0;0;-1\n    set Length = 1\n"
                                        "    set Pushes = true")),
               {"Lines/hook/Pushes", "points nowhere"});
  expect_parts(error_of_model(with_line("    set Anchor = 0;0;2\n    set Length = 1")),
               {"Lines/hook/Length", "does not stretch"});
}

TEST(RigidScene, BodiesNeedMassAndInertia)
{
  const auto error = [](const std::string &entries) {
    return error_of_model("set Dimension = 3\nsubsection Rigid bodies\n  subsection a\n" + entries +
                          "\n  end\nend\nsubsection Time\n  set End = 1\n  set Step = 0.1\nend\n");
  };
  expect_parts(error("    set Geometry = ball(0, 0, 0; 1)"), {"a/Density", "no mass"});
  expect_parts(error("    set Mass = 1"), {"a/Centre", "without a Geometry"});
  expect_parts(error("    set Mass = 1\n    set Centre = 0,0,0\n    set Inertia = 1, -1, 1"),
               {"a/Inertia", "positive"});
  EXPECT_EQ(error("    set Geometry = ball(0, 0, 0; 1)\n    set Density = 1"), "");
}
