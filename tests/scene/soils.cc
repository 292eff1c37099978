// What the reader says of soils and of element tests.
#include "scene_text.h"

#include <kedge/scene/path_scene.h>

using namespace scene_tests;

namespace
{
  const std::string path_text = R"(subsection Constants
  set K = 30e6
end
subsection Materials
  subsection elastic
    set Model            = improved_hencky
    set Density          = 2000
    set Bulk modulus     = K
    set Shear modulus    = 28e6
    set Initial porosity = 0.2
  end
  subsection clay
    set Model                     = critical_state
    set Density                   = 2000
    set Bulk modulus              = K
    set Shear modulus             = 28e6
    set Initial porosity          = 0.2
    set Preconsolidation pressure = 2.5e5
    set Critical state slope      = 0.964
    set Surface alpha             = 0.3
    set Surface gamma             = 0.9
  end
end
subsection Path
  set Material               = clay
  set Control                = stress(-K/300); strain(0); strain(min(t, 1)/100)
  set Consolidation pressure = 1e5
  set Drainage               = undrained
  set Fluid bulk modulus     = 2.2e9
end
)";

  PathScene
  read(const std::vector<std::string> &settings)
  {
    ParameterFile file = parse(path_text);
    for (const std::string &setting : settings)
      file.set(setting);
    return read_path_scene(file);
  }

  std::string
  path_message(const std::vector<std::string> &settings)
  {
    try
      {
        read(settings);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace

TEST(SceneSoils, ModuliAreGivenInOneOfTwoWays)
{
  // E = 9 K G/(3 K + G), nu = (3 K - 2 G)/(2 (3 K + G))
  const MaterialParameters soil = read({}).material;
  EXPECT_NEAR(soil.young_modulus / (9. * 30e6 * 28e6 / 118e6), 1., rounding);
  EXPECT_NEAR(soil.poisson_ratio, 34. / 236., rounding);
  EXPECT_EQ(soil.initial_porosity, 0.2);
  const std::string clay = "Materials/clay/";
  expect_parts(path_message({clay + "Young's modulus = 1"}),
               {"Bulk modulus", "Only one of Young's modulus and Bulk modulus"});
  expect_parts(path_message({clay + "Poisson's ratio = 0.2"}), {"not with Bulk modulus"});
  expect_parts(path_message({clay + "Shear modulus ="}), {"must be given with Bulk modulus"});
  expect_parts(path_message({clay + "Bulk modulus ="}), {"Either Young's modulus or Bulk modulus"});
  const std::string young = clay + "Bulk modulus =";
  expect_parts(path_message({young, clay + "Young's modulus = 1"}),
               {"Shear modulus", "not with Young's modulus"});
  expect_parts(path_message({young, clay + "Young's modulus = 1", clay + "Shear modulus ="}),
               {"Poisson's ratio", "must be given with Young's modulus"});
}

TEST(SceneSoils, ModelsAreReadWithTheirElasticity)
{
  EXPECT_EQ(read({"Path/Material = elastic"}).material.kind, MaterialKind::improved_hencky);
  const MaterialParameters soil = read({}).material;
  EXPECT_EQ(soil.kind, MaterialKind::critical_state_improved);
  EXPECT_EQ(soil.preconsolidation_pressure, 2.5e5);
  EXPECT_EQ(soil.critical_state_slope, 0.964);
  EXPECT_EQ(soil.surface_alpha, 0.3);
  EXPECT_EQ(soil.surface_gamma, 0.9);
  EXPECT_EQ(soil.frozen_energy, FrozenEnergy::centred);
  const MaterialParameters printed =
    read({"Materials/clay/Elasticity = hencky", "Materials/clay/Frozen energy = none"}).material;
  EXPECT_EQ(printed.kind, MaterialKind::critical_state);
  EXPECT_EQ(printed.frozen_energy, FrozenEnergy::none);
}

TEST(SceneSoils, EntriesThatDoNotFitAreRefused)
{
  const std::string clay = "Materials/clay/";
  for (const std::string entry :
       {"Preconsolidation pressure", "Critical state slope", "Surface alpha", "Surface gamma"})
    {
      expect_parts(path_message({clay + entry + " ="}), {entry, "Model critical_state needs it"});
      expect_parts(path_message({"Materials/elastic/" + entry + " = 1"}),
                   {entry, "belongs to model critical_state"});
    }
  expect_parts(path_message({clay + "Initial porosity ="}), {"needs it"});
  expect_parts(path_message({"Materials/elastic/Initial porosity ="}), {"needs it"});
  expect_parts(path_message({clay + "Initial porosity = 1"}), {"less than 1"});
  expect_parts(path_message({clay + "Initial porosity = 0"}), {"greater than 0"});
  expect_parts(path_message({clay + "Surface alpha = 1.1"}), {"at most 1"});
  expect_parts(path_message({clay + "Surface gamma = 0"}), {"greater than 0"});
  expect_parts(path_message({clay + "Volume change = cell mean"}), {"pointwise"});
  expect_parts(path_message({clay + "Yield radius rho_y = 1"}), {"did you mean von_mises?"});
  expect_parts(path_message({clay + "Model = critical state"}), {"Did you mean 'critical_state'?"});
}

TEST(SceneSoils, ElementTestsAreRead)
{
  const PathParameters path = read({}).path;
  EXPECT_EQ(path.kind, PathParameters::Kind::control);
  EXPECT_TRUE(path.control[0].is_stress);
  EXPECT_FALSE(path.control[2].is_stress);
  EXPECT_EQ(path.control[2].expression, "min(t, 1)/100");
  EXPECT_EQ(path.consolidation_pressure, 1e5);
  EXPECT_TRUE(path.undrained);
  EXPECT_EQ(path.fluid_bulk_modulus, 2.2e9);
  EXPECT_TRUE(is_path_file(parse(path_text)));
  EXPECT_FALSE(is_path_file(parse(full_scene)));
}

TEST(SceneSoils, ElementTestsThatDoNotFitAreRefused)
{
  expect_parts(path_message({"Path/Control = stress(0); strain(0)"}), {"2 parts, not three"});
  expect_parts(path_message({"Path/Control = stress(0); strain(0); stran(t)"}),
               {"Did you mean 'strain'?"});
  expect_parts(path_message({"Path/Control = stress(x); strain(0); strain(t)"}), {"\"x\""});
  expect_parts(path_message({"Path/Logarithmic strain = 0; 0; 0"}), {"Only one of"});
  expect_parts(path_message({"Path/Drainage = drained"}), {"Fluid bulk modulus", "undrained"});
  expect_parts(path_message(
                 {"Path/Fluid bulk modulus =", "Path/Control = strain(0); strain(0); strain(0)"}),
               {"Path/Drainage", "any pore pressure would do"});
  expect_parts(path_message(
                 {"Materials/clay/Elasticity = hencky", "Materials/clay/Initial porosity ="}),
               {"Path/Drainage", "no Initial porosity"});
  const std::vector<std::string> strain      = {"Path/Control =",
                                                "Path/Logarithmic strain = t; 0; 0",
                                                "Path/Fluid bulk modulus ="};
  auto                           with_strain = [&](const std::string &setting) {
    std::vector<std::string> settings = strain;
    settings.push_back(setting);
    return path_message(settings);
  };
  expect_parts(with_strain("Path/Consolidation pressure = 0"), {"Drainage", "belongs to Control"});
  expect_parts(with_strain("Path/Drainage = drained"),
               {"Consolidation pressure", "belongs to Control"});
}

TEST(SceneSoils, StrengthsOfPlaceRateAndPastAreRead)
{
  const std::vector<std::string> clay = {"Path/Drainage = drained",
                                         "Path/Fluid bulk modulus =",
                                         "Materials/clay/Preconsolidation pressure =",
                                         "Materials/clay/Critical state slope =",
                                         "Materials/clay/Surface alpha =",
                                         "Materials/clay/Surface gamma ="};
  const auto                     with = [&](const std::vector<std::string> &more) {
    std::vector<std::string> settings = clay;
    for (const std::string &setting : more)
      settings.push_back("Materials/clay/" + setting);
    return settings;
  };
  const std::vector<std::string> tresca = {"Model = tresca",
                                           "Undrained strength = 1e4",
                                           "Rate coefficient = 0.1",
                                           "Reference shear rate = 1e-3"};
  EXPECT_EQ(read(with(tresca)).material.rate_coefficient, 0.1);
  EXPECT_EQ(read(with(tresca)).material.reference_rate, 1e-3);
  expect_parts(path_message(with({tresca[0], tresca[1], tresca[2]})),
               {"Reference shear rate", "needs it"});
  expect_parts(path_message(with({tresca[0], tresca[1], tresca[3]})),
               {"Reference shear rate", "belongs to a Rate coefficient"});
  expect_parts(path_message(with({"Model = hencky", "Rate coefficient = 0.1"})),
               {"Rate coefficient", "belongs to Undrained strength"});
  expect_parts(path_message(with({"Model = hencky", "Stiffness factor = 2"})),
               {"Stiffness factor", "belongs to models drucker_prager and mohr_coulomb"});

  std::vector<std::string> sand = {"Model = mohr_coulomb",
                                   "Cohesion = 1e3",
                                   "Friction angle = 30",
                                   "Dilation angle = 25",
                                   "Stiffness factor = 2 + y"};
  EXPECT_EQ(read(with(sand)).material.stiffness_factor.value, 2.);
  EXPECT_EQ(read(with(sand)).material.stiffness_factor.expression, "2 + y");
  sand.back() = "Stiffness factor = 0";
  expect_parts(path_message(with(sand)), {"Stiffness factor", "greater than 0"});

  const std::vector<std::string> cam_clay = {"Model = modified_cam_clay",
                                             "Bulk modulus =",
                                             "Initial porosity =",
                                             "Swelling slope = 0.02",
                                             "Compression slope = 0.2",
                                             "Initial void ratio = 1",
                                             "Critical state slope = 1",
                                             "Overconsolidation ratio = 1.5"};
  const MaterialParameters       by_ratio = read(with(cam_clay)).material;
  EXPECT_TRUE(by_ratio.preconsolidation_by_ratio);
  EXPECT_EQ(by_ratio.start_preconsolidation_pressure.value, 1.5);
  auto both = with(cam_clay);
  both.push_back("Materials/clay/Preconsolidation pressure = 1e5");
  expect_parts(path_message(both), {"Only one of Preconsolidation pressure and Over"});
  both.back() = "Materials/clay/Overconsolidation ratio =";
  expect_parts(path_message(both), {"Either Preconsolidation pressure or Over"});
  expect_parts(path_message(with({"Model = hencky", "Overconsolidation ratio = 2"})),
               {"Overconsolidation ratio", "belongs to model modified_cam_clay"});
}

TEST(SceneSoils, StrengthsAreReduced)
{
  // c/F, tan phi/F, psi at most phi; s_u/F; what has no strength of its own cannot be reduced
  const std::vector<std::string> clay = {"Strength reduction = 1.25",
                                         "Path/Drainage = drained",
                                         "Path/Fluid bulk modulus =",
                                         "Materials/clay/Preconsolidation pressure =",
                                         "Materials/clay/Critical state slope =",
                                         "Materials/clay/Surface alpha =",
                                         "Materials/clay/Surface gamma ="};
  auto                           sand = clay, stiff = clay;
  for (const std::string entry : {"Model = drucker_prager",
                                  "Cohesion = 1e3*(1 + y)",
                                  "Friction angle = 30",
                                  "Dilation angle = 28"})
    sand.push_back("Materials/clay/" + std::string(entry));
  const MaterialParameters reduced = read(sand).material;
  const double             phi     = std::atan(std::tan(std::acos(-1.) / 6.) / 1.25);
  EXPECT_NEAR(reduced.friction_angle, phi * 180. / std::acos(-1.), 1e-12);
  EXPECT_EQ(reduced.dilation_angle, reduced.friction_angle);
  EXPECT_NEAR(reduced.cohesion.value, 800., 1e-10);
  EXPECT_NEAR(reduced.cohesion.factor, 0.8, 1e-15);
  for (const std::string entry : {"Model = tresca", "Undrained strength = 1e4"})
    stiff.push_back("Materials/clay/" + std::string(entry));
  EXPECT_NEAR(read(stiff).material.undrained_strength.value, 8000., 1e-9);
  expect_parts(path_message({"Strength reduction = 2"}), {"Strength reduction", "Materials/clay"});
}
