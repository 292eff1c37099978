#ifndef kedge_solid_load_control_term_h
#define kedge_solid_load_control_term_h

#include <kedge/base/expression.h>
#include <kedge/equations/term.h>
#include <kedge/solid/load_factor.h>
#include <kedge/solid/parameters.h>

namespace kedge
{
  /**
   * Loads that are found instead of given: they are taken at a load factor l in place of the
   * time, and l is the unknown of one more equation,
   *   d . (u_p(t + dt) - u_p(t)) = g(t + dt) - g(t),
   * which says how a material point p moves along a direction d. So a run goes over a largest load
   * and down behind it, as long as u_p grows. l begins at the start of the run's time.
   *
   * The unknown x and its equation are scaled so that they have the units of the others:
   * l = l_n + s x, s |df/dl| = k, k = M h^(dim-2); [x] = m.
   */
  template <int dim>
  class LoadControlTerm
    : public Term<dim>
    , public LoadFactor<dim>
  {
  public:
    /**
     * @param control   what the scene says
     * @param constants of its expression
     * @param field     to which the point's body belongs
     * @param patch     of that field
     * @param stiffness k, of that body [N/m; N/m^2 in 2D]
     * @param start     of the run, l at first
     * @param loads     of all fields; they follow l from now on and last as long as this
     */
    LoadControlTerm(const LoadControlParameters<dim>          &control,
                    const std::map<std::string, double>       &constants,
                    const std::vector<std::string>            &body_names,
                    const unsigned int                         field,
                    const Patch<dim>                          &patch,
                    const double                               stiffness,
                    const double                               start,
                    const std::vector<ControlledLoads<dim> *> &loads);

    std::string
    name() const override
    {
      return "load control";
    }

    /** @throws UserError if no point is near */
    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    declare_unknowns(Unknowns<dim> &unknowns) override;

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

    void
    commit(const Trial<dim> &trial, MaterialPoints<dim> &cloud) override;

    void
    save(SavedState &state) const override;

    void
    restore(const SavedState &state) override;

    double
    at_start() const override
    {
      return factor_n;
    }

    double
    at_balance(const Trial<dim> &trial) const override;

  private:
    /** How far the point moves along the direction in a step [m], this rank's share. */
    double
    moved(const Trial<dim> &trial) const;
    /** The derivative of the loads by l has this norm [N; N/m in 2D] (collective). */
    double
    norm_of_slope(const Trial<dim> &trial) const;
    bool
    is_first() const;

    const LoadControlParameters<dim>          control;
    const Expression                          displacement; ///< g(t) [m]
    const std::vector<std::string>            body_names;
    const unsigned int                        field;
    const Patch<dim>                         &patch;
    const double                              stiffness;
    const std::vector<ControlledLoads<dim> *> loads;
    std::uint64_t                             point   = 0; ///< its id
    unsigned int                              unknown = 0; ///< number of x
    double                                    factor_n;    ///< l at the balance of the last step
    double                                    scale  = 0.; ///< s [1/m]
    double                                    demand = 0.; ///< g(t + dt) - g(t) [m]
    std::vector<double>                       weights; ///< N_A(x_p) d, dim values per local node
    Ledger::Index                             load_factor = 0, point_displacement = 0;
  };
} // namespace kedge

#endif
