#ifndef kedge_solid_internal_force_h
#define kedge_solid_internal_force_h

#include <kedge/materials/material.h>
#include <kedge/stress/force_stress.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  struct GroupDilatation;

  /** Whether all material points could answer to a trial displacement. */
  struct PointStatus
  {
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    unsigned int failed_slot = none; ///< first point whose det F <= 0 or whose stress is not finite
    bool         has_stress  = false; ///< whether it fails though its law has an answer

    bool
    ok() const
    {
      return failed_slot == none;
    }
  };

  /**
   * The internal force (3.116)/(3.133) of trial displacements u of the
   * active nodes, and its derivative. Both are partial sums over the points
   * of this rank. They hold the gradients of the basis at the configuration n
   * and carry dF in the stress (see ForceStress). Points of StepPoints::group
   * have the pressure of their group (see GroupDilatation); the stiffness then
   * couples the nodes of all points of a group.
   */
  template <int dim>
  class InternalForce
  {
  public:
    /**
     * @param material_of_body one per body
     * @param rule, alpha      see StressRule
     */
    InternalForce(const std::vector<Material> &material_of_body,
                  const StressRule             rule,
                  const double                 alpha);

    /**
     * Adds sum_p V0 P dN_A/dx_n to @p force [N], dim values per local node.
     * Stops at the first point that fails.
     *
     * @param viscous_moduli 2 eta/dt of each body's dashpot [Pa], see add_viscous_stress(); empty:
     *                       none has one
     */
    PointStatus
    add_force(const Patch<dim>          &patch,
              const std::vector<double> &displacement,
              std::vector<double>       &force,
              const std::vector<double> &viscous_moduli = {}) const;

    /**
     * Adds d force / d u to @p stiffness [N/m]. The displacement must be one
     * for which add_force() succeeded.
     */
    void
    add_stiffness(const Patch<dim>          &patch,
                  const std::vector<double> &displacement,
                  NodeMatrix<dim>           &stiffness,
                  const std::vector<double> &viscous_moduli = {}) const;

    const Material &
    material_of_body(const unsigned int body) const
    {
      return materials[body];
    }

    StressRule
    rule() const
    {
      return stress_rule;
    }

    double
    alpha() const
    {
      return fraction;
    }

  private:
    PointStatus
    evaluate_groups(const Patch<dim>          &patch,
                    const std::vector<double> &displacement,
                    GroupDilatation           &dilatation) const;

    std::vector<Material> materials;
    StressRule            stress_rule;
    double                fraction;
  };
} // namespace kedge

#endif
