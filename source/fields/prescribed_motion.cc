#include <kedge/base/slope.h>
#include <kedge/fields/prescribed_motion.h>

namespace kedge
{
  double
  prescribed_increment(const ConditionKind kind,
                       const Expression   &expression,
                       const double (&place)[3],
                       const double t0,
                       const double t1)
  {
    switch (kind)
      {
        case ConditionKind::displacement:
          return expression({t1}) - expression({t0});
        case ConditionKind::velocity:
          return expression({0.5 * (t0 + t1)}) * (t1 - t0);
        case ConditionKind::motion:
          return expression({place[0], place[1], place[2], t0, t1 - t0});
        default:
          return 0.;
      }
  }



  double
  prescribed_velocity(const ConditionKind kind,
                      const Expression   &expression,
                      const double (&place)[3],
                      const double t,
                      const double dt)
  {
    if (kind == ConditionKind::velocity)
      return expression({t});
    return slope_from_right(
      [&](const double s) {
        return s > 0. ? prescribed_increment(kind, expression, place, t, t + s) : 0.;
      },
      dt);
  }
} // namespace kedge
