#include <kedge/base/exceptions.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/path_scene.h>
#include <kedge/scene/read_checks.h>
#include <kedge/scene/read_materials.h>
#include <kedge/scene/values.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    using Constants = std::map<std::string, double>;

    SectionDeclaration
    path_section(const Constants &constants)
    {
      const ValuePatterns<3> allow(constants);
      const ValuePattern     nine_expressions(
        "nine expressions of t, row by row, the rows separated by ;",
        [constants](const auto &text) {
          parse_expressions(text, 9, {"t"}, constants);
        });
      return {
        "Path",
        "Read by kedge --drive only, which deforms a single material point along it, in a file "
        "of its own with Title, Constants, Materials and Checks. It begins undeformed at t = 0. "
        "Either Deformation gradient or Logarithmic strain is given.",
        SectionKind::plain,
        {{"Material",
          std::nullopt,
          allow.text("the name of a section of Materials"),
          "What the point is made of."},
         {"Deformation gradient",
          "",
          nine_expressions.or_empty(),
          "F_xx, F_xy, F_xz; F_yx, ...; ..., F_zz [-]."},
         {"Logarithmic strain",
          "",
          allow.expressions({"t"}, "t").or_empty(),
          "Principal strains, logarithms of the stretches in x, y, z, no shear [-]."},
         {"End", "1", allow.number(NumberRange::positive()), "When the path ends [s]."},
         {"Steps", "100", allow.whole_number(1), "Equal steps from 0 to End [-]."}}};
    }

    PathParameters
    read_path(const SectionReader &section)
    {
      PathParameters path;
      path.by_strain = !first_is_given(section, "Deformation gradient", "Logarithmic strain");
      if (path.by_strain)
        {
          const auto parts = section.list("Logarithmic strain");
          std::copy(parts.begin(), parts.end(), path.logarithmic_strain.begin());
        }
      else
        {
          const auto parts = section.list("Deformation gradient");
          std::copy(parts.begin(), parts.end(), path.deformation_gradient.begin());
        }
      path.end     = section.number("End");
      path.n_steps = section.whole_number("Steps");
      return path;
    }
  } // namespace



  std::vector<SectionDeclaration>
  declare_path(const Constants &constants)
  {
    std::vector<SectionDeclaration> sections;
    for (SectionDeclaration &section : declare_scene<3>(constants))
      {
        if (section.name.empty())
          section.entries.erase(std::remove_if(section.entries.begin(),
                                               section.entries.end(),
                                               [](const EntryDeclaration &entry) {
                                                 return entry.name != "Title";
                                               }),
                                section.entries.end());
        if (section.name == "Checks")
          sections.push_back(path_section(constants));
        if (section.name.empty() || section.name == "Constants" || section.name == "Materials" ||
            section.name == "Checks")
          sections.push_back(std::move(section));
      }
    return sections;
  }



  PathScene
  read_path_scene(const ParameterFile &file)
  {
    PathScene scene;
    scene.constants = read_constants(file);
    const ParameterReader reader(file, declare_path(scene.constants), scene.constants);
    const SectionReader   section(reader, {"Path"});

    scene.name     = file.scene_name();
    scene.title    = SectionReader(reader, {}).text("Title");
    scene.path     = read_path(section);
    scene.material = read_materials(reader)[find_name(reader, section, "Material", "Materials")];
    TimeParameters time;
    time.start   = 0.;
    time.end     = scene.path.end;
    scene.checks = read_checks(reader, time);
    for (const CheckParameters &check : scene.checks)
      if (check.statistic == CheckStatistic::point_error)
        throw SectionReader(reader, {"Checks", check.name})
          .error("Quantity", "There is but one point; compare a column, history.COLUMN.");
    scene.parameters = reader.print();
    return scene;
  }
} // namespace kedge
