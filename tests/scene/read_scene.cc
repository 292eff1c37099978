#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/scene/read_scene.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace kedge;

// Expected values are those written in the scenes. Numbers given as formulas
// differ from them by the rounding of a few operations.

namespace
{
  constexpr double rounding = 1e-14;

  const std::string full_scene = R"(# a beam that says everything
set Dimension = 2
set Title = Cantilever

subsection Constants
  set force = load_per_length*h   # uses constants defined below it
  set h = 1
  set L = 10*h
  set load_per_length = 1e5
end

subsection Grid
  set Origin = 0, -5
  set Extent = L + 1, L
  set Cells  = (L + 1)/0.1, 20
end

subsection Materials
  subsection soft
    set Density = 1000
    set Young's modulus = 12e6
    set Poisson's ratio = 0.2
  end
  subsection stiff
    set Model = hencky
    set Density = 2000
    set Young's modulus = 12e7
    set Poisson's ratio = -0.1
  end
end

subsection Bodies
  subsection beam
    set Geometry = box(0, -h/2; L, h/2)
    set Material = stiff
    set Points per cell = 3
    set Basis = linear
    set Initial velocity = 0; max(x, y)*h
    set Body force = false
  end
  subsection ball
    set Geometry = ball(5, 3; h)
    set Material = soft
    set Points per cell = 2, 4
  end
end

subsection Node conditions
  subsection wall
    set Side = x-
    set Component x = fixed
  end
  subsection pin
    set Where = abs(x) < 1e-6 && abs(y) < 1e-6
    set Component x = velocity(sin(2*pi*t)*h)
    set Component y = displacement(t*L)
  end
end

subsection Body force
  set Acceleration = 0; -9.81
end

subsection Point loads
  subsection end load
    set Body = beam
    set Place = L, 0
    set Points = 2
    set Force = 0; -force*min(t, 1)
  end
end

subsection Tractions
  subsection top
    set Body = beam
    set Side = top
    set Where = x > L/2
    set Traction = 0; -1e3*t
  end
end

subsection Time
  set Scheme = generalised-alpha
  set Start = 1
  set End = 1 + 2*h
  set Step = 15 initial cfl
  set Smallest step factor = 1/64
  set Break times = 2.5, 2, 2.5
  set Newmark beta = 0.3
  set Newmark gamma = 0.6
  set Spectral radius = 0.9
  set Carry acceleration = false
end

subsection Newton
  set Tolerance = 1e-9
  set Iterations = 15
end

subsection Linear solver
  set Method = krylov-ilu
  set Tolerance = 1e-12
  set Iterations = 77
end

subsection Mapping
  set Velocity = pic
  set Lumping = 0.5
  set Audit = true
end

subsection Output
  set Points interval = 0.25
  set Points every steps = 4
  set Fields = displacement, det_F
  set Formats = hdf5
  set Grid = true
  set Checkpoint every steps = 10
  set Checkpoint interval = 5
  set Progress interval = 2
end

subsection Probes
  subsection tip
    set Body = beam
    set Place = L, 0
  end
  subsection end face
    set Face = right
  end
end

subsection Checks
  subsection deflection
    set Quantity = at(probe.tip.displacement_y)
    set Time = 2
    set Reference = -8.28
    set Tolerance = 0.5 %
    set Source = a table
  end
  subsection energy
    set Quantity = drift(history.total_energy)
    set Scale = 2*L
    set Tolerance = 1e-9
    set Source = conservation
  end
  subsection stress
    set Quantity = point_error(cauchy_stress_yy)
    set Exact = -80*(L - Y)
    set Tolerance = 1e-3
    set Source = closed form
  end
end
)";

  const std::string small_scene = R"(set Dimension = 3
subsection Grid
  set Extent = 1, 2, 3
  set Cells = 1, 2, 3
end
subsection Materials
  subsection steel
    set Density = 8000
    set Young's modulus = 2e11
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  subsection cube
    set Geometry = box(0, 0, 0; 1, 1, 1)
    set Material = steel
  end
end
subsection Time
  set End = 2
  set Step = 0.1
