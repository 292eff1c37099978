#include <kedge/surfaces/face_functions.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** The linear functions of two cells at @p t, in cells from the first of their nodes. */
    void
    hat_functions(const double t, double (&value)[3])
    {
      const bool   upper = t > 1.;
      const double xi    = upper ? t - 1. : t; // beyond the nodes they are continued
      value[0]           = upper ? 0. : 1. - xi;
      value[1]           = upper ? 1. - xi : xi;
      value[2]           = upper ? xi : 0.;
    }

    /** Those of the quadratic element, see quadratic_stencil(). */
    void
    quadratic_functions(const double xi, double (&value)[3])
    {
      value[0] = (1. - xi) * (1. - 2. * xi);
      value[1] = 4. * xi * (1. - xi);
      value[2] = xi * (2. * xi - 1.);
    }
  } // namespace



  template <int dim>
  Stencil<dim>
  functions_at_face(const Patch<dim>  &patch,
                    const unsigned int slot,
                    const BasisKind    basis,
                    const double (&offset)[dim],
                    const double (&area)[dim])
  {
    Stencil<dim> result = patch.points.stencil[slot];
    const auto   first =
      patch.grid().lattice().node_position(patch.window().node_index(result.first_node));
    const int normal = static_cast<int>(std::max_element(area,
                                                         area + dim,
                                                         [](const double a, const double b) {
                                                           return std::abs(a) < std::abs(b);
                                                         }) -
                                        area);
    for (int d = 0; d < dim; ++d)
      {
        const double x = patch.points.location[slot][d] + offset[d] - first[d];
        const double t = x / patch.grid().lattice().h[d];
        if (stencil_width(result.pattern, d) == 3 && basis == BasisKind::quadratic)
          quadratic_functions(0.5 * t, result.value[d]);
        else if (stencil_width(result.pattern, d) == 3 && d == normal)
          hat_functions(t, result.value[d]);
        else
          for (int i = 0; i < stencil_width(result.pattern, d); ++i)
            result.value[d][i] += result.slope[d][i] * offset[d];
      }
    return result;
  }

#define KEDGE_INSTANTIATE(dim)                                        \
  template Stencil<dim> functions_at_face(const Patch<dim>  &patch,   \
                                          const unsigned int slot,    \
                                          const BasisKind    basis,   \
                                          const double(&offset)[dim], \
                                          const double(&area)[dim]);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
