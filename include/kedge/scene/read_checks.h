#ifndef kedge_scene_read_checks_h
#define kedge_scene_read_checks_h

#include <kedge/io/parameters.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/time_integration/parameters.h>

#include <vector>

namespace kedge
{
  /**
   * The section Checks. That a probe exists is seen to here, that history.csv
   * and probes.csv have the column is seen to where they are written.
   *
   * @throws UserError for a check that cannot be made.
   */
  std::vector<CheckParameters>
  read_checks(const ParameterReader &reader, const TimeParameters &run);
} // namespace kedge

#endif