end
)";

  ParameterFile
  parse(const std::string &text)
  {
    std::istringstream input(text);
    return ParameterFile::read(input, "folder/beam.prm");
  }

  /** The error that a scene gives once some options are set. */
  template <int dim = 2>
  std::string
  message_of(const std::string &text, const std::vector<std::string> &settings = {})
  {
    try
      {
        ParameterFile file = parse(text);
        for (const std::string &setting : settings)
          file.set(setting);
        read_scene<dim>(file);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "no error";
  }

  /** The scene with a line added after the first one that holds @p after. */
  std::string
  with_line(const std::string &after, const std::string &line)
  {
    std::string       text = full_scene;
    const std::size_t end  = text.find('\n', text.find(after));
    return text.insert(end + 1, line + "\n");
  }

  /** The scene with the first @p from replaced. */
  std::string
  with(const std::string &from, const std::string &to)
  {
    std::string       text     = full_scene;
    const std::size_t position = text.find(from);
    EXPECT_NE(position, std::string::npos) << from;
    return text.replace(position, from.size(), to);
  }

  void
  expect_parts(const std::string &message, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos)
        << "missing: " << part << "\nin: " << message;
  }
} // namespace



TEST(SceneRead, GridMaterialsAndBodies)
{
  const ParameterFile file = parse(full_scene);
  EXPECT_EQ(scene_dimension(file), 2u);
  const Scene<2> scene = read_scene<2>(file);
  EXPECT_EQ(scene.name, "beam");
  EXPECT_EQ(scene.title, "Cantilever");
  EXPECT_EQ(scene.constants.at("L"), 10);
  EXPECT_EQ(scene.constants.at("force"), 1e5);
  EXPECT_EQ(scene.grid.origin, dealii::Point<2>(0, -5));
  EXPECT_NEAR(scene.grid.extent[0], 11, rounding);
  EXPECT_EQ(scene.grid.n_cells, (std::array<unsigned int, 2>{{110, 20}})); // 11/0.1 is not whole

  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[1].name, "stiff");
  EXPECT_EQ(scene.materials[1].density, 2000);
  EXPECT_EQ(scene.materials[1].young_modulus, 12e7);
  EXPECT_EQ(scene.materials[1].poisson_ratio, -0.1);

  ASSERT_EQ(scene.bodies.size(), 2u);
  const BodyParameters<2> &beam = scene.bodies[0];
  EXPECT_EQ(beam.name, "beam");
  EXPECT_EQ(beam.material, 1u);
  EXPECT_EQ(beam.points_per_cell, (std::array<unsigned int, 2>{{3, 3}}));
  EXPECT_EQ(beam.basis, BasisKind::linear);
  EXPECT_EQ(beam.initial_velocity, (std::array<std::string, 2>{{"0", "max(x, y)*h"}}));
  EXPECT_FALSE(beam.body_force);
  EXPECT_TRUE(beam.geometry->contains({10., .5}));
  EXPECT_FALSE(beam.geometry->contains({10., .6}));
  EXPECT_EQ(scene.bodies[1].material, 0u);
  EXPECT_EQ(scene.bodies[1].points_per_cell, (std::array<unsigned int, 2>{{2, 4}}));
  EXPECT_EQ(scene.bodies[1].basis, BasisKind::gimp);
  EXPECT_TRUE(scene.bodies[1].body_force);
}

TEST(SceneRead, ConditionsAndLoads)
{
  const Scene<2> scene = read_scene<2>(parse(full_scene));
  ASSERT_EQ(scene.node_conditions.size(), 2u);
  const auto &wall = scene.node_conditions[0];
  EXPECT_EQ(wall.name, "wall");
  EXPECT_TRUE(wall.on_side);
  EXPECT_EQ(wall.side, 0u);
  EXPECT_EQ(wall.components[0].kind, ConditionKind::fixed);
  EXPECT_EQ(wall.components[1].kind, ConditionKind::free);
  const auto &pin = scene.node_conditions[1];
  EXPECT_FALSE(pin.on_side);
  EXPECT_EQ(pin.where, "abs(x) < 1e-6 && abs(y) < 1e-6");
  EXPECT_EQ(pin.components[0].kind, ConditionKind::velocity);
  EXPECT_EQ(pin.components[0].expression, "sin(2*pi*t)*h");
  EXPECT_EQ(pin.components[1].kind, ConditionKind::displacement);
  EXPECT_EQ(pin.components[1].expression, "t*L");

  EXPECT_EQ(scene.body_force, (std::array<std::string, 2>{{"0", "-9.81"}}));
  ASSERT_EQ(scene.point_loads.size(), 1u);
  EXPECT_EQ(scene.point_loads[0].name, "end load");
  EXPECT_EQ(scene.point_loads[0].body, "beam");
  EXPECT_EQ(scene.point_loads[0].place, dealii::Point<2>(10, 0));
  EXPECT_EQ(scene.point_loads[0].n_points, 2u);
  EXPECT_EQ(scene.point_loads[0].force[1], "-force*min(t, 1)");
  // the texts are expressions of t and the scene's constants
  EXPECT_EQ(Expression(scene.point_loads[0].force[1], {"t"}, scene.constants)({.5}), -5e4);
  ASSERT_EQ(scene.tractions.size(), 1u);
  EXPECT_EQ(scene.tractions[0].side, 3u);
  EXPECT_EQ(scene.tractions[0].where, "x > L/2");
  EXPECT_EQ(scene.tractions[0].traction[1], "-1e3*t");
}

