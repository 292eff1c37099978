#ifndef kedge_solid_load_columns_h
#define kedge_solid_load_columns_h

#include <kedge/equations/ledger.h>

namespace kedge
{
  /** The work of loads and supports: one column, whoever does it. */
  inline const Ledger::Entry external_work = {"external_work",
                                              "J",
                                              Ledger::Section::work,
                                              Ledger::Kind::total,
                                              Ledger::Role::supplied,
                                              "energy"};

  /** A component of a force of the step, for example "reaction_base_y" [N]. */
  inline Ledger::Entry
  force_column(const std::string &what, const std::string &name, const int component)
  {
    return {what + "_" + name + "_" + "xyz"[component],
            "N",
            Ledger::Section::force,
            Ledger::Kind::of_step};
  }
} // namespace kedge

#endif
