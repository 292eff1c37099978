#include <kedge/base/exceptions.h>
#include <kedge/base/shortened.h>
#include <kedge/base/user_errors.h>
#include <kedge/scene/parameter_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <utility>

namespace kedge
{
  namespace
  {
    using Path = std::vector<std::string>;

    /** Runs of blanks become one, those at the ends go. */
    std::string
    squeeze(const std::string &text)
    {
      std::string squeezed;
      for (const char letter : text)
        if (!std::isspace(static_cast<unsigned char>(letter)))
          squeezed += letter;
        else if (!squeezed.empty() && squeezed.back() != ' ')
          squeezed += ' ';
      return dealii::Utilities::trim(squeezed);
    }

    std::string
    join(const Path &path)
    {
      std::string joined;
      for (const std::string &part : path)
        joined += part + "/";
      return joined;
    }

    /** Replaces the value of an entry or appends it. */
    void
    put(std::vector<ParameterEntry> &entries, const ParameterEntry &entry)
    {
      const auto same =
        std::find_if(entries.begin(), entries.end(), [&](const ParameterEntry &other) {
          return other.section == entry.section && other.name == entry.name;
        });
      if (same == entries.end())
        entries.push_back(entry);
      else
        *same = entry;
    }

    /** Splits "name = value"; false if there is no = or no name. */
    bool
    split_assignment(const std::string &text, std::string &name, std::string &value)
    {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        return false;
      name  = squeeze(text.substr(0, equals));
      value = dealii::Utilities::trim(text.substr(equals + 1));
      return !name.empty();
    }



    /** Reads one file, and by recursion those that it includes. */
    class FileParser
    {
    public:
      FileParser(const std::string              &file_name,
                 const std::vector<std::string> &including_files,
                 const Path                     &section,
                 ParameterFile                  &result)
        : file_name(file_name)
        , including_files(including_files)
        , section(section)
        , depth_at_begin(section.size())
        , result(result)
      {}

      void
      parse(std::istream &input)
      {
        std::string line, statement;
        for (unsigned int number = 1; std::getline(input, line); ++number)
          {
            if (statement.empty())
              origin = {file_name, number};
            line                 = dealii::Utilities::trim(line.substr(0, line.find('#')));
            const bool continued = !line.empty() && line.back() == '\\';
            if (continued)
              line.pop_back();
            statement += line;
            if (continued)
              continue;
            if (!statement.empty())
              attempt(statement);
            statement.clear();
          }
        if (input.bad())
          throw UserError(file_name + ": cannot be read to its end.");
        if (!statement.empty())
          attempt(statement);
        errors.throw_if_any();
        if (section.size() > depth_at_begin)
          throw UserError(opened_at.back().describe() + ": subsection " +
                          shortened(section.back()) +
                          " is not closed; write 'end' after its last entry.");
      }

    private:
      /** Keeps errors for later, but what follows a wrong 'end' has no meaning. */
      void
      attempt(const std::string &statement)
      {
        if (!errors.attempt([&]() {
              handle(statement);
            }) &&
            (statement.rfind("end", 0) == 0 || statement.rfind("END", 0) == 0))
          errors.throw_if_any();
      }

      void
      handle(const std::string &statement)
      {
        const std::size_t blank   = statement.find_first_of(" \t");
        const std::string keyword = statement.substr(0, blank);
        const std::string rest =
          blank == std::string::npos ? "" : dealii::Utilities::trim(statement.substr(blank));
        if (keyword == "set" || keyword == "SET")
          handle_set(rest);
        else if (keyword == "subsection" || keyword == "SUBSECTION")
          handle_subsection(rest);
        else if ((keyword == "end" || keyword == "END") && rest.empty())
          handle_end();
        else if (keyword == "include" || keyword == "INCLUDE")
          handle_include(rest);
        else
          throw UserError(origin.describe() + ": '" + shortened(statement) +
                          "' is not a line of a parameter file; allowed are 'set name = value', "
                          "'subsection name', 'end' and 'include file'.");
      }

      void
      handle_set(const std::string &assignment)
      {
        ParameterEntry entry;
        if (!split_assignment(assignment, entry.name, entry.value))
          throw UserError(origin.describe() + ": 'set " + shortened(assignment) +
                          "' does not have the form 'set name = value'.");
        entry.section              = section;
        entry.origin               = origin;
        const std::string key      = join(section) + entry.name;
        const auto [first, is_new] = first_lines.emplace(key, origin.line);
        if (!is_new)
          throw UserError(origin.describe() + ": " + shortened(key) +
                          " is set a second time; line " + std::to_string(first->second) +
                          " has set it already.");
        put(result.entries, entry);
      }

      void
      handle_subsection(const std::string &name)
      {
        if (name.empty())
          throw UserError(origin.describe() + ": a subsection lacks its name.");
        section.push_back(squeeze(name));
        opened_at.push_back(origin);
        result.sections.push_back({section, origin});
      }

