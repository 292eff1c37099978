#include <kedge/rigid/line_law.h>

#include <algorithm>

namespace kedge
{
  LineTension
  line_tension(const double stiffness,
               const double start,
               const double end,
               const bool   pushes,
               const bool   conserving)
  {
    if (!conserving)
      return pushes || end > 0. ? LineTension{stiffness * end, stiffness} : LineTension();
    if (pushes || (start > 0. && end > 0.))
      return {0.5 * stiffness * (start + end), 0.5 * stiffness};
    if (end > 0.) // it becomes taut
      {
        const double tension = 0.5 * stiffness * end * end / (end - start);
        return {tension, (stiffness * end - tension) / (end - start)};
      }
    if (start > 0.) // it goes slack
      {
        const double tension = 0.5 * stiffness * start * start / (start - end);
        return {tension, tension / (start - end)};
      }
    return {};
  }



  double
  stored_in_line(const double stiffness, const double stretch, const bool pushes)
  {
    const double held = pushes ? stretch : std::max(stretch, 0.);
    return 0.5 * stiffness * held * held;
  }



  Matrix33
  LineInStep::pull_slope() const
  {
    const double   l         = length();
    const Vector3  direction = end / length_end();
    const Matrix33 by_length = outer_product(vector(), direction);
    Matrix33       result    = alpha / (l * l) * by_length;
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] -= alpha / l;
    return result;
  }
} // namespace kedge
