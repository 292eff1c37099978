#ifndef kedge_io_versions_h
#define kedge_io_versions_h

#include <map>
#include <string>

namespace kedge
{
  /** kedge, deal.II, Trilinos, p4est, BLAS (the library in use), build_type. */
  std::map<std::string, std::string>
  software_versions();
} // namespace kedge

#endif
