#ifndef kedge_rigid_line_law_h
#define kedge_rigid_line_law_h

#include <kedge/rigid/rotation.h>

namespace kedge
{
  /** The elastic tension of a line in a step. */
  struct LineTension
  {
    double value = 0.; ///< T of the balance [N]
    double slope = 0.; ///< dT / d(stretch at the end) [N/m]
  };

  /**
   * The tension as the stretch of a line goes from @p start to @p end [m], with the stored energy
   *   U(e) = k <e>^2 / 2, of a rod k e^2 / 2:
   * conserving, T = (U(e_1) - U(e_0)) / (e_1 - e_0), whose work is what U gains; else that of the
   * end.
   */
  LineTension
  line_tension(const double stiffness,
               const double start,
               const double end,
               const bool   pushes,
               const bool   conserving);

  /** U [J]. */
  double
  stored_in_line(const double stiffness, const double stretch, const bool pushes);

  /**
   * A line as a step sees it: from one end to the other d_0 at the start and d_1 at the end of the
   * step. A tension T pulls at the first end by
   *   f = -T d_alpha / l_alpha,  d_alpha = (1-alpha) d_0 + alpha d_1, l_alpha likewise of lengths:
   * with alpha = 1/2, f.(d_1 - d_0) = -T (l_1 - l_0), and the force points from end to end.
   */
  struct LineInStep
  {
    Vector3 start, end; ///< d_0, d_1 [m]
    double  alpha;

    double
    length_start() const
    {
      return start.norm();
    }
    double
    length_end() const
    {
      return end.norm();
    }
    double
    length() const
    {
      return (1. - alpha) * length_start() + alpha * length_end();
    }
    Vector3
    vector() const
    {
      return (1. - alpha) * start + alpha * end;
    }

    /** The force of a unit tension on the first end. */
    Vector3
    pull() const
    {
      return -1. / length() * vector();
    }

    /** d pull / d d_1 [1/m]. */
    Matrix33
    pull_slope() const;
  };
} // namespace kedge

#endif
