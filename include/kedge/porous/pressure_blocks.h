#ifndef kedge_porous_pressure_blocks_h
#define kedge_porous_pressure_blocks_h

#include <kedge/equations/equation_system.h>
#include <kedge/solvers/mixed_blocks.h>

namespace kedge
{
  /**
   * What a block preconditioner needs to know of the u-p tangent. In place of
   * the part of the Schur complement that comes from the skeleton stand
   *   by stiffness, c/alpha sum_p V N_A N_B / M, the drained P-wave modulus M
   *     (the "fixed stress" of splitting schemes),
   *   by inertia, c sum_p V grad N_A . grad N_B / (rho d a/d u),
   * with c the scheme's factor of the volume of fluid.
   */
  template <int dim>
  class PressureBlocks
  {
  public:
    /** Takes a new pattern (collective). */
    void
    reinit(const Patch<dim> &patch, const EquationSystem<dim> &equations, const int radius);

    /**
     * Sums over the points (collective).
     *
     * @param modulus_of_body M of each body [Pa]
     * @param stiffness_factor c/alpha [-]
     * @param inertia_factor c du/da, 0 without inertia [s^2]
     */
    void
    assemble(const Patch<dim>          &patch,
             const std::vector<double> &modulus_of_body,
             const double               stiffness_factor,
             const double               inertia_factor);

    const MixedBlocks &
    blocks() const
    {
      return blocks_;
    }

  private:
    EquationSystem<dim> pressures;
    NodeMatrix<dim>     matrix;
    std::vector<double> weights;
    MixedBlocks         blocks_;
  };
} // namespace kedge

#endif
