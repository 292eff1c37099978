#ifndef kedge_transfer_velocity_mapping_h
#define kedge_transfer_velocity_mapping_h

#include <kedge/fields/node_conditions.h>
#include <kedge/solvers/linear_solver.h>
#include <kedge/equations/equation_system.h>
#include <kedge/transfer/node_sums.h>
#include <kedge/transfer/parameters.h>

namespace kedge
{
  /**
   * The point-to-grid mapping (3.163) of velocities and accelerations,
   *   sum_B M~_AB v_B = sum_p m N_A v_p,
   * solved for the free components; prescribed components have their given
   * value. It is the projection, in the mass norm, onto what the grid can do.
   *
   * The mass matrix of well filled cells is so well conditioned that a few
   * conjugate-gradient iterations, scaled by the lumped mass, solve it to round-off,
   * whatever its size; it is factorised only where they do not.
   */
  template <int dim>
  class VelocityMapping
  {
  public:
    /**
     * Announces the nodes, conditions and effective mass of a step.
     *
     * @param new_pattern true if nodes or conditions differ from the last step
     */
    void
    reinit(const BackgroundGrid<dim> &grid,
           const ActiveNodes<dim>    &nodes,
           const NodeConditions<dim> &conditions,
           const NodeTies<dim>       &ties,
           const NodeMatrix<dim>     &mass,
           const bool                 new_pattern);

    /**
     * Solves for nodal values. On entry @p nodal holds the prescribed
     * values, on return all of them, ghosts included; @p momentum holds
     * sum_p m N_A q_p, restricted by the ties, at the owned nodes.
     */
    LinearStatus
    solve(const BackgroundGrid<dim> &grid,
          const ActiveNodes<dim>    &nodes,
          const NodeTies<dim>       &ties,
          const NodeMatrix<dim>     &mass,
          const std::vector<double> &momentum,
          std::vector<double>       &nodal);

  private:
    /** One set of equations; components with the same free nodes share it. */
    struct Component
    {
      std::vector<NodalStatus>      status;
      EquationSystem<dim>           equations;
      std::unique_ptr<LinearSolver> solver;
      SparseSystem                  raised; ///< with a slightly larger diagonal
      bool                          is_factorised = false;
      bool                          has_pattern   = false;
    };

    void
    find_components(const NodeConditions<dim> &conditions,
                    const ActiveNodes<dim>    &nodes,
                    const NodeTies<dim>       &ties);
    void
    set_scaling(const ActiveNodes<dim> &nodes,
                const NodeTies<dim>    &ties,
                const NodeMatrix<dim>  &mass);
    void
    apply_mass(const ActiveNodes<dim> &nodes,
               const NodeTies<dim>    &ties,
               const NodeMatrix<dim>  &mass,
               std::vector<double>    &nodal,
               std::vector<double>    &product) const;
    bool
    iterate(const ActiveNodes<dim> &nodes,
            const NodeTies<dim>    &ties,
            const NodeMatrix<dim>  &mass,
            const double            tolerance,
            std::vector<double>     residual,
            std::vector<double>    &correction,
            double                 &energy) const;
    LinearStatus
    factorise_all(const BackgroundGrid<dim> &grid,
                  const ActiveNodes<dim>    &nodes,
                  const NodeTies<dim>       &ties,
                  const NodeMatrix<dim>     &mass);
    LinearStatus
    factorise(Component &component);
    LinearStatus
    correct(const std::vector<double> &defect, std::vector<double> &nodal, double &energy);

    std::vector<unsigned int> neighbours;      ///< see node_neighbours()
    std::vector<double>       inverse_lumped;  ///< of the mass with its ties; 0 where not free
    bool                      is_hard = false; ///< conjugate gradients failed in this step

    std::vector<Component>                     components;
    std::array<unsigned int, std::size_t(dim)> component_of_direction;
  };
} // namespace kedge

#endif
