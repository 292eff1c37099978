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

    /** Whether all nodes of a stencil are in use. */
    template <int dim>
    bool
    has_nodes(const Patch<dim> &patch, const LatticeIndex<dim> &first, const int width)
    {
      const auto       &window = patch.window();
      LatticeIndex<dim> node   = first;
      int               n      = 1;
      for (int d = 0; d < dim; ++d)
        if (first[d] < window.low[d] || first[d] + width > window.low[d] + window.n_cells[d] + 1)
          return false;
        else
          n *= width;
      for (int A = 0; A < n; ++A)
        {
          for (int d = 0, a = A; d < dim; ++d, a /= width)
            node[d] = first[d] + a % width;
          if (patch.nodes.local(window.node_number(node)) < 0)
            return false;
        }
      return true;
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



  template <int dim>
  std::optional<Stencil<dim>>
  functions_of_cell(const Patch<dim>         &patch,
                    const BasisKind           basis,
                    const LatticeIndex<dim>  &cell,
                    const dealii::Point<dim> &x)
  {
    const auto       &lattice = patch.grid().lattice();
    const bool        linear  = basis != BasisKind::quadratic;
    LatticeIndex<dim> first   = cell;
    for (int d = 0; d < dim && !linear; ++d)
      first[d] -= cell[d] % 2;
    if (!has_nodes<dim>(patch, first, linear ? 2 : 3))
      return std::nullopt;
    Stencil<dim> result;
    result.first_node = patch.window().node_number(first);
    result.pattern    = linear ? 0 : n_stencil_patterns<dim> - 1;
    for (int d = 0; d < dim; ++d)
      {
        const double t = lattice.scaled(x[d], d) - first[d], xi = 0.5 * t, h = lattice.h[d];
        if (linear)
          {
            const double value[3] = {1. - t, t, 0.}, slope[3] = {-1. / h, 1. / h, 0.};
            std::copy_n(value, 3, result.value[d]);
            std::copy_n(slope, 3, result.slope[d]);
            continue;
          }
        quadratic_functions(xi, result.value[d]);
        const double slope[3] = {4. * xi - 3., 4. - 8. * xi, 4. * xi - 1.}; // by xi, of length 2 h
        for (int i = 0; i < 3; ++i)
          result.slope[d][i] = slope[i] / (2. * h);
      }
    return result;
  }

#define KEDGE_INSTANTIATE(dim)                                                           \
  template Stencil<dim>                functions_at_face(const Patch<dim>  &patch,       \
                                                         const unsigned int slot,        \
                                                         const BasisKind    basis,       \
                                                         const double(&offset)[dim],     \
                                                         const double(&area)[dim]);      \
  template std::optional<Stencil<dim>> functions_of_cell<dim>(const Patch<dim> &,        \
                                                              const BasisKind,           \
                                                              const LatticeIndex<dim> &, \
                                                              const dealii::Point<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
