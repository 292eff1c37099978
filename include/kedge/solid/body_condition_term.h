#ifndef kedge_solid_body_condition_term_h
#define kedge_solid_body_condition_term_h

#include <kedge/equations/term.h>
#include <kedge/solid/parameters.h>
#include <kedge/surfaces/face_multipliers.h>

namespace kedge
{
  /**
   * Motion prescribed on faces that a body carries along: on its own surface, or on a section
   * within it. Along each direction a of a condition the displacement over the step is
   *   sum_f A_f phi_k(X_f) (a . u(x_f) - g_f) = 0,   u(x_f) = sum_A N_A(x_f) u_A,
   * for all functions phi_k of FaceMultipliers, A_f the faces' areas at the start. The multipliers
   * lambda_k, nominal tractions along a, are unknowns that belong to no node, and the force on the
   * body is sum_f A_f phi_k lambda_k a at the faces: it does the work lambda_k (B u)_k exactly.
   *
   * Where a force F is given and not the motion, g_f = q is one more unknown, the same
   * for all faces, and sum_f A_f lambda(X_f) = F.
   *
   * With inertia, u of the mid-point rule prescribes the mean of two velocities only: a
   * velocity that is off at the start would swing to and fro for ever. g_f is therefore raised by
   * dt (1 - beta/gamma) times what the velocity at the start is off, after which that of the end is
   * the prescribed one.
   *
   * Equations and multipliers are scaled by a stiffness, so that they have the units
   * of the others: lambda = s x, [x] = m.
   */
  template <int dim>
  class BodyConditionTerm : public Term<dim>
  {
  public:
    /**
     * @param conditions on bodies of the field
     * @param stiffness  of each of these bodies: modulus over size of a cell [Pa/m]
     * @param program    when forces are evaluated
     * @param surfaces   that bodies carry, on which conditions on oblique and curved sides act
     */
    BodyConditionTerm(const unsigned int                               field,
                      const Patch<dim>                                &patch,
                      const std::vector<BodyConditionParameters<dim>> &conditions,
                      const std::vector<double>                       &stiffness,
                      const std::vector<std::string>                  &body_names,
                      const std::map<std::string, double>             &constants,
                      const LoadProgram                               &program,
                      const Scheme                                    &scheme,
                      const std::vector<const SurfaceTerm<dim> *>     &surfaces = {});

    std::string
    name() const override
    {
      return "body conditions";
    }

    /** Finds the faces, and adds the unknowns to those that declare_unknowns() was given. */
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

  private:
    /** A direction along which a condition prescribes something. */
    struct Line
    {
      unsigned int           condition;
      dealii::Tensor<1, dim> direction;
      ConditionKind          kind;
      Expression             motion, force; ///< of what is prescribed
      bool                   by_force;
      unsigned int           first = 0, end = 0; ///< its multipliers, in the arrays of this term
      unsigned int           common = 0;         ///< unknown that all faces share, if by_force
    };

    /** An entry of B: of a multiplier, and a component at a local node. */
    struct Coupling
    {
      unsigned int multiplier, node, component;
      double       value;
    };

    /** x, y, z [m]. */
    struct Place
    {
      double coordinates[3];
    };

    template <typename Visit>
    void
    for_faces(const Visit &visit) const;
    Place
    place(const SurfacePoint<dim> &face) const;
    double
    demand(const Line                        &line,
           const SurfacePoint<dim>           &face,
           const StepTimes                   &times,
           const typename Trial<dim>::Motion &motion) const;
    std::vector<double>
    weighted_means(const std::vector<double> &nodal) const;
    UnknownIndex
    unknown(const unsigned int multiplier) const
    {
      return UnknownIndex::other(first_unknown + multiplier);
    }

    const unsigned int                              field;
    const Patch<dim>                               &patch;
    const std::vector<BodyConditionParameters<dim>> conditions;
    const std::vector<double>                       stiffness;
    const std::vector<std::string>                  body_names;
    const LoadProgram                               program;
    const Scheme                                    scheme;
    SurfaceFaces<dim>                               faces;
    std::vector<Line>                               lines;
    std::vector<FaceMultipliers<dim>>               functions; ///< one per condition
    Unknowns<dim>                                  *unknowns      = nullptr;
    unsigned int                                    first_unknown = 0;

    // of the configuration, and of the step
    std::vector<Coupling> couplings;
    std::vector<double>   area;     ///< s sum_f A_f phi_k of each multiplier, this rank's share
    std::vector<bool>     is_idle;  ///< multipliers of no area on any rank
    std::vector<double>   demanded; ///< s sum_f A_f phi_k g_f, this rank's share
    double                load_time = 0.;

    Ledger::Index              work = 0;
    std::vector<Ledger::Index> reactions; ///< dim per condition; of those asked for
  };
} // namespace kedge

#endif