TEST(SceneRead, TimeAndSolvers)
{
  const Scene<2> scene = read_scene<2>(parse(full_scene));
  EXPECT_EQ(scene.time.scheme, SchemeKind::generalised_alpha);
  EXPECT_EQ(scene.time.start, 1);
  EXPECT_EQ(scene.time.end, 3);
  EXPECT_EQ(scene.time.step_kind, StepSizeKind::cfl_initial);
  EXPECT_EQ(scene.time.cfl_factor, 15);
  EXPECT_EQ(scene.time.minimum_step_factor, 1. / 64);
  EXPECT_EQ(scene.time.break_times, (std::vector<double>{2, 2.5})); // sorted, each once
  EXPECT_EQ(scene.time.newmark_beta, 0.3);
  EXPECT_EQ(scene.time.newmark_gamma, 0.6);
  EXPECT_EQ(scene.time.spectral_radius, 0.9);
  EXPECT_FALSE(scene.time.carry_acceleration);
  EXPECT_EQ(scene.newton.tolerance, 1e-9);
  EXPECT_EQ(scene.newton.max_iterations, 15u);
  EXPECT_EQ(scene.linear_solver.kind, LinearSolverKind::krylov_ilu);
  EXPECT_EQ(scene.linear_solver.tolerance, 1e-12);
  EXPECT_EQ(scene.linear_solver.max_iterations, 77u);
  EXPECT_EQ(scene.transfer.velocity_mapping, VelocityUpdate::pic);
  EXPECT_EQ(scene.transfer.lumping, 0.5);
  EXPECT_TRUE(scene.transfer.audit);
}

TEST(SceneRead, OutputProbesAndChecks)
{
  const Scene<2> scene = read_scene<2>(parse(full_scene));
  EXPECT_EQ(scene.output.points_interval, 0.25);
  EXPECT_EQ(scene.output.points_every_steps, 4u);
  EXPECT_EQ(scene.output.fields, (std::vector<std::string>{"displacement", "det_F"}));
  EXPECT_FALSE(scene.output.vtu);
  EXPECT_TRUE(scene.output.hdf5 && scene.output.grid);
  EXPECT_EQ(scene.output.checkpoint_every_steps, 10u);
  EXPECT_EQ(scene.output.checkpoint_interval, 5);
  EXPECT_EQ(scene.output.progress_interval, 2);

  ASSERT_EQ(scene.probes.size(), 2u);
  EXPECT_EQ(scene.probes[0].body, "beam");
  EXPECT_FALSE(scene.probes[0].face_mean);
  EXPECT_EQ(scene.probes[0].place, dealii::Point<2>(10, 0));
  EXPECT_EQ(scene.probes[1].name, "end face");
  EXPECT_EQ(scene.probes[1].body, "");
  EXPECT_TRUE(scene.probes[1].face_mean);
  EXPECT_EQ(scene.probes[1].side, 1u);

  ASSERT_EQ(scene.checks.size(), 3u);
  EXPECT_EQ(scene.checks[0].statistic, CheckStatistic::at);
  EXPECT_EQ(scene.checks[0].column, "probe.tip.displacement_y");
  EXPECT_EQ(scene.checks[0].time, 2);
  EXPECT_EQ(scene.checks[0].reference, -8.28);
  EXPECT_NEAR(scene.checks[0].tolerance, 0.005, rounding);
  EXPECT_TRUE(scene.checks[0].relative);
  EXPECT_EQ(scene.checks[0].source, "a table");
  EXPECT_EQ(scene.checks[1].statistic, CheckStatistic::drift);
  EXPECT_EQ(scene.checks[1].time, 1); // the start
  EXPECT_EQ(scene.checks[1].scale, 20);
  EXPECT_FALSE(scene.checks[1].relative);
  EXPECT_EQ(scene.checks[2].column, "cauchy_stress_yy");
  EXPECT_EQ(scene.checks[2].exact, "-80*(L - Y)");
}

