#ifndef kedge_io_check_result_h
#define kedge_io_check_result_h

#include <string>

namespace kedge
{
  /** What became of a check of the scene. */
  struct CheckResult
  {
    std::string name;
    double      value     = 0; ///< NaN if it could not be had
    double      reference = 0;
    double      tolerance = 0;
    bool        relative  = true;
    bool        pass      = false;
    std::string source;
    std::string remark; ///< why the value could not be had; else empty
  };
} // namespace kedge

#endif
