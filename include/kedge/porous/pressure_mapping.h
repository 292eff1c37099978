#ifndef kedge_porous_pressure_mapping_h
#define kedge_porous_pressure_mapping_h

#include <kedge/fields/node_ties.h>
#include <kedge/porous/parameters.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  /**
   * The point-to-grid mapping of the pore pressure (4.181),
   *   sum_B Omega_AB p_B = sum_p v N_A p_p,  v the points' volumes now,
   * with Omega lumped as in (4.182), or consistent, Omega_AB = sum_p v N_A N_B,
   * which reproduces what the grid can: a linear pressure exactly. With ties
   * (p = C p_roots) it solves C^T Omega C.
   */
  template <int dim>
  class PressureMapping
  {
  public:
    explicit PressureMapping(const PressureMap kind)
      : kind(kind)
    {}

    /**
     * Sets the pressures among @p unknowns, dim + 1 values per local node, the
     * pressure last, ghosts and tied nodes included (collective).
     *
     * @param pressure at the points, one per slot [Pa]
     * @param radius   how far a point couples nodes
     */
    void
    map(const StepPoints<dim>     &points,
        const LatticeWindow<dim>  &window,
        const ActiveNodes<dim>    &nodes,
        const NodeTies<dim>       &ties,
        const std::vector<double> &pressure,
        const int                  radius,
        std::vector<double>       &unknowns);

  private:
    void
    map_lumped(const ActiveNodes<dim> &nodes, const NodeTies<dim> &ties, std::vector<double> &sums);
    void
    improve(const LatticeWindow<dim> &window,
            const ActiveNodes<dim>   &nodes,
            const NodeTies<dim>      &ties);
    void
    multiply_volumes(const LatticeWindow<dim> &window,
                     const ActiveNodes<dim>   &nodes,
                     const NodeTies<dim>      &ties,
                     std::vector<double>      &x,
                     std::vector<double>      &y) const;

    const PressureMap   kind;
    NodeMatrix<dim>     volumes; ///< Omega of this rank
    std::vector<double> nodal, right_side;
    std::vector<double> weights; ///< Omega, lumped [m^3]
  };
} // namespace kedge

#endif
