#include <kedge/base/exceptions.h>
#include <kedge/base/nearest_name.h>
#include <kedge/base/shortened.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/path_scene.h>
#include <kedge/scene/print_parameters.h>

#include <deal.II/base/utilities.h>

namespace kedge
{
  namespace
  {
    constexpr unsigned int line_width = 78;

    void
    print_comment(std::ostream &out, const std::string &indent, const std::string &text)
    {
      for (const std::string &line :
           dealii::Utilities::break_text_into_lines(text,
                                                    line_width - static_cast<int>(indent.size())))
        out << indent << "# " << line << '\n';
    }

    void
    print_entries(std::ostream &out, const std::string &indent, const SectionDeclaration &section)
    {
      for (const EntryDeclaration &entry : section.entries)
        {
          const std::string value = entry.default_value.value_or("");
          print_comment(out, indent, entry.documentation);
          print_comment(out, indent, "Allowed: " + entry.pattern.description() + ".");
          print_comment(out,
                        indent,
                        !entry.default_value ? "Must be given."
                        : value.empty()      ? "Default: empty."
                                             : "Default: " + value);
          out << indent << "set " << entry.name << " =" << (value.empty() ? "" : " ") << value
              << "\n\n";
        }
    }

    std::vector<SectionDeclaration>
    all_sections()
    {
      std::vector<SectionDeclaration> sections = declare_scene<3>({});
      for (SectionDeclaration &section : declare_path({}))
        if (section.name == "Path")
          sections.push_back(std::move(section));
      return sections;
    }

    void
    print_section(std::ostream &out, const SectionDeclaration &section)
    {
      print_comment(out, "", section.documentation);
      if (section.name.empty())
        {
          out << '\n';
          print_entries(out, "", section);
          return;
        }
      const bool named = section.kind == SectionKind::named;
      out << "subsection " << section.name << '\n';
      if (named)
        out << "  subsection <name>\n";
      print_entries(out, named ? "    " : "  ", section);
      if (named)
        out << "  end\n";
      out << "end\n\n";
    }

    /** As a text of JSON; the declarations hold no control characters. */
    std::string
    quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char letter : text)
        result += (letter == '"' || letter == '\\' ? "\\" : "") + std::string(1, letter);
      return result + '"';
    }

    void
    print_json(std::ostream &out, const std::vector<SectionDeclaration> &sections)
    {
      const auto kind_of = [](const SectionDeclaration &section) {
        return section.kind == SectionKind::named          ? "named"
               : section.kind == SectionKind::free_entries ? "free"
                                                           : "plain";
      };
      out << "{\"sections\": [";
      const char *before_section = "\n";
      for (const SectionDeclaration &section : sections)
        {
          out << before_section << "  {\"name\": " << quoted(section.name)
              << ", \"kind\": " << quoted(kind_of(section))
              << ",\n   \"documentation\": " << quoted(section.documentation)
              << ",\n   \"entries\": [";
          const char *before_entry = "\n";
          for (const EntryDeclaration &entry : section.entries)
            {
              out << before_entry << "    {\"name\": " << quoted(entry.name)
                  << ", \"required\": " << (entry.default_value ? "false" : "true")
                  << ", \"default\": " << quoted(entry.default_value.value_or(""))
                  << ",\n     \"allowed\": " << quoted(entry.pattern.description())
                  << ",\n     \"documentation\": " << quoted(entry.documentation) << "}";
              before_entry = ",\n";
            }
          out << "]}";
          before_section = ",\n";
        }
      out << "\n]}\n";
    }
  } // namespace



  void
  print_parameters(std::ostream &out, const std::string &which)
  {
    const std::vector<SectionDeclaration> sections = all_sections();
    if (which == "json")
      return print_json(out, sections);
    if (which.empty())
      {
        print_comment(out,
                      "",
                      "Every parameter of a scene, as in 3D. A scene with Dimension = 2 has two "
                      "numbers and two expressions where three stand here, no Component z and no "
                      "side back or front.");
        out << '\n';
      }
    std::vector<std::string> names = {"json"};
    bool                     any   = false;
    for (const SectionDeclaration &section : sections)
      {
        if (which.empty() || which == section.name)
          print_section(out, section);
        any = any || which.empty() || which == section.name;
        names.push_back(section.name);
      }
    if (!any)
      throw UserError("There is no section '" + shortened(which) + "'." +
                      did_you_mean(which, names));
  }
} // namespace kedge
