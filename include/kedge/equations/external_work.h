#ifndef kedge_equations_external_work_h
#define kedge_equations_external_work_h

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
} // namespace kedge

#endif
