#include "scene_text.h"

#include <kedge/scene/print_parameters.h>

using namespace scene_tests;



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
               {"Time/Scheme = generalized-alpha", "Did you mean 'generalised-alpha'?"});
  expect_parts(message_of(with("displacement, det_F", "displacement, detF")),
               {"Output/Fields", "Did you mean 'det_F'?"});
  expect_parts(message_of(with("Side = x-", "Side = lft")), {"Did you mean 'left'?"});
  expect_parts(message_of(with("Side = x-", "Side = back")), {"one of left, right, bottom, top"});
  expect_parts(message_of(with("probe.tip.", "probe.tp.")),
               {"Checks/deflection/Quantity", "Did you mean 'tip'?"});
  expect_parts(message_of(with("drift(", "drfit(")), {"Did you mean 'drift'?"});
  expect_parts(message_of(with("velocity(sin", "velocty(sin")), {"Did you mean 'velocity'?"});
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
    {"Tractions/top/Side", "up", "Did you mean 'top'?"},
    {"Time/End", "1", "later than Start = 1"},
    {"Time/Step", "0", "greater than 0"},
    {"Time/Step", "cfl", "write for example 15 cfl"},
    {"Time/Step", "15 clf", "FACTOR initial cfl"},
    {"Time/Break times", "0.5", "later than Start"},
    {"Time/Break times", "4", "not after End"},
    {"Time/Smallest step factor", "2", "at most 1"},
    {"Time/Failure displacement", "0.1", "without inertia only"},
    {"Time/Failure displacement", "0", "greater than 0"},
    {"Strength reduction", "0", "greater than 0"},
    {"Time/Spectral radius", "1.1", "at most 1"},
    {"Newton/Tolerance", "0", "greater than 0"},
    {"Newton/Iterations", "0", "at least 1"},
    {"Mapping/Lumping", "-1", "at least 0"},
    {"Mapping/Filter time", "0", "greater than 0"},
    {"Materials/soft/Viscosity", "-1", "at least 0"},
    {"Output/Formats", "vtk", "Did you mean 'vtu'?"},
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
    {"Checks/stress/Part", "0.5", "point_quantile only"},
    {"Checks/stress/Part", "1", "less than 1"},
    {"Checks/deflection/Quantity", "point_quantile(history.mass)", "field of the material points"},
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
               {":139: Checks/deflection/Tolerance = 0.5 %", "percentage of the reference 0"});
  expect_parts(message_of(with("Density = 1000", "Density = -1000")),
               {"folder/beam.prm:20: Materials/soft/Density = -1000: ", "greater than 0"});
  expect_parts(message_of(with("    set Density = 1000\n", "")),
               {"folder/beam.prm:19: Materials/soft/Density must be given: a number"});
  expect_parts(message_of(with("set End = 1 + 2*h", "set End = 1")),
               {"folder/beam.prm:86: Time/End = 1: "});
}

