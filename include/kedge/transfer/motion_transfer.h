#ifndef kedge_transfer_motion_transfer_h
#define kedge_transfer_motion_transfer_h

#include <kedge/equations/trial.h>
#include <kedge/fields/patch.h>
#include <kedge/transfer/audit.h>
#include <kedge/transfer/velocity_mapping.h>

#include <functional>
#include <optional>

namespace kedge
{
  /**
   * The mappings of velocities (and accelerations, where the scheme carries them) between
   * the points and the nodes of a field, and the mass (3.161) which they share with the inertia
   * of the balance: one mass for both, or energy is not conserved. Of dynamic runs
   * only.
   */
  template <int dim>
  class MotionTransfer
  {
  public:
    /** @param radius how far points couple nodes */
    MotionTransfer(const unsigned int        field,
                   const Patch<dim>         &patch,
                   const TransferParameters &parameters,
                   const Scheme             &scheme,
                   const int                 radius);

    /**
     * Assembles the mass of a new configuration (collective).
     *
     * @param add adds what terms have to the mass of the mapping alone
     */
    void
    reinit(const std::function<void(NodeMatrix<dim> &mass)> &add);

    /** Effective mass M~ of (3.161), one component, this rank's share [kg]. */
    const NodeMatrix<dim> &
    mass() const
    {
      return effective_mass;
    }

    /** Point to grid: v_n and a_n of the trial (collective). */
    LinearStatus
    to_nodes(Trial<dim> &trial);

    /** Grid to point: what the points' motion will be (collective). */
    void
    to_points(const Trial<dim> &trial);

    bool
    carries_acceleration() const
    {
      return scheme.carries_acceleration;
    }

    /**
     * What the mappings of a step take from the points' kinetic energy, this rank's share [J]; not
     * negative. Of what the points' velocities have beside v_n, v'_p, they keep the part k: with
     * w = v_{n+1} - k v_n and D = M~ - M it is
     *   1/2 w D w + (1 - k^2) (1/2 v_n D v_n + 1/2 sum m |v'_p|^2),
     * with k = 1 for FLIP, exp(-dt/Filter time) with a filter, 0 for PIC.
     */
    double
    loss(const Trial<dim> &trial) const;

    /** Whether it may be more than nothing. */
    bool
    is_lossy() const
    {
      return parameters.lumping > 0. || parameters.kept_part(1.) < 1.;
    }

    /** Writes the motion of a point at the end of the step, but for its acceleration. */
    void
    update(const unsigned int slot, PointCore<dim> &state) const;
    /** Writes the motion of a point at the end of the step, if the scheme carries all of it. */
    void
    update(const unsigned int slot, PointState<dim> &state) const;

    /** Gives points at rest the accelerations of forces at the nodes [N] (collective). */
    void
    accelerate(const std::vector<double> &force, MaterialPoints<dim> &cloud);

    /** What the mappings of the last step lost, if asked for. */
    const std::optional<TransferAudit<dim>> &
    audit() const
    {
      return audit_;
    }

  private:
    LinearStatus
    project(const std::vector<dealii::Tensor<1, dim>> &at_points, std::vector<double> &at_nodes);
    std::vector<double>
    velocity_change(const Trial<dim>          &trial,
                    const double               kept,
                    const std::vector<double> &v_end) const;
    const NodeMatrix<dim> &
    mapping_mass() const
    {
      return has_own_mass ? mapped_mass : effective_mass;
    }

    const unsigned int                  field;
    const Patch<dim>                   &patch;
    const TransferParameters            parameters;
    const Scheme                        scheme;
    const int                           radius;
    NodeMatrix<dim>                     effective_mass, mapped_mass;
    bool                                has_own_mass = false; ///< terms have added to the mapping's
    double                              kept = 1.; ///< of the points' velocities, in this step
    VelocityMapping<dim>                mapping;
    std::vector<dealii::Tensor<1, dim>> velocities; ///< what is added to the part that is kept
    std::vector<dealii::Tensor<1, dim>> accelerations;
    std::optional<TransferAudit<dim>>   audit_;
  };
} // namespace kedge

#endif
