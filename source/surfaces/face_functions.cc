#include <kedge/surfaces/face_functions.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** The linear functions of two cells at @p t, in cells from the first of their nodes. */
    void
    hat_functions(const double t, double (&value)[most_stencil_nodes])
    {
      const bool   upper = t > 1.;
      const double xi    = upper ? t - 1. : t; // beyond the nodes they are continued
      value[0]           = upper ? 0. : 1. - xi;
      value[1]           = upper ? 1. - xi : xi;
      value[2]           = upper ? xi : 0.;
    }

    /** Those of the quadratic element, see quadratic_stencil(). */
    void
    quadratic_functions(const double xi, double (&value)[most_stencil_nodes])
    {
      value[0] = (1. - xi) * (1. - 2. * xi);
      value[1] = 4. * xi * (1. - xi);
      value[2] = xi * (2. * xi - 1.);
    }

    /** Whether all nodes of a stencil are in use. */
    template <int dim>
    bool
    has_nodes(const Patch<dim> &patch, const LevelNode<dim> &lowest, const unsigned int pattern)
    {
      const auto             &window = patch.grid().levels().numbering(lowest.level);
      const LatticeIndex<dim> first  = lowest.index;
      LatticeIndex<dim>       node   = first;
      int                     n      = 1;
      for (int d = 0; d < dim; ++d)
        {
          const int width = stencil_width(pattern, d);
          if (first[d] < window.low[d] || first[d] + width > window.low[d] + window.n_cells[d] + 1)
            return false;
          n *= width;
        }
      for (int A = 0; A < n; ++A)
        {
          for (int d = 0, a = A; d < dim; a /= stencil_width(pattern, d), ++d)
            node[d] = first[d] + a % stencil_width(pattern, d);
          if (patch.nodes.local(window.node_number(node)) < 0)
            return false;
        }
      return true;
    }

    /**
     * The splines of one of the halves of a cell, per direction: on the side of @p x if their nodes
     * are in use, else of the half that is next. Beyond the cell they go on straight: their
     * parabolas would give nodes on the other side weights far above 1.
     *
     * @return false if no half has all its nodes
     */
    template <int dim>
    bool
    splines_of_cell(const Patch<dim>         &patch,
                    const LevelNode<dim>     &here,
                    const dealii::Point<dim> &x,
                    Stencil<dim>             &result)
    {
      const Lattice<dim>      &lattice = patch.grid().levels().lattice(here.level);
      const LatticeIndex<dim> &cell    = here.index;
      for (unsigned int flips = 0; flips < (1u << dim); ++flips)
        {
          LatticeIndex<dim> first;
          result.pattern = 0;
          for (int d = 0; d < dim; ++d)
            {
              const bool is_flipped = ((flips >> d) & 1u) != 0;
              const bool is_upper   = lattice.scaled(x[d], d) - cell[d] >= 0.5;
              const int  line       = cell[d] + (is_upper != is_flipped ? 1 : 0);
              const int  last       = std::min(line + 1, lattice.n_cells[d]);
              first[d]              = std::max(line - 1, 0);
              result.pattern |= pattern_part(last - first[d] + 1, d);
            }
          if (!has_nodes<dim>(patch, {here.level, first}, result.pattern))
            continue;
          result.first_node = patch.grid().levels().numbering(here.level).node_number(first);
          for (int d = 0; d < dim; ++d)
            {
              const double s      = lattice.scaled(x[d], d);
              const double inside = std::clamp(s, double(cell[d]), cell[d] + 1.);
              set_splines_at(lattice, inside, d, first[d], result);
              for (int i = 0; i < most_stencil_nodes; ++i)
                result.value[d][i] += (s - inside) * lattice.h[d] * result.slope[d][i];
            }
          return true;
        }
      return false;
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
    Stencil<dim> result     = patch.points.stencil[slot];
    const auto  &levels     = patch.grid().levels();
    const auto   node       = levels.node(result.first_node);
    const auto  &first_node = node.index;
    const auto  &lattice    = levels.lattice(node.level);
    const auto   first      = lattice.node_position(first_node);
    const int    normal     = static_cast<int>(std::max_element(area,
                                                         area + dim,
                                                         [](const double a, const double b) {
                                                           return std::abs(a) < std::abs(b);
                                                         }) -
                                        area);
    for (int d = 0; d < dim; ++d)
      {
        const double x = patch.points.location[slot][d] + offset[d] - first[d];
        const double t = x / lattice.h[d];
        if (stencil_width(result.pattern, d) == 3 && basis == BasisKind::quadratic)
          quadratic_functions(0.5 * t, result.value[d]);
        else if (basis == BasisKind::spline && d == normal)
          {
            Stencil<dim> at_face = result;
            set_splines_at(lattice, t + first_node[d], d, first_node[d], at_face);
            std::copy_n(at_face.value[d], most_stencil_nodes, result.value[d]);
          }
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
    const LevelNode<dim> here    = patch.grid().levels().on_level(cell);
    const auto          &lattice = patch.grid().levels().lattice(here.level);
    LatticeIndex<dim>    first   = here.index;
    Stencil<dim>         result{};
    result.pattern = basis == BasisKind::quadratic ? uniform_pattern<dim>(3) : 0;
    if (basis == BasisKind::spline)
      {
        if (splines_of_cell<dim>(patch, here, x, result))
          return result;
        result = {}; // the linear functions
      }
    else if (basis == BasisKind::quadratic)
      for (int d = 0; d < dim; ++d)
        first[d] -= first[d] % 2;
    if (!has_nodes<dim>(patch, {here.level, first}, result.pattern))
      return std::nullopt;
    result.first_node = patch.grid().levels().numbering(here.level).node_number(first);
    for (int d = 0; d < dim; ++d)
      {
        const double s = lattice.scaled(x[d], d), t = s - first[d], h = lattice.h[d];
        const double xi = 0.5 * t; // of the quadratic element, of length 2 h
        if (basis == BasisKind::quadratic)
          {
            quadratic_functions(xi, result.value[d]);
            const double slope[3] = {4. * xi - 3., 4. - 8. * xi, 4. * xi - 1.}; // by xi
            for (int i = 0; i < 3; ++i)
              result.slope[d][i] = slope[i] / (2. * h);
          }
        else
          {
            const double value[2] = {1. - t, t}, slope[2] = {-1. / h, 1. / h};
            std::copy_n(value, 2, result.value[d]);
            std::copy_n(slope, 2, result.slope[d]);
          }
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
