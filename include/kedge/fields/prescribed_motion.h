#ifndef kedge_fields_prescribed_motion_h
#define kedge_fields_prescribed_motion_h

#include <kedge/base/expression.h>
#include <kedge/grid/parameters.h>

namespace kedge
{
  /**
   * Displacement from @p t0 to @p t1 of what a condition moves [m]; 0 if it is fixed or free.
   *
   * @param place x, y, z, for motions that depend on it
   */
  double
  prescribed_increment(const ConditionKind kind,
                       const Expression   &expression,
                       const double (&place)[3],
                       const double t0,
                       const double t1);

  /**
   * Its velocity at the start of the step from @p t to @p t + @p dt [m/s]: what is
   * prescribed as a velocity, and the slope from the right of what is prescribed as a
   * displacement, see slope_from_right().
   */
  double
  prescribed_velocity(const ConditionKind kind,
                      const Expression   &expression,
                      const double (&place)[3],
                      const double t,
                      const double dt);
} // namespace kedge

#endif
