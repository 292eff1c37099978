#ifndef kedge_stress_force_stress_h
#define kedge_stress_force_stress_h

#include <kedge/stress/relative_stress.h>

namespace kedge
{
  /**
   * Which stress enters the internal force.
   *   at_configuration: the material's stress at the displacement alpha * u,
   *     alpha in (0, 1] (quasi-static, mid-point, Newmark, generalised-alpha);
   *   conserving: the CLC stress (3.142), whose work over the step is exactly
   *     the stored and dissipated energy.
   */
  enum class StressRule
  {
    at_configuration,
    conserving
  };

  /**
   * The stress that acts on the gradients dN/dx_n of the basis, which do not
   * change within a step:
   *   f_A = sum_p V0_p P_p dN_A/dx_n,   P = dF_e S [Pa],
   * first index in the configuration of equilibrium (dF_e = I + alpha A or
   * I + A/2), second in configuration n. It equals the printed updated
   * Lagrangian form (3.133) with gradients pushed forward.
   */
  template <int dim, typename Number = double>
  struct ForceStress
  {
    Number            stress[dim][dim];            ///< P
    Number            tangent[dim][dim][dim][dim]; ///< dP_pR / dA_mS as [p][R][m][S]
    Number            work_increment;              ///< Delta Psi + Delta D at u, per V0
    Condition<Number> valid;
  };

  namespace internal
  {
    /** a : b of symmetric tensors in the order of symmetric_index(). */
    template <int dim, typename Number>
    inline Number
    double_contract(const Number (&a)[n_symmetric<dim>], const Number (&b)[n_symmetric<dim>])
    {
      Number sum = 0.;
      for (int s = 0; s < n_symmetric<dim>; ++s)
        sum += (s < dim ? 1. : 2.) * a[s] * b[s];
      return sum;
    }

    /** b E b for symmetric b and E. */
    template <int dim, typename Number>
    inline void
    sandwich(const Number (&b)[n_symmetric<dim>],
             const Number (&E)[n_symmetric<dim>],
             Number (&bEb)[n_symmetric<dim>])
    {
      Number Eb[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            Eb[i][j] = 0.;
            for (int k = 0; k < dim; ++k)
              Eb[i][j] += E[symmetric_index<dim>(i, k)] * b[symmetric_index<dim>(k, j)];
          }
      for (int s = 0; s < n_symmetric<dim>; ++s)
        {
          const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
          bEb[s] = 0.;
          for (int k = 0; k < dim; ++k)
            bEb[s] += b[symmetric_index<dim>(i, k)] * Eb[k][j];
        }
    }

    /** P = (I + w A) S and, if asked for, its derivative with respect to A. */
    template <int dim, bool with_tangent, typename Number>
    inline void
    assemble_force_stress(const Number (&A)[dim][dim],
                          const double mid_weight,
                          const Number (&S)[n_symmetric<dim>],
                          const Number (&H)[n_symmetric<dim>][n_symmetric<dim>],
                          ForceStress<dim, Number> &result)
    {
      Number mid[dim][dim], full[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            mid[i][j]  = (i == j ? 1. : 0.) + mid_weight * A[i][j];
            full[i][j] = (i == j ? 1. : 0.) + A[i][j];
          }
      for (int p = 0; p < dim; ++p)
        for (int R = 0; R < dim; ++R)
          {
            Number sum = 0.;
            for (int Q = 0; Q < dim; ++Q)
              sum += mid[p][Q] * S[symmetric_index<dim>(Q, R)];
            result.stress[p][R] = sum;
          }
      if constexpr (with_tangent)
        for (int p = 0; p < dim; ++p)
          for (int R = 0; R < dim; ++R)
            {
              // dP_pR / dE_PQ, then dE_PS = 2 sym(dF^T dA)
              Number dE[n_symmetric<dim>];
              for (int t = 0; t < n_symmetric<dim>; ++t)
                {
                  dE[t] = 0.;
                  for (int Q = 0; Q < dim; ++Q)
                    dE[t] += mid[p][Q] * H[symmetric_index<dim>(Q, R)][t];
                }
              for (int m = 0; m < dim; ++m)
                for (int T = 0; T < dim; ++T)
                  {
                    Number sum = 0.;
                    for (int Q = 0; Q < dim; ++Q)
                      sum += full[m][Q] * dE[symmetric_index<dim>(Q, T)];
                    result.tangent[p][R][m][T] =
                      2. * sum + (p == m ? mid_weight * S[symmetric_index<dim>(R, T)] : 0.);
                  }
            }
    }

