# Soil laws: element tests, limit loads, initial states. scenes.cmake says how.

# --- Element tests: high-order integrations, the same steps elsewhere --------------
kedge_add_scene_test(path.clay_softening prm/paths/clay_softening.prm OPTIONS --drive)
kedge_add_scene_test(path.clay_softening.von_mises prm/paths/clay_softening.prm OPTIONS --drive
  SET "Materials/clay/Model = von_mises")
kedge_add_scene_test(path.sand_plane_strain prm/paths/sand_plane_strain.prm OPTIONS --drive)
kedge_add_scene_test(path.sand_plane_strain.no_dilation prm/paths/sand_plane_strain.prm
  OPTIONS --drive SET "Constants/c = 5e3" "Constants/psi = 0")
kedge_add_scene_test(path.sand_plane_strain.associated prm/paths/sand_plane_strain.prm
  OPTIONS --drive SET "Constants/c = 5e3" "Constants/psi = 30")
kedge_add_scene_test(path.cam_clay_undrained prm/paths/cam_clay_undrained.prm OPTIONS --drive)
kedge_add_scene_test(path.cam_clay_undrained.overconsolidated prm/paths/cam_clay_undrained.prm
  OPTIONS --drive SET "Constants/OCR = 1.5")
kedge_add_scene_test(path.cam_clay_drained prm/paths/cam_clay_drained.prm OPTIONS --drive)
kedge_add_scene_test(path.cam_clay_drained.overconsolidated prm/paths/cam_clay_drained.prm
  OPTIONS --drive SET "Constants/OCR = 2")
kedge_add_scene_test(path.mohr_coulomb_plane_strain prm/paths/mohr_coulomb_plane_strain.prm
  OPTIONS --drive)

# --- Element tests of soil, against integrations in other variables --------------
kedge_add_scene_test(path.isotropic_compression prm/paths/isotropic_compression.prm)
kedge_add_scene_test(path.oedometer prm/oedometer.prm)
kedge_add_scene_test(path.triaxial prm/triaxial.prm)
kedge_add_scene_test(path.triaxial.overconsolidated prm/triaxial.prm SET "Constants/p0 = 50e3")
kedge_add_scene_test(path.triaxial_drained prm/paths/triaxial_drained.prm)
kedge_add_scene_test(path.triaxial_drained.critical prm/paths/triaxial_drained.prm
  SET "Constants/cell = 70e3")

# --- Limit loads and initial states -------------------------------------------------
kedge_add_scene_test(scene.cavity_cylinder prm/cavity_cylinder.prm)
# past the largest pressure, at 1.4, without a mandrel
kedge_add_scene_test(scene.cavity_cylinder.load_control prm/cavity_cylinder.prm
  SET "Constants/n = 2" "Constants/ratio = 1.58" "Constants/p = 37052" "Bodies/clay/Basis = gimp"
    "Tractions/mandrel/Pressure = su*t" "Load control/Body = clay" "Load control/Place = R, h/8"
    "Constants/R = a + h/8" "Load control/Direction = 1, 0"
    "Load control/Displacement = sqrt(R^2 + (ratio^2 - 1)*a^2*t) - R")
kedge_add_scene_test(scene.cavity_sphere prm/cavity_sphere.prm TIMEOUT 200)
kedge_add_scene_test(scene.cavity_sphere.von_mises prm/cavity_sphere.prm TIMEOUT 200
  SET "Constants/ratio = 1.2" "Materials/clay/Model = von_mises" "Materials/clay/Undrained strength = "
    "Materials/clay/Yield radius rho_y = 2*sqrt(2/3)*su")
# limit loads: found as the answer, or where a run without one stops
kedge_add_scene_test(scene.vertical_cut prm/vertical_cut.prm)
kedge_add_scene_test(scene.vertical_cut.ranks prm/vertical_cut.prm SET "Constants/n = 4"
  COMPARE_RANKS 1e-6)
kedge_add_scene_test(scene.vertical_cut.coarse prm/vertical_cut.prm SET "Constants/n = 8"
  EXPECT_STDOUT "a limit load.*still growing at .* times as fast as in the first step")
kedge_add_scene_test(scene.vertical_cut.stops prm/vertical_cut.prm SET "Constants/n = 8"
  "Time/Failure displacement = " EXPECT_EXIT 2
  EXPECT_STDOUT "no equilibrium beyond load factor Body force 0.[678].*still growing"
  EXPECT_STDERR "^$")
kedge_add_scene_test(scene.cut_softening prm/cut_softening.prm)
# the scene can fail: clay that keeps its strength has no fall behind a peak
kedge_add_scene_test(scene.cut_softening.perfect prm/cut_softening.prm SET "Constants/left = 1"
  EXPECT_EXIT 2 EXPECT_STDOUT "FAIL what is left" EXPECT_STDERR "^$")
kedge_add_scene_test(scene.slope prm/slope.prm
  SET "Constants/n = 5" "Strength reduction = 1.3")
# by steps that find no equilibrium or by one that moves it too far: round-off decides which comes first
kedge_add_scene_test(scene.slope.fails prm/slope.prm SET "Constants/n = 5"
  "Strength reduction = 1.7" EXPECT_EXIT 2
  EXPECT_STDOUT "a limit load(, no equilibrium beyond it)?: the largest displacement.*still growing"
  EXPECT_STDERR "^$")
