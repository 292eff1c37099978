#ifndef kedge_solid_solid_problem_h
#define kedge_solid_solid_problem_h

#include <kedge/solid/balance.h>
#include <kedge/time_integration/scheme.h>

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
    start(NodalState &state, const double t_n, const double dt) override;

    NewtonProblem::Evaluation
    evaluate() override;

    void
    apply_correction(const double factor) override;

  protected:
    void
    assemble_tangent() override;

  private:
    using Balance<dim>::conditions;
    using Balance<dim>::correction;
    using Balance<dim>::dt;
    using Balance<dim>::equations;
    using Balance<dim>::ghosts;
    using Balance<dim>::grid;
    using Balance<dim>::mass;
    using Balance<dim>::nodes;
    using Balance<dim>::points;
    using Balance<dim>::residual;
    using Balance<dim>::state;
    using Balance<dim>::t_n;
    using Balance<dim>::tangent;
    using Balance<dim>::ties;
    using Balance<dim>::timings_;

    void
    set_prescribed_displacements();
    void
    follow_supports();
    void
    add_ghost_force();

    const InternalForce<dim> internal_force;
    const Scheme             scheme;
    std::vector<double>      internal, inertia, acceleration;
    std::vector<double>      diagonal; ///< of the last tangent, at the equations
  };
} // namespace kedge

#endif
