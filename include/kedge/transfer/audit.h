#ifndef kedge_transfer_audit_h
#define kedge_transfer_audit_h

#include <kedge/equations/node_matrix.h>
#include <kedge/fields/patch.h>
#include <kedge/transfer/parameters.h>

namespace kedge
{
  /**
   * What a moving set of masses has in total, of all ranks; per metre of
   * thickness in 2D. The angular momentum is taken about the origin of the
   * coordinates; in 2D only its z component is not zero.
   */
  template <int dim>
  struct MotionTotals
  {
    dealii::Tensor<1, dim> linear_momentum;     ///< (3.155), (3.156) [kg m/s]
    dealii::Tensor<1, 3>   angular_momentum;    ///< (3.157), (3.158) [kg m^2/s]
    double                 kinetic_energy = 0.; ///< (3.159), (3.160) [J]
  };

  template <int dim>
  MotionTotals<dim>
  operator-(const MotionTotals<dim> &a, const MotionTotals<dim> &b);

  /**
   * The conservation audit of one step: the totals of points and grid before
   * and after it, what the mappings between them lose, and what they must
   * lose by the closed expressions of Tables 3.1 and 3.2. With D = lumped -
   * consistent mass, dv = v_{n+1} - v_n, v' = v_n of a point - (v_n of the
   * grid) there, and the new positions of the nodes x_{n+1} = x_n + u:
   *
   *   P2G      K:  eps/2 v_n D v_n + 1/2 sum m |v'|^2            (3.169)
   *   FLIP     J:  -eps x_{n+1} x (D dv)                         (3.178)
   *            K:  -eps/2 dv D dv                                (3.182)
   *   PIC      J:  -eps x_{n+1} x (D v_{n+1})                    (3.177)
   *            K:  -eps/2 v_{n+1} D v_{n+1} - P2G's K            (3.180)
   *   between  J:  -eps x_{n+1} x (D w),  w = v_{n+1} - k v_n
   *            K:  -eps/2 w D w - (1 - k^2) P2G's K
   *
   * and zero for all others; in between the points keep the part k of v': 1 is FLIP, 0 PIC. The
   * last line of (3.180) as printed counts eps/2 v_n D v_n twice. The expressions presume that
   * (3.163) holds at all nodes: where node conditions prescribe a velocity, the measured losses
   * hold in addition what the condition takes or gives.
   */
  template <int dim>
  struct TransferAudit
  {
    MotionTotals<dim> points_n, grid_n, points_np1, grid_np1;

    MotionTotals<dim> expected_p2g;  ///< points - grid at n
    MotionTotals<dim> expected_step; ///< (change of points) - (change of grid)

    /** What point-to-grid loses: points - grid before the step (Table 3.1). */
    MotionTotals<dim>
    measured_p2g() const
    {
      return points_n - grid_n;
    }

    /** What points gain over the step beyond what the grid gains (Table 3.2). */
    MotionTotals<dim>
    measured_step() const
    {
      return (points_np1 - points_n) - (grid_np1 - grid_n);
    }

    /** Adds the audit of another field. */
    TransferAudit &
    operator+=(const TransferAudit &other);
  };

  /**
   * Computes the audit of a step (collective; the result is the same on all
   * ranks). Nodal arrays hold dim values per local node, ghosts up to date.
   *
   * @param points         with positions and velocities at n
   * @param new_velocities of the points, by slot [m/s]
   * @param mass           effective mass M~ of (3.161), this rank's share
   * @param lumping        epsilon in it
   * @param kept           part of v' that the points have kept: 1 with FLIP, 0 with PIC
   * @param v_n, v_np1     nodal velocities [m/s]
   * @param u              nodal displacements over the step [m]
   */
  template <int dim>
  TransferAudit<dim>
  audit_transfer(const Patch<dim>                          &patch,
                 const std::vector<dealii::Tensor<1, dim>> &new_velocities,
                 const NodeMatrix<dim>                     &mass,
                 const double                               lumping,
                 const double                               kept,
                 const std::vector<double>                 &v_n,
                 const std::vector<double>                 &v_np1,
                 const std::vector<double>                 &u);

  /** 1/2 sum m |v_p - v(x_p)|^2 of nodal velocities v, this rank's share [J]. */
  template <int dim>
  double
  filtered_energy(const Patch<dim> &patch, const std::vector<double> &v);

  /**
   * 1/2 v (M_l - M) v of nodal velocities, lumped and consistent mass; not negative. This rank's
   * share [J].
   */
  template <int dim>
  double
  lumping_energy(const Patch<dim> &patch, const std::vector<double> &v);
} // namespace kedge

#endif
