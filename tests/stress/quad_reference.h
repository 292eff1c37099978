// The stresses of Hencky's and von Mises' materials evaluated anew with 113-bit
// numbers: no principal axes, the logarithm from repeated square roots and a series.
#ifndef kedge_tests_stress_quad_reference_h
#define kedge_tests_stress_quad_reference_h

#include <kedge/materials/material.h>
#include <kedge/points/point_state.h>
#include <kedge/stress/force_stress.h>

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

  /** A committed state: b^e_n, alpha_n and sigma_y. */
  struct State
  {
    Matrix elastic_left_cauchy_green;
    Quad   equivalent_plastic_strain = 0;
    Quad   yield_stress              = 0;
  };

  /** What a point can say of one state of strain. */
  struct Answer
  {
    Matrix kirchhoff_stress, elastic_strain;
    Quad   elastic_energy;
    Quad   hardening_energy          = 0;
    Quad   dissipation               = 0; ///< of the step
    Quad   equivalent_plastic_strain = 0;

    /** dPsi_1 + dPsi_2 + dD since @p begin, each difference taken for itself. */
    Quad
    work_since(const Answer &begin) const
    {
      return (elastic_energy - begin.elastic_energy) + (hardening_energy - begin.hardening_energy) +
             dissipation;
    }
  };

  inline Answer
  hencky_of_strain(const Hencky &material, const Matrix &strain)
  {
    Answer answer;
    answer.elastic_strain   = strain;
    answer.kirchhoff_stress = combine(2 * Quad(material.shear_modulus),
                                      strain,
                                      Quad(material.lame_modulus) * trace(strain),
                                      Matrix::identity());
    answer.elastic_energy   = contract(answer.kirchhoff_stress, strain) / 2;
    return answer;
  }

  inline Answer
  hencky(const Hencky &material, const Matrix &elastic_left_cauchy_green)
  {
    return hencky_of_strain(material,
                            combine(0.5, logarithm(elastic_left_cauchy_green), 0, Matrix()));
  }

  // the answer of a law in the committed state, and after the step F

  inline Answer
  committed(const Hencky &material, const State &state)
  {
    return hencky(material, state.elastic_left_cauchy_green);
  }

  inline Answer
  after_step(const Hencky &material, const State &state, const Matrix &F)
  {
    return hencky(material, F * state.elastic_left_cauchy_green * transpose(F));
  }

  inline Quad
  hardening_energy(const VonMises &material, const Quad equivalent_plastic_strain)
  {
    return Quad(material.hardening_modulus) * equivalent_plastic_strain *
           equivalent_plastic_strain / 2;
  }

  inline Answer
  committed(const VonMises &material, const State &state)
  {
    Answer answer                    = hencky(material.elastic, state.elastic_left_cauchy_green);
    answer.hardening_energy          = hardening_energy(material, state.equivalent_plastic_strain);
    answer.equivalent_plastic_strain = state.equivalent_plastic_strain;
    return answer;
  }

  /** The plastic strain is taken off the trial strain as a tensor; energies are summed up. */
  inline Answer
  after_step(const VonMises &material, const State &state, const Matrix &F)
  {
    const Answer trial =
      hencky(material.elastic, F * state.elastic_left_cauchy_green * transpose(F));
    const Matrix s =
      combine(1, trial.kirchhoff_stress, -trace(trial.kirchhoff_stress) / 3, Matrix::identity());
    const Quad norm = sqrt(contract(s, s)), root = sqrt(Quad(2) / 3);
    const Quad excess     = norm - root * (state.yield_stress + Quad(material.hardening_modulus) *
                                                              state.equivalent_plastic_strain);
    const Quad multiplier = excess > 0 ? excess / (2 * Quad(material.elastic.shear_modulus) +
                                                   2 * Quad(material.hardening_modulus) / 3)
                                       : Quad(0);

    Answer answer                    = multiplier > 0
                                         ? hencky_of_strain(material.elastic,
                                         combine(1, trial.elastic_strain, -multiplier / norm, s))
                                         : trial;
    answer.equivalent_plastic_strain = state.equivalent_plastic_strain + root * multiplier;
    answer.hardening_energy          = hardening_energy(material, answer.equivalent_plastic_strain);
    answer.dissipation               = state.yield_stress * root * multiplier;
    return answer;
  }

  /** A S as evaluate_force_stress() should give it, and the work of the step. */
  struct Force
  {
    Matrix stress; ///< P
    Quad   work;   ///< dPsi + dD
  };

  /** P of StressRule::at_configuration at I + A. */
  template <class Material>
  inline Force
  at_configuration(const Material &material, const State &state, const Matrix &A)
  {
    const Matrix F   = combine(1, Matrix::identity(), 1, A);
    const Answer end = after_step(material, state, F);
    return {end.kirchhoff_stress * transpose(inverse(F)),
            end.work_since(committed(material, state))};
  }

  /** P of StressRule::conserving by the printed quotient (3.142), which 113 bits bear. */
  template <class Material>
  inline Force
  conserving(const Material &material, const State &state, const Matrix &A)
  {
    const Matrix one   = Matrix::identity();
    const Matrix F     = combine(1, one, 1, A);
    const Matrix E     = combine(1, transpose(F) * F, -1, one);
    const Answer begin = committed(material, state), end = after_step(material, state, F);
    const Matrix pull = inverse(F);
    const Matrix mean =
      combine(0.5, begin.kirchhoff_stress, 0.5, pull * end.kirchhoff_stress * transpose(pull));
    const Matrix N      = state.elastic_left_cauchy_green * E * state.elastic_left_cauchy_green;
    const Quad   work   = end.work_since(begin);
    const Quad   square = contract(E, N);
    const Quad   q      = square == 0 ? Quad(0) : (2 * work - contract(mean, E)) / square;
    return {combine(1, one, 0.5, A) * combine(1, mean, q, N), work};
  }

  /** P of either rule; A is the whole step. */
  template <class Material>
  inline Force
  force(const StressRule rule,
        const Material  &material,
        const State     &state,
        const Matrix    &A,
        const double     alpha)
  {
    return rule == StressRule::conserving
             ? conserving(material, state, A)
             : at_configuration(material, state, combine(alpha, A, 0, A));
  }

  /** The same state for the reference; tensors outside the plane are those of plane strain. */
  template <int dim>
  inline State
  reference_state(const PointState<dim> &point)
  {
    Matrix B = Matrix::identity();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        B[i][j] = point.elastic_frame[i][j];
    if (dim == 2)
      B[2][2] = point.out_of_plane_elastic_stretch;
    return {B * transpose(B),
            point.memory[memory_index("equivalent_plastic_strain")],
            point.memory[memory_index("yield_stress")]};
  }

  template <int dim>
  inline Matrix
  to_matrix(const double (&A)[dim][dim])
  {
    Matrix result;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i][j] = A[i][j];
    return result;
  }

  template <int dim>
  inline double
  largest_difference(const double (&P)[dim][dim], const Matrix &expected)
  {
    double largest = 0.;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        largest = std::max(largest, std::abs(static_cast<double>(P[i][j] - expected[i][j])));
    return largest;
  }

  /** dP/dA of the reference by central differences with steps @p h. */
  template <int dim, class Material>
  inline double
  tangent_error(const ForceStress<dim> &result,
                const StressRule        rule,
                const Material         &material,
                const State            &state,
                const double (&A)[dim][dim],
                const double alpha,
                const double h)
  {
    double largest = 0.;
    for (int m = 0; m < dim; ++m)
      for (int S = 0; S < dim; ++S)
        {
          Matrix plus = to_matrix<dim>(A), minus = plus;
          plus[m][S] += h;
          minus[m][S] -= h;
          const Matrix slope = combine(0.5 / Quad(h),
                                       force(rule, material, state, plus, alpha).stress,
                                       -0.5 / Quad(h),
                                       force(rule, material, state, minus, alpha).stress);
          for (int p = 0; p < dim; ++p)
            for (int R = 0; R < dim; ++R)
              largest =
                std::max(largest,
                         std::abs(result.tangent[p][R][m][S] - static_cast<double>(slope[p][R])));
        }
    return largest;
  }
} // namespace kedge::reference

#endif
