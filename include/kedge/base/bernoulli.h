#ifndef kedge_base_bernoulli_h
#define kedge_base_bernoulli_h

#include <kedge/base/pack.h>

#include <limits>

namespace kedge
{
  /**
   * The function 1 - B(d) of Bernoulli's B(d) = d/(e^d - 1) and its slope: the discrete gradient
   * of an exponential law, theory_mixture.md 3. Both are accurate relative to the result; d below
   * the first argument at which the closed form has lost digits is summed as a series.
   */
  template <typename Number>
  struct BernoulliGap
  {
    Number value, slope;

    /** B_2k/(2k)!, k = 1 ..: 1e-25 of the value at a quarter. */
    static inline const Number coefficient[8] = {Number(1.) / 12.,
                                                 Number(-1.) / 720.,
                                                 Number(1.) / 30240.,
                                                 Number(-1.) / 1209600.,
                                                 Number(1.) / 47900160.,
                                                 Number(-691.) / 1307674368000.,
                                                 Number(1.) / 74724249600.,
                                                 Number(-3617.) / 10670622842880000.};

    explicit BernoulliGap(const Number &d)
    {
      using std::abs;
      using std::expm1;
      const auto   near = abs(d) < 0.25;
      const Number s    = d * d;
      Number       sum = 0., of_slope = 0.;
      for (int k = 7; k >= 0; --k)
        {
          sum      = sum * s + coefficient[k];
          of_slope = of_slope * s + (2. * k + 2.) * coefficient[k];
        }
      value = d * (0.5 - d * sum);
      slope = 0.5 - d * of_slope;
      if (!any(!near))
        return;
      const Number safe = select(near, Number(1.), d), e = expm1(safe);
      value = select(near, value, 1. - safe / e);
      slope = select(near, slope, (safe * (e + 1.) - e) / (e * e));
    }
  };

  /** A relative change that tells nothing any more. */
  template <typename Number>
  inline double
  negligible_change()
  {
    if constexpr (std::numeric_limits<Number>::is_specialized)
      return 2. * static_cast<double>(std::numeric_limits<Number>::epsilon());
    else // a Pack
      return 2. * std::numeric_limits<double>::epsilon();
  }

  /** The d of 1 - B(d) = @p gap < 1, by Newton's method. */
  template <typename Number>
  inline Number
  invert_bernoulli_gap(const Number &gap)
  {
    // the square of the last change but one is round-off
    const double settled = 0.1 * std::sqrt(negligible_change<Number>());
    Number       d       = 2. * gap / (1. - gap / 3.); // right to third order
    for (int k = 0; k < 6; ++k)
      {
        const BernoulliGap<Number> at(d);
        const Number               change = (at.value - gap) / at.slope;
        d -= change;
        using std::abs;
        if (!any(abs(change) > settled * abs(d)))
          break;
      }
    return d;
  }
} // namespace kedge

#endif