TEST(SceneRead, DefaultsIn3D)
{
  const Scene<3> scene = read_scene<3>(parse(small_scene));
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(scene.grid.origin, dealii::Point<3>());
  EXPECT_EQ(scene.bodies[0].points_per_cell, (std::array<unsigned int, 3>{{2, 2, 2}}));
  EXPECT_EQ(scene.bodies[0].initial_velocity[2], "0");
  EXPECT_EQ(scene.body_force[2], "0");
  EXPECT_EQ(scene.time.scheme, SchemeKind::clc_midpoint);
  EXPECT_EQ(scene.time.step_kind, StepSizeKind::fixed);
  EXPECT_EQ(scene.time.step, 0.1);
  EXPECT_NEAR(scene.output.points_interval, 2. / 50, rounding); // a fiftieth of the run
  EXPECT_TRUE(scene.output.vtu);
  EXPECT_FALSE(scene.output.hdf5);

  // what the file leaves out is what the structs say
  EXPECT_EQ(scene.time.minimum_step_factor, TimeParameters().minimum_step_factor);
  EXPECT_EQ(scene.time.newmark_beta, TimeParameters().newmark_beta);
  EXPECT_EQ(scene.time.newmark_gamma, TimeParameters().newmark_gamma);
  EXPECT_EQ(scene.time.spectral_radius, TimeParameters().spectral_radius);
  EXPECT_EQ(scene.time.carry_acceleration, TimeParameters().carry_acceleration);
  EXPECT_EQ(scene.newton.tolerance, NewtonParameters().tolerance);
  EXPECT_EQ(scene.newton.max_iterations, NewtonParameters().max_iterations);
  EXPECT_EQ(scene.linear_solver.kind, LinearSolverParameters().kind);
  EXPECT_EQ(scene.linear_solver.tolerance, LinearSolverParameters().tolerance);
  EXPECT_EQ(scene.linear_solver.max_iterations, LinearSolverParameters().max_iterations);
  EXPECT_EQ(scene.transfer.velocity_mapping, TransferParameters().velocity_mapping);
  EXPECT_EQ(scene.transfer.lumping, TransferParameters().lumping);
  EXPECT_EQ(scene.output.checkpoint_interval, OutputParameters().checkpoint_interval);
  EXPECT_EQ(scene.output.progress_interval, OutputParameters().progress_interval);
}

TEST(SceneRead, StepIsSecondsOrAFactor)
{
  ParameterFile file = parse(full_scene);
  file.set("Time/Step = h/8");
  EXPECT_EQ(read_scene<2>(file).time.step, 0.125);
  EXPECT_EQ(read_scene<2>(file).time.step_kind, StepSizeKind::fixed);
  file.set("Time/Step = 2*h cfl");
  EXPECT_EQ(read_scene<2>(file).time.cfl_factor, 2);
  EXPECT_EQ(read_scene<2>(file).time.step_kind, StepSizeKind::cfl_nodal);
}

TEST(SceneRead, OptionsWinOverTheFile)
{
  ParameterFile file = parse(full_scene);
  file.set("Bodies/ball/Points per cell = 5");
  file.set("Constants/L = 9");
  file.set("Newton/Iterations = 3");
  file.set("Probes/middle/Place = L/2, 0");
  const Scene<2> scene = read_scene<2>(file);
  EXPECT_EQ(scene.bodies[1].points_per_cell, (std::array<unsigned int, 2>{{5, 5}}));
  EXPECT_EQ(scene.grid.n_cells[0], 100u);
  EXPECT_EQ(scene.newton.max_iterations, 3u);
  ASSERT_EQ(scene.probes.size(), 3u);
  EXPECT_EQ(scene.probes[2].place, dealii::Point<2>(4.5, 0));
}

