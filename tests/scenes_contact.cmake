# The scenes of contact between bodies that are run as tests.

# contact with a law: energy for steps from half of the CFL step to twenty of them
kedge_add_scene_test(scene.prisms_collision prm/prisms_collision.prm)
foreach(cfl 0.5 5 20)
  kedge_add_scene_test(scene.prisms_collision.cfl_${cfl} prm/prisms_collision.prm
    SET "Constants/cfl = ${cfl}")
endforeach()
# the last cells are filled to 0.6
kedge_add_scene_test(scene.prisms_collision.cut prm/prisms_collision.prm
  SET "Constants/x0 = 0.41" "Constants/cfl = 0.5")
kedge_add_scene_test(scene.bars_unequal prm/bars_unequal.prm)
kedge_add_scene_test(scene.discs_contact prm/discs_contact.prm SET "Output/Points interval = 0")
kedge_add_scene_test(scene.discs_contact.slow prm/discs_contact.prm
  SET "Constants/speed = 0.05" "Output/Points interval = 0")
# the thesis's methods at common nodes: the exact ones keep all but what the ghost mass takes;
# the penalty keeps what is printed if its stiffness is 113 (E_1 + E_2); contact velocities lose
# nearly all (printed: 99.57 % and 95.73 %), and lumped mappings 2 % more than the books know
kedge_add_scene_test(scene.prisms_nodes prm/prisms_nodes.prm)
kedge_add_scene_test(scene.prisms_nodes.multipliers prm/prisms_nodes.prm
  SET "Contact/prisms/Method = lagrange multipliers" EXPECT_EXIT 2
  EXPECT_STDOUT "stopped at t = 1.8.*bodies part at the node" EXPECT_STDERR "^$")
kedge_add_scene_test(scene.prisms_nodes.penalty prm/prisms_nodes.prm
  SET "Contact/prisms/Method = penalty" "Contact/prisms/Penalty factor = 113"
    "Constants/kept = 0.9788" "Constants/tolerance = 0.001")
kedge_add_scene_test(scene.prisms_nodes.nonlinear_penalty prm/prisms_nodes.prm
  SET "Contact/prisms/Method = non-linear penalty" "Contact/prisms/Penalty factor = 113"
    "Constants/kept = 0.9788" "Constants/tolerance = 0.001")
kedge_add_scene_test(scene.prisms_nodes.velocity prm/prisms_nodes.prm
  SET "Contact/prisms/Method = contact velocity" "Constants/kept = 0" "Constants/tolerance = 0.06")
kedge_add_scene_test(scene.prisms_nodes.velocity_lumped prm/prisms_nodes.prm
  SET "Contact/prisms/Method = contact velocity" "Mapping/Lumping = 1" "Constants/kept = 0"
    "Constants/tolerance = 0.06" "Constants/books = 0.03")
kedge_add_scene_test(scene.block_on_incline prm/block_on_incline.prm)
kedge_add_scene_test(scene.block_on_incline.sticks prm/block_on_incline.prm
  SET "Constants/mu = 0.6")
kedge_add_scene_test(scene.block_on_incline.smooth prm/block_on_incline.prm
  SET "Constants/mu = 0")
# rigid walls: waves, and sliding along a plane oblique to the grid
kedge_add_scene_test(scene.bar_on_wall prm/bar_on_wall.prm)
kedge_add_scene_test(scene.bar_on_wall.short_steps prm/bar_on_wall.prm SET "Constants/cfl = 0.5")
kedge_add_scene_test(scene.bar_on_wall.moving_wall prm/bar_on_wall.prm
  SET "Constants/wall = 0.05")
# facets that are stretched fourfold and drawn together to a quarter while they touch
kedge_add_scene_test(scene.flattened_block prm/flattened_block.prm)
kedge_add_scene_test(refusal.wall_displacement.not_finite prm/bar_on_wall.prm
  SET "Contact/wall/Wall displacement = log(t - 1); 0" EXPECT_EXIT 1
  EXPECT_STDERR "Wall displacement has no finite value at the start")
kedge_add_scene_test(scene.flattened_block.ranks prm/flattened_block.prm RANKS 2)
kedge_add_restart_test(scene.restart.flattened_block prm/flattened_block.prm KILLS 2
  SET "Output/Checkpoint every steps = 5")
# with 40 steps it is chance how much of the block bears at the end, for waves lift parts of it
kedge_add_scene_test(scene.flattened_block.in_motion prm/flattened_block.prm
  SET "Time/Scheme = clc-midpoint" "Constants/steps = 80" "Constants/books = 1e-11"
    "Constants/tolerance = 2")
kedge_add_scene_test(refusal.wall_displacement prm/bars_unequal.prm
  SET "Contact/bars/Wall displacement = t; 0" EXPECT_EXIT 1
  EXPECT_STDERR "Wall displacement.*There is no Wall")
kedge_add_scene_test(scene.block_on_slope prm/block_on_slope.prm)
kedge_add_scene_test(scene.block_on_slope.sticks prm/block_on_slope.prm SET "Constants/mu = 0.6")
kedge_add_scene_test(scene.block_on_slope.smooth prm/block_on_slope.prm SET "Constants/mu = 0")
kedge_add_restart_test(scene.restart.wall prm/block_on_slope.prm KILLS 1
  SET "Output/Checkpoint every steps = 5")
# gravity that strikes makes the cylinder hop: within two per cent
kedge_add_scene_test(scene.cylinder_rolling prm/cylinder_rolling.prm)
kedge_add_scene_test(scene.cylinder_rolling.slides prm/cylinder_rolling.prm
  SET "Constants/mu = 0.2")
