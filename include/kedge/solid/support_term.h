#ifndef kedge_solid_support_term_h
#define kedge_solid_support_term_h

#include <kedge/equations/term.h>
#include <kedge/grid/parameters.h>

namespace kedge
{
  /**
   * The supports of a field: the residual at prescribed components is their force on the bodies.
   * Books the work of those that move, and the forces that the scene asks for. Without inertia
   * a body that comes off the nodes of a condition is an error: nothing says where it would go.
   */
  template <int dim>
  class SupportTerm : public Term<dim>
  {
  public:
    SupportTerm(const unsigned int                               field,
                const Patch<dim>                                &patch,
                const std::vector<NodeConditionParameters<dim>> &conditions,
                const Scheme                                    &scheme);

    std::string
    name() const override
    {
      return "supports";
    }

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    /** No residual; an answer why there is no step if a condition has lost its body. */
    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    const unsigned int                              field;
    const Patch<dim>                               &patch;
    const std::vector<NodeConditionParameters<dim>> conditions;
    const bool                                      can_lose; ///< its bodies: there is inertia
    std::vector<double>        n_held;    ///< nodes of each condition, of all ranks
    std::string                lost;      ///< conditions that hold nothing any more; empty: none
    std::vector<Ledger::Index> reactions; ///< dim per condition; of those asked for
    Ledger::Index              work = 0;
  };
} // namespace kedge

#endif
