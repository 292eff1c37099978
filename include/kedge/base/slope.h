#ifndef kedge_base_slope_h
#define kedge_base_slope_h

namespace kedge
{
  /**
   * The derivative from the right, at 0, of a function that is smooth from 0 to
   * @p length: that of the polynomial of degree six through seven values in
   * the first half of the way. Exact for such polynomials; for sin(w s) its relative error is
   * about (w length/12)^6/7, below round-off for w length < 0.1.
   */
  template <typename Function>
  double
  slope_from_right(const Function &function, const double length)
  {
    constexpr double weights[7] = {-147., 360., -450., 400., -225., 72., -10.};
    const double     h          = length / 12.;
    double           sum        = 0.;
    for (int k = 0; k < 7; ++k)
      sum += weights[k] * function(k * h);
    return sum / (60. * h);
  }
} // namespace kedge

#endif