    /**
     * Turns S_{n+1} and H = dS_{n+1}/dE into the CLC stress and its
     * derivative:
     *   S_clc = (tau_n + S_{n+1})/2 + q N,  N = b^e_n E b^e_n,
     *   q = [2 (dPsi + dD) - (tau_n + S_{n+1})/2 : E] / (E : N),
     * E : N = |C^e - C^e_n|^2, of the trial from the stress-free state of n, which is |C - C_n|^2
     * of bodies that have not flowed. (Measured from the state before all plastic flow, whose
     * strains may be large by any factor, the directions of N would be as far apart.) @p work_slope
     * is 2 d(dPsi + dD)/dE, S_{n+1} for most materials. As E -> 0, q = O(|E|); it is set to zero
     * where |E| < 1e-15: what it does there, a part |E|^2 of the work, is nothing, and round-off of the
     * work over |E|^2 (strains of 1e-33 of a motion that is rigid) would be more than any stiffness. Its
     * derivative's rank-one part, O(|E|) too, is dropped where round-off would exceed it.
     */
    template <int dim, bool with_tangent, typename Number>
    inline void
    make_conserving(const StressState<dim, Number> &state,
                    const Number (&E)[n_symmetric<dim>],
                    const Number &work_increment,
                    const Number (&work_slope)[n_symmetric<dim>],
                    Number (&S)[n_symmetric<dim>],
                    Number (&H)[n_symmetric<dim>][n_symmetric<dim>])
    {
      constexpr int    ns              = n_symmetric<dim>;
      constexpr double smallest_square = 1e-30, smallest_square_for_slope = 1e-16;

      Number N[ns];
      sandwich<dim>(state.elastic_left_cauchy_green, E, N);
      const Number square = double_contract<dim>(E, N);

      Number mean[ns];
      for (int s = 0; s < ns; ++s)
        mean[s] = 0.5 * (state.kirchhoff_stress[s] + S[s]);
      const auto   moves  = square > smallest_square;
      const Number excess = 2. * work_increment - double_contract<dim>(mean, E);
      const Number q      = select(moves, excess / select(moves, square, 1.), 0.);

      if constexpr (with_tangent)
        {
          const auto   steep  = square > smallest_square_for_slope;
          const Number weight = select(steep, 1. / select(steep, square, 1.), 0.);
          Number       slope[ns];
          for (int t = 0; t < ns; ++t)
            {
              Number EH = 0.;
              for (int s = 0; s < ns; ++s)
                EH += (s < dim ? 1. : 2.) * E[s] * H[s][t];
              slope[t] = (0.5 * (S[t] - state.kirchhoff_stress[t]) + (work_slope[t] - S[t]) -
                          0.5 * EH - 2. * q * N[t]) *
                         weight;
            }
          const auto &b = state.elastic_left_cauchy_green;
          for (int s = 0; s < ns; ++s)
            {
              const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
              for (int t = 0; t < ns; ++t)
                {
                  const int k = symmetric_row<dim>[t], l = symmetric_column<dim>[t];
                  H[s][t] = 0.5 * H[s][t] + N[s] * slope[t] +
                            0.5 * q *
                              (b[symmetric_index<dim>(i, k)] * b[symmetric_index<dim>(j, l)] +
                               b[symmetric_index<dim>(i, l)] * b[symmetric_index<dim>(j, k)]);
                }
            }
        }
      for (int s = 0; s < ns; ++s)
        S[s] = mean[s] + q * N[s];
    }
  } // namespace internal

  /**
   * The force stress of one material point for the relative displacement
   * gradient @p A of the whole step.
   *
   * @param rule  what stress is meant
   * @param alpha for StressRule::at_configuration the fraction of the step at
   *              which equilibrium is stated; ignored otherwise
   * @param history of the material at the start of the step
   */
  template <int dim, bool with_tangent, StressRule rule, class Material, typename Number>
  inline ForceStress<dim, Number>
  evaluate_force_stress(const Material                 &material,
                        const StressState<dim, Number> &state,
                        const Number (&A)[dim][dim],
                        const double                       alpha,
                        const HistoryOf<Material, Number> &history = {})
  {
    ForceStress<dim, Number> result;
    Number                   H[n_symmetric<dim>][n_symmetric<dim>];
    Number                   E[n_symmetric<dim>];

    Number       at[dim][dim];
    const double fraction = (rule == StressRule::conserving) ? 1. : alpha;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        at[i][j] = fraction * A[i][j];

    result.valid = relative_determinant<dim>(at) > 0.;
    if (!any(result.valid))
      return result;
    relative_strain<dim>(at, E);
    auto r       = evaluate_relative_stress<dim>(material, state, E, history);
    result.valid = result.valid && r.valid;
    if (!any(result.valid))
      return result;
    result.work_increment = r.response.work_increment;

    if constexpr (with_tangent)
      relative_stress_tangent<dim>(material, r, H);

    if constexpr (rule == StressRule::conserving)
      {
        Number work_slope[n_symmetric<dim>];
        relative_work_slope<dim>(material, r, work_slope);
        internal::make_conserving<dim, with_tangent>(state,
                                                     E,
                                                     r.response.work_increment,
                                                     work_slope,
                                                     r.stress,
                                                     H);
        internal::assemble_force_stress<dim, with_tangent>(at, 0.5, r.stress, H, result);
      }
    else
      internal::assemble_force_stress<dim, with_tangent>(at, 1., r.stress, H, result);

    if constexpr (with_tangent && rule == StressRule::at_configuration)
      if (alpha != 1.)
        for (auto &a : result.tangent)
          for (auto &b : a)
            for (auto &c : b)
              for (Number &d : c)
                d *= alpha;
    return result;
  }
} // namespace kedge

#endif
