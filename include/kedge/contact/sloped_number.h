#ifndef kedge_contact_sloped_number_h
#define kedge_contact_sloped_number_h

#include <array>
#include <cmath>

namespace kedge
{
  /** A number and its derivatives by n others: arithmetic carries them along. */
  template <unsigned int n>
  struct SlopedNumber
  {
    double                value = 0.;
    std::array<double, n> slope{};

    SlopedNumber() = default;
    SlopedNumber(const double value)
      : value(value)
    {}

    /** The number @p which of those by which derivatives are taken. */
    static SlopedNumber
    variable(const double value, const unsigned int which)
    {
      SlopedNumber result(value);
      result.slope[which] = 1.;
      return result;
    }

    /** This times a, plus b times c, for the slopes; the value is given. */
    static SlopedNumber
    combined(const double        value,
             const SlopedNumber &a,
             const double        of_a,
             const SlopedNumber &b,
             const double        of_b)
    {
      SlopedNumber result(value);
      for (unsigned int i = 0; i < n; ++i)
        result.slope[i] = of_a * a.slope[i] + of_b * b.slope[i];
      return result;
    }

    friend SlopedNumber
    operator+(const SlopedNumber &a, const SlopedNumber &b)
    {
      return combined(a.value + b.value, a, 1., b, 1.);
    }
    friend SlopedNumber
    operator-(const SlopedNumber &a, const SlopedNumber &b)
    {
      return combined(a.value - b.value, a, 1., b, -1.);
    }
    friend SlopedNumber
    operator*(const SlopedNumber &a, const SlopedNumber &b)
    {
      return combined(a.value * b.value, a, b.value, b, a.value);
    }
    friend SlopedNumber
    operator/(const SlopedNumber &a, const SlopedNumber &b)
    {
      return combined(a.value / b.value, a, 1. / b.value, b, -a.value / (b.value * b.value));
    }
    friend SlopedNumber
    sqrt(const SlopedNumber &a)
    {
      const double root = std::sqrt(a.value);
      return combined(root, a, 0.5 / root, a, 0.);
    }
  };

  inline double
  value_of(const double x)
  {
    return x;
  }

  template <unsigned int n>
  double
  value_of(const SlopedNumber<n> &x)
  {
    return x.value;
  }
} // namespace kedge

#endif
