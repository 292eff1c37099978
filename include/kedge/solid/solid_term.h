#ifndef kedge_solid_solid_term_h
#define kedge_solid_solid_term_h

#include <kedge/equations/term.h>
#include <kedge/solid/internal_force.h>

namespace kedge
{
  /**
   * The internal force of the dry bodies of a field, f_int(u) of (3.114), (3.148) and its
   * tangent.
   */
  template <int dim>
  class SolidTerm : public Term<dim>
  {
  public:
    SolidTerm(const unsigned int           field,
              const Patch<dim>            &patch,
              const std::vector<Material> &material_of_body,
              const Scheme                &scheme);

    std::string
    name() const override
    {
      return "internal force";
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_residual_at_rest(const double t, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

  private:
    const unsigned int       field;
    const Patch<dim>        &patch;
    const InternalForce<dim> internal_force;
    const InternalForce<dim> force_at_rest; ///< of the present configuration
  };
} // namespace kedge

#endif