TEST(SceneRead, NamesAreUniqueAndSimple)
{
  expect_parts(message_of(full_scene + "subsection Bodies\nsubsection beam\nend\nend\n"),
               {"folder/beam.prm:", "the name Bodies/beam is given a second time; line 34"});
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

// A load factor is found for loads and pressures, without inertia, and from a point of a body.
TEST(SceneRead, LoadControlIsForLoadsWithoutInertia)
{
  const auto message = [](std::vector<std::string> more) {
    std::vector<std::string> settings = {"Load control/Body = beam",
                                         "Load control/Place = 1, 0",
                                         "Load control/Direction = 0, 1",
                                         "Load control/Displacement = t",
                                         "Linear solver/Method = auto",
                                         "Time/Scheme = quasi-static"};
    settings.insert(settings.end(), more.begin(), more.end());
    return message_of(full_scene, settings);
  };
  expect_parts(message({"Time/Scheme = clc-midpoint"}),
               {"Load control/Displacement = t", "quasi-static or clc-quasi-static"});
  expect_parts(message({"Load control/Body = bean"}), {"Load control/Body = bean", "beam"});
  expect_parts(message({"Load control/Body = "}), {"Load control/Place = 1, 0: It needs a Body"});
  expect_parts(message({"Load control/Displacement = "}),
               {"Load control/Displacement", "It must be given with a Body"});
  expect_parts(message({"Load control/Direction = 0, 0"}),
               {"Load control/Direction = 0, 0", "must not be zero"});
  expect_parts(message({"Linear solver/Method = krylov-amg"}),
               {"without a diagonal", "Linear solver/Method = auto"});
  expect_parts(message({"Tractions/wind/Body = beam",
                        "Tractions/wind/Side = top",
                        "Tractions/wind/Pressure = t"}),
               {"no error"}); // a pressure that follows its face is scaled too
  expect_parts(message({"Body conditions/press/Body = beam",
                        "Body conditions/press/Side = top",
                        "Body conditions/press/Component y = force(t)"}),
               {"Body conditions/press gives a force"});
}

TEST(SceneRead, GhostFactorsOfPressuresNeedAPoreFluid)
{
  for (const char *factor : {"Ghost conductivity factor", "Ghost storage factor"})
    expect_parts(message_of(full_scene, {std::string("Stabilisation/") + factor + " = 1e-3"}),
                 {std::string("Stabilisation/") + factor + " = 1e-3", "dry", "Pore fluid/Density"});
}

TEST(SceneRead, SettingsWithoutEffectAreSaid)
{
  const auto lines = [](const std::vector<std::string> &settings) {
    ParameterFile file = parse(full_scene);
    for (const std::string &setting : settings)
      file.set(setting);
    std::string text;
    for (const std::string &line : idle_settings(file, read_scene<2>(file)))
      text += line + "\n";
    return text;
  };
  const std::string plain = lines({});
  EXPECT_EQ(plain.find("Spectral radius"), std::string::npos) << plain; // its scheme is chosen
  expect_parts(lines({"Time/Scheme = quasi-static", "Bodies/beam/Initial velocity = 1; 0"}),
               {"Bodies/beam/Initial velocity = 1; 0 has no effect without inertia"});
  expect_parts(lines({"Time/Newmark beta = 0.3"}),
               {"Time/Newmark beta = 0.3 has no effect but with Time/Scheme = newmark"});
  expect_parts(lines({"Mapping/Velocity = pic", "Mapping/Filter time = 2"}),
               {"Filter time = 2 has no effect but with Mapping/Velocity = flip"});
  expect_parts(message_of(full_scene,
                          {"Bodies/beam/Basis = spline", "Stabilisation/Method = ghost"}),
               {"Stabilisation/Method = ghost", "splines choose aggregation or none"});
  expect_parts(message_of(full_scene,
                          {"Bodies/beam/Basis = spline", "Stabilisation/Method = none"}),
               {"Stabilisation/Method = none", "With splines and inertia it must be aggregation"});
  expect_parts(lines({"Stabilisation/Ghost mass factor = 7", "Stabilisation/Method = none"}),
               {"Ghost mass factor = 7 has no effect but with Stabilisation/Method = ghost"});
  expect_parts(lines({"Materials/spare/Density = 1",
                      "Materials/spare/Young's modulus = 1",
                      "Materials/spare/Poisson's ratio = 0"}),
               {"Materials/spare is the Material of no body"});
  expect_parts(lines({"Materials/soft/Hydraulic conductivity = 1e-5"}),
               {"Materials/soft/Hydraulic conductivity = 1e-5 has no effect without a Pore fluid"});
  expect_parts(message_of(full_scene, {"Bodies/beam/Initial pore pressure = 1e3"}),
               {"Bodies/beam/Initial pore pressure = 1e3", "The body is dry"});
}

// Who writes a section of Contact without more has bodies that pass through each other: said,
// unless it is asked for or there is a law.
TEST(SceneRead, ContactWithoutALawIsSaid)
{
  const auto lines = [](const std::vector<std::string> &settings) {
    ParameterFile file = parse(full_scene);
    for (const std::string setting : {"Contact/pair/First = beam", "Contact/pair/Second = ball"})
      file.set(setting);
    for (const std::string &setting : settings)
      file.set(setting);
    std::string text;
    for (const std::string &line : idle_settings(file, read_scene<2>(file)))
      text += line + "\n";
    return text;
  };
  const std::string said = "Contact/pair gives no law: its bodies pass through each other";
  expect_parts(lines({}), {said});
  for (const std::string setting : {"Method = none", "Friction coefficient = 0"})
    EXPECT_EQ(lines({"Contact/pair/" + setting}).find(said), std::string::npos) << setting;
}

TEST(ScenePrintParameters, OneSectionAloneOrJson)
{
  std::ostringstream time, json;
  print_parameters(time, "Time");
  EXPECT_EQ(time.str().find("subsection Grid"), std::string::npos);
  expect_parts(time.str(), {"subsection Time\n", "set Scheme = clc-midpoint"});
  print_parameters(json, "json");
  expect_parts(json.str(),
               {"{\"sections\": [",
                "{\"name\": \"Density\", \"required\": true, \"default\": \"\"",
                "\"documentation\": \"Mass per volume of the undeformed body [kg/m^3].\"}"});
  EXPECT_THROW(print_parameters(json, "Tme"), UserError);
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
