#ifndef kedge_solid_inertia_term_h
#define kedge_solid_inertia_term_h

#include <kedge/equations/term.h>

namespace kedge
{
  /**
   * The inertia of the dry bodies of a field, M a_m(u), with the mass that the velocity
   * mapping uses too: only so is energy conserved.
   */
  template <int dim>
  class InertiaTerm : public Term<dim>
  {
  public:
    /** @param mass of the field, one component; must last as long as this */
    InertiaTerm(const unsigned int     field,
                const Patch<dim>      &patch,
                const NodeMatrix<dim> &mass,
                const Scheme          &scheme)
      : field(field)
      , patch(patch)
      , mass(mass)
      , scheme(scheme)
    {}

    std::string
    name() const override
    {
      return "inertia";
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override
    {
      unknowns.traits.dominated_by_inertia = true;
    }

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

  private:
    const unsigned int     field;
    const Patch<dim>      &patch;
    const NodeMatrix<dim> &mass;
    const Scheme           scheme;
  };
} // namespace kedge

#endif
