#include <kedge/time_integration/pore_scheme.h>

namespace kedge
{
  PoreScheme::PoreScheme(const TimeParameters &parameters)
    : carries_rates(false)
    , theta(1.)
    , beta(1.)
    , gamma(1.)
  {
    switch (parameters.scheme)
      {
        case SchemeKind::midpoint:
          theta = parameters.pore_theta;
          return;
        case SchemeKind::trapezoidal:
          beta  = 0.25;
          gamma = 0.5;
          break;
        case SchemeKind::newmark:
          beta  = parameters.newmark_beta;
          gamma = parameters.newmark_gamma;
          break;
        default:
          return;
      }
    carries_rates = parameters.carry_acceleration;
  }
} // namespace kedge
