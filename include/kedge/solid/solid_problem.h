#ifndef kedge_solid_solid_problem_h
#define kedge_solid_solid_problem_h

#include <kedge/solid/balance.h>
#include <kedge/solid/internal_force.h>
#include <kedge/time_integration/scheme.h>
#include <kedge/transfer/equation_system.h>

namespace kedge
{
  /**
   * The balance of momentum of one step (3.114), (3.148),
   *   r(u) = f_int(u) + alpha_f K_G u + M a_m(u) - f_ext = 0
   * at the free components of the active nodes, with its tangent
   *   J = K + alpha_f K_G + c M,   c = d a_m / d u.
   * K_G is the ghost stiffness of (3.154), if there is one; the ghost mass is
   * part of M.
   */
  template <int dim>
  class SolidProblem : public Balance<dim>
  {
  public:
    SolidProblem(const InternalForce<dim>       &internal_force,
                 const Scheme                   &scheme,
                 const LinearSolverParameters   &parameters,
                 const std::vector<std::string> &body_names);

    void
    reinit(const BackgroundGrid<dim> &grid,
           const ActiveNodes<dim>    &nodes,
           const NodeConditions<dim> &conditions,
           const NodeTies<dim>       &ties,
           const StepPoints<dim>     &points,
           const NodeMatrix<dim>     &mass,
           const NodeMatrix<dim>     *ghost_stiffness,
           const int                  stiffness_radius,
           const bool                 new_pattern) override;

    void
    start(NodalState &state, const double t_n, const double dt) override;

    NewtonProblem::Evaluation
    evaluate() override;

    void
    set_linear_tolerance(const double tolerance) override
    {
      linear_tolerance = tolerance;
    }

    LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override;

    void
    apply_correction(const double factor) override;

    double
    reaction_work() const override;

    std::vector<double>
    reactions() const override;

    std::string
    diagnosis() const override;

    double
    largest_condition() const override
    {
      return largest_condition_;
    }

    std::uint64_t
    n_equations() const override
    {
      return equations.system().n_global;
    }

    std::string
    linear_method() const override
    {
      return linear_solver.method();
    }

    const SolidTimings &
    timings() const override
    {
      return timings_;
    }

  private:
    void
    set_prescribed_displacements();
    void
    follow_supports();
    void
    assemble_tangent();
    void
    add_ghost_force();
    void
    add_to_diagonal_blocks(const double coefficient, const NodeMatrix<dim> &matrix);
    std::string
    describe_point(const unsigned int slot) const;
    std::string
    describe_equation(const std::int64_t equation) const;

    const InternalForce<dim>       internal_force;
    const Scheme                   scheme;
    const std::vector<std::string> body_names;
    LinearSolver                   linear_solver;

    const BackgroundGrid<dim> *grid       = nullptr;
    const ActiveNodes<dim>    *nodes      = nullptr;
    const NodeConditions<dim> *conditions = nullptr;
    const NodeTies<dim>       *ties       = nullptr;
    const StepPoints<dim>     *points     = nullptr;
    const NodeMatrix<dim>     *mass       = nullptr;
    const NodeMatrix<dim>     *penalty    = nullptr; ///< K_G
    NodalState                *state      = nullptr;
    double                     t_n        = 0.;
    double                     dt         = 0.;

    NodeMatrix<dim>          stiffness;
    EquationSystem<dim>      equations;
    std::vector<NodalStatus> status;
    std::vector<double>      internal, inertia, acceleration, residual, correction;
    std::vector<double>      diagonal; ///< of the last tangent, at the equations
    double                   linear_tolerance = 0.;
    SolidTimings             timings_;
    std::string              warning_;                ///< of a singular tangent in this step
    double                   condition          = 0.; ///< worst of this step
    double                   largest_condition_ = 0.;
    std::int64_t             weakest_equation   = -1;
  };
} // namespace kedge

#endif
