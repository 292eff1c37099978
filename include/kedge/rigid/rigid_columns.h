#ifndef kedge_rigid_rigid_columns_h
#define kedge_rigid_rigid_columns_h

#include <kedge/equations/ledger.h>

#include <algorithm>

namespace kedge
{
  /** A column of something rigid, named after what it holds, its owner and, if any, a component. */
  inline Ledger::Entry
  rigid_column(const std::string &what,
               const std::string &unit,
               const Ledger::Kind kind,
               const std::string &owner,
               const int          component = -1)
  {
    std::string name = what + "_" + owner;
    std::replace(name.begin(), name.end(), ' ', '_');
    if (component >= 0)
      name += std::string("_") + "xyz"[component];
    return {name, unit, Ledger::Section::force, kind};
  }
} // namespace kedge

#endif
