// What the reader says of materials that yield, of motions, and of paths.
#include "scene_text.h"

#include <kedge/scene/path_scene.h>

using namespace scene_tests;

namespace
{
  /** The second material of the scene, with further lines. */
  std::string
  with_stiff(const std::string &lines)
  {
    return with("set Model = hencky", lines);
  }

  /** The same without the remedy against locking, which sand does not take. */
  std::string
  with_sand(const std::string &lines)
  {
    std::string       text   = with_stiff(lines);
    const std::string remedy = "    set Volume change = cell mean\n";
    return text.erase(text.find(remedy), remedy.size());
  }

  const std::string path_text = R"(set Title = A path
subsection Constants
  set g = 2
end
subsection Materials
  subsection soft
    set Density = 1000
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
  end
  subsection metal
    set Model = von_mises
    set Density = 8000
    set Young's modulus = 2e11
    set Poisson's ratio = 0.3
    set Yield radius rho_y = 2e8
    set Hardening modulus = 1e9
  end
end
subsection Path
  set Material = metal
  set Deformation gradient = 1, g*t, 0; 0, 1, 0; 0, 0, 1
  set End = 3
  set Steps = 30
end
subsection Checks
  subsection stress
    set Quantity = at(history.kirchhoff_stress_xy)
    set Time = 2
    set Reference = 1
    set Tolerance = 1 %
    set Source = a table
  end
end
)";

  std::string
  path_message(const std::string &setting)
  {
    try
      {
        ParameterFile file = parse(path_text);
        file.set(setting);
        read_path_scene(file);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace

TEST(ScenePlasticity, StrengthsMayDependOnThePlace)
{
  const auto read = [](const std::string &text) {
    return read_scene<2>(parse(text)).materials[1];
  };
  const auto clay = read(with_stiff("set Model = tresca\n"
                                    "    set Undrained strength = h*1e3*(5 - y)\n"
                                    "    set Remoulded strength ratio = 0.25"));
  EXPECT_EQ(clay.kind, MaterialKind::tresca);
  EXPECT_EQ(clay.undrained_strength.expression, "h*1e3*(5 - y)");
  EXPECT_EQ(clay.undrained_strength.entry, "Undrained strength");
  EXPECT_EQ(clay.remoulded_strength, 0.25);
  // a number is one
  EXPECT_EQ(read(with_stiff("set Model = tresca\n    set Undrained strength = 2e4"))
              .undrained_strength.expression,
            "");
  // von Mises takes a strength of clay or a yield stress
  EXPECT_EQ(read(with_stiff("set Model = von_mises\n    set Undrained strength = 2e4")).kind,
            MaterialKind::undrained_von_mises);
  expect_parts(message_of(with_stiff("set Model = von_mises\n    set Undrained strength = 2e4\n"
                                     "    set Yield radius rho_y = 1e6")),
               {"Yield radius rho_y = 1e6", "Only one"});
  expect_parts(message_of(with_stiff("set Model = tresca")),
               {"Materials/stiff/Undrained strength", "Model tresca needs it"});
  expect_parts(message_of(with_stiff("set Model = tresca\n    set Undrained strength = -1")),
               {"Undrained strength = -1", "greater than 0"});
  expect_parts(message_of(with_stiff("set Model = tresca\n    set Undrained strength = z*q")),
               {"Undrained strength = z*q", "an expression of x, y, z"});
  expect_parts(message_of(with_stiff("set Undrained strength = 1e3")),
               {"Undrained strength = 1e3", "belongs to models tresca and von_mises"});
}

TEST(ScenePlasticity, ShearBandsOfSomeCellsScaleTheSoftening)
{
  const auto read = [](const std::string &lines) {
    return read_scene<2>(parse(with_stiff("set Model = tresca\n    set Undrained strength = 1e4\n"
                                          "    set Softening shear strain = 6" +
                                          lines)))
      .materials[1];
  };
  EXPECT_EQ(read("").softening_strain, 6.);
  const auto   scene = read_scene<2>(parse(with_stiff("set Model = hencky")));
  const double edge  = scene.grid.extent[0] / scene.grid.n_cells[0];
  EXPECT_DOUBLE_EQ(read("\n    set Softening cell size = 0.3").softening_strain, 6. * 0.3 / edge);
}

TEST(ScenePlasticity, SandMustNotDilateMoreThanItRubs)
{
  const std::string sand     = "set Model = drucker_prager\n    set Cohesion = 1e3\n"
                               "    set Friction angle = 30\n    set Dilation angle = ";
  const auto        material = read_scene<2>(parse(with_sand(sand + "30"))).materials[1];
  EXPECT_EQ(material.kind, MaterialKind::drucker_prager);
  EXPECT_EQ(material.tension_cut_off, 0.8);
  EXPECT_EQ(material.apex_rounding, 0.1);
  expect_parts(message_of(with_sand(sand + "31")),
               {"Dilation angle = 31", "larger than the angle of friction, 30", "make energy"});
  expect_parts(message_of(with_sand("set Dilation angle = 5")), {"Dilation angle = 5", "belongs"});
  expect_parts(message_of(with_sand("set Model = mohr_coulomb\n    set Cohesion = 1e3")),
               {"Friction angle", "Model mohr_coulomb needs it"});
}

TEST(ScenePlasticity, TheYieldStressIsGivenInOneOfTwoWays)
{
  // sigma_y = sqrt(3/2) rho_y
  auto read = [](const std::string &text) {
    return read_scene<2>(parse(text)).materials[1];
  };
  const auto by_radius = read(with_stiff("set Model = von_mises\n"
                                         "    set Yield radius rho_y = h*2e6\n"
                                         "    set Hardening modulus = 3e5"));
  EXPECT_EQ(by_radius.kind, MaterialKind::von_mises);
  EXPECT_NEAR(by_radius.yield_stress.value, 2449489.742783178, 1e-8);
  EXPECT_EQ(by_radius.hardening_modulus, 3e5);
  const auto by_stress =
    read(with_stiff("set Model = von_mises\n    set Uniaxial yield stress sigma_y = 2e6"));
  EXPECT_EQ(by_stress.yield_stress.value, 2e6);
  EXPECT_EQ(by_stress.hardening_modulus, 0.);
  EXPECT_EQ(read(full_scene).kind, MaterialKind::hencky);
}

TEST(ScenePlasticity, YieldEntriesThatDoNotFitAreRefused)
{
  expect_parts(message_of(with_stiff("set Model = von_mises")),
               {"folder/beam.prm:24: Materials/stiff/Yield radius rho_y",
                "Either Yield radius rho_y or Uniaxial yield stress sigma_y must be given"});
  expect_parts(message_of(with_stiff("set Model = von_mises\n"
                                     "    set Yield radius rho_y = 1e6\n"
                                     "    set Uniaxial yield stress sigma_y = 2e6")),
               {"folder/beam.prm:27: Materials/stiff/Uniaxial yield stress sigma_y = 2e6",
                "Only one of"});
  expect_parts(message_of(with_stiff("set Model = hencky\n    set Yield radius rho_y = 1e6")),
               {"Materials/stiff/Yield radius rho_y = 1e6", "does not yield", "von_mises?"});
  expect_parts(message_of(with_stiff("set Uniaxial yield stress sigma_y = 1e6")),
               {"Materials/stiff/Uniaxial yield stress sigma_y = 1e6", "does not yield"});
  expect_parts(message_of(with_stiff("set Hardening modulus = 1e6")),
               {"Materials/stiff/Hardening modulus = 1e6", "does not harden"});
  const std::string yielding = "set Model = von_mises\n    set Yield radius rho_y = 1e6\n    ";
  expect_parts(message_of(with_stiff(yielding + "set Hardening modulus = -1")),
               {"Materials/stiff/Hardening modulus = -1", "at least 0"});
  for (const std::string value : {"0", "-3"})
    expect_parts(message_of(
                   with_stiff("set Model = von_mises\n    set Yield radius rho_y = " + value)),
                 {"Materials/stiff/Yield radius rho_y = " + value, "greater than 0"});
  expect_parts(message_of(with_stiff("set Model = von_misses")), {"Did you mean 'von_mises'?"});
}

TEST(ScenePlasticity, MotionsOfNodesAreRead)
{
  const auto scene =
    read_scene<2>(parse(with("Component x = fixed", "Component x = motion(x*(exp(dt) - h) + t)")));
  const auto &component = scene.node_conditions[0].components[0];
  EXPECT_EQ(component.kind, ConditionKind::motion);
  EXPECT_EQ(component.expression, "x*(exp(dt) - h) + t");
  const std::string entry = "Node conditions/wall/Component x = ";
  expect_parts(message_of(full_scene, {entry + "motion(X)"}), {"\"X\"", "motion(expression"});
  expect_parts(message_of(full_scene, {entry + "moton(x)"}), {"Did you mean 'motion'?"});
  expect_parts(message_of(full_scene, {"Constants/dt = 2", entry + "motion(x*dt)"}),
               {"give the constant dt another name"});
}

TEST(ScenePath, IsReadWithItsMaterial)
{
  const PathScene scene = read_path_scene(parse(path_text));
  EXPECT_EQ(scene.name, "beam");
  EXPECT_EQ(scene.title, "A path");
  EXPECT_EQ(scene.material.name, "metal");
  EXPECT_EQ(scene.material.hardening_modulus, 1e9);
  EXPECT_EQ(scene.path.kind, PathParameters::Kind::deformation_gradient);
  EXPECT_EQ(scene.path.deformation_gradient[1], "g*t");
  EXPECT_EQ(scene.path.deformation_gradient[8], "1");
  EXPECT_EQ(scene.path.end, 3.);
  EXPECT_EQ(scene.path.n_steps, 30u);
  ASSERT_EQ(scene.checks.size(), 1u);
  EXPECT_EQ(scene.checks[0].time, 2.);
  // what is written back reads the same
  EXPECT_EQ(read_path_scene(parse(scene.parameters)).parameters, scene.parameters);
}

TEST(ScenePath, WhatDoesNotFitIsRefused)
{
  expect_parts(path_message("Path/Material = metl"), {"no Materials/metl", "'metal'"});
  expect_parts(path_message("Path/Logarithmic strain = t; 0; 0"), {"Only one of"});
  expect_parts(path_message("Path/Deformation gradient ="),
               {"Either Deformation gradient or Logarithmic strain"});
  expect_parts(path_message("Path/Deformation gradient = 1, 0, 0"), {"9 expressions", "not 3"});
  expect_parts(path_message("Path/Deformation gradient = 1, x, 0; 0, 1, 0; 0, 0, 1"), {"\"x\""});
  expect_parts(path_message("Path/Steps = 0"), {"at least 1"});
  expect_parts(path_message("Path/End = 0"), {"greater than 0"});
  expect_parts(path_message("Checks/stress/Time = 4"), {"Checks/stress/Time = 4"});
  expect_parts(path_message("Checks/stress/Quantity = last(probe.a.pressure)"), {"no Probes/a"});
  expect_parts(path_message("Bodies/b/Basis = gimp"), {"no section 'Bodies'"});
  // a scene holds no path
  expect_parts(message_of(full_scene, {"Path/Steps = 3"}), {"no section 'Path'"});
}
