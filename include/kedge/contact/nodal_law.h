#ifndef kedge_contact_nodal_law_h
#define kedge_contact_nodal_law_h

#include <kedge/contact/parameters.h>

#include <deal.II/base/tensor.h>

namespace kedge
{
  /**
   * What two bodies do to each other at a node that both have (Pretti 2024, section 5.4). They
   * are there together at the start of the step, so that all gaps are those of the step alone.
   */
  struct NodalLaw
  {
    double stiffness = 0.;  ///< r, of the gap and of the slip over the step [N/m]
    double friction  = 0.;  ///< mu [-]
    double alpha     = 0.5; ///< part of the step at which the gap is taken

    /** @name of the non-linear penalty (5.108) */
    //@{
    double begin           = 0.; ///< c_0, gap below which it presses [m]
    double first_bend      = 0.; ///< c_1, where it begins to stiffen [m]
    double last_bend       = 0.; ///< c_2, where it has its final stiffness [m]
    double final_stiffness = 0.; ///< r_n^fin [N/m]; r_n^in is the stiffness above
    //@}
  };

  /** A state in which a node is held whatever the law says, where Newton's method goes in circles.
   */
  enum class NodalHold
  {
    none,
    sticks, ///< if it is closed
    open
  };

  /**
   * The answer of a node in its own directions, of which the first is the normal away from the
   * first body; [i][j] is the slope of component i with component j.
   */
  template <int dim>
  struct NodalResponse
  {
    dealii::Tensor<1, dim> force;                 ///< on the first body [N]
    dealii::Tensor<2, dim> force_by_displacement; ///< [N/m]
    dealii::Tensor<2, dim> force_by_multiplier;   ///< [-]

    dealii::Tensor<1, dim> constraint;                 ///< C of the multipliers [N], 0 if they hold
    dealii::Tensor<2, dim> constraint_by_displacement; ///< [N/m]
    dealii::Tensor<2, dim> constraint_by_multiplier;   ///< [-]

    bool closed = false, slides = false;
  };

  /**
   * A law at a node. With D the displacement of the first body less that of the second over the
   * step, g = -alpha D_n (5.73):
   *   F = -p n + P,   P = t where |t| <= mu p, else mu p t/|t|,
   * where the pressure p [N] and the trial force t along the surface are
   *   penalty               p = [r g]_-,             t = -r D_t                (5.105), (5.106)
   *   non-linear penalty    p = [p(g)]_-,            t = -r D_t                (5.108)
   *   augmented Lagrangian  p = [lambda_n + r g]_-,  t = lambda_t - r D_t      (5.71), (5.72)
   *   multipliers           p = [lambda_n]_-,        t = lambda_t               (5.100), (5.101)
   * with [a]_- = -a for a <= 0, else 0. Sliding of the non-linear penalty begins at c_3, up to
   * which (5.114) is the linear one: what it says of larger slips is scaled back. The augmented
   * Lagrangian's constraint is C = lambda - F (5.80); that of the multipliers is the same in each
   * state, which the multipliers alone choose: in print (5.103) it says nothing of the gap and of
   * what sticks, and (5.48) says this,
   *   closed   C_n = -r g,   sticks   C_t = r D_t,
   *   slides   C_t = m (|lambda_t| - mu p) + r (I - m m) D_t,   m = lambda_t/|lambda_t|,
   * the last part so that a slip in space has the direction of its force.
   *
   * @param n_directions the normal and those along the surface in which friction acts
   * @param multiplier   lambda [N]; 0 for penalties
   * @param displacement D [m]
   */
  template <int dim>
  using NodalFunction = NodalResponse<dim> (*)(const NodalLaw               &law,
                                               const unsigned int            n_directions,
                                               const dealii::Tensor<1, dim> &multiplier,
                                               const dealii::Tensor<1, dim> &displacement,
                                               const NodalHold               hold);

  /** The law of a method at nodes. */
  template <int dim>
  NodalFunction<dim>
  nodal_function(const ContactMethod method);

  /** p(g) of (5.108), negative if it presses, with the erratum of (5.109) [N]; and its slope. */
  double
  nonlinear_penalty(const NodalLaw &law, const double gap, double &slope);
} // namespace kedge

#endif
