#ifndef kedge_solid_follower_term_h
#define kedge_solid_follower_term_h

#include <kedge/equations/term.h>
#include <kedge/solid/load_factor.h>
#include <kedge/solid/surface_loads.h>

namespace kedge
{
  /** The faces with a pressure that follows them, and its expression. */
  template <int dim>
  class FollowerPressures : public SurfaceFaces<dim>
  {
  public:
    FollowerPressures(const std::vector<TractionParameters<dim>>  &parameters,
                      const std::map<std::string, double>         &constants,
                      const LoadProgram                           &program  = {},
                      const std::vector<const SurfaceTerm<dim> *> &surfaces = {});

    /** The pressure on a surface at a place and a time [Pa]. */
    double
    pressure(const unsigned int surface, const dealii::Point<dim> &x, const double t) const;

    /** Its slope by the place [Pa/m]; by differences over @p length. */
    dealii::Tensor<1, dim>
    slope(const unsigned int        surface,
          const dealii::Point<dim> &x,
          const double              t,
          const double              length) const;

    /** Whether history.csv is to have the force on a surface. */
    bool
    shows_resultant(const unsigned int surface) const
    {
      return resultants[surface];
    }

  private:
    const LoadProgram       program;
    std::vector<Expression> expressions; ///< of x, y, z, t [Pa]
    std::vector<bool>       resultants;
  };

  /**
   * Pressures that follow outer faces as they move, turn and stretch: on a face with the
   * area a_n in configuration n
   *   f = -p(x, t) cof(I + alpha A) a_n,   x = x_n + alpha sum_B N_B(face) u_B,
   * A the displacement gradient of the step at the face's point (on facets: at the place itself),
   * alpha the fraction of the displacement at which the balance is stated (1/2 for the conserving
   * stress). The tangent is exact, unsymmetric at the edges of the loaded surface. Books the work
   * of f in the middle of the step. Where the pressures follow a load factor l they are taken at t
   * = l.
   */
  template <int dim>
  class FollowerTerm
    : public Term<dim>
    , public ControlledLoads<dim>
  {
  public:
    FollowerTerm(const unsigned int              field,
                 const Patch<dim>               &patch,
                 const FollowerPressures<dim>   &pressures,
                 const std::vector<std::string> &body_names,
                 const Scheme                   &scheme);

    double
    square_of_slope(const Trial<dim> &trial) const override;

    void
    add_slope(const Trial<dim>   &trial,
              const double        s,
              const UnknownIndex &x,
              Tangent<dim>       &tangent) const override;

    std::string
    name() const override
    {
      return "pressures on surfaces";
    }

    void
    attach(std::vector<GeneratedPoint<dim>> &points) override;

    void
    declare_books(Ledger &ledger) override;

    void
    activate(const MaterialPoints<dim> &cloud) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_residual_at_rest(const double t, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

  private:
    /** df/dl, complete at the owned nodes. */
    std::vector<double>
    slope_at_nodes(const Trial<dim> &trial) const;

    const unsigned int             field;
    const Patch<dim>              &patch;
    FollowerPressures<dim>         pressures;
    const std::vector<std::string> body_names;
    const double                   alpha; ///< of the balance
    Ledger::Index                  work = 0;
    std::vector<Ledger::Index>     resultants; ///< dim per surface; 0 where not shown
  };
} // namespace kedge

#endif
