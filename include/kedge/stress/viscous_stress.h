#ifndef kedge_stress_viscous_stress_h
#define kedge_stress_viscous_stress_h

#include <kedge/stress/force_stress.h>

namespace kedge
{
  namespace internal
  {
    /** E = (A + A^T + A^T A)/2, the strain of a step relative to the configuration n. */
    template <int dim, typename Number>
    inline void
    strain_of_step(const Number (&A)[dim][dim], Number (&E)[dim][dim])
    {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            E[i][j] = A[i][j] + A[j][i];
            for (int k = 0; k < dim; ++k)
              E[i][j] += A[k][i] * A[k][j];
            E[i][j] = 0.5 * E[i][j];
          }
    }
  } // namespace internal

  /**
   * Adds the stress of a dashpot beside the material (Kelvin and Voigt), which resists the
   * rate of strain with 2 eta d:
   *   P = (I + A/2) S,  S = c E,  c = 2 eta J_n/dt,
   * per V0, with E the strain of the step relative to the configuration n, whose work
   * over the step is P : A = S : E = c E : E: never negative, however large the step. S is
   * symmetric and E does not feel rotations: angular momentum is kept.
   *
   * @param A displacement gradient of the whole step by x_n [-]
   * @param c [Pa]
   */
  template <int dim, typename Number>
  inline void
  add_viscous_stress(const Number (&A)[dim][dim],
                     const Number             &c,
                     const bool                with_tangent,
                     ForceStress<dim, Number> &result)
  {
    Number E[dim][dim], middle[dim][dim], end[dim][dim];
    internal::strain_of_step<dim>(A, E);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          middle[i][j] = 0.5 * A[i][j];
          end[i][j]    = A[i][j];
          if (i == j)
            {
              middle[i][j] += 1.;
              end[i][j] += 1.;
            }
        }
    for (int p = 0; p < dim; ++p)
      for (int R = 0; R < dim; ++R)
        for (int Q = 0; Q < dim; ++Q)
          result.stress[p][R] += c * middle[p][Q] * E[Q][R];
    if (!with_tangent)
      return;
    // dE_QR/dA_mS = (delta_QS end_mR + end_mQ delta_RS)/2
    for (int p = 0; p < dim; ++p)
      for (int m = 0; m < dim; ++m)
        {
          Number both = 0.; // (middle end^T)_pm
          for (int Q = 0; Q < dim; ++Q)
            both += middle[p][Q] * end[m][Q];
          for (int R = 0; R < dim; ++R)
            for (int S = 0; S < dim; ++S)
              {
                Number slope = middle[p][S] * end[m][R];
                if (p == m)
                  slope += E[S][R];
                if (R == S)
                  slope += both;
                result.tangent[p][R][m][S] += 0.5 * c * slope;
              }
        }
  }
} // namespace kedge

#endif
