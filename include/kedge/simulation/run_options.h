#ifndef kedge_simulation_run_options_h
#define kedge_simulation_run_options_h

#include <kedge/base/exceptions.h>

#include <filesystem>
#include <string>
#include <vector>

namespace kedge
{
  struct RunOptions
  {
    std::filesystem::path    output;
    bool                     resume = false;
    bool                     strict = false; ///< a failed check makes the exit code 2
    std::vector<std::string> notes;          ///< on the scene, for the log
    std::string              resume_command; ///< with which the user goes on; for the log
  };

  /** How a run ended, and why if it stopped before the end. */
  struct RunEnd
  {
    ExitCode    code;
    std::string reason;
  };
} // namespace kedge

#endif
