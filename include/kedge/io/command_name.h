#ifndef kedge_io_command_name_h
#define kedge_io_command_name_h

#include <cstdlib>
#include <string>

namespace kedge
{
  /** How the user calls kedge; the scripts that start the program say it in the environment. */
  inline std::string
  command_name()
  {
    const char *name = std::getenv("KEDGE_COMMAND");
    return name != nullptr ? name : "./kedge";
  }
} // namespace kedge

#endif
