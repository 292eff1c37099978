#ifndef kedge_porous_gradient_inverse_h
#define kedge_porous_gradient_inverse_h

#include <kedge/base/pack.h>

namespace kedge
{
  namespace internal
  {
    /** A function of one double, in each lane. */
    template <typename Function>
    inline Pack
    of_each(const Pack &x, const Function &function)
    {
      Pack result;
      for (unsigned int lane = 0; lane < pack_width; ++lane)
        result.set(lane, function(x[lane]));
      return result;
    }

    template <typename Number, typename Function>
    inline Number
    of_each(const Number &x, const Function &function)
    {
      return function(static_cast<double>(x));
    }

    /** Inverse of I + w A, and det(I + w A) - 1 without cancellation. */
    template <int dim, typename Number>
    inline Number
    invert_gradient(const Number (&A)[dim][dim], const double w, Number (&inverse)[dim][dim])
    {
      Number B[dim][dim], F[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            B[i][j] = w * A[i][j];
            F[i][j] = (i == j ? 1. : 0.) + B[i][j];
          }
      Number excess;
      if constexpr (dim == 2)
        {
          excess             = B[0][0] + B[1][1] + (B[0][0] * B[1][1] - B[0][1] * B[1][0]);
          const Number scale = 1. / (1. + excess);
          inverse[0][0]      = scale * F[1][1];
          inverse[0][1]      = -scale * F[0][1];
          inverse[1][0]      = -scale * F[1][0];
          inverse[1][1]      = scale * F[0][0];
        }
      else
        {
          const auto minor = [](const Number(&M)[dim][dim], const int i, const int j) -> Number {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            return M[a][c] * M[b][d] - M[a][d] * M[b][c];
          };
          excess = B[0][0] + B[1][1] + B[2][2] + minor(B, 0, 0) + minor(B, 1, 1) + minor(B, 2, 2);
          for (int j = 0; j < dim; ++j)
            excess += B[0][j] * minor(B, 0, j);
          const Number scale = 1. / (1. + excess);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              inverse[j][i] = scale * minor(F, i, j);
        }
      return excess;
    }
  } // namespace internal
} // namespace kedge

#endif
