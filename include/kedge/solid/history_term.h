#ifndef kedge_solid_history_term_h
#define kedge_solid_history_term_h

#include <kedge/equations/term.h>
#include <kedge/solid/point_update.h>

namespace kedge
{
  /**
   * The strains, stresses and material histories of a field's points: evaluated at the
   * end of a step, refused where det F <= 0, committed with it. It has no residual.
   * Books the energies of the (effective) stress.
   */
  template <int dim>
  class HistoryTerm : public Term<dim>
  {
  public:
    HistoryTerm(const unsigned int           field,
                const Patch<dim>            &patch,
                const std::vector<Material> &material_of_body,
                const MemoryColumns         &columns_of_body);

    std::string
    name() const override
    {
      return "material histories";
    }

    void
    declare_books(Ledger &ledger) override;

    Answer
    finish(const Trial<dim> &trial) override;

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    book_state(const MaterialPoints<dim> &cloud, Ledger &ledger) const override;

  private:
    const unsigned int            field;
    const Patch<dim>             &patch;
    const std::vector<Material>   material_of_body;
    const MemoryColumns           columns_of_body; ///< in the points' memory
    bool                          has_plasticity;
    std::vector<PointUpdate<dim>> updates;
    Ledger::Index                 strain_energy = 0, hardening_energy = 0, dissipation = 0;
  };
} // namespace kedge

#endif
