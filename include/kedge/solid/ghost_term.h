#ifndef kedge_solid_ghost_term_h
#define kedge_solid_ghost_term_h

#include <kedge/equations/term.h>
#include <kedge/transfer/ghost_penalty.h>
#include <kedge/transfer/parameters.h>

namespace kedge
{
  /**
   * Ghost stabilisation of the displacements of a field, alpha_f K_G u of (3.154), (4.174)
   * on the nodes of partly filled cells.
   */
  template <int dim>
  class GhostTerm : public Term<dim>
  {
  public:
    /** @param modulus_of_body Young's moduli [Pa] */
    GhostTerm(const unsigned int             field,
              const Patch<dim>              &patch,
              const StabilisationParameters &parameters,
              const std::vector<double>     &modulus_of_body,
              const Scheme                  &scheme);

    std::string
    name() const override
    {
      return "ghost stabilisation";
    }

    void
    declare_books(Ledger &ledger) override;

    void
    reach(const unsigned int field, std::vector<unsigned char> &reached) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    /** The faces with a penalty, for other terms on them. */
    const GhostPenalty<dim> &
    penalty() const
    {
      return ghosts;
    }

    /** How far the faces couple nodes: the outer ones of two cells. */
    static constexpr int radius = 2;

  private:
    const unsigned int            field;
    const Patch<dim>             &patch;
    const StabilisationParameters parameters;
    const std::vector<double>     modulus_of_body;
    const Scheme                  scheme;
    GhostPenalty<dim>             ghosts;
    NodeMatrix<dim>               stiffness; ///< K_G (4.173) [N/m]
    Ledger::Index                 energy = 0;
  };

  /**
   * Its inertia, M_G a of (3.154), (4.174). Where the mass is badly conditioned M_G is
   * part of the velocity mapping too.
   */
  template <int dim>
  class GhostInertiaTerm : public Term<dim>
  {
  public:
    /** @param ghosts of the field, whose faces have the mass; must last as long as this */
    GhostInertiaTerm(const unsigned int             field,
                     const Patch<dim>              &patch,
                     const GhostTerm<dim>          &ghosts,
                     const StabilisationParameters &parameters,
                     const Scheme                  &scheme);

    std::string
    name() const override
    {
      return "inertia of the ghost stabilisation";
    }

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    void
    add_mapping_mass(const unsigned int field, NodeMatrix<dim> &mass) const override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    const unsigned int    field;
    const Patch<dim>     &patch;
    const GhostTerm<dim> &ghosts;
    const double          factor;
    const Scheme          scheme;
    NodeMatrix<dim>       mass;              ///< M_G (4.172) [kg]
    mutable bool          is_mapped = false; ///< M_G is part of the velocity mapping
    Ledger::Index         energy    = 0;
  };
} // namespace kedge

#endif
