#ifndef kedge_porous_nodal_potential_h
#define kedge_porous_nodal_potential_h

#include <kedge/equations/node_matrix.h>
#include <kedge/materials/pore_fluid.h>

namespace kedge
{
  /**
   * The potential at the nodes of the conserving balance,
   *   lambda_A = pi(p_A) - rho_0 (|u_A/dt|^2 + |u_A/dt - v_A|^2)/2,
   * of the pore pressure p_A and the displacement u_A over the step at the nodes that move by
   * themselves; at tied ones what the ties make of it, so that it is a field of the grid.
   */
  template <int dim>
  class NodalPotential
  {
  public:
    /**
     * @param fluid      of all bodies: its density and bulk modulus
     * @param velocity_n v_A, dim per local node [m/s]
     */
    NodalPotential(const Patch<dim>          &patch,
                   const PoreFluid           &fluid,
                   const std::vector<double> &velocity_n,
                   const double               dt)
      : patch(patch)
      , fluid(fluid)
      , velocity_n(velocity_n)
      , dt(dt)
    {}

    /** Displacement and potential, dim + 1 per local node, from displacement and pressure. */
    std::vector<double>
    values(const std::vector<double> &unknowns) const;

    /**
     * Makes the columns of a matrix by displacement and potential those by displacement and
     * pressure. At tied nodes the slopes of the roots are taken together: exact where these move
     * alike.
     */
    void
    change_columns(const std::vector<double> &unknowns, NodeMatrix<dim> &matrix) const;

  private:
    const Patch<dim>          &patch;
    const PoreFluid           &fluid;
    const std::vector<double> &velocity_n;
    const double               dt;
  };
} // namespace kedge

#endif