kedge_add_scene_test(scene.cylinder_rolling.shifted prm/cylinder_rolling.prm
  SET "Constants/shift = 3/8" "Constants/T = 1.25" "Output/Points interval = 0")
kedge_add_scene_test(scene.cylinder_rolling.struck prm/cylinder_rolling.prm
  SET "Constants/lay = 0" "Constants/tolerance = 0.02" "Output/Points interval = 0")
kedge_add_scene_test(scene.hertz_line prm/hertz_line.prm)
kedge_add_scene_test(scene.spheres_collision prm/spheres_collision.prm)
kedge_add_scene_test(scene.spheres_collision.smooth prm/spheres_collision.prm
  SET "Constants/mu = 0")
kedge_add_scene_test(refusal.surface_spacing prm/prisms_collision.prm
  SET "Contact/bars/Surface spacing = 1e-6" EXPECT_EXIT 1
  EXPECT_STDERR "Surface spacing of .* cells .* more surface points" LABELS refusal)
# several processes: each knows the nodes of all surfaces, and adds what it owns
kedge_add_scene_test(scene.prisms_collision.ranks prm/prisms_collision.prm RANKS 2)
kedge_add_scene_test(scene.spheres_collision.ranks prm/spheres_collision.prm RANKS 2)
kedge_add_scene_test(scene.hertz_line.ranks prm/hertz_line.prm COMPARE_RANKS 1e-6)
kedge_add_scene_test(scene.block_on_slope.ranks prm/block_on_slope.prm RANKS 2)
kedge_add_scene_test(refusal.nodal_contact_on_ranks prm/prisms_nodes.prm RANKS 2
  EXPECT_EXIT 1 EXPECT_STDERR "Methods at nodes run on one process")
kedge_add_scene_test(refusal.splines_in_contact_on_ranks prm/hertz_line.prm RANKS 2
  SET "Bodies/layer/Basis = spline"
  EXPECT_EXIT 1 EXPECT_STDERR "bodies of splines are in contact on one process")
# friction of saturated soil acts on what its grains carry
kedge_add_scene_test(scene.friction_returns prm/friction_returns.prm)
kedge_add_test(scene.contact.surfaces LABELS scene
  COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/contact_surfaces.py
    $<TARGET_FILE:kedge> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/scenes/contact_surfaces)
# partial slip: friction is held at rest, not by a spring; where it sticks by Cattaneo and Mindlin, and
# how far it moves by finite elements of the same blocks, both within 3 %, with q = 0.9
kedge_add_scene_test(scene.cattaneo_mindlin prm/cattaneo_mindlin.prm)
kedge_add_test(scene.cattaneo_mindlin.displacement LABELS scene
  COMMAND /usr/bin/python3 ${PROJECT_SOURCE_DIR}/benchmarks/contact/partial_slip.py
    --kedge $<TARGET_FILE:kedge> --output ${CMAKE_CURRENT_BINARY_DIR}/scenes/partial_slip
    --cells 32 --within 0.03)
kedge_add_scene_test(scene.prism_sliding prm/prism_sliding.prm)
# uniform pressure wherever the blocks lie on the grid
kedge_add_scene_test(scene.patch_contact prm/patch_contact.prm)
kedge_add_scene_test(scene.patch_contact.shifted prm/patch_contact.prm
  SET "Constants/across = 5/8" "Constants/up = 1/2")
kedge_add_scene_test(scene.patch_contact.sliver prm/patch_contact.prm SET "Constants/up = 1/8")
kedge_add_scene_test(scene.patch_contact.spline prm/patch_contact.prm
  SET "Bodies/lower/Basis = spline" "Bodies/upper/Basis = spline")
kedge_add_scene_test(scene.patch_contact.block_3d tests/scenes/patch_contact_3d.prm)
kedge_add_scene_test(scene.patch_contact.sliver_3d tests/scenes/patch_contact_3d.prm SET "Constants/up = 1/8")
# soft bodies: h = 1/4 is as far off finite elements as 0.49 %
kedge_add_scene_test(scene.prism_soft prm/prism_soft.prm SET "Output/Points interval = 0")
# the adhesion of clay, of the soil and of the place; the checkpoint knows from where depth counts
kedge_add_scene_test(scene.block_on_clay prm/block_on_clay.prm SET "Output/Points interval = 0")
kedge_add_scene_test(scene.block_on_clay.of_place prm/block_on_clay.prm
  SET "Contact/sole/Shear limit = alpha*(s0 + k*(x + 1e-6*depth))" "Output/Points interval = 0")
kedge_add_scene_test(scene.block_on_clay.ranks prm/block_on_clay.prm COMPARE_RANKS 1e-6
  SET "Output/Points interval = 0" "Constants/G = 1e7")
kedge_add_restart_test(scene.restart.shear_limit prm/block_on_clay.prm KILLS 1
  SET "Output/Checkpoint every steps = 5" "Constants/G = 1e7")
kedge_add_scene_test(scene.ball_and_ring prm/ball_and_ring.prm
  SET "Output/Points interval = 0")
kedge_add_scene_test(scene.prisms_nodes.ray_tracing prm/prisms_nodes.prm
  SET "Contact/prisms/Method = ray tracing")
kedge_add_scene_test(scene.block_on_incline.ray_tracing prm/block_on_incline.prm
  SET "Contact/sole/Method = ray tracing")
