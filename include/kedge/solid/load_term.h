#ifndef kedge_solid_load_term_h
#define kedge_solid_load_term_h

#include <kedge/equations/term.h>
#include <kedge/solid/external_loads.h>
#include <kedge/solid/load_factor.h>
#include <kedge/solid/surface_loads.h>
#include <kedge/transfer/motion_term.h>

namespace kedge
{
  /**
   * The external forces on the points and outer faces of a field, f_ext at the load time of the
   * scheme. Books their work: that of their value in the middle of the step. Where they follow
   * a load factor l they are taken at t = l.
   */
  template <int dim>
  class LoadTerm
    : public Term<dim>
    , public ControlledLoads<dim>
  {
  public:
    /** @param motion of the points, whose displacements the forces work on */
    LoadTerm(const unsigned int              field,
             const Patch<dim>               &patch,
             const ExternalLoads<dim>       &loads,
             const SurfaceTractions<dim>    &tractions,
             const std::vector<std::string> &body_names,
             const MotionTerm<dim>          &motion,
             const Scheme                   &scheme);

    /** Further forces on faces; they must last as long as this. */
    void
    add_forces(const SurfaceLoads<dim> &forces)
    {
      on_faces.push_back(&forces);
    }

    double
    square_of_slope(const Trial<dim> &trial) const override;

    void
    add_slope(const Trial<dim>   &trial,
              const double        s,
              const UnknownIndex &x,
              Tangent<dim>       &tangent) const override;

    const ExternalLoads<dim> &
    external_loads() const
    {
      return loads;
    }

    std::string
    name() const override
    {
      return "loads";
    }

    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    void
    start(Trial<dim> &trial) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_residual_at_rest(const double t, Residual<dim> &residual) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    bool
    empty() const;
    std::vector<dealii::Tensor<1, dim>>
    forces_at(const double t) const;
    std::vector<double>
    at_nodes(const double t) const;
    std::vector<double>
    slope_at_nodes(const double l) const;
    void
    add_external_force(Residual<dim> &residual) const;

    const unsigned int                     field;
    const Patch<dim>                      &patch;
    ExternalLoads<dim>                     loads;
    SurfaceTractions<dim>                  tractions;
    const std::vector<std::string>         body_names;
    const MotionTerm<dim>                 &motion;
    std::vector<const SurfaceLoads<dim> *> on_faces;       ///< tractions and others
    std::vector<double>                    external_force; ///< at the owned nodes [N]
    Ledger::Index                          work = 0;
    std::vector<Ledger::Index>             resultants; ///< dim per traction; 0 where not shown
  };
} // namespace kedge

#endif
