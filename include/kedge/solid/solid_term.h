#ifndef kedge_solid_solid_term_h
#define kedge_solid_solid_term_h

#include <kedge/equations/term.h>
#include <kedge/solid/internal_force.h>

namespace kedge
{
  /**
   * The internal force of the dry bodies of a field, f_int(u) of (3.114), (3.148) and its
   * tangent, with the stress of dashpots beside the materials that have a viscosity.
   */
  template <int dim>
  class SolidTerm : public Term<dim>
  {
  public:
    /** @param viscosity_of_body one per body [Pa s]; empty: all are 0 */
    SolidTerm(const unsigned int           field,
              const Patch<dim>            &patch,
              const std::vector<Material> &material_of_body,
              const Scheme                &scheme,
              const std::vector<double>   &viscosity_of_body = {});

    std::string
    name() const override
    {
      return "internal force";
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

    void
    declare_books(Ledger &ledger) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_residual_at_rest(const double t, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    /** The dissipation of the dashpots, sum_p V0 c E : E. */
    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    /** 2 eta/dt of each body [Pa]; empty if none has a viscosity. */
    std::vector<double>
    viscous_moduli(const double dt) const;

    const unsigned int       field;
    const Patch<dim>        &patch;
    const InternalForce<dim> internal_force;
    const InternalForce<dim> force_at_rest; ///< of the present configuration
    std::vector<double>      viscosities;   ///< empty if all are 0
    Ledger::Index            viscous_dissipation{};
  };
} // namespace kedge

#endif
