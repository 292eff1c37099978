# Writes the git revision of the sources into a C++ file, only if it changed.
set(revision "")
find_program(git git)
if(git)
  execute_process(COMMAND ${git} -C ${source_folder} describe --always --dirty --abbrev=12
    OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${output} CONTENT [[
#include <kedge/base/version.h>

namespace kedge::version
{
  const char *const revision = "@revision@";
}
]] @ONLY)
