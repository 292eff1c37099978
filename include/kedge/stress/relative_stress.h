#ifndef kedge_stress_relative_stress_h
#define kedge_stress_relative_stress_h

#include <kedge/base/incremental_spectrum.h>
#include <kedge/base/symmetric_index.h>
#include <kedge/materials/history.h>

#include <cmath>

namespace kedge
{
  /**
   * The committed state of a material point that its stress depends on, in
   * the configuration n at the start of the step.
   */
  template <int dim, typename Number = double>
  struct StressState
  {
    Number elastic_frame[dim][dim];                     ///< B, B B^T = b^e_n, orthogonal columns
    Number squared_stretch[dim];                        ///< squared length of each column of B
    Number strain[3];                                   ///< principal elastic Hencky strain eps_n
    Number elastic_left_cauchy_green[n_symmetric<dim>]; ///< b^e_n = B B^T
    Number kirchhoff_stress[n_symmetric<dim>];          ///< tau_n [Pa]
  };

  /** What a material answers, with Number for each value. */
  template <class Material, typename Number>
  using ResponseOf = decltype(std::declval<const Material &>().respond(
    std::declval<const Number (&)[3]>(),
    std::declval<const Number (&)[3]>(),
    std::declval<const HistoryOf<Material, Number> &>()));

  /**
   * The stress of a trial step, pulled back to the configuration n. With the
   * relative deformation gradient dF = I + A, A = d(Delta u)/dx_n, and the
   * relative Green-type strain E = A + A^T + A^T A (so that C - C_n =
   * F_n^T E F_n), it is
   *   S = dF^{-1} tau dF^{-T} [Pa], work-conjugate to E/2 per volume V0,
   * the second Piola-Kirchhoff stress of the step. It is computed in the
   * eigenframe of B^T (I + E) B, whose eigenvectors w_i give a_i = B w_i and
   *   S = sum_i tau_i / lambda_i a_i (x) a_i.
   */
  template <int dim, class Material, typename Number = double>
  struct RelativeStress
  {
    Number                       frame[dim][dim];    ///< a_i as columns
    Number                       rotation[dim][dim]; ///< w_i as columns
    Number                       lambda[dim];        ///< squared principal trial stretches
    Number                       increment[3];       ///< increment of the principal Hencky strain
    ResponseOf<Material, Number> response;           ///< principal Kirchhoff stresses, work
    Number                       stress[n_symmetric<dim>]; ///< S [Pa]
    /** false where an eigenvalue is not positive or the material has no answer */
    Condition<Number> valid;
  };

  /** E = A + A^T + A^T A in the order of symmetric_index(). */
  template <int dim, typename Number>
  inline void
  relative_strain(const Number (&A)[dim][dim], Number (&E)[n_symmetric<dim>])
  {
    for (int s = 0; s < n_symmetric<dim>; ++s)
      {
        const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
        Number    sum = A[i][j] + A[j][i];
        for (int k = 0; k < dim; ++k)
          sum += A[k][i] * A[k][j];
        E[s] = sum;
      }
  }

  /** det(I + A). */
  template <int dim, typename Number>
  inline Number
  relative_determinant(const Number (&A)[dim][dim])
  {
    if constexpr (dim == 2)
      return (1. + A[0][0]) * (1. + A[1][1]) - A[0][1] * A[1][0];
    else
      return (1. + A[0][0]) * ((1. + A[1][1]) * (1. + A[2][2]) - A[1][2] * A[2][1]) -
             A[0][1] * (A[1][0] * (1. + A[2][2]) - A[1][2] * A[2][0]) +
             A[0][2] * (A[1][0] * A[2][1] - (1. + A[1][1]) * A[2][0]);
  }

