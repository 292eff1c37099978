#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>
#include <kedge/base/shortened.h>
#include <kedge/base/user_errors.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/scene/values.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <cmath>
#include <functional>
#include <set>

#include <sstream>

namespace kedge
{
  namespace
  {
    using Path = std::vector<std::string>;

    std::vector<std::string>
    entry_names(const SectionDeclaration &section)
    {
      std::vector<std::string> names;
      for (const EntryDeclaration &entry : section.entries)
        names.push_back(entry.name);
      return names;
    }

    /** Characters with a meaning in paths, columns, options or files; names that are too long. */
    void
    check_user_name(const std::string &name, const std::string &place)
    {
      constexpr std::size_t longest = 100;
      if (name.size() > longest)
        throw UserError(place + ": the name '" + shortened(name, 40) + "' is longer than " +
                        std::to_string(longest) + " characters.");
      const std::string forbidden = "/\\.,;=\"<>";
      if (name.find_first_of(forbidden) != std::string::npos)
        throw UserError(place + ": the name '" + name + "' may not hold any of the characters " +
                        "/ \\ . , ; = \" < >.");
    }

    void
    check_constant_name(const ParameterEntry &entry)
    {
      std::vector<std::string> taken = Expression::function_names();
      taken.insert(taken.end(), {"x", "y", "z", "t", "X", "Y", "Z", "pi"});
      const std::string place = entry.origin.describe() + ": Constants/" + entry.name + ": ";
      if (std::find(taken.begin(), taken.end(), entry.name) != taken.end())
        throw UserError(
          place + "this name is taken, as are x, y, z, t, X, Y, Z, pi and those of all functions.");
      try
        {
          Expression(entry.name, {}, {{entry.name, 0.}});
        }
      catch (const UserError &)
        {
          throw UserError(place +
                          "the name of a constant holds letters, digits and _, no digit first.");
        }
    }

    /** Says why the constants @p entries cannot be worked out from the known ones. */
    [[noreturn]] void
    refuse_constants(const std::vector<ParameterEntry> &entries,
                     std::map<std::string, double>      constants)
    {
      std::vector<std::string> names;
      for (const ParameterEntry &entry : entries)
        {
          names.push_back(entry.name);
          constants[entry.name] = 1; // any number: is it only the value that is missing?
        }
      const auto place = [](const ParameterEntry &entry) {
        return entry.origin.describe() + ": Constants/" + entry.name + " = " +
               shortened(entry.value) + ": ";
      };
      UserErrors errors;
      for (const ParameterEntry &entry : entries)
        errors.attempt([&]() {
          try
            {
              evaluate_constant(entry.value, constants);
            }
          catch (const UserError &error)
            {
              throw UserError(place(entry) + error.what());
            }
        });
      errors.throw_if_any();
      throw UserError(place(entries.front()) + "Of the constants " +
                      shortened(boost::algorithm::join(names, ", ")) +
                      " each needs another of them.");
    }
  } // namespace



  std::map<std::string, double>
  read_constants(const ParameterFile &file)
  {
    std::vector<ParameterEntry> unknown;
    for (const ParameterEntry &entry : file.entries)
      if (entry.section == Path{"Constants"})
        {
          check_constant_name(entry);
          unknown.push_back(entry);
        }

    std::map<std::string, double> constants;
    while (!unknown.empty())
      {
        std::vector<ParameterEntry> still_unknown;
        for (const ParameterEntry &entry : unknown)
          try
            {
              constants[entry.name] = evaluate_constant(entry.value, constants);
            }
          catch (const UserError &)
            {
              still_unknown.push_back(entry);
            }
        if (still_unknown.size() == unknown.size())
          refuse_constants(unknown, constants);
        unknown = still_unknown;
      }
    return constants;
  }



  ParameterReader::ParameterReader(const ParameterFile                   &file,
                                   const std::vector<SectionDeclaration> &declarations,
                                   const std::map<std::string, double>   &constants)
    : file(file)
    , declarations(declarations)
    , user_constants(constants)
  {
    check();
    for_each_declared([&](const Path &path, const SectionDeclaration &section) {
      declare(path, section);
    });
    for (const ParameterEntry &entry : file.entries)
      {
        for (const std::string &section : entry.section)
          handler.enter_subsection(section);
        handler.set(entry.name, entry.value);
        for (std::size_t i = 0; i < entry.section.size(); ++i)
          handler.leave_subsection();
      }
  }



