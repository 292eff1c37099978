#ifndef kedge_scene_command_line_h
#define kedge_scene_command_line_h

#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** What the user asked for on the command line: kedge SCENE.prm [options]. */
  struct CommandLine
  {
    std::vector<std::string>    arguments; ///< as they are, the program's name first
    std::string                 scene;     ///< path; "-" is standard input; see print_parameters
    std::string                 output;    ///< -o, --output; empty: output/<scene name>
    std::vector<std::string>    settings;  ///< -s, --set, each "Section/Name = value"
    std::optional<unsigned int> n_threads; ///< --threads, at least 1
    bool                        drive            = false; ///< the scene is a path of one point
    bool                        resume           = false;
    bool                        validate         = false;
    bool                        strict           = false;
    bool                        print_parameters = false; ///< of the section `scene`, if given
    bool                        version          = false;
    bool                        help             = false;
  };

  /**
   * Reads main's arguments. Options may stand before or after the scene; those
   * with a value take it as the next argument or after an equals sign
   * (--output DIR, --output=DIR).
   *
   * @throws UserError for an unknown option (naming the nearest valid one), a
   * missing or wrong value, a second scene, or no scene where one is needed
   * (--print-parameters, --version and --help need none).
   */
  CommandLine
  parse_command_line(int argc, const char *const *argv);

  /** What --help prints: usage, options, exit codes. */
  std::string
  help_text();
} // namespace kedge

#endif
