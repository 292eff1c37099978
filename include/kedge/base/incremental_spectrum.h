#ifndef kedge_base_incremental_spectrum_h
#define kedge_base_incremental_spectrum_h

#include <kedge/base/pack.h>

namespace kedge
{
  /**
   * Eigenvalues and eigenvectors of diag(base) + P for a symmetric P, by
   * Jacobi rotations that never add P to the base: what is returned are the
   * eigenvalue *increments*, with errors relative to |P| and not to the base,
   * however small P is.
   *
   * @param base      the dim values on the diagonal of the unperturbed matrix
   * @param P         the symmetric perturbation, P[i][j]; destroyed
   * @param increment eigenvalue minus base, increment[i] belongs to column i
   * @param W         rotation whose column i is the eigenvector of
   *                  base[i] + increment[i]; W[row][column]
   */
  template <int dim, typename Number>
  inline void
  incremental_spectrum(const Number (&base)[dim],
                       Number (&P)[dim][dim],
                       Number (&increment)[dim],
                       Number (&W)[dim][dim])
  {
    using std::sqrt, std::abs;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        W[i][j] = (i == j) ? 1. : 0.;

    constexpr int max_sweeps = (dim == 2) ? 1 : 12;
    for (int sweep = 0; sweep < max_sweeps; ++sweep)
      {
        bool rotated = false;
        for (int p = 0; p < dim - 1; ++p)
          for (int q = p + 1; q < dim; ++q)
            {
              // a rotation by less than the round-off of both diagonals does nothing
              const Number app = base[p] + P[p][p], aqq = base[q] + P[q][q];
              const Number off = P[p][q], small = 1e34 * off * off;
              const auto   rotates =
                small > abs(app * aqq) || small > P[p][p] * P[p][p] + P[q][q] * P[q][q];
              if (!any(rotates))
                continue;
              rotated = true;

              // tangent of the angle: t^2 + t (a_qq - a_pp)/off - 1 = 0, the smaller root
              const Number difference = (base[q] - base[p]) + (P[q][q] - P[p][p]);
              const Number root       = sqrt(difference * difference + 4. * off * off);
              const Number sum        = difference + select(difference >= 0., root, -root);
              const Number t          = select(rotates, 2. * off, 0.) / select(rotates, sum, 1.);
              const Number c          = 1. / sqrt(t * t + 1.);
              const Number s          = t * c;
              P[p][p] -= t * off;
              P[q][q] += t * off;
              P[p][q] = P[q][p] = select(rotates, 0., off);
              for (int k = 0; k < dim; ++k)
                {
                  if (k != p && k != q)
                    {
                      const Number kp = P[k][p], kq = P[k][q];
                      P[k][p] = P[p][k] = c * kp - s * kq;
                      P[k][q] = P[q][k] = s * kp + c * kq;
                    }
                  const Number wp = W[k][p], wq = W[k][q];
                  W[k][p] = c * wp - s * wq;
                  W[k][q] = s * wp + c * wq;
                }
            }
        if (!rotated)
          break;
      }
    for (int i = 0; i < dim; ++i)
      increment[i] = P[i][i];
  }
} // namespace kedge

#endif
