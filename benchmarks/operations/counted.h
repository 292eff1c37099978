#ifndef kedge_benchmarks_counted_h
#define kedge_benchmarks_counted_h

#include <cmath>
#include <cstddef>

namespace kedge
{
  /**
   * A double that counts what is done with it, for the code that takes the
   * number type as a template parameter. Each +, -, *, /, square root counts 1; a
   * logarithm 30, which is what the series of base/pack.h takes. Changes of sign,
   * comparisons and choices count nothing.
   */
  struct Counted
  {
    Counted() = default;
    Counted(const double value)
      : value(value)
    {}

    Counted &
    operator+=(const Counted &other)
    {
      return *this = *this + other;
    }
    Counted &
    operator-=(const Counted &other)
    {
      return *this = *this - other;
    }
    Counted &
    operator*=(const Counted &other)
    {
      return *this = *this * other;
    }

    friend Counted
    operator+(const Counted &a, const Counted &b)
    {
      return result(a.value + b.value);
    }
    friend Counted
    operator-(const Counted &a, const Counted &b)
    {
      return result(a.value - b.value);
    }
    friend Counted
    operator*(const Counted &a, const Counted &b)
    {
      return result(a.value * b.value);
    }
    friend Counted
    operator/(const Counted &a, const Counted &b)
    {
      return result(a.value / b.value);
    }
    friend Counted
    operator-(const Counted &a)
    {
      return -a.value;
    }
    friend bool
    operator>(const Counted &a, const Counted &b)
    {
      return a.value > b.value;
    }
    friend bool
    operator<(const Counted &a, const Counted &b)
    {
      return a.value < b.value;
    }
    friend bool
    operator>=(const Counted &a, const Counted &b)
    {
      return a.value >= b.value;
    }
    friend bool
    operator<=(const Counted &a, const Counted &b)
    {
      return a.value <= b.value;
    }
    friend Counted
    sqrt(const Counted &a)
    {
      return result(std::sqrt(a.value));
    }
    friend Counted
    abs(const Counted &a)
    {
      return std::abs(a.value);
    }
    friend Counted
    log1p(const Counted &a)
    {
      operations += 29;
      return result(std::log1p(a.value));
    }

    double                    value = 0.;
    static inline std::size_t operations;

  private:
    static Counted
    result(const double value)
    {
      ++operations;
      return value;
    }
  };

  inline Counted
  select(const bool condition, const Counted &yes, const Counted &no)
  {
    return condition ? yes : no;
  }
} // namespace kedge

#endif