# beyond the yield surface: returned, and said so
kedge_add_scene_test(scene.initial_stress_returned prm/layer_at_rest.prm
  SET "Materials/skeleton/Model = drucker_prager" "Materials/skeleton/Cohesion = 0"
    "Materials/skeleton/Friction angle = 20" "Constants/K_0 = 0.2" OPTIONS --validate
  EXPECT_STDOUT "Bodies/soil/Initial stress: [0-9]+ of [0-9]+ material points .* were returned to it")
kedge_add_scene_test(scene.k0_layer prm/k0_layer.prm)
kedge_add_scene_test(scene.k0_layer.ranks prm/k0_layer.prm RANKS 2)
kedge_add_scene_test(scene.k0_layer.dense prm/k0_layer.prm
  SET "Constants/RD = 0.82" "Constants/yw = 8.3" "Constants/h = 0.5")
# the scene can fail: with less horizontal stress the layer yields and sinks
kedge_add_scene_test(scene.k0_layer.returned prm/k0_layer.prm SET "Constants/K0 = 0.2"
  EXPECT_EXIT 2 EXPECT_STDOUT "80 of 80 material points .100 .. began beyond the yield surface"
  EXPECT_STDERR "^$")
kedge_add_scene_test(scene.cut_failure prm/cut_failure.prm)
# the scene can fail: half the weight, it stands
kedge_add_scene_test(scene.cut_failure.stands prm/cut_failure.prm
  SET "Constants/N = 3" "Constants/n = 4" "Constants/T = 2" EXPECT_EXIT 2
  EXPECT_STDOUT "FAIL it slides" EXPECT_STDERR "^$")
# beyond the limit load: through failure to rest, and nothing of the kind where there is none
kedge_add_scene_test(scene.slope_failure prm/slope_failure.prm)
kedge_add_scene_test(scene.slope_failure.stands prm/slope_failure.prm
  SET "Strength reduction = 1.2" "Constants/n = 5" "Constants/T = 2" EXPECT_EXIT 2
  EXPECT_STDOUT "FAIL it slides" EXPECT_STDERR "^$")
# Modified Cam Clay with pore water: the element test's path; overconsolidated soil is none of it
kedge_add_scene_test(scene.clay_undrained prm/clay_undrained.prm)
kedge_add_scene_test(scene.clay_undrained.overconsolidated prm/clay_undrained.prm
  SET "Materials/clay/Preconsolidation pressure = 1.5*p0" "Constants/steps = 20" EXPECT_EXIT 2
  EXPECT_STDOUT "FAIL pore pressure" EXPECT_STDERR "^$")
# sand that flows: to rest, with closed books and the front of the fits
kedge_add_scene_test(scene.granular_collapse prm/granular_collapse.prm)
# the scene can fail: with FLIP the points keep velocities that the grid does not see
kedge_add_scene_test(scene.granular_collapse.flip prm/granular_collapse.prm
  SET "Mapping/Velocity = flip" EXPECT_EXIT 2 EXPECT_STDOUT "FAIL at rest" EXPECT_STDERR "^$")
kedge_add_scene_test(scene.strip_su_depth prm/strip_su_depth.prm)
kedge_add_scene_test(scene.strip_su_depth.von_mises prm/strip_su_depth.prm
  SET "Materials/clay/Model = von_mises")
kedge_add_scene_test(scene.strip_friction prm/strip_friction.prm)
kedge_add_scene_test(scene.strip_weight prm/strip_weight.prm)
kedge_add_scene_test(scene.strip_weight.rough prm/strip_weight.prm
  SET "Node conditions/footing/Component x = fixed" "Constants/q_u = 235.81e3" "Constants/w = 1e-3")
kedge_add_scene_test(scene.strip_weight.alone prm/strip_weight.prm
  SET "Constants/c = 50" "Constants/q = 0" "Constants/q_u = 42.117e3" "Constants/E = 1e10"
    "Constants/w = 1.2e-5*B" "Constants/L = 2" "Constants/D = 1" "Constants/edge = 1"
    "Time/Scheme = quasi-static" "Constants/books = 0.05")
kedge_add_scene_test(scene.circle_clay prm/circle_clay.prm)
kedge_add_scene_test(scene.circle_clay.rough prm/circle_clay.prm
  SET "Node conditions/footing/Component x = fixed" "Node conditions/footing/Component z = fixed"
    "Constants/N = 6.04842")
kedge_add_scene_test(scene.retaining_wall prm/retaining_wall.prm)
kedge_add_scene_test(scene.retaining_wall.smooth prm/retaining_wall.prm
  SET "Constants/delta = 0" "Constants/K = 3")
kedge_add_scene_test(scene.retaining_wall.gives_way prm/retaining_wall.prm
  SET "Constants/side = -1" "Constants/K = 0.291146" "Constants/w = 1e-5*H" "Constants/L = 2*H")
# pore pressures of the scene's own cells are minutes: coarser, by their own tolerance
kedge_add_scene_test(scene.set_up prm/set_up.prm SET "Constants/n = 2")
