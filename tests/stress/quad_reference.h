// The stresses of a Hencky material evaluated anew with 113-bit numbers: no
// principal axes, the logarithm from repeated square roots and a series.
#ifndef kedge_tests_stress_quad_reference_h
#define kedge_tests_stress_quad_reference_h

#include <kedge/materials/hencky.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <cmath>

namespace kedge::reference
{
  using Quad =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                  boost::multiprecision::et_off>;

  /** A 3 x 3 matrix; plane strain has the out-of-plane part at [2][2]. */
  struct Matrix
  {
    std::array<std::array<Quad, 3>, 3> entry{};

    static Matrix
    identity()
    {
      Matrix one;
      for (int i = 0; i < 3; ++i)
        one.entry[i][i] = 1;
      return one;
    }

    Quad *
    operator[](const int i)
    {
      return entry[i].data();
    }

    const Quad *
    operator[](const int i) const
    {
      return entry[i].data();
    }
  };

  inline Matrix
  operator*(const Matrix &a, const Matrix &b)
  {
    Matrix c;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          c[i][j] += a[i][k] * b[k][j];
    return c;
  }

  /** x a + y b. */
  inline Matrix
  combine(const Quad x, const Matrix &a, const Quad y, const Matrix &b)
  {
    Matrix c;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        c[i][j] = x * a[i][j] + y * b[i][j];
    return c;
  }

  inline Matrix
  transpose(const Matrix &a)
  {
    Matrix c;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        c[i][j] = a[j][i];
    return c;
  }

  inline Matrix
  inverse(const Matrix &a)
  {
    Matrix c;
    Quad   determinant = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        {
          const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
          c[i][j] = a[p][r] * a[q][s] - a[p][s] * a[q][r];
        }
    for (int j = 0; j < 3; ++j)
      determinant += a[0][j] * c[j][0];
    return combine(1 / determinant, c, 0, c);
  }

  inline Quad
  contract(const Matrix &a, const Matrix &b)
  {
    Quad sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum += a[i][j] * b[i][j];
    return sum;
  }

  inline Quad
  trace(const Matrix &a)
  {
    return a[0][0] + a[1][1] + a[2][2];
  }

  /** Logarithm of a positive definite matrix: square roots by Denman and Beavers, then 2 artanh. */
  inline Matrix
  logarithm(Matrix a)
  {
    constexpr int n_roots = 5;
    const Matrix  one     = Matrix::identity();
    for (int root = 0; root < n_roots; ++root)
      {
        Matrix y = a, z = one;
        for (int k = 0; k < 20; ++k)
          {
            const Matrix next = combine(0.5, y, 0.5, inverse(z));
            z                 = combine(0.5, z, 0.5, inverse(y));
            const Matrix step = combine(1, next, -1, y);
            y                 = next;
            if (contract(step, step) < Quad(1e-38))
              break; // quadratic: the next step would be below 1e-38
          }
        a = y;
      }
    const Matrix x = combine(1, a, -1, one) * inverse(combine(1, a, 1, one)), square = x * x;
    Matrix       power = x, sum;
    for (int k = 1; k < 60; k += 2)
      {
        sum   = combine(1, sum, Quad(2) / k, power);
        power = power * square;
        if (contract(power, power) < Quad(1e-72))
          break;
      }
    return combine(1 << n_roots, sum, 0, sum);
  }

  /** What a point can say of one state of strain. */
  struct Answer
  {
    Matrix kirchhoff_stress;
    Quad   energy;
  };

  inline Answer
  hencky(const Hencky &material, const Matrix &elastic_left_cauchy_green)
  {
    const Matrix strain = combine(0.5, logarithm(elastic_left_cauchy_green), 0, Matrix());
    const Quad   volume = trace(strain);
    Answer       answer;
    answer.kirchhoff_stress = combine(2 * Quad(material.shear_modulus),
                                      strain,
                                      Quad(material.lame_modulus) * volume,
                                      Matrix::identity());
    answer.energy           = contract(answer.kirchhoff_stress, strain) / 2;
    return answer;
  }

  /** A committed state: b^e_n, and b_n of the total deformation. */
  struct State
  {
    Matrix elastic_left_cauchy_green, left_cauchy_green;
  };

  /** A S as evaluate_force_stress() should give it, and the work of the step. */
  struct Force
  {
    Matrix stress; ///< P
    Quad   work;
  };

  /** P of StressRule::at_configuration at I + A. */
  inline Force
  at_configuration(const Hencky &material, const State &state, const Matrix &A)
  {
    const Matrix F      = combine(1, Matrix::identity(), 1, A);
    const Answer before = hencky(material, state.elastic_left_cauchy_green);
    const Answer after  = hencky(material, F * state.elastic_left_cauchy_green * transpose(F));
    return {after.kirchhoff_stress * transpose(inverse(F)), after.energy - before.energy};
  }

  /** P of StressRule::conserving by the printed quotient (3.142), which 113 bits bear. */
  inline Force
  conserving(const Hencky &material, const State &state, const Matrix &A)
  {
    const Matrix one   = Matrix::identity();
    const Matrix F     = combine(1, one, 1, A);
    const Matrix E     = combine(1, transpose(F) * F, -1, one);
    const Answer begin = hencky(material, state.elastic_left_cauchy_green);
    const Answer end   = hencky(material, F * state.elastic_left_cauchy_green * transpose(F));
    const Matrix pull  = inverse(F);
    const Matrix mean =
      combine(0.5, begin.kirchhoff_stress, 0.5, pull * end.kirchhoff_stress * transpose(pull));
    const Matrix N      = state.left_cauchy_green * E * state.left_cauchy_green;
    const Quad   work   = end.energy - begin.energy;
    const Quad   square = contract(E, N);
    const Quad   q      = square == 0 ? Quad(0) : (2 * work - contract(mean, E)) / square;
    return {combine(1, one, 0.5, A) * combine(1, mean, q, N), work};
  }
} // namespace kedge::reference

#endif