TEST(SceneRead, WrittenParametersRunAgainAsTheyAre)
{
  ParameterFile file = parse(full_scene);
  file.set("Constants/L = 9");
  const Scene<2> scene = read_scene<2>(file);
  const Scene<2> again = read_scene<2>(parse(scene.parameters));
  EXPECT_EQ(again.parameters, scene.parameters);
  EXPECT_EQ(again.constants, scene.constants);
  EXPECT_EQ(again.grid.n_cells, scene.grid.n_cells);
  EXPECT_EQ(again.bodies[0].name, "beam");
  EXPECT_EQ(again.bodies[0].material, 1u);
  EXPECT_EQ(again.materials[1].young_modulus, 12e7);
  EXPECT_EQ(again.node_conditions[1].where, scene.node_conditions[1].where);
  EXPECT_EQ(again.time.break_times, scene.time.break_times);
  EXPECT_EQ(again.checks[2].exact, scene.checks[2].exact);
  // defaults are written too
  expect_parts(scene.parameters, {"set Model           = hencky", "set Scale     = 1"});

  const Scene<3> solid = read_scene<3>(parse(small_scene));
  EXPECT_EQ(read_scene<3>(parse(solid.parameters)).parameters, solid.parameters);
}

TEST(SceneRead, UnknownNamesAreAnsweredWithTheNearest)
{
  expect_parts(message_of(with("set Title", "set Titel")),
               {"folder/beam.prm:3: ", "Titel", "Did you mean 'Title'?"});
  expect_parts(message_of(with("subsection Grid", "subsection Gird")),
               {"folder/beam.prm:12: ", "'Gird'", "Did you mean 'Grid'?"});
  expect_parts(message_of(with("set Density", "set Densty")),
               {"folder/beam.prm:20: ", "Materials/soft/Densty", "Did you mean 'Density'?"});
  expect_parts(message_of(with("set Component x = fixed", "set Component z = fixed")),
               {"Node conditions/wall/Component z", "'Component x'"});
  expect_parts(message_of(with("Material = stiff", "Material = stif")),
               {"Bodies/beam/Material = stif", "Materials/stif", "Did you mean 'stiff'?"});
  expect_parts(message_of(with("Scheme = generalised-alpha", "Scheme = generalized-alpha")),
               {"Time/Scheme = generalized-alpha", "did you mean generalised-alpha?"});
  expect_parts(message_of(with("displacement, det_F", "displacement, detF")),
               {"Output/Fields", "did you mean det_F?"});
  expect_parts(message_of(with("Side = x-", "Side = lft")), {"did you mean left?"});
  expect_parts(message_of(with("Side = x-", "Side = back")), {"one of left, right, bottom, top"});
  expect_parts(message_of(with("probe.tip.", "probe.tp.")),
               {"Checks/deflection/Quantity", "Did you mean 'tip'?"});
  expect_parts(message_of(with("drift(", "drfit(")), {"did you mean drift?"});
  expect_parts(message_of(with("velocity(sin", "velocty(sin")), {"did you mean velocity?"});
  expect_parts(message_of(full_scene, {"Bodies/bem/Points per cell = 2"}),
               {"option --set: Bodies/bem/", "Did you mean 'beam'?"});
  expect_parts(message_of(full_scene, {"Boddies/beam/Basis = gimp"}),
               {"option --set: ", "Did you mean 'Bodies'?"});
  for (const char *load : {"end load/Body", "top/Body"})
    expect_parts(message_of(full_scene,
                            {(load[0] == 'e' ? "Point loads/" : "Tractions/") + std::string(load) +
                             " = baem"}),
                 {"There is no Bodies/baem", "Did you mean 'beam'?"});
  expect_parts(message_of(full_scene, {"Probes/tip/Body = baem"}), {"Did you mean 'beam'?"});
}

