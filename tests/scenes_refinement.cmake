# Scenes on refined grids.

kedge_add_scene_test(scene.refined_patch prm/refined_patch.prm)
# it can fail: functions that are not continuous across levels
kedge_add_scene_test(scene.refined_patch.spline prm/refined_patch.prm
  SET "Bodies/block/Basis = spline" EXPECT_EXIT 2 EXPECT_STDOUT "FAIL xx 0.0[0-4]" EXPECT_STDERR "^$")
# tractions on faces, off the grid's lines, in cells of three sizes
kedge_add_scene_test(scene.patch_traction.refined prm/patch_traction.prm
  SET "Grid/Refinement = if(x > 0.4, 2, 0)")
kedge_add_scene_test(scene.patch_traction_3d.refined tests/scenes/patch_traction_3d.prm
  SET "Grid/Refinement = if(x > 0.4 && z < 0.4, 1, 0)")
# cells are refined and coarsened under a body that spins, points are split: energy and momenta stay
kedge_add_scene_test(scene.spinning_body.refined prm/spinning_body.prm
  SET "Grid/Refinement = if(t > 0.1, if(x > 0.5*sin(t), 1, 0), 0)")
# Prandtl's limit load: that of a uniform grid with the small cells, less than 1 % apart
kedge_add_scene_test(scene.strip_footing.refined prm/strip_footing.prm
  SET "Constants/n = 4" "Constants/wide = 1 + 0.34/16"
      "Grid/Refinement = if(x < 1.25 && y > -0.25, 2, 0)")
kedge_add_scene_test(scene.strip_footing.refined_by_strain prm/strip_footing.prm
  SET "Constants/n = 4" "Constants/wide = 1 + 0.34/8"
      "Grid/Refinement = if(plastic_strain > 0.0002 || y > -0.25, 1, 0)")
kedge_add_scene_test(scene.terzaghi.refined prm/terzaghi.prm SET "Grid/Refinement = if(y < 0.5, 1, 0)")
# contact and tools: the checks of the scenes
kedge_add_scene_test(scene.hertz_line.refined prm/hertz_line.prm
  SET "Grid/Refinement = if(abs(y - 1) < 0.2 && x < 0.3, 1, 0)")
kedge_add_scene_test(scene.block_on_incline.refined prm/block_on_incline.prm
  SET "Grid/Refinement = if(x > 1, 1, 0)")
kedge_add_restart_test(scene.restart.refined prm/spinning_body.prm KILLS 1
  SET "Time/End = 10" "Output/Checkpoint every steps = 5"
      "Grid/Refinement = if(x > 0.5*sin(t), 1, 0)")
foreach(wrong 0.5 7 -1)
  kedge_add_scene_test(refusal.refinement.${wrong} prm/strip_footing.prm
    SET "Grid/Refinement = if(x < 1, ${wrong}, 0)" EXPECT_EXIT 1
    EXPECT_STDERR "Grid/Refinement is .* it must be a whole number from 0 to 6" LABELS refusal)
endforeach()
kedge_add_scene_test(refusal.refinement_word prm/strip_footing.prm
  SET "Grid/Refinement = if(q > 1, 1, 0)" EXPECT_EXIT 1
  EXPECT_STDERR "Grid/Refinement.*Known names: .*plastic_strain" LABELS refusal)
kedge_add_scene_test(refusal.refinement_quadratic prm/strip_footing.prm
  SET "Grid/Refinement = 1" "Bodies/ground/Basis = quadratic" "Materials/clay/Volume change = pointwise"
  EXPECT_EXIT 1 EXPECT_STDERR "Bodies/ground/Basis.*not made for a refined grid" LABELS refusal)
kedge_add_scene_test(refusal.refinement_ghost prm/strip_footing.prm
  SET "Grid/Refinement = 1" "Stabilisation/Method = ghost"
  EXPECT_EXIT 1 EXPECT_STDERR "Stabilisation/Method.*not made for a refined grid" LABELS refusal)
kedge_add_scene_test(refusal.refinement_conserving_soil prm/saturated_tumbling.prm
  SET "Grid/Refinement = 1" EXPECT_EXIT 1
  EXPECT_STDERR "Time/Scheme.*not made for a refined grid" LABELS refusal)
kedge_add_scene_test(refusal.refinement_ranks prm/strip_footing.prm RANKS 2
  SET "Grid/Refinement = 1" EXPECT_EXIT 1
  EXPECT_STDERR "Grid/Refinement: a refined grid runs on one process" LABELS refusal)