  void
  ParameterReader::check() const
  {
    UserErrors     errors;
    std::set<Path> unknown; // sections; what stands in them is not worth an error of its own
    std::set<Path> suspect; // an entry that seems to be missing there may be misspelt
    for (const ParameterSection &section : file.sections)
      if (!errors.attempt([&]() {
            check_section(section);
          }))
        unknown.insert(section.path);
    const bool all_sections_known = unknown.empty();
    for (const ParameterEntry &entry : file.entries)
      {
        const Path parent(entry.section.begin(),
                          entry.section.begin() +
                            std::min<std::ptrdiff_t>(1, entry.section.size()));
        if (unknown.count(entry.section) == 0 && unknown.count(parent) == 0 &&
            !errors.attempt([&]() {
              check_entry(entry);
            }))
          suspect.insert(entry.section);
      }
    for_each_declared([&](const Path &path, const SectionDeclaration &section) {
      if (unknown.count(path) + suspect.count(path) == 0 && (all_sections_known || is_opened(path)))
        for (const EntryDeclaration &entry : section.entries)
          errors.attempt([&]() {
            require(path, entry);
          });
    });
    errors.throw_if_any();
  }



  bool
  ParameterReader::is_opened(const Path &path) const
  {
    return path.empty() ||
           std::any_of(file.sections.begin(), file.sections.end(), [&](const auto &section) {
             return section.path == path;
           });
  }



  std::string
  ParameterReader::full_name(const Path &section, const std::string &entry)
  {
    std::string joined;
    for (const std::string &part : section)
      joined += part + "/";
    return joined + entry;
  }



  const SectionDeclaration &
  ParameterReader::declaration(const std::string &section, const std::string &place) const
  {
    std::vector<std::string> known;
    for (const SectionDeclaration &candidate : declarations)
      if (candidate.name == section)
        return candidate;
      else if (!candidate.name.empty())
        known.push_back(candidate.name);
    throw UserError(place + ": there is no section '" + shortened(section) + "'." +
                    did_you_mean(section, known) + " Sections are " +
                    boost::algorithm::join(known, ", ") + ".");
  }



  void
  ParameterReader::check_section(const ParameterSection &section) const
  {
    const std::string         place  = section.origin.describe();
    const SectionDeclaration &parent = declaration(section.path[0], place);
    if (section.path.size() == 1)
      return;
    if (section.path.size() > 2 || parent.kind != SectionKind::named)
      throw UserError(place + ": the section " + full_name(section.path, "") +
                      " cannot stand here; section " + section.path[0] +
                      (parent.kind == SectionKind::named ? " holds subsections of one level only."
                                                         : " holds no subsections."));
    check_user_name(section.path[1], place);
    for (const ParameterSection &first : file.sections)
      {
        if (&first == &section)
          return;
        if (first.path == section.path && first.origin.file == section.origin.file)
          throw UserError(place + ": the name " + section.path[0] + "/" + section.path[1] +
                          " is given a second time; line " + std::to_string(first.origin.line) +
                          " has it already.");
      }
  }



  void
  ParameterReader::check_entry(const ParameterEntry &entry) const
  {
    const std::string         place = entry.origin.describe();
    const std::string         name  = full_name(entry.section, entry.name);
    const SectionDeclaration &section =
      declaration(entry.section.empty() ? "" : entry.section[0], place);

    const bool        named = section.kind == SectionKind::named;
    const std::size_t depth = section.name.empty() ? 0 : (named ? 2 : 1);
    if (entry.section.size() != depth)
      throw UserError(
        place + ": " + name + " is not an entry. " +
        (named ? "Entries of this section have the form " + section.name + "/<name>/<entry>."
               : "Section " + section.name + " holds no subsections."));
    if (named)
      check_user_name(entry.section[1], place);

    const EntryDeclaration *declared = nullptr;
    for (const EntryDeclaration &candidate : section.entries)
      if (candidate.name == entry.name || section.kind == SectionKind::free_entries)
        declared = &candidate;
    if (declared == nullptr)
      throw UserError(place + ": there is no entry " + shortened(name) + "." +
                      did_you_mean(entry.name, entry_names(section)) + " Entries here are " +
                      boost::algorithm::join(entry_names(section), ", ") + ".");

    const std::string problem = declared->pattern.problem(entry.value);
    if (!problem.empty())
      throw UserError(place + ": " + shortened(name) + " = " + shortened(entry.value) + ": " +
                      problem);
  }



