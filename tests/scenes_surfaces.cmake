# The scenes of loads and motions at bodies' surfaces, and of conditions at nodes that lose what they hold.

# surface loads: uniform stress to round-off wherever the block ends within a cell
kedge_add_scene_test(scene.patch_traction prm/patch_traction.prm)
foreach(shift 0 0.5 0.97)
  kedge_add_scene_test(scene.patch_traction.${shift} prm/patch_traction.prm
    SET "Constants/shift = ${shift}" "Bodies/block/Points per cell = 3")
endforeach()
kedge_add_scene_test(scene.patch_traction.3d tests/scenes/patch_traction_3d.prm)
kedge_add_scene_test(scene.patch_traction.3d.cut tests/scenes/patch_traction_3d.prm
  SET "Constants/shift = 0.81")
# oblique and curved sides: facets; a square that turns under a pressure
kedge_add_scene_test(scene.patch_oblique prm/patch_oblique.prm)
kedge_add_scene_test(scene.patch_oblique.elsewhere prm/patch_oblique.prm
  SET "Constants/shift = 0.5" "Constants/angle = 0.7")
kedge_add_scene_test(scene.patch_oblique.triangle prm/patch_oblique.prm
  SET "Bodies/block/Geometry = polygon(-0.1, 0.1; 1.03, 0.17; 0.31, 1.1)"
      "Constants/area = 0.55065")
kedge_add_scene_test(scene.lame_cylinder prm/lame_cylinder.prm)
kedge_add_scene_test(scene.lame_cylinder.finer prm/lame_cylinder.prm SET "Constants/n = 32")
kedge_add_scene_test(scene.plate_with_hole prm/plate_with_hole.prm)
kedge_add_scene_test(scene.plate_with_hole.coarser prm/plate_with_hole.prm SET "Constants/n = 8")
kedge_add_scene_test(scene.cooks_membrane prm/cooks_membrane.prm)
kedge_add_scene_test(scene.lame_sphere prm/lame_sphere.prm)
kedge_add_scene_test(scene.lame_cylinder_limit prm/lame_cylinder_limit.prm)
kedge_add_scene_test(scene.turning_under_pressure tests/scenes/turning_under_pressure.prm)
# facets on several processes, which share out cells that they run through
kedge_add_scene_test(scene.patch_oblique.ranks prm/patch_oblique.prm RANKS 2)
kedge_add_scene_test(scene.lame_sphere.ranks prm/lame_sphere.prm RANKS 2)
kedge_add_scene_test(refusal.where_holds_nothing prm/patch_oblique.prm
  SET "Tractions/sides/Where = nx > 2" EXPECT_EXIT 1
  EXPECT_STDERR "finds no exposed face" LABELS refusal)
kedge_add_scene_test(scene.dead_load_tension prm/dead_load_tension.prm COMPARE_RANKS 1e-7)
# the load is found: past its largest value, in both schemes, on several processes and resumed
kedge_add_scene_test(scene.load_control prm/load_control.prm COMPARE_RANKS 1e-6)
kedge_add_scene_test(scene.load_control.finer prm/load_control.prm SET "Constants/n = 4")
# (its books close; its load is that of the middle of the step)
kedge_add_scene_test(scene.load_control.clc prm/load_control.prm
  SET "Time/Scheme = clc-quasi-static" "Constants/a = 2.7" "Time/Step = 0.01"
    "Checks/books/Quantity = max_abs(history.energy_error)" "Checks/books/Scale = 1e6"
    "Checks/books/Reference = 0" "Checks/books/Tolerance = 1e-9" "Checks/books/Source = conservation")
# a pressure on the present area: another power of the stretch, and past the largest one where the area stays
kedge_add_scene_test(scene.load_control.suction prm/load_control.prm COMPARE_RANKS 1e-6
  SET "Tractions/end/Traction = " "Tractions/end/Pressure = -E_*t"
    "Constants/m = (1 - 2*nu)/(1 - nu)"
    "Checks/newton/Quantity = maximum(history.newton_iterations)" "Checks/newton/Reference = 3"
    "Checks/newton/Tolerance = 1e-9" "Checks/newton/Source = quadratic, if the border is right")
