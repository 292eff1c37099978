# The scenes of rigid bodies and lines that are run as tests.

# energy and momentum to round-off for any step; errors that fall by four when the step is halved
kedge_add_scene_test(scene.free_top prm/free_top.prm COMPARE_RANKS 1e-12)
kedge_add_scene_test(scene.free_top.short_steps prm/free_top.prm SET "Constants/dt = 0.01")
kedge_add_scene_test(scene.free_top.long_steps prm/free_top.prm SET "Constants/dt = 0.9")
foreach(angle 5 60 90 150)
  kedge_add_scene_test(scene.pendulum.${angle} prm/pendulum.prm SET "Constants/angle = ${angle}")
endforeach()
foreach(k 1e5 1e6 1e7)
  kedge_add_scene_test(scene.pendulum.k_${k} prm/pendulum.prm
    SET "Constants/angle = 60" "Constants/k = ${k}" "Lines/rod/Stiffness = k"
      "Lines/rod/Pushes = false")
endforeach()
# joints hold their places and do no work
kedge_add_scene_test(scene.double_pendulum prm/double_pendulum.prm COMPARE_RANKS 1e-9)
kedge_add_scene_test(scene.double_pendulum.short_steps prm/double_pendulum.prm
  SET "Constants/dt = 0.001")
kedge_add_restart_test(scene.restart.double_pendulum prm/double_pendulum.prm KILLS 1
  SET "Constants/dt = 2e-4" "Output/Checkpoint every steps = 500")
kedge_add_scene_test(scene.anchor_swing prm/anchor_swing.prm)
kedge_add_scene_test(scene.anchor_swing.long_steps prm/anchor_swing.prm SET "Constants/dt = 0.01")
kedge_add_scene_test(scene.slack_line prm/slack_line.prm COMPARE_RANKS 1e-9)
kedge_add_restart_test(scene.restart.slack_line prm/slack_line.prm KILLS 1
  SET "Constants/dt = 1e-4" "Output/Checkpoint every steps = 500")
# where bodies are drawn is where the books have them
kedge_add_test(scene.rigid_pictures LABELS scene
  COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/rigid_pictures.py
    $<TARGET_FILE:kedge> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/scenes/rigid_pictures)
# contact with soil: a rigid box strikes a column
kedge_add_scene_test(scene.box_on_column prm/box_on_column.prm)
kedge_add_scene_test(scene.box_on_column.ranks prm/box_on_column.prm RANKS 2)
kedge_add_scene_test(scene.box_on_column.finer prm/box_on_column.prm SET "Constants/h = 0.025")
kedge_add_restart_test(scene.restart.box_on_column prm/box_on_column.prm KILLS 1
  SET "Constants/h = 0.025" "Output/Checkpoint every steps = 20")
# tools on elastic and plastic ground
kedge_add_scene_test(scene.platen prm/platen.prm)
kedge_add_scene_test(scene.platen.off_the_lines prm/platen.prm SET "Constants/shift = 0.37")
foreach(alpha 0 1)
  kedge_add_scene_test(scene.strip_rigid.alpha_${alpha} prm/strip_rigid.prm
    SET "Constants/alpha = ${alpha}")
endforeach()
foreach(alpha 0 1)
  kedge_add_scene_test(scene.circle_rigid.alpha_${alpha} prm/circle_rigid.prm
    SET "Constants/alpha = ${alpha}")
endforeach()
foreach(alpha 0 0.5 1)
  kedge_add_scene_test(scene.t_bar.alpha_${alpha} prm/t_bar.prm SET "Constants/alpha = ${alpha}")
endforeach()
kedge_add_scene_test(scene.anchor_plate prm/anchor_plate.prm)
kedge_add_scene_test(scene.anchor_plate.along prm/anchor_plate.prm SET "Constants/along = 1")
# contacts on facets that are divided are handed on
kedge_add_scene_test(scene.flattened_by_tool tests/scenes/flattened_by_tool.prm)
kedge_add_scene_test(scene.flattened_by_tool.in_motion tests/scenes/flattened_by_tool.prm
  SET "Time/Scheme = clc-midpoint" "Time/Step = 5e-3" "Constants/books = 1e-11"
    "Constants/tolerance = 2")
kedge_add_scene_test(scene.wedge_push_in prm/wedge_push_in.prm)
foreach(alpha 0 1)
  kedge_add_scene_test(scene.blade.alpha_${alpha} prm/blade.prm SET "Constants/alpha = ${alpha}")
endforeach()
foreach(angle 0 10 20 30)
  kedge_add_scene_test(scene.sledge.${angle} prm/sledge.prm SET "Constants/angle = ${angle}")
endforeach()
kedge_add_scene_test(scene.anchor_tow prm/anchor_tow.prm)
# set down on clay and pulled at, on a coarse grid and for a short time
kedge_add_scene_test(scene.anchor_clay prm/anchor_clay.prm
  SET "Constants/h = 0.8" "Constants/lay = 1" "Constants/drag = 0.2")
# a stage of equilibrium before it: the line's energy is that of the run's start
kedge_add_scene_test(scene.sledge.rough prm/sledge.prm
  SET "Constants/mu = 0.5" "Equilibrium/Steps = 1")
kedge_add_scene_test(scene.sphere_rolling prm/sphere_rolling.prm)
kedge_add_scene_test(scene.sphere_rolling.slides prm/sphere_rolling.prm SET "Constants/mu = 0.1")
kedge_add_scene_test(refusal.rigid_scheme prm/free_top.prm
  SET "Time/Scheme = newmark" EXPECT_EXIT 1
  EXPECT_STDERR "Rigid bodies: Time/Scheme must be" LABELS refusal)
kedge_add_scene_test(refusal.rigid_without_grid prm/quickstart.prm
  SET "Grid/Extent = " EXPECT_EXIT 1 EXPECT_STDERR "Grid/Extent must be given" LABELS refusal)
