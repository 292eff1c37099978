#ifndef kedge_base_incremental_spectrum_h
#define kedge_base_incremental_spectrum_h

#include <cmath>

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
  template <int dim>
  inline void
  incremental_spectrum(const double (&base)[dim],
                       double (&P)[dim][dim],
                       double (&increment)[dim],
                       double (&W)[dim][dim])
  {
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
              const double off = P[p][q];
              // a rotation by less than the round-off of both diagonals does nothing
              const double app = base[p] + P[p][p], aqq = base[q] + P[q][q];
              if (off * off <= 1e-34 * std::abs(app * aqq) &&
                  off * off <= 1e-34 * (P[p][p] * P[p][p] + P[q][q] * P[q][q]))
                continue;
              rotated = true;

              const double difference = (base[q] - base[p]) + (P[q][q] - P[p][p]);
              const double theta      = difference / (2. * off);
              const double t =
                (theta >= 0. ? 1. : -1.) / (std::abs(theta) + std::sqrt(theta * theta + 1.));
              const double c = 1. / std::sqrt(t * t + 1.);
              const double s = t * c;
              P[p][p] -= t * off;
              P[q][q] += t * off;
              P[p][q] = P[q][p] = 0.;
              for (int k = 0; k < dim; ++k)
                {
                  if (k != p && k != q)
                    {
                      const double kp = P[k][p], kq = P[k][q];
                      P[k][p] = P[p][k] = c * kp - s * kq;
                      P[k][q] = P[q][k] = s * kp + c * kq;
                    }
                  const double wp = W[k][p], wq = W[k][q];
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