kedge_add_scene_test(scene.load_control.suction.peak prm/load_control.prm
  SET "Tractions/end/Traction = " "Tractions/end/Pressure = -E_*t" "Constants/nu = 0"
    "Constants/a = 2.8")
kedge_add_scene_test(scene.load_control.suction.clc prm/load_control.prm
  SET "Tractions/end/Traction = " "Tractions/end/Pressure = -E_*t" "Constants/a = 2"
    "Time/Scheme = clc-quasi-static" "Constants/m = (1 - 2*nu)/(1 - nu)"
    "Checks/largest load/Tolerance = 1 %" "Checks/load at the end/Tolerance = 1 %"
    "Checks/books/Quantity = max_abs(history.energy_error)" "Checks/books/Scale = 1e6"
    "Checks/books/Reference = 0" "Checks/books/Tolerance = 1e-9" "Checks/books/Source = conservation")
kedge_add_scene_test(refusal.load_control_without_load prm/load_control.prm
  SET "Tractions/end/Traction = E_; 0" EXPECT_EXIT 2
  EXPECT_STDOUT "no Body force, Point load, Traction or Pressure changes with t" EXPECT_STDERR "^$" LABELS refusal)
# what moves a body goes with it: uniform stress under platens through 25 cells, at any place
# (on two ranks by the scenes' own checks: reactions of 0 are round-off, which cannot be compared)
# (its faces are as long as the block is wide: 1.07 m)
kedge_add_scene_test(scene.pressed_by_condition prm/pressed_by_condition.prm
  EXPECT_STDOUT "upper .'block', top, .y.: [0-9]+ faces of material points, 1.07 m long")
kedge_add_scene_test(scene.pressed_by_condition.ranks prm/pressed_by_condition.prm RANKS 2)
kedge_add_scene_test(scene.pressed_by_condition.elsewhere prm/pressed_by_condition.prm
  SET "Constants/shift = 0.87" "Constants/steps = 20" "Bodies/block/Points per cell = 3")
kedge_add_scene_test(scene.pressed_by_force prm/pressed_by_force.prm)
kedge_add_scene_test(scene.pressed_by_force.ranks prm/pressed_by_force.prm RANKS 2)
kedge_add_scene_test(scene.pressed_3d tests/scenes/pressed_3d.prm)
kedge_add_scene_test(scene.pressed_3d.force tests/scenes/pressed_3d.prm
  SET "Body conditions/upper/Component y = force(force*t)")
kedge_add_scene_test(scene.moved_section prm/moved_section.prm COMPARE_RANKS 1e-7)
kedge_add_scene_test(scene.moved_section.fine prm/moved_section.prm
  SET "Constants/n = 100" "Checks/force/Tolerance = 0.2 %")
kedge_add_scene_test(scene.inclined_roller prm/inclined_roller.prm)
# on a curved surface, wherever its centre is among the nodes
kedge_add_scene_test(scene.cylinder_wall_moved prm/cylinder_wall_moved.prm)
kedge_add_scene_test(scene.cylinder_wall_moved.shifted prm/cylinder_wall_moved.prm
  SET "Constants/n = 8" "Constants/shift = 0.3")
kedge_add_scene_test(scene.cylinder_wall_moved.ranks prm/cylinder_wall_moved.prm
  SET "Constants/n = 8" RANKS 2)
# nodes that are held for a time
kedge_add_scene_test(scene.released tests/scenes/released.prm)
# the sum of thirty steps is not 0.5 in round-off; what is no number holds nothing
kedge_add_scene_test(scene.released.short_steps tests/scenes/released.prm
  SET "Time/Step = 1/30" "Node conditions/hand/Where = t < t_0" "Checks/weight in the hand/Time = 0.3")
kedge_add_scene_test(scene.released.not_a_number tests/scenes/released.prm
  SET "Node conditions/hand/Where = sqrt(t_0 - 1e-6 - t)")
