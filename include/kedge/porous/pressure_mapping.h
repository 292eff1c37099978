#ifndef kedge_porous_pressure_mapping_h
#define kedge_porous_pressure_mapping_h

#include <kedge/porous/parameters.h>
#include <kedge/transfer/mass_system.h>

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
    map(const Patch<dim>          &patch,
        const std::vector<double> &pressure,
        const int                  radius,
        std::vector<double>       &unknowns) const;

  private:
    const PressureMap kind;
  };
} // namespace kedge

#endif
