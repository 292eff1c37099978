#ifndef kedge_solid_load_columns_h
#define kedge_solid_load_columns_h

#include <kedge/equations/external_work.h>

#include <vector>

namespace kedge
{
  /** A component of a force of the step, for example "reaction_base_y" [N]. */
  inline Ledger::Entry
  force_column(const std::string &what, const std::string &name, const int component)
  {
    return {what + "_" + name + "_" + "xyz"[component],
            "N",
            Ledger::Section::force,
            Ledger::Kind::of_step};
  }

  /**
   * Columns of the reactions [N] of those @p conditions that ask for them: dim to a
   * condition, 0 where it does not.
   */
  template <int dim, typename Condition>
  std::vector<Ledger::Index>
  declare_reactions(Ledger &ledger, const std::vector<Condition> &conditions)
  {
    std::vector<Ledger::Index> columns(conditions.size() * dim, 0);
    for (std::size_t c = 0; c < conditions.size(); ++c)
      for (int d = 0; d < dim && conditions[c].reaction; ++d)
        columns[c * dim + d] = ledger.declare(force_column("reaction", conditions[c].name, d));
    return columns;
  }
} // namespace kedge

#endif