kedge_add_restart_test(scene.restart.pressed_by_condition prm/pressed_by_condition.prm KILLS 3
  SET "Output/Checkpoint every steps = 5" "Output/Points interval = 0")
kedge_add_scene_test(scene.lost_support tests/scenes/lost_support.prm EXPECT_EXIT 2
  EXPECT_STDOUT "stopped at t = 0.25 s: Node conditions/grip holds nothing any more of the material"
  EXPECT_STDERR "^$")
# with inertia the body may fly on: said, and gone on
kedge_add_scene_test(scene.lost_support.dynamic tests/scenes/lost_support.prm
  SET "Time/Scheme = newmark"
  EXPECT_STDOUT "WARNING: Node conditions/grip holds nothing any more of the material .* .t = 0.25 s.")
# a fixed support that its body is pushed off
kedge_add_scene_test(scene.lost_support.fixed tests/scenes/lost_support.prm
  SET "Time/Scheme = newmark" "Node conditions/grip/Component x = free"
      "Bodies/block/Initial velocity = 2, 0"
  EXPECT_STDOUT "WARNING: Node conditions/grip holds nothing any more of the material")
# conditions on nodes that take a place between nodes or a part of the body for theirs
kedge_add_scene_test(scene.water_table.snaps prm/water_table.prm OPTIONS --validate
  SET "Node conditions/dry/Where = y > yw - 1e-6" "Node conditions/dry/Pore pressure = 0"
  EXPECT_STDOUT "note: Node conditions/dry: Where ends between nodes, up to 0.5 of a cell .*Surface pressures")
kedge_add_scene_test(scene.moved_section.slips prm/moved_section.prm EXPECT_EXIT 2
  SET "Body conditions/middle/Where = 0" "Node conditions/mid/Where = abs(x - 5) < 1e-6"
      "Node conditions/mid/Component x = displacement(d*t)"
  EXPECT_STDERR "^$"
  EXPECT_STDOUT "(?s)WARNING: Node conditions/mid holds no more than 16 % .*stopped at t = 0.8 s: .*Body conditions")
# a drained surface that sinks by several cells; the water stays in (.16 of it leaves for .93)
kedge_add_scene_test(scene.terzaghi.sinks prm/terzaghi.prm
  SET "Constants/w = 1.5e6" "Constants/dt = 2" "Output/Points interval = 0" EXPECT_EXIT 2
  EXPECT_STDERR "^$"
  EXPECT_STDOUT "WARNING: Node conditions/top holds nothing any more of the material .*Surface pressures")
kedge_add_scene_test(scene.lost_support.note tests/scenes/lost_support.prm OPTIONS --validate
  EXPECT_STDOUT "grip moves what it holds by 8 cells, but its nodes stay")
# a solution that runs away is no reason to enlarge the grid
kedge_add_scene_test(scene.unstable_tension tests/scenes/unstable_tension.prm EXPECT_EXIT 2
  EXPECT_STDOUT "stopped at t = .*further than the whole grid: the equations have no sensible"
  EXPECT_STDERR "^$")
kedge_add_scene_test(scene.shear_patch prm/shear_patch.prm)
# pressures that follow: uniform stress again, and Archimedes
kedge_add_scene_test(scene.patch_pressure tests/scenes/patch_pressure.prm)
kedge_add_scene_test(scene.patch_pressure.0.5 tests/scenes/patch_pressure.prm
  SET "Constants/shift = 0.5" "Bodies/block/Points per cell = 3")
kedge_add_scene_test(scene.submerged_block prm/submerged_block.prm)
kedge_add_scene_test(scene.submerged_block.elsewhere prm/submerged_block.prm
  SET "Constants/shift = 0.87")
# a load on part of a surface weighs the same on any grid
foreach(n 10 14 22)
  kedge_add_scene_test(scene.load_on_part.${n} tests/scenes/load_on_part.prm
    SET "Constants/n = ${n}")
endforeach()