      void
      handle_end()
      {
        if (section.size() == depth_at_begin)
          throw UserError(origin.describe() + ": 'end' without a subsection to close.");
        section.pop_back();
        opened_at.pop_back();
      }

      void
      handle_include(const std::string &name)
      {
        const std::filesystem::path path =
          std::filesystem::path(file_name).parent_path() / std::filesystem::path(name);
        std::vector<std::string> files = including_files;
        files.push_back(file_name);
        std::error_code error; // for instance of a name that is too long
        errno = 0;
        std::ifstream input(path);
        if (name.empty() || std::filesystem::is_directory(path, error) || !input)
          throw UserError(origin.describe() + ": the included file '" + shortened(path.string()) +
                          "' cannot be opened" +
                          (errno != 0 ? ": " + std::string(std::strerror(errno)) : "") + ".");
        for (const std::string &file : files)
          if (std::filesystem::equivalent(file, path, error))
            throw UserError(origin.describe() + ": the file '" + shortened(name) +
                            "' includes itself.");
        FileParser(path.string(), files, section, result).parse(input);
      }

      const std::string                   file_name;
      const std::vector<std::string>      including_files;
      Path                                section;
      const std::size_t                   depth_at_begin;
      ParameterFile                      &result;
      ParameterOrigin                     origin;
      std::vector<ParameterOrigin>        opened_at; ///< of the subsections now open
      UserErrors                          errors;
      std::map<std::string, unsigned int> first_lines;
    };



    ParameterFile
    read_named_file(const std::string &file_name)
    {
      if (file_name == "-")
        return ParameterFile::read(std::cin, "-");
      std::error_code error;
      if (std::filesystem::is_directory(file_name, error))
        throw UserError("The scene '" + file_name + "' is a folder, not a parameter file.");
      errno = 0;
      std::ifstream input(file_name);
      if (!input)
        throw UserError("The scene '" + shortened(file_name) + "' cannot be opened: " +
                        (errno != 0 ? std::strerror(errno) : "unknown cause") + ".");
      return ParameterFile::read(input, file_name);
    }
  } // namespace



  std::string
  ParameterOrigin::describe() const
  {
    if (file.empty())
      return "option --set";
    if (line == 0)
      return file;
    return (file == "-" ? "standard input" : file) + ":" + std::to_string(line);
  }



  ParameterFile
  ParameterFile::read(const std::string &file_name, const MPI_Comm communicator)
  {
    std::pair<std::string, ParameterFile> error_and_file;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          error_and_file.second = read_named_file(file_name);
        }
      catch (const UserError &error)
        {
          error_and_file.first = error.what();
        }
    error_and_file = dealii::Utilities::MPI::broadcast(communicator, error_and_file);
    if (!error_and_file.first.empty())
      throw UserError(error_and_file.first);
    return error_and_file.second;
  }



  ParameterFile
  ParameterFile::read(std::istream &input, const std::string &file_name)
  {
    ParameterFile file;
    file.file_name = file_name;
    FileParser(file_name, {}, {}, file).parse(input);
    return file;
  }



  void
  ParameterFile::set(const std::string &assignment)
  {
    ParameterEntry entry;
    std::string    name;
    if (!split_assignment(assignment, name, entry.value))
      throw UserError("The option --set '" + shortened(assignment) +
                      "' does not have the form --set \"Section/Name = value\".");
    entry.section = dealii::Utilities::split_string_list(name, '/');
    entry.name    = entry.section.back();
    entry.section.pop_back();
    put(entries, entry);
  }



  void
  ParameterFile::set(const std::vector<std::string> &section,
                     const std::string              &name,
                     const std::string              &value,
                     const ParameterOrigin          &origin)
  {
    Path path;
    for (const std::string &part : section)
      path.push_back(squeeze(part));
    put(entries, {path, squeeze(name), dealii::Utilities::trim(value), origin});
  }



  void
  ParameterFile::print(std::ostream &out) const
  {
    print_below({}, out);
  }



  void
  ParameterFile::print_below(const std::vector<std::string> &path, std::ostream &out) const
  {
    const std::string indent(2 * path.size(), ' ');
    Path              below; // names of the sections one level down, in their order
    const auto        note = [&](const Path &other) {
      if (other.size() > path.size() && std::equal(path.begin(), path.end(), other.begin()) &&
          std::find(below.begin(), below.end(), other[path.size()]) == below.end())
        below.push_back(other[path.size()]);
    };
    for (const ParameterSection &section : sections)
      note(section.path);
    for (const ParameterEntry &entry : entries)
      {
        note(entry.section);
        if (entry.section == path)
          out << indent << "set " << entry.name << " = " << entry.value << "\n";
      }
    for (const std::string &name : below)
      {
        out << indent << "subsection " << name << "\n";
        Path deeper = path;
        deeper.push_back(name);
        print_below(deeper, out);
        out << indent << "end\n";
      }
  }



  std::string
  ParameterFile::scene_name() const
  {
    return file_name == "-" ? "stdin" : std::filesystem::path(file_name).stem().string();
  }
} // namespace kedge
