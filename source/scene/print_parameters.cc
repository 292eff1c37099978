#include <kedge/scene/declarations.h>
#include <kedge/scene/path_scene.h>
#include <kedge/scene/read_scene.h>

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
  } // namespace



  void
  print_parameters(std::ostream &out)
  {
    print_comment(out,
                  "",
                  "Every parameter of a scene, as in 3D. A scene with Dimension = 2 has two "
                  "numbers and two expressions where three stand here, no Component z and no side "
                  "back or front.");
    out << '\n';
    std::vector<SectionDeclaration> sections = declare_scene<3>({});
    for (SectionDeclaration &section : declare_path({}))
      if (section.name == "Path")
        sections.push_back(std::move(section));
    for (const SectionDeclaration &section : sections)
      {
        print_comment(out, "", section.documentation);
        if (section.name.empty())
          {
            out << '\n';
            print_entries(out, "", section);
            continue;
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
  }
} // namespace kedge
