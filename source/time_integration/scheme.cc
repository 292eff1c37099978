#include <kedge/time_integration/scheme.h>

namespace kedge
{
  Scheme::Scheme(const TimeParameters &parameters)
    : dynamic(parameters.scheme != SchemeKind::quasi_static &&
              parameters.scheme != SchemeKind::clc_quasi_static)
    , conserving_stress(parameters.scheme == SchemeKind::clc_midpoint ||
                        parameters.scheme == SchemeKind::clc_quasi_static)
    , carries_acceleration(false)
    , alpha_f(1.)
    , alpha_m(1.)
    , beta(0.25)
    , gamma(0.5)
  {
    switch (parameters.scheme)
      {
        case SchemeKind::quasi_static:
          return;
        case SchemeKind::clc_quasi_static:
        case SchemeKind::clc_midpoint:
        case SchemeKind::midpoint:
          // the mean of a_n and a_{n+1} follows from u and v_n: a_n drops out
          alpha_f = alpha_m = 0.5;
          return;
        case SchemeKind::trapezoidal:
          break;
        case SchemeKind::newmark:
          beta  = parameters.newmark_beta;
          gamma = parameters.newmark_gamma;
          break;
        case SchemeKind::generalised_alpha:
          {
            // fractions of the new state, so alpha = 1 - alpha of the literature
            const double rho = parameters.spectral_radius;
            alpha_m          = (2. - rho) / (1. + rho);
            alpha_f          = 1. / (1. + rho);
            const double sum = 1. + alpha_m - alpha_f;
            beta             = 0.25 * sum * sum;
            gamma            = 0.5 + alpha_m - alpha_f;
            break;
          }
      }
    carries_acceleration = parameters.carry_acceleration;
  }
} // namespace kedge
