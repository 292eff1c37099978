#ifndef kedge_materials_closing_of_cracks_h
#define kedge_materials_closing_of_cracks_h

#include <kedge/base/pack.h>

namespace kedge
{
  /**
   * Soil that tension has torn open closes before it bears pressure again. Without that every
   * opening would be a growth for good, and sand that flies apart and comes together would swell.
   * With the mean stress P = K eps_v of the trial and the volume strain o >= 0 by which it is open,
   *   c = min(o, -P/K) where P < 0,  P + K c in place of P,  o - c left open.
   * It takes place at P = 0 or below, so that P c, what it dissipates, is not negative.
   */
  template <typename Number>
  struct ClosingOfCracks
  {
    ClosingOfCracks(const Number &trial_mean, const double bulk_modulus, const Number &opening)
    {
      const auto   closes = trial_mean < 0. && opening > 0.;
      const Number all    = -trial_mean / bulk_modulus;
      const auto   partly = closes && all <= opening;
      change              = select(partly, all, select(closes, opening, Number(0.)));
      mean =
        select(partly, Number(0.), select(closes, trial_mean + bulk_modulus * opening, trial_mean));
      slope = select(partly, Number(0.), Number(1.));
    }

    Number change; ///< c [-]
    Number mean;   ///< P + K c [Pa]
    Number slope;  ///< its derivative by P
  };
} // namespace kedge

#endif
