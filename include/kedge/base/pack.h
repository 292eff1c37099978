#ifndef kedge_base_pack_h
#define kedge_base_pack_h

#include <cmath>

namespace kedge
{
  /** Lanes of a Pack: what one vector register of the machine compiled for holds. */
#if defined(__AVX512F__)
  constexpr unsigned int pack_width = 8;
#elif defined(__AVX__)
  constexpr unsigned int pack_width = 4;
#else
  constexpr unsigned int pack_width = 2;
#endif

  /**
   * Doubles of several material points, computed with together in the lanes of
   * a vector register. Code that takes the number type as a template parameter
   * runs with one double or with a Pack: conditions become select(), and a
   * branch is taken if any() lane needs it. Lanes do not influence each other.
   */
  struct Pack
  {
    using Vector = double __attribute__((vector_size(pack_width * sizeof(double))));

    Pack() = default;
    Pack(const double value)
      : lanes(value - Vector{})
    {}
    Pack(const Vector &lanes)
      : lanes(lanes)
    {}

    double
    operator[](const unsigned int lane) const
    {
      return lanes[lane];
    }

    void
    set(const unsigned int lane, const double value)
    {
      reinterpret_cast<double *>(&lanes)[lane] = value;
    }

    Pack &
    operator+=(const Pack &other)
    {
      lanes += other.lanes;
      return *this;
    }
    Pack &
    operator-=(const Pack &other)
    {
      lanes -= other.lanes;
      return *this;
    }
    Pack &
    operator*=(const Pack &other)
    {
      lanes *= other.lanes;
      return *this;
    }
    Pack &
    operator/=(const Pack &other)
    {
      lanes /= other.lanes;
      return *this;
    }

    Vector lanes;
  };

  inline Pack
  operator+(const Pack &a, const Pack &b)
  {
    return a.lanes + b.lanes;
  }
  inline Pack
  operator-(const Pack &a, const Pack &b)
  {
    return a.lanes - b.lanes;
  }
  inline Pack
  operator*(const Pack &a, const Pack &b)
  {
    return a.lanes * b.lanes;
  }
  inline Pack
  operator/(const Pack &a, const Pack &b)
  {
    return a.lanes / b.lanes;
  }
  inline Pack
  operator-(const Pack &a)
  {
    return -a.lanes;
  }

  /** A condition in each lane. */
  struct PackMask
  {
    using Vector = decltype(Pack::Vector{} < Pack::Vector{});

    Vector lanes; ///< -1 where it holds, else 0

    bool
    operator[](const unsigned int lane) const
    {
      return lanes[lane] != 0;
    }
  };

  inline PackMask
  operator>(const Pack &a, const Pack &b)
  {
    return {a.lanes > b.lanes};
  }
  inline PackMask
  operator<(const Pack &a, const Pack &b)
  {
    return {a.lanes < b.lanes};
  }
  inline PackMask
  operator>=(const Pack &a, const Pack &b)
  {
    return {a.lanes >= b.lanes};
  }
  inline PackMask
  operator<=(const Pack &a, const Pack &b)
  {
    return {a.lanes <= b.lanes};
  }
  inline PackMask
  operator!(const PackMask &a)
  {
    return {~a.lanes};
  }
  inline PackMask
  operator&&(const PackMask &a, const PackMask &b)
  {
    return {a.lanes & b.lanes};
  }
  inline PackMask
  operator||(const PackMask &a, const PackMask &b)
  {
    return {a.lanes | b.lanes};
  }

  inline Pack
  select(const PackMask &condition, const Pack &yes, const Pack &no)
  {
    return condition.lanes ? yes.lanes : no.lanes;
  }

  inline bool
  any(const PackMask &condition)
  {
    long long result = 0;
    for (unsigned int lane = 0; lane < pack_width; ++lane)
      result |= condition.lanes[lane];
    return result != 0;
  }

  // one double, with the same names
  inline double
  select(const bool condition, const double yes, const double no)
  {
    return condition ? yes : no;
  }
  /** Of other numbers, such as those of more digits. */
  template <typename Number>
  inline Number
  select(const bool condition, const Number &yes, const Number &no)
  {
    return condition ? yes : no;
  }
  inline bool
  any(const bool condition)
  {
    return condition;
  }

  /** What comparing two Numbers gives. */
  template <typename Number>
  using Condition = decltype(Number{} > Number{});

  inline Pack
  sqrt(const Pack &x)
  {
    Pack result;
    for (unsigned int lane = 0; lane < pack_width; ++lane)
      result.lanes[lane] = std::sqrt(x.lanes[lane]);
    return result;
  }

  inline Pack
  abs(const Pack &x)
  {
    return x.lanes < 0. ? -x.lanes : x.lanes;
  }

  inline Pack
  exp(const Pack &x)
  {
    Pack result;
    for (unsigned int lane = 0; lane < pack_width; ++lane)
      result.lanes[lane] = std::exp(x.lanes[lane]);
    return result;
  }

  /** exp(x) - 1, accurate relative to the result. */
  inline Pack
  expm1(const Pack &x)
  {
    Pack result;
    for (unsigned int lane = 0; lane < pack_width; ++lane)
      result.lanes[lane] = std::expm1(x.lanes[lane]);
    return result;
  }

  /**
   * ln(1 + x), accurate relative to the result: the series of 2 artanh z,
   * z = x/(2 + x), where |z| <= 1/5, which twelve terms give to round-off, and
   * the standard library's function elsewhere.
   */
  inline Pack
  log1p(const Pack &x)
  {
    const Pack z = x / (2. + x), square = z * z;
    Pack       sum = 1. / 23.;
    for (int k = 21; k > 0; k -= 2)
      sum = sum * square + 1. / k;
    sum *= 2. * z;
    const PackMask far = !(square <= 0.04);
    if (any(far))
      for (unsigned int lane = 0; lane < pack_width; ++lane)
        if (far[lane])
          sum.lanes[lane] = std::log1p(x.lanes[lane]);
    return sum;
  }
} // namespace kedge

#endif
