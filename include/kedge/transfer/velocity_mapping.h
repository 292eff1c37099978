#ifndef kedge_transfer_velocity_mapping_h
#define kedge_transfer_velocity_mapping_h

#include <kedge/equations/equation_system.h>
#include <kedge/solvers/linear_solver.h>
#include <kedge/transfer/mass_system.h>
#include <kedge/transfer/parameters.h>

namespace kedge
{
  /**
   * The point-to-grid mapping (3.163) of velocities and accelerations,
   *   sum_B M~_AB v_B = sum_p m N_A v_p,
   * solved for the free components; prescribed components have their given
   * value. It is the projection, in the mass norm, onto what the grid can do.
   *
   * The system is a MassSystem; it is factorised where conjugate gradients fail, or take longer.
   */
  template <int dim>
  class VelocityMapping
  {
  public:
    /** Takes the constraints and the effective mass of a step; both must last as long as it. */
    void
    reinit(const Patch<dim> &patch, const NodeMatrix<dim> &mass);

    /**
     * Solves for nodal values. On entry @p nodal holds the prescribed
     * values, on return all of them, ghosts included; @p momentum holds
     * sum_p m N_A q_p, restricted by the ties, at the owned nodes.
     */
    LinearStatus
    solve(const std::vector<double> &momentum, std::vector<double> &nodal);

  private:
    /** One set of equations; components with the same free nodes share it. */
    struct Component
    {
      std::vector<NodalStatus>      status;
      EquationSystem<dim>           equations;
      std::unique_ptr<LinearSolver> solver; ///< once its pattern is known
      SparseSystem                  raised; ///< with a slightly larger diagonal
      bool                          is_factorised = false;
    };

    void
    find_components();
    bool
    iterate(const double               tolerance,
            const std::vector<double> &defect,
            std::vector<double>       &correction,
            double                    &energy);
    void
    find_pattern(Component &component);
    LinearStatus
    factorise_all();
    LinearStatus
    factorise(Component &component);
    LinearStatus
    correct(const std::vector<double> &defect, std::vector<double> &nodal, double &energy);

    const Patch<dim>      *patch   = nullptr;
    const NodeMatrix<dim> *mass    = nullptr;
    MassSystem<dim>        system  = MassSystem<dim>(MassVectors::velocities);
    bool                   is_hard = false; ///< no conjugate gradients in this step

    std::vector<Component>                     components;
    std::array<unsigned int, std::size_t(dim)> component_of_direction;
  };
} // namespace kedge

#endif
