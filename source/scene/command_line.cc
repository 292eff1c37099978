#include <kedge/base/exceptions.h>
#include <kedge/base/nearest_name.h>
#include <kedge/base/shortened.h>
#include <kedge/scene/command_line.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <sstream>

namespace kedge
{
  namespace
  {
    /** One option: its names, how the help explains it, and what it sets. */
    struct Option
    {
      std::string                                             name;       ///< "--output"
      std::string                                             short_name; ///< "-o" or nothing
      std::string                                             argument;   ///< "DIR"; empty: a flag
      std::string                                             help;
      std::function<void(CommandLine &, const std::string &)> apply;
    };

    std::function<void(CommandLine &, const std::string &)>
    raise(bool CommandLine::*flag)
    {
      return [flag](CommandLine &command, const std::string &) {
        command.*flag = true;
      };
    }

    void
    set_threads(CommandLine &command, const std::string &value)
    {
      unsigned int n_threads = 0;
      const auto   end       = value.data() + value.size();
      const auto   result    = std::from_chars(value.data(), end, n_threads);
      if (result.ec != std::errc() || result.ptr != end || n_threads < 1)
        throw UserError("The option --threads needs a whole number of at least 1, not '" + value +
                        "'.");
      command.n_threads = n_threads;
    }

    const std::vector<Option> &
    options()
    {
      static const std::vector<Option> table = {
        {"--output",
         "-o",
         "DIR",
         "folder for the results (default: output/<scene name>)",
         [](CommandLine &command, const std::string &value) {
           command.output = value;
         }},
        {"--set",
         "-s",
         "\"Section/Name = value\"",
         "set a parameter; wins over the file; may be repeated",
         [](CommandLine &command, const std::string &value) {
           command.settings.push_back(value);
         }},
        {"--drive",
         "",
         "",
         "the file is a path: deform one material point along it, write its stress",
         raise(&CommandLine::drive)},
        {"--resume",
         "",
         "",
         "go on from the last good checkpoint in the output folder",
         raise(&CommandLine::resume)},
        {"--validate",
         "",
         "",
         "read and build the scene, print its size, run no step",
         raise(&CommandLine::validate)},
        {"--strict",
         "",
         "",
         "a failed check of the scene makes the exit code 2",
         raise(&CommandLine::strict)},
        {"--threads",
         "",
         "N",
         "threads of the BLAS in direct solvers (1); all else uses one, see mpirun",
         set_threads},
        {"--print-parameters",
         "",
         "",
         "print every parameter with unit, default and allowed values; with the name of a section "
         "after it that one alone, with json all for scripts",
         raise(&CommandLine::print_parameters)},
        {"--version",
         "",
         "",
         "print the versions of kedge and of what it is built on",
         raise(&CommandLine::version)},
        {"--help", "-h", "", "print this help", raise(&CommandLine::help)}};
      return table;
    }

    const Option &
    find_option(const std::string &name)
    {
      std::vector<std::string> names;
      for (const Option &option : options())
        {
          if (name == option.name || name == option.short_name)
            return option;
          names.push_back(option.name);
        }
      throw UserError("There is no option " + shortened(name) + "." + did_you_mean(name, names) +
                      " kedge --help lists all options.");
    }

    /** Splits "--output=DIR"; a short option and one with a blank stay as they are. */
    std::pair<std::string, std::optional<std::string>>
    split_option(const std::string &argument)
    {
      const std::size_t equals = argument.find('=');
      if (argument.rfind("--", 0) != 0 || equals == std::string::npos)
        return {argument, std::nullopt};
      return {argument.substr(0, equals), argument.substr(equals + 1)};
    }
  } // namespace



  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    CommandLine                    command;
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    command.arguments.assign(argv, argv + argc);
    for (std::size_t i = 0; i < arguments.size(); ++i)
      {
        if (arguments[i].empty() || arguments[i] == "-" || arguments[i][0] != '-')
          {
            if (arguments[i].empty())
              throw UserError("The name of the scene is empty.");
            if (!command.scene.empty())
              throw UserError("Only one scene can be run at a time, not '" + command.scene +
                              "' and '" + arguments[i] + "'.");
            command.scene = arguments[i];
            continue;
          }
        auto [name, value]   = split_option(arguments[i]);
        const Option &option = find_option(name);
        if (option.argument.empty() && value)
          throw UserError("The option " + name + " takes no value.");
        if (!option.argument.empty() && !value)
          {
            if (++i == arguments.size())
              throw UserError("The option " + name + " needs a value: " + name + " " +
                              option.argument + ".");
            value = arguments[i];
          }
        if (!option.argument.empty() && value->empty())
          throw UserError("The option " + name + " has an empty value.");
        option.apply(command, value.value_or(""));
      }
    if (command.scene.empty() && !command.help && !command.version && !command.print_parameters)
      throw UserError("Which scene? Give a parameter file: kedge SCENE.prm; - reads standard "
                      "input, kedge --help says more.");
    if (command.drive && (command.resume || command.validate))
      throw UserError("The option --drive goes with neither --resume nor --validate.");
    return command;
  }



  std::string
  help_text()
  {
    std::ostringstream out;
    out
      << "kedge SCENE.prm [options]\n\n"
         "Large deformations of solids by the implicit Material Point Method.\n"
         "A - as SCENE reads standard input.\n\n"
         "kedge init NAME [KIND]         writes a commented scene to start from\n"
         "kedge plot DIR                 draws pictures of a run; kedge plot --help\n"
         "kedge sweep SCENE.prm ..       runs a scene with many settings; kedge sweep --help\n"
         "kedge safety SCENE.prm         by what its strengths can be divided; kedge safety --help\n"
         "(by the script kedge that starts this program)\n\nOptions\n";
    for (const Option &option : options())
      out << "  " << (option.short_name.empty() ? "" : option.short_name + ", ") << option.name
          << (option.argument.empty() ? "" : " ") << option.argument << "\n      " << option.help
          << '\n';
    out << "\nExit codes\n"
           "  0  finished\n"
           "  1  the scene or an option cannot be used\n"
           "  2  the numerics: the smallest time step was reached; with --strict, a check failed\n"
           "  3  stopped by SIGINT, SIGTERM or SIGUSR1, after writing a checkpoint\n"
           "  4  an internal error\n";
    return out.str();
  }
} // namespace kedge
