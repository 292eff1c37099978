// Joints between rigid bodies: tangent, conservation, stops, friction, what is refused.
#include "../contact/two_blocks.h"
#include "../equations/term_cloud.h"

#include <kedge/rigid/rigid_bodies.h>

using namespace kedge;
using namespace contact_tests;

namespace
{
  std::string
  scene(const unsigned int dim, const std::string &bodies, const std::string &joints)
  {
    return "set Dimension = " + std::to_string(dim) + "\nsubsection Rigid bodies\n" + bodies +
           "end\nsubsection Joints\n" + joints +
           "end\nsubsection Time\n  set End = 100\n  set Step = 0.05\nend\n";
  }

  /** Two boxes that tumble in space, one on the other. */
  const std::string tumblers = R"(
  subsection upper
    set Geometry         = box(0, 0, 0; 0.4, 0.3, 0.2)
    set Density          = 100
    set Angular velocity = 1, -2, 0.5
    set Velocity         = 1, 0, 0
    set Rotation y       = force(0.3*t)
  end
  subsection lower
    set Geometry         = box(0, 0, -0.5; 0.4, 0.3, 0)
    set Density          = 50
    set Angular velocity = 1, -2, 0.5
    set Velocity         = VELOCITY
  end
)";

  std::string
  joint(const std::string &entries)
  {
    return "  subsection pin\n    set Body = upper\n" + entries + "\n  end\n";
  }

  const std::string between = "    set Other body = lower\n    set Place = 0.2, 0.1, 0\n",
                    hinge   = "    set Axis = 1, 2, 0.5\n",
                    full    = hinge + "    set Lowest angle = -0.02\n    set Highest angle = 0.01\n"
                                      "    set Stop stiffness = 50\n    set Friction moment = 0.4\n",
                    fixed   = "    set Kind = fixed\n";

  std::string
  two_tumblers(const std::string &joints, const std::string &velocity = "1, 0, 0")
  {
    std::string bodies = tumblers;
    bodies.replace(bodies.find("VELOCITY"), 8, velocity);
    return scene(3, bodies, joints);
  }
} // namespace

TEST(Joints, TangentIsTheSlopeOfTheResidual)
{
  for (const std::string &kind : {hinge, full, fixed})
    for (const std::string &ends : {between, std::string("    set Place = 0.1, 0, 0.1\n")})
      {
        Setting<3> setting(two_tumblers(joint(ends + kind)));
        setting.run(2, 0.05);
        setting.start_step(0.1);
        setting.correct({0.5, 0.3});
        test::expect_slope_of_residual(*setting.equations);
      }
}

/** Without a moment nor friction all is kept, for any step, to the round-off of hundreds of them.
 */
TEST(Joints, KeepEnergyAndMomenta)
{
  for (const std::string &kind :
       {hinge,
        hinge + "    set Highest angle = 0.3\n    set Lowest angle = -0.1\n"
                "    set Stop stiffness = 40\n",
        fixed})
    for (const double dt : {0.01, 0.1})
      {
        std::string text = two_tumblers(joint(between + kind));
        text.replace(text.find("force(0.3*t)"), 12, "free");
        Setting<3>                     setting(text);
        const Ledger                  &ledger = setting.model.ledger;
        const double                   energy = ledger.value("total_energy");
        const std::vector<std::string> kept   = {"linear_momentum_x",
                                                 "linear_momentum_z",
                                                 "angular_momentum_x",
                                                 "angular_momentum_y",
                                                 "angular_momentum_z"};
        std::vector<double>            before;
        for (const auto &name : kept)
          before.push_back(ledger.value(name));
        double largest_energy = 0.;
        for (unsigned int step = 0; step < 3. / dt; ++step)
          {
            setting.run(1, dt);
            largest_energy = std::max(largest_energy, ledger.value("joint_energy"));
            EXPECT_LT(ledger.value("joint_gap_pin"), 1e-11);
          }
        EXPECT_NEAR(ledger.value("total_energy"), energy, 1e-11 * energy);
        for (std::size_t k = 0; k < kept.size(); ++k)
          EXPECT_NEAR(ledger.value(kept[k]), before[k], 1e-11 * energy) << kept[k];
        if (kind.size() > 100)
          {
            EXPECT_GT(largest_energy, 1e-3); // it has struck a stop
          }
      }
}

/**
 * Two halves that are welded move as the whole does, which is a scene without a joint. Both are of
 * order two, but not the same map: differences fall by four with half the step.
 */