  /** Evaluates RelativeStress at the relative strain @p E. */
  template <int dim, class Material, typename Number>
  inline RelativeStress<dim, Material, Number>
  evaluate_relative_stress(const Material                 &material,
                           const StressState<dim, Number> &state,
                           const Number (&E)[n_symmetric<dim>],
                           const HistoryOf<Material, Number> &history = {})
  {
    using std::log1p;
    RelativeStress<dim, Material, Number> result;
    const auto                           &B = state.elastic_frame;

    // P = B^T E B
    Number EB[dim][dim], P[dim][dim], delta[dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          EB[i][j] = 0.;
          for (int k = 0; k < dim; ++k)
            EB[i][j] += E[symmetric_index<dim>(i, k)] * B[k][j];
        }
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        {
          Number sum = 0.;
          for (int k = 0; k < dim; ++k)
            sum += B[k][i] * EB[k][j];
          P[i][j] = P[j][i] = sum;
        }
    incremental_spectrum<dim>(state.squared_stretch, P, delta, result.rotation);

    for (int i = 0; i < dim; ++i)
      {
        result.lambda[i]    = state.squared_stretch[i] + delta[i];
        const auto positive = result.lambda[i] > 0.;
        result.valid        = i == 0 ? positive : result.valid && positive;
      }
    if (!any(result.valid))
      return result;
    result.increment[2] = 0.; // plane strain: no increment out of plane
    for (int i = 0; i < dim; ++i)
      result.increment[i] = 0.5 * log1p(delta[i] / state.squared_stretch[i]);

    result.response = material.respond(state.strain, result.increment, history);
    if constexpr (Material::can_fail)
      {
        result.valid = result.valid && result.response.valid;
        if (!any(result.valid))
          return result;
      }

    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k)
        {
          result.frame[k][i] = 0.;
          for (int l = 0; l < dim; ++l)
            result.frame[k][i] += B[k][l] * result.rotation[l][i];
        }
    Number ratio[dim];
    for (int i = 0; i < dim; ++i)
      ratio[i] = result.response.kirchhoff_stress[i] / result.lambda[i];
    for (int s = 0; s < n_symmetric<dim>; ++s)
      {
        const int k = symmetric_row<dim>[s], l = symmetric_column<dim>[s];
        Number    sum = 0.;
        for (int i = 0; i < dim; ++i)
          sum += ratio[i] * result.frame[k][i] * result.frame[l][i];
        result.stress[s] = sum;
      }
    return result;
  }

  /** ln(1 + x)/x, so that (eps_i - eps_j)/(lambda_i - lambda_j) = log_slope(x)/(2 lambda_j). */
  template <typename Number>
  inline Number
  log_slope(const Number &x)
  {
    using std::log1p, std::abs;
    const auto   near  = abs(x) < 1e-4;
    const Number value = log1p(x) / select(near, 1., x);
    return select(near, 1. - x * (0.5 - x * (1. / 3. - 0.25 * x)), value);
  }

  /**
   * Twice the slope of the work by E, 2 d(dPsi + dD)/dE = sum_i w_i/lambda_i
   * a_i (x) a_i with w = d(dPsi + dD)/d eps^tr, in the order of
   * symmetric_index() [Pa]; S itself where w = tau.
   */
  template <int dim, class Material, typename Number>
  inline void
  relative_work_slope(const Material                              &material,
                      const RelativeStress<dim, Material, Number> &r,
                      Number (&slope)[n_symmetric<dim>])
  {
    for (int s = 0; s < n_symmetric<dim>; ++s)
      {
        slope[s] = r.stress[s];
        if constexpr (!Material::stress_is_work_slope)
          {
            const int k = symmetric_row<dim>[s], l = symmetric_column<dim>[s];
            slope[s] = 0.;
            for (int i = 0; i < dim; ++i)
              slope[s] +=
                material.work_slope(r.response, i) / r.lambda[i] * r.frame[k][i] * r.frame[l][i];
          }
      }
  }

  /**
   * dS/dE in the order of symmetric_index(), as H[s][t] with the meaning
   * dS_s = sum over all pairs (P, Q) of H[s][index(P, Q)] dE_PQ; minor
   * symmetric, [Pa].
   */
  template <int dim, class Material, typename Number>
  inline void
  relative_stress_tangent(const Material                              &material,
                          const RelativeStress<dim, Material, Number> &r,
                          Number (&H)[n_symmetric<dim>][n_symmetric<dim>])
  {
    const auto   &tau = r.response.kirchhoff_stress;
    constexpr int ns  = n_symmetric<dim>;
    Number        same[dim][ns], inverse[dim];
    for (int i = 0; i < dim; ++i)
      inverse[i] = 1. / r.lambda[i];
    for (int i = 0; i < dim; ++i)
      for (int s = 0; s < ns; ++s)
        same[i][s] = r.frame[symmetric_row<dim>[s]][i] * r.frame[symmetric_column<dim>[s]][i];

    for (int s = 0; s < ns; ++s)
      for (int t = 0; t < ns; ++t)
        H[s][t] = 0.;

    for (int i = 0; i < dim; ++i)
      {
        Number row[ns];
        for (int j = 0; j < dim; ++j)
          {
            Number h = 0.5 * material.tangent(r.response, i, j);
            if (i == j)
              h -= tau[i];
            h *= inverse[i] * inverse[j];
            for (int t = 0; t < ns; ++t)
              row[t] = j == 0 ? h * same[j][t] : row[t] + h * same[j][t];
          }
        for (int s = 0; s < ns; ++s)
          for (int t = 0; t < ns; ++t)
            H[s][t] += same[i][s] * row[t];
      }

    for (int i = 0; i < dim - 1; ++i)
      for (int j = i + 1; j < dim; ++j)
        {
          const Number li = r.lambda[i], lj = r.lambda[j];
          const Number secant = 0.5 * material.secant_shear(r.response, i, j) *
                                log_slope((li - lj) * inverse[j]) * inverse[j];
          const Number g =
            (0.5 * (li + lj) * secant - 0.5 * (tau[i] + tau[j])) * (inverse[i] * inverse[j]);
          Number mixed[ns];
          for (int s = 0; s < ns; ++s)
            {
              const int k = symmetric_row<dim>[s], l = symmetric_column<dim>[s];
              mixed[s] = r.frame[k][i] * r.frame[l][j] + r.frame[l][i] * r.frame[k][j];
            }
          for (int s = 0; s < ns; ++s)
            for (int t = 0; t < ns; ++t)
              H[s][t] += 0.5 * g * mixed[s] * mixed[t];
        }
  }
} // namespace kedge

#endif
