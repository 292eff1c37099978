#ifndef kedge_porous_prepared_blocks_h
#define kedge_porous_prepared_blocks_h

#include <kedge/porous/pressure_blocks.h>
#include <kedge/solvers/linear_solver.h>

namespace kedge
{
  /** The PressureBlocks that the linear solver is given: one pattern per configuration, values once
   * per step. */
  template <int dim>
  class PreparedBlocks
  {
  public:
    /** Arguments of PressureBlocks::assemble(). */
    struct Factors
    {
      const std::vector<double> &modulus_of_body;
      double                     stiffness, inertia;
    };

    /** A new configuration. */
    void
    activate(const Patch<dim> &patch)
    {
      have_pattern = have_pattern && !patch.new_pattern();
    }

    /** A new attempt at a step. */
    void
    start()
    {
      have_values = false;
    }

    /** Gives them to a solver that will use them: at the first tangent of a step (collective). */
    void
    tell(const Patch<dim>          &patch,
         const EquationSystem<dim> &equations,
         const int                  radius,
         const SparseSystem        &system,
         const Factors             &factors,
         LinearSolver              &solver)
    {
      if (solver.choose(system) != LinearSolverKind::krylov_blocks)
        return;
      if (!have_pattern)
        blocks.reinit(patch, equations, radius);
      have_pattern = true;
      if (have_values)
        return;
      blocks.assemble(patch, factors.modulus_of_body, factors.stiffness, factors.inertia);
      have_values = true;
      solver.set_blocks(blocks.blocks());
    }

  private:
    PressureBlocks<dim> blocks;
    bool                have_pattern = false, have_values = false;
  };
} // namespace kedge

#endif