TEST(SceneRead, WrongValuesAreAnsweredWithWhatIsAllowed)
{
  struct Case
  {
    std::string entry, value, problem;
  };
  const std::vector<Case> cases = {
    {"Materials/soft/Density", "-3", "greater than 0"},
    {"Materials/soft/Density", "heavy", "\"heavy\""},
    {"Materials/soft/Young's modulus", "0", "greater than 0"},
    {"Materials/soft/Poisson's ratio", "0.5", "greater than -1 and less than 0.5"},
    {"Materials/soft/Poisson's ratio", "-1", "greater than -1"},
    {"Materials/soft/Density", "", "must be given"},
    {"Grid/Cells", "0, 3", "at least 1"},
    {"Grid/Cells", "2.5, 3", "whole number"},
    {"Grid/Cells", "3", "2 numbers"},
    {"Grid/Extent", "1, 2, 3", "2 numbers separated by commas or semicolons, not 3"},
    {"Grid/Extent", "0, 1", "greater than 0"},
    {"Bodies/beam/Geometry", "", "must be given"},
    {"Bodies/beam/Geometry", "blob(1)", "There is no shape 'blob'"},
    {"Bodies/beam/Geometry", "box(0, 0; 12, 1)", "from 0 to 12 in direction x, the grid"},
    {"Bodies/beam/Points per cell", "0", "at least 1"},
    {"Bodies/beam/Points per cell", "1, 2, 3", "2 numbers"},
    {"Bodies/beam/Body force", "yes", "true, false"},
    {"Bodies/beam/Initial velocity", "0", "2 expressions"},
    {"Bodies/beam/Initial velocity", "0; t", "\"t\""},
    {"Node conditions/wall/Where", "x < 1", "Only one of Side and Where"},
    {"Node conditions/wall/Side", "", "Either Side or Where"},
    {"Node conditions/wall/Component x", "free", "does nothing"},
    {"Node conditions/wall/Component x", "velocity(x)", "\"x\""},
    {"Node conditions/pin/Where", "x = 0", "=="},
    {"Body force/Acceleration", "0; -g", "\"g\""},
    {"Point loads/end load/Points", "0", "at least 1"},
    {"Tractions/top/Side", "up", "did you mean top?"},
    {"Time/End", "1", "later than Start = 1"},
    {"Time/Step", "0", "greater than 0"},
    {"Time/Step", "cfl", "write for example 15 cfl"},
    {"Time/Step", "15 clf", "FACTOR initial cfl"},
    {"Time/Break times", "0.5", "later than Start"},
    {"Time/Break times", "4", "not after End"},
    {"Time/Smallest step factor", "2", "at most 1"},
    {"Time/Spectral radius", "1.1", "at most 1"},
    {"Newton/Tolerance", "0", "greater than 0"},
    {"Newton/Iterations", "0", "at least 1"},
    {"Mapping/Lumping", "-1", "at least 0"},
    {"Output/Formats", "vtk", "did you mean vtu?"},
    {"Output/Points interval", "-1", "at least 0"},
    {"Probes/tip/Face", "left", "Only one of Place and Face"},
    {"Probes/tip/Place", "", "Either Place or Face"},
    {"Checks/deflection/Quantity", "history.mass", "statistic(column)"},
    {"Checks/deflection/Quantity", "last(mass)", "history.COLUMN or probe.NAME.COLUMN"},
    {"Checks/deflection/Quantity", "last(probe.tip)", "probe.NAME.COLUMN"},
    {"Checks/stress/Quantity", "point_error(history.mass)", "field of the material points"},
    {"Checks/deflection/Time", "", "needs the time"},
    {"Checks/deflection/Time", "4", "between Time/Start and Time/End"},
    {"Checks/deflection/Exact", "X", "point_error only"},
    {"Checks/stress/Exact", "", "needs the exact field"},
    {"Checks/stress/Exact", "x", "\"x\""},
    {"Checks/deflection/Reference", "", "known answer must be given"},
    {"Checks/deflection/Tolerance", "-1 %", "at least 0"},
    {"Checks/deflection/Scale", "0", "greater than 0"},
    {"Checks/deflection/Source", "", "must be given"}};
  for (const auto &[entry, value, problem] : cases)
    expect_parts(message_of(full_scene, {entry + " = " + value}),
                 {"option --set: ", entry, value, problem});
}

TEST(SceneRead, ErrorsNameFileAndLine)
{
  expect_parts(message_of(with("Reference = -8.28", "Reference = 0")),
               {":138: Checks/deflection/Tolerance = 0.5 %", "percentage of the reference 0"});
  expect_parts(message_of(with("Density = 1000", "Density = -1000")),
               {"folder/beam.prm:20: Materials/soft/Density = -1000: ", "greater than 0"});
  expect_parts(message_of(with("    set Density = 1000\n", "")),
               {"folder/beam.prm:19: Materials/soft/Density must be given: a number"});
  expect_parts(message_of(with("set End = 1 + 2*h", "set End = 1")),
               {"folder/beam.prm:85: Time/End = 1: "});
}

