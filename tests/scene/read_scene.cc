#include "scene_text.h"

using namespace scene_tests;



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
  EXPECT_EQ(scene.materials[0].volume_change, VolumeChange::pointwise);
  EXPECT_EQ(scene.materials[1].volume_change, VolumeChange::cell_mean);

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
  EXPECT_EQ(again.materials[1].volume_change, VolumeChange::cell_mean);
  EXPECT_EQ(again.node_conditions[1].where, scene.node_conditions[1].where);
  EXPECT_EQ(again.time.break_times, scene.time.break_times);
  EXPECT_EQ(again.checks[2].exact, scene.checks[2].exact);
  // defaults are written too
  expect_parts(scene.parameters, {"set Hardening modulus             = 0", "set Scale     = 1"});

  const Scene<3> solid = read_scene<3>(parse(small_scene));
  EXPECT_EQ(read_scene<3>(parse(solid.parameters)).parameters, solid.parameters);
}
