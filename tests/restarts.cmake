# Runs that are killed and resumed.
kedge_add_restart_test(scene.restart.outflow prm/outflow.prm KILLS 1
  SET "Output/Checkpoint every steps = 5")
# the first checkpoints before, the last ones after the body has left with its surface
kedge_add_restart_test(scene.restart.outflow_after_collision prm/outflow_after_collision.prm
  KILLS 2 SET "Output/Checkpoint every steps = 5")
kedge_add_restart_test(scene.restart prm/spinning_body.prm KILLS 3
  SET "Time/End = 10" "Output/Checkpoint every steps = 5" "Newton/Log = true"
    "Mapping/Audit = true")
kedge_add_restart_test(scene.restart.ghost prm/spinning_body.prm KILLS 1
  SET "Time/End = 10" "Output/Checkpoint every steps = 5" "Stabilisation/Method = ghost")
kedge_add_restart_test(scene.restart.fields prm/crossing_bodies.prm KILLS 1
  SET "Output/Checkpoint every steps = 5")
# surfaces and closed contacts go on where they were
kedge_add_restart_test(scene.restart.contact prm/block_on_incline.prm KILLS 1
  SET "Output/Checkpoint every steps = 5")
kedge_add_restart_test(scene.restart.facets tests/scenes/turning_under_pressure.prm KILLS 1
  SET "Output/Checkpoint every steps = 5")
# the clock goes on in the steps that Newton's method has found good
kedge_add_restart_test(scene.restart.adapted_steps prm/collapse.prm KILLS 1
  SET "Constants/points = 6" "Constants/steps = 160" "Time/Largest step factor = 4"
    "Output/Checkpoint every steps = 4")
kedge_add_restart_test(scene.restart.2ranks prm/quickstart.prm KILLS 2 RANKS 2
  SET "Time/End = 0.5" "Output/Checkpoint every steps = 5")

# nothing that a Krylov solver keeps outlives its step
kedge_add_restart_test(scene.restart.krylov_ilu.2ranks prm/spinning_body.prm KILLS 1 RANKS 2
  SET "Time/End = 10" "Output/Checkpoint every steps = 5" "Linear solver/Method = krylov-ilu")
kedge_add_restart_test(scene.restart.krylov_amg prm/column_quasi_static.prm KILLS 1
  SET "Output/Checkpoint every steps = 3" "Linear solver/Method = krylov-amg")
kedge_add_restart_test(scene.restart.multigrid benchmarks/multigrid/block.prm KILLS 1
  SET "Constants/n = 6" "Constants/steps = 12" "Output/Checkpoint every steps = 3"
    "Linear solver/Method = krylov-amg")
kedge_add_restart_test(scene.restart.krylov_blocks benchmarks/saturated/strip.prm KILLS 1
  SET "Constants/steps = 24" "Output/Checkpoint every steps = 4"
    "Linear solver/Method = krylov-blocks")

kedge_add_test(scene.change_ranks LABELS scene restart RANKS 2
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/change_ranks.py
    $<TARGET_FILE:kedge> ${KEDGE_MPIRUN} ${PROJECT_SOURCE_DIR}
    ${CMAKE_CURRENT_BINARY_DIR}/scenes/change_ranks 1e-9)
kedge_add_test(scene.stop_mpirun LABELS scene restart RANKS 2
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/stop_mpirun.py
    $<TARGET_FILE:kedge> ${KEDGE_MPIRUN} ${PROJECT_SOURCE_DIR}
    ${CMAKE_CURRENT_BINARY_DIR}/scenes/stop_mpirun)
kedge_add_test(scene.stop_and_resume LABELS scene restart
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/stop_and_resume.py
    $<TARGET_FILE:kedge> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/scenes/stop_and_resume)
# the load factor found so far goes into the checkpoint
kedge_add_restart_test(scene.restart.load_control prm/load_control.prm KILLS 1
  SET "Constants/n = 8" "Constants/a = 2.4" "Time/Step = 0.004" "Output/Checkpoint every steps = 20"
    "Output/Points interval = 0")
