# Saturated soil in the conserving scheme. scenes.cmake says how.
kedge_add_scene_test(scene.saturated_tumbling prm/saturated_tumbling.prm COMPARE_RANKS 1e-9)
kedge_add_scene_test(scene.saturated_tumbling_3d prm/saturated_tumbling_3d.prm COMPARE_RANKS 1e-9)
# bodies that part: ties change their weights and nothing else (a kept weight is 1e-3 off here)
kedge_add_scene_test(scene.saturated_impact prm/saturated_impact.prm COMPARE_RANKS 1e-9)
kedge_add_scene_test(scene.saturated_impact.yields prm/saturated_impact.prm
  SET "Materials/soil/Model = von_mises" "Materials/soil/Uniaxial yield stress sigma_y = 5e4")
kedge_add_scene_test(scene.saturated_contact tests/scenes/saturated_contact.prm COMPARE_RANKS 1e-6)
kedge_add_scene_test(scene.dry_on_saturated tests/scenes/dry_on_saturated.prm)
# the checks can fail: the u-p equations leave out the fluid's own acceleration
kedge_add_scene_test(scene.saturated_impact.strict prm/saturated_impact.prm
  SET "Time/Scheme = midpoint" EXPECT_EXIT 2 OPTIONS --strict
  EXPECT_STDOUT "FAIL energy" EXPECT_STDERR "^$")
kedge_add_scene_test(scene.biot_column prm/biot_column.prm COMPARE_RANKS 1e-7)
kedge_add_scene_test(scene.rock_wave prm/rock_wave.prm)
kedge_add_scene_test(scene.falling_soil.conserving prm/falling_soil.prm
  SET "Time/Scheme = clc-midpoint")
kedge_add_scene_test(scene.mandel.conserving prm/mandel.prm SET "Time/Scheme = clc-midpoint")
kedge_add_scene_test(scene.saturated_tumbling.cfl prm/saturated_tumbling.prm
  SET "Time/Step = 5 cfl" "Constants/steps = 10")
kedge_add_scene_test(refusal.saturated_initial_cfl prm/saturated_tumbling.prm
  SET "Time/Step = 5 initial cfl" EXPECT_EXIT 1
  EXPECT_STDERR "Time/Step.*FACTOR cfl or FACTOR density cfl" LABELS refusal)
kedge_add_scene_test(refusal.pore_pressure_beyond_fluid prm/saturated_tumbling.prm
  SET "Bodies/block/Initial pore pressure = 2*K_f" EXPECT_EXIT 1
  EXPECT_STDERR "Initial pore pressure: 2e.* stands no more than that" LABELS refusal)
# no pores are left: the cause is told by itself
kedge_add_scene_test(scene.gibson.conserving prm/gibson.prm
  SET "Time/Scheme = clc-midpoint" "Output/Points interval = 0" EXPECT_EXIT 2 EXPECT_STDERR "^$"
  EXPECT_STDOUT "stopped at t = [0-9.]+ s: material point")
kedge_add_restart_test(scene.restart.biot_column prm/biot_column.prm KILLS 1
  SET "Constants/n = 20" "Constants/dt = 1e-3" "Output/Checkpoint every steps = 5")
kedge_add_scene_test(refusal.conserving_coarse prm/saturated_tumbling.prm
  SET "Pore fluid/Pressure space = coarse" "Pore fluid/Stabilisation = " EXPECT_EXIT 1
  EXPECT_STDERR "Pore fluid/Pressure space.*clc-midpoint it must be equal" LABELS refusal)
kedge_add_scene_test(refusal.conserving_quadratic prm/saturated_tumbling.prm
  SET "Bodies/block/Basis = quadratic" EXPECT_EXIT 1
  EXPECT_STDERR "Time/Scheme.*not with the quadratic" LABELS refusal)
kedge_add_scene_test(refusal.conserving_ghosts prm/saturated_tumbling.prm
  SET "Stabilisation/Method = ghost" EXPECT_EXIT 1
  EXPECT_STDERR "Stabilisation/Method.*aggregation or none" LABELS refusal)
kedge_add_scene_test(scene.saturated_impact.filtered prm/saturated_impact.prm
  SET "Pore fluid/Velocity filter = 0.5")
kedge_add_scene_test(refusal.velocity_filter prm/saturated_tumbling.prm
  SET "Pore fluid/Velocity filter = 1.5" EXPECT_EXIT 1
  EXPECT_STDERR "Pore fluid/Velocity filter" LABELS refusal)
kedge_add_scene_test(refusal.stabilisation_theta prm/saturated_tumbling.prm
  SET "Pore fluid/Stabilisation theta = 0.4" EXPECT_EXIT 1
  EXPECT_STDERR "Pore fluid/Stabilisation theta" LABELS refusal)

# books over steps, conductivities, fluids and bases, in two and three dimensions
kedge_add_test(saturated_books COMMAND ${Python3_EXECUTABLE}
  ${CMAKE_CURRENT_SOURCE_DIR}/saturated_books.py $<TARGET_FILE:kedge>
  ${CMAKE_CURRENT_BINARY_DIR}/saturated_books ${PROJECT_SOURCE_DIR}/prm LABELS scene)
