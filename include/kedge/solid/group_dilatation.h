#ifndef kedge_solid_group_dilatation_h
#define kedge_solid_group_dilatation_h

#include <kedge/solid/internal_force.h>

namespace kedge
{
  /**
   * The volume of the groups of points of StepPoints::group over a step. The
   * points p of a group g share the increment of their elastic volume strain:
   *   theta_p,n+1 = theta_p,n + dtheta_g,   dtheta_g = sum_p V_p ln det(I + A_p) / W_g,
   * W_g = sum_p V_p with the reference volumes. It stands in place of the
   * points' own ln det(I + A_p), which a nearly incompressible body cannot
   * keep small everywhere without stopping to bend.
   */
  struct GroupDilatation
  {
    std::vector<double> volume;    ///< W_g [m^3]
    std::vector<double> strain_n;  ///< mean of theta_p,n weighted by V_p
    std::vector<double> increment; ///< dtheta_g

    /**
     * The strain that belongs to the pressure in the force: at the end of the
     * increment, or in its middle for the conserving rule, which makes the
     * work of the pressure W_g K strain dtheta_g the increment of
     * sum_p V_p K theta_p^2/2.
     */
    double
    force_strain(const StressRule rule, const unsigned int group) const
    {
      return strain_n[group] + (rule == StressRule::conserving ? 0.5 : 1.) * increment[group];
    }
  };

  /**
   * Evaluates all groups at the displacement gradients of @p fraction times
   * @p displacement. Fails at the first point with det F <= 0.
   */
  template <int dim>
  PointStatus
  evaluate_group_dilatation(const Patch<dim>          &patch,
                            const std::vector<double> &displacement,
                            const double               fraction,
                            GroupDilatation           &result);

  /**
   * Adds to the tangent what couples all points of a group: their forces
   * depend on the displacement of all their nodes through the pressure,
   *   K_AB += c_g/W_g (sum_p V_p dP/dp dN_A/dx) (x) (sum_p V_p dtheta/dA dN_B/dx)
   * with c_g = dp_g/d dtheta_g = K, or K/2 for the conserving rule.
   */
  template <int dim>
  void
  add_group_stiffness(const std::vector<Material> &materials,
                      const StressRule             rule,
                      const double                 alpha,
                      const Patch<dim>            &patch,
                      const std::vector<double>   &displacement,
                      NodeMatrix<dim>             &stiffness);
} // namespace kedge

#endif
