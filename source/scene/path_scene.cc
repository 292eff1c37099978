#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/path_scene.h>
#include <kedge/scene/read_checks.h>
#include <kedge/scene/read_materials.h>
#include <kedge/scene/values.h>

#include <algorithm>
#include <array>

namespace kedge
{
  namespace
  {
    using Constants = std::map<std::string, double>;

    std::array<AxisControl, 3>
    parse_controls(const std::string &text, const Constants &constants)
    {
      const std::vector<std::string> parts = split_list(text);
      if (parts.size() != 3)
        throw UserError("There are " + std::to_string(parts.size()) + " parts, not three.");
      std::array<AxisControl, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = parse_axis_control(parts[i], constants);
      return result;
    }

    SectionDeclaration
    path_section(const Constants &constants)
    {
      const ValuePatterns<3> allow(constants);
      const ValuePattern     nine_expressions(
        "nine expressions of t, row by row, the rows separated by ;",
        [constants](const auto &text) {
          parse_expressions(text, 9, {"t"}, constants);
        });
      const ValuePattern three_controls(
        "three of strain(expression of t) or stress(expression of t), of x, y, z",
        [constants](const auto &text) {
          parse_controls(text, constants);
        });
      return {
        "Path",
        "Read by kedge --drive only, which deforms a single material point along it, in a file "
        "of its own with Title, Constants, Materials and Checks. It begins undeformed at t = 0. "
        "One of Deformation gradient, Logarithmic strain and Control is given; the rest is for "
        "Control, an element test of soil.",
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
         {"Control",
          "",
          three_controls.or_empty(),
          "Of x, y, z: strain(ln of the stretch from the consolidated state) or stress(total "
          "Cauchy, tension positive [Pa])."},
         {"Initial pressure",
          "0",
          allow.number(NumberRange::not_negative()),
          "Effective, isotropic, which the undeformed point bears, as by Initial stress of a "
          "body [Pa]."},
         {"Consolidation pressure",
          "0",
          allow.number(NumberRange::not_negative()),
          "Effective, isotropic, to which the specimen is loaded, drained, before t = 0 [Pa]."},
         {"Drainage",
          "drained",
          allow.one_of({"drained", "undrained"}),
          "drained: the pore pressure stays 0. undrained: the fluid stays in the pores."},
         {"Fluid bulk modulus",
          "",
          allow.number(NumberRange::positive()).or_empty(),
          "undrained: K_f [Pa]; nothing: the fluid is incompressible, the volume is kept."},
         {"End", "1", allow.number(NumberRange::positive()), "When the path ends [s]."},
         {"Steps", "100", allow.whole_number(1), "Equal steps from 0 to End [-]."}}};
    }

    /** The entries of an element test. */
    void
    read_control(const SectionReader &section, PathParameters &path)
    {
      const bool is_test = !section.is_empty("Control");
      if (!is_test)
        {
          if (section.number("Consolidation pressure") > 0.)
            throw section.error("Consolidation pressure", "It belongs to Control.");
          if (section.text("Drainage") == "undrained")
            throw section.error("Drainage", "It belongs to Control.");
        }
      path.undrained = section.text("Drainage") == "undrained";
      if (!section.is_empty("Fluid bulk modulus"))
        {
          if (!path.undrained)
            throw section.error("Fluid bulk modulus", "It belongs to Drainage = undrained.");
          path.fluid_bulk_modulus = section.number("Fluid bulk modulus");
        }
      if (!is_test)
        return;
      for (const std::string other : {"Deformation gradient", "Logarithmic strain"})
        if (!section.is_empty(other))
          throw section.error(other, "Only one of it and Control may be given.");
      path.kind                   = PathParameters::Kind::control;
      path.control                = parse_controls(section.text("Control"), section.constants());
      path.consolidation_pressure = section.number("Consolidation pressure");
      if (path.undrained && !(path.fluid_bulk_modulus > 0.) &&
          std::none_of(path.control.begin(), path.control.end(), [](const AxisControl &axis) {
            return axis.is_stress;
          }))
        throw section.error("Drainage",
                            "Where all strains are given and the fluid is incompressible, any pore "
                            "pressure would do; give Fluid bulk modulus or a stress.");
    }

    PathParameters
    read_path(const SectionReader &section)
    {
      PathParameters path;
      path.end              = section.number("End");
      path.n_steps          = section.whole_number("Steps");
      path.initial_pressure = section.number("Initial pressure");
      read_control(section, path);
      if (path.kind == PathParameters::Kind::control)
        return path;
      if (first_is_given(section, "Deformation gradient", "Logarithmic strain"))
        {
          const auto parts = section.list("Deformation gradient");
          std::copy(parts.begin(), parts.end(), path.deformation_gradient.begin());
        }
      else
        {
          path.kind        = PathParameters::Kind::logarithmic_strain;
          const auto parts = section.list("Logarithmic strain");
          std::copy(parts.begin(), parts.end(), path.logarithmic_strain.begin());
        }
      return path;
    }
  } // namespace



  bool
  is_path_file(const ParameterFile &file)
  {
    return std::any_of(file.sections.begin(),
                       file.sections.end(),
                       [](const ParameterSection &section) {
                         return section.path == std::vector<std::string>{"Path"};
                       });
  }



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
                                                 return entry.name != "Title" &&
                                                        entry.name != "Strength reduction";
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
    auto materials = read_materials(reader);
    reduce_strength(reader, materials);
    scene.material = materials[find_name(reader, section, "Material", "Materials")];
    if (scene.path.undrained && !(scene.material.initial_porosity > 0.))
      throw section.error("Drainage",
                          "Materials/" + scene.material.name +
                            " has no Initial porosity to hold "
                            "the fluid.");
    TimeParameters time;
    time.start   = 0.;
    time.end     = scene.path.end;
    scene.checks = read_checks(reader, time);
    for (const CheckParameters &check : scene.checks)
      if (is_of_points(check.statistic))
        throw SectionReader(reader, {"Checks", check.name})
          .error("Quantity", "There is but one point; compare a column, history.COLUMN.");
    scene.parameters = reader.print();
    return scene;
  }
} // namespace kedge