  void
  ParameterReader::declare(const Path &path, const SectionDeclaration &section)
  {
    for (const std::string &part : path)
      handler.enter_subsection(part);
    for (const EntryDeclaration &entry : section.entries)
      {
        const ValuePattern pattern = entry.default_value ? entry.pattern : entry.pattern.or_empty();
        handler.declare_entry(entry.name,
                              entry.default_value.value_or(""),
                              pattern,
                              entry.documentation);
      }
    for (std::size_t i = 0; i < path.size(); ++i)
      handler.leave_subsection();
  }



  void
  ParameterReader::for_each_declared(
    const std::function<void(const Path &, const SectionDeclaration &)> &action) const
  {
    for (const SectionDeclaration &section : declarations)
      if (section.name.empty())
        action({}, section);
      else if (section.kind == SectionKind::plain)
        action({section.name}, section);
      else if (section.kind == SectionKind::named)
        for (const std::string &name : names(section.name))
          action({section.name, name}, section);
      else
        {
          SectionDeclaration                  given = section;
          const std::vector<EntryDeclaration> model = std::move(given.entries);
          given.entries.clear();
          for (const ParameterEntry &entry : file.entries)
            if (entry.section == Path{section.name})
              {
                given.entries.push_back(model[0]);
                given.entries.back().name = entry.name;
              }
          action({section.name}, given);
        }
  }



  void
  ParameterReader::require(const Path &section, const EntryDeclaration &entry) const
  {
    if (entry.default_value)
      return;
    for (const ParameterEntry &given : file.entries)
      if (given.section == section && given.name == entry.name)
        return;

    std::string hint;
    if (section.size() == 2)
      {
        std::vector<std::string> opened;
        for (const ParameterSection &candidate : file.sections)
          if (candidate.path.size() == 2 && candidate.path[0] == section[0])
            opened.push_back(candidate.path[1]);
        if (std::find(opened.begin(), opened.end(), section[1]) == opened.end())
          hint = did_you_mean(section[1], opened);
      }
    throw UserError(place(section, entry.name) + ": " + full_name(section, entry.name) +
                    " must be given: " + entry.pattern.description() + "." + hint);
  }



  std::vector<std::string>
  ParameterReader::names(const std::string &section) const
  {
    std::vector<std::string> names;
    const auto               add = [&](const Path &path) {
      if (path.size() == 2 && path[0] == section &&
          std::find(names.begin(), names.end(), path[1]) == names.end())
        names.push_back(path[1]);
    };
    for (const ParameterSection &opened : file.sections)
      add(opened.path);
    for (const ParameterEntry &entry : file.entries)
      add(entry.section);
    return names;
  }



  std::string
  ParameterReader::text(const Path &section, const std::string &name) const
  {
    return handler.get(section, name);
  }



  bool
  ParameterReader::differs_from_default(const Path &section, const std::string &name) const
  {
    for (const SectionDeclaration &candidate : declarations)
      if (candidate.name == (section.empty() ? "" : section[0]))
        for (const EntryDeclaration &entry : candidate.entries)
          if (entry.name == name)
            return text(section, name) != entry.default_value.value_or("");
    return false;
  }



  std::string
  ParameterReader::place(const Path &section, const std::string &name) const
  {
    for (const ParameterEntry &entry : file.entries)
      if (entry.section == section && entry.name == name)
        return entry.origin.describe();
    for (const ParameterSection &opened : file.sections)
      if (opened.path == section)
        return opened.origin.describe();
    for (const ParameterEntry &entry : file.entries)
      if (!section.empty() && entry.section == section)
        return entry.origin.describe();
    return file.file_name == "-" ? "standard input" : file.file_name;
  }



  const std::map<std::string, double> &
  ParameterReader::constants() const
  {
    return user_constants;
  }



  std::string
  ParameterReader::print() const
  {
    std::ostringstream out;
    handler.print_parameters(out,
                             dealii::ParameterHandler::ShortPRM |
                               dealii::ParameterHandler::KeepDeclarationOrder);
    return out.str();
  }



  std::map<std::string, std::string>
  ParameterReader::settings() const
  {
    std::stringstream json;
    handler.print_parameters(json, dealii::ParameterHandler::ShortJSON);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(json, tree);
    std::map<std::string, std::string>                                                  result;
    const std::function<void(const boost::property_tree::ptree &, const std::string &)> collect =
      [&](const boost::property_tree::ptree &section, const std::string &path) {
        for (const auto &[name, child] : section)
          if (child.empty())
            result[path + name] = child.data();
          else
            collect(child, path + name + '/');
      };
    collect(tree, "");
    return result;
  }
} // namespace kedge