TEST(Joints, WeldedHalvesMoveAsOneBody)
{
  const auto half = [](const std::string &name, const std::string &box, const std::string &v) {
    return "  subsection " + name + "\n    set Geometry = " + box +
           "\n    set Density = 10\n    set Angular velocity = 1, 2, 3\n    set Velocity = " + v +
           "\n  end\n";
  };
  // the centres are 0.5 from the whole's, along x: omega x r = (0, 3, -2) 0.5
  const std::string halves = half("upper", "box(0, 0, 0; 1, 0.6, 0.3)", "0, -1.5, 1") +
                             half("lower", "box(1, 0, 0; 2, 0.6, 0.3)", "0, 1.5, -1");
  std::array<double, 2> off{};
  for (const unsigned int fineness : {0, 1})
    {
      Setting<3> two(
        scene(3,
              halves,
              joint("    set Other body = lower\n    set Place = 1, 0.3, 0.15\n" + fixed)));
      Setting<3> one(scene(3, half("upper", "box(0, 0, 0; 2, 0.6, 0.3)", "0, 0, 0"), ""));
      two.run(20u << fineness, 0.02 / (1u << fineness));
      one.run(20u << fineness, 0.02 / (1u << fineness));
      for (const std::string axis : {"x", "y", "z"})
        {
          const double turned = two.model.ledger.value("rotation_upper_" + axis);
          off[fineness] =
            std::max(off[fineness],
                     std::abs(turned - one.model.ledger.value("rotation_upper_" + axis)));
          EXPECT_NEAR(turned, two.model.ledger.value("rotation_lower_" + axis), 1e-11);
        }
    }
  EXPECT_LT(off[0], 2e-3);
  EXPECT_GT(off[0], 3.5 * off[1]);
  EXPECT_LT(off[0], 4.5 * off[1]);
}

/** A wheel that turns with 2 rad/s and is braked by M stops after I w / M = 1 s and w^2 I / (2 M)
 * = 1 rad. A step turns by an angle a where cay has 2 tan(a/2): a^3/12 less, 3e-5 in all steps;
 * velocities and work know nothing of that. */
TEST(Joints, FrictionBrakesAndHolds)
{
  Setting<2>    setting(scene(2,
                           "  subsection upper\n    set Mass = 3\n    set Centre = 0, 0\n"
                              "    set Inertia = 0.5\n    set Angular velocity = 2\n  end\n",
                           joint("    set Place = 0, 0\n    set Friction moment = 1\n")));
  const Ledger &ledger = setting.model.ledger;
  setting.run(50, 0.01);
  EXPECT_NEAR(ledger.value("body_rate_upper_z"), 1., 1e-12);
  EXPECT_NEAR(ledger.value("joint_angle_pin"), 0.75, 5e-5);
  EXPECT_NEAR(ledger.value("joint_moment_pin_z"), -1., 1e-12);
  setting.run(70, 0.01);
  EXPECT_NEAR(ledger.value("joint_angle_pin"), 1., 5e-5);
  EXPECT_NEAR(ledger.value("joint_dissipation"), 1., 1e-10);
  EXPECT_NEAR(ledger.value("energy_error"), 0., 1e-12);
}

TEST(JointScene, RefusesWhatCannotBe)
{
  const auto message = [](const std::string &entries) {
    return message_of<3>(two_tumblers(joint(entries)));
  };
  expect_parts(message(""), {"Joints/pin/Place", "must be given"});
  expect_parts(message("    set Place = 0,0,0"), {"Joints/pin/Axis", "needs an axis"});
  expect_parts(message("    set Place = 0,0,0\n    set Axis = 0,0,0"), {"Axis", "somewhere"});
  expect_parts(message(between + "    set Kind = hing"), {"Joints/pin/Kind", "hinge"});
  expect_parts(message("    set Other body = lowe\n    set Place = 0,0,0"),
               {"Joints/pin/Other body", "lower"});
  expect_parts(message("    set Other body = upper\n    set Place = 0,0,0"),
               {"Joints/pin/Other body", "between two bodies"});
  expect_parts(message(between + hinge + "    set Highest angle = 0.1"),
               {"Joints/pin/Stop stiffness", "needs it"});
  expect_parts(message(between + hinge + "    set Highest angle = -0.1"),
               {"Joints/pin/Highest angle", "from the start"});
  expect_parts(message(between + hinge + "    set Lowest angle = 0.1"),
               {"Joints/pin/Lowest angle", "from the start"});
  expect_parts(message(between + hinge + "    set Stop stiffness = 0"),
               {"Joints/pin/Stop stiffness", "greater than 0"});
  expect_parts(message(between + fixed + "    set Highest angle = 1"),
               {"Joints/pin/Highest angle", "does not turn"});
  expect_parts(message(between + fixed + "    set Friction moment = 1"),
               {"Joints/pin/Friction moment", "does not turn"});
}