TEST(SceneRead, NamesAreUniqueAndSimple)
{
  expect_parts(message_of(full_scene + "subsection Bodies\nsubsection beam\nend\nend\n"),
               {"folder/beam.prm:", "the name Bodies/beam is given a second time; line 33"});
  expect_parts(message_of(with("subsection tip", "subsection t.p")),
               {"the name 't.p' may not hold"});
  expect_parts(message_of(with("subsection beam", "subsection a/b")), {"'a/b' may not hold"});
}

TEST(SceneRead, EntriesStandWhereTheyBelong)
{
  expect_parts(message_of(with_line("subsection Bodies", "set Material = soft")),
               {"Bodies/Material", "Bodies/<name>/<entry>"});
  expect_parts(message_of(with_line("subsection Grid", "subsection fine\nend")),
               {"Grid/fine", "no subsections"});
  expect_parts(message_of(with_line("subsection beam", "subsection part\nend")),
               {"Bodies/beam/part", "one level only"});
  expect_parts(message_of(full_scene, {"Grid/fine/Cells = 3"}), {"Section Grid holds no"});
}

TEST(SceneRead, ConstantsAreChecked)
{
  expect_parts(message_of(with("set h = 1", "set h = 1\n  set t = 3")),
               {":8: Constants/t", "is taken"});
  expect_parts(message_of(with("set h = 1", "set h = 1\n  set 2a = 3")),
               {"Constants/2a", "letters"});
  expect_parts(message_of(with("set h = 1", "set h = 1\n  set sin = 3")), {"Constants/sin"});
  expect_parts(message_of(with("set h = 1", "set h = L/10")),
               {"Constants/", "each needs another", "force, h, L"});
  expect_parts(message_of(with("set h = 1", "set h = 1 + foo")), {":7: Constants/h", "\"foo\""});
  expect_parts(message_of(with("set h = 1", "set h =")), {":7: Constants/h", "empty"});
}

TEST(SceneRead, TheDimensionIsNeededAndObeyed)
{
  const auto message = [](const std::string &text) {
    try
      {
        scene_dimension(parse(text));
      }
    catch (const UserError &error)
      {
        return std::string(error.what());
      }
    return std::string("no error");
  };
  EXPECT_EQ(scene_dimension(parse(small_scene)), 3u);
  expect_parts(message("set Dimension = 4"),
               {"beam.prm:1: Dimension = 4", "2 (plane strain) or 3"});
  expect_parts(message("set Title = a"), {"beam.prm: Dimension must be given"});
  expect_parts(message("set Dimensoin = 3"), {"Did you mean 'Dimension'?"});
  expect_parts(message_of<3>(full_scene), {"3"});
}

TEST(SceneRead, ASceneNeedsABody)
{
  const std::size_t begin = small_scene.find("subsection Bodies");
  const std::size_t end   = small_scene.find("subsection Time");
  const std::string text  = small_scene.substr(0, begin) + small_scene.substr(end);
  expect_parts(message_of<3>(text), {"has no body", "Bodies/<name>"});
  expect_parts(message_of<3>(text + "subsection Bodies\nend\n"), {"beam.prm:17: ", "has no body"});
}

TEST(ScenePrintParameters, ShowsEveryEntryWithUnitDefaultAndAllowedValues)
{
  std::ostringstream out;
  print_parameters(out);
  expect_parts(out.str(),
               {"subsection Bodies\n  subsection <name>\n",
                "# Mass per volume of the undeformed body [kg/m^3].\n"
                "    # Allowed: a number greater than 0.\n"
                "    # Must be given.\n"
                "    set Density =\n",
                "# Default: clc-midpoint\n  set Scheme = clc-midpoint\n"});

  // it has the form of a scene, and every entry of a scene stands in it
  const ParameterFile printed = parse(out.str());
  for (const ParameterEntry &entry : parse(read_scene<3>(parse(small_scene)).parameters).entries)
    {
      std::vector<std::string> section = entry.section;
      if (section.size() == 2)
        section[1] = "<name>";
      const bool found =
        std::any_of(printed.entries.begin(), printed.entries.end(), [&](const auto &other) {
          return other.section == section && other.name == entry.name;
        });
      EXPECT_TRUE(found) << entry.name;
    }
}
