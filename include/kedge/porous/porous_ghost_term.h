#ifndef kedge_porous_porous_ghost_term_h
#define kedge_porous_porous_ghost_term_h

#include <kedge/porous/porous_term.h>
#include <kedge/solid/ghost_term.h>

namespace kedge
{
  /**
   * Ghost stabilisation of the pore pressure of a field (4.178) on the faces of GhostTerm:
   *   dt K_G^(f)/rho_0 p + M_G^(f)/rho_0 (p_{n+1} - p_n).
   */
  template <int dim>
  class PorousGhostTerm : public Term<dim>
  {
  public:
    /** The other terms must last as long as this. */
    PorousGhostTerm(const unsigned int             field,
                    const Patch<dim>              &patch,
                    const GhostTerm<dim>          &ghosts,
                    const PorousTerm<dim>         &soil,
                    const StabilisationParameters &parameters,
                    const PoreFluidParameters     &fluid);

    std::string
    name() const override
    {
      return "ghost stabilisation of pressures";
    }

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    std::vector<double>
    flow(const Trial<dim> &trial) const;

    const unsigned int            field;
    const Patch<dim>             &patch;
    const GhostTerm<dim>         &ghosts;
    const PorousTerm<dim>        &soil;
    const StabilisationParameters parameters;
    const PoreFluidParameters     fluid;
    const double                  theta;
    NodeMatrix<dim>               conductance; ///< K_G^(f)/rho_0 (4.177) [m^3/(Pa s)]
    NodeMatrix<dim>               storage;     ///< M_G^(f)/rho_0 (4.176) [m^3/Pa]
    std::vector<double>           pressure_n; ///< at the nodes, of the points at n; for the storage
    Ledger::Index                 energy = 0;
  };
} // namespace kedge

#endif
