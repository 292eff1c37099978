#ifndef kedge_solid_support_term_h
#define kedge_solid_support_term_h

#include <kedge/equations/term.h>
#include <kedge/grid/parameters.h>

namespace kedge
{
  /**
   * The supports of a field: the residual at prescribed components is their force on the bodies.
   * Books the work of those that move, and the forces that the scene asks for.
   */
  template <int dim>
  class SupportTerm : public Term<dim>
  {
  public:
    SupportTerm(const unsigned int                               field,
                const Patch<dim>                                &patch,
                const std::vector<NodeConditionParameters<dim>> &conditions);

    std::string
    name() const override
    {
      return "supports";
    }

    void
    declare_books(Ledger &ledger) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    const unsigned int                              field;
    const Patch<dim>                               &patch;
    const std::vector<NodeConditionParameters<dim>> conditions;
    std::vector<Ledger::Index> reactions; ///< dim per condition; of those asked for
    Ledger::Index              work = 0;
  };
} // namespace kedge

#endif
