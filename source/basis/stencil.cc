#include <kedge/basis/stencil.h>

namespace kedge
{
  namespace
  {
    /** Linear functions of the cell [line, line + 1] at coordinate @p s. */
    void
    set_two_nodes(const double s,
                  const int    line,
                  const double inverse_h,
                  double (&value)[3],
                  double (&slope)[3])
    {
      const double fraction = s - line;
      value[0]              = 1. - fraction;
      value[1]              = fraction;
      value[2]              = 0.;
      slope[0]              = -inverse_h;
      slope[1]              = inverse_h;
      slope[2]              = 0.;
    }

    /**
     * Mean of the hat functions around the grid line @p line over the
     * interval [line - left, line + right].
     */
    void
    set_three_nodes(const double left,
                    const double right,
                    const double inverse_h,
                    double (&value)[3],
                    double (&slope)[3])
    {
      const double inverse_length = 1. / (left + right);
      value[0]                    = 0.5 * left * left * inverse_length;
      value[2]                    = 0.5 * right * right * inverse_length;
      value[1]                    = 1. - value[0] - value[2];
      slope[0]                    = -left * inverse_length * inverse_h;
      slope[2]                    = right * inverse_length * inverse_h;
      slope[1]                    = -slope[0] - slope[2];
    }
  } // namespace



  template <int dim>
  Stencil<dim>
  linear_stencil(const Lattice<dim>       &lattice,
                 const LatticeWindow<dim> &window,
                 const dealii::Point<dim> &x)
  {
    Stencil<dim>            stencil;
    const LatticeIndex<dim> cell = lattice.cell_of(x);
    for (int d = 0; d < dim; ++d)
      set_two_nodes(lattice.scaled(x[d], d),
                    cell[d],
                    1. / lattice.h[d],
                    stencil.value[d],
                    stencil.slope[d]);
    stencil.pattern    = 0;
    stencil.first_node = window.node_number(cell);
    return stencil;
  }



  template <int dim>
  Stencil<dim>
  gimp_stencil(const Lattice<dim>           &lattice,
               const LatticeWindow<dim>     &window,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &half_lengths)
  {
    Stencil<dim>            stencil;
    LatticeIndex<dim>       first;
    const LatticeIndex<dim> cell = lattice.cell_of(x);
    stencil.pattern              = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double s         = lattice.scaled(x[d], d);
        const double inverse_h = 1. / lattice.h[d];
        const double half = std::min({half_lengths[d] * inverse_h, 0.5, s, lattice.n_cells[d] - s});

        // overlap with the cells below and above the one that holds the centre
        const double below = cell[d] - (s - half), above = (s + half) - (cell[d] + 1);
        const double reach = std::max(below, above);
        if (reach <= gimp_smallest_overlap)
          {
            first[d] = cell[d];
            set_two_nodes(s, cell[d], inverse_h, stencil.value[d], stencil.slope[d]);
          }
        else
          {
            const bool at_lower_line = below > above;
            const int  line          = cell[d] + (at_lower_line ? 0 : 1);
            first[d]                 = line - 1;
            stencil.pattern |= 1u << d;
            set_three_nodes(line - (s - half),
                            (s + half) - line,
                            inverse_h,
                            stencil.value[d],
                            stencil.slope[d]);
          }
      }
    stencil.first_node = window.node_number(first);
    return stencil;
  }



  template <int dim>
  Stencil<dim>
  quadratic_stencil(const Lattice<dim>       &lattice,
                    const LatticeWindow<dim> &window,
                    const dealii::Point<dim> &x)
  {
    Stencil<dim>            stencil;
    const LatticeIndex<dim> cell = lattice.cell_of(x);
    LatticeIndex<dim>       first;
    for (int d = 0; d < dim; ++d)
      {
        first[d]               = cell[d] - cell[d] % 2;
        const double xi        = 0.5 * (lattice.scaled(x[d], d) - first[d]);
        const double inverse_l = 0.5 / lattice.h[d];
        stencil.value[d][0]    = (1. - xi) * (1. - 2. * xi);
        stencil.value[d][1]    = 4. * xi * (1. - xi);
        stencil.value[d][2]    = xi * (2. * xi - 1.);
        stencil.slope[d][0]    = (4. * xi - 3.) * inverse_l;
        stencil.slope[d][1]    = (4. - 8. * xi) * inverse_l;
        stencil.slope[d][2]    = (4. * xi - 1.) * inverse_l;
      }
    stencil.pattern    = n_stencil_patterns<dim> - 1;
    stencil.first_node = window.node_number(first);
    return stencil;
  }



  template <int dim>
  Stencil<dim>
  make_stencil(const BasisKind               basis,
               const Lattice<dim>           &lattice,
               const LatticeWindow<dim>     &window,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &half_lengths)
  {
    switch (basis)
      {
        case BasisKind::linear:
          return linear_stencil(lattice, window, x);
        case BasisKind::quadratic:
          return quadratic_stencil(lattice, window, x);
        case BasisKind::gimp:
        default:
          return gimp_stencil(lattice, window, x, half_lengths);
      }
  }

#define KEDGE_INSTANTIATE(dim)                                         \
  template Stencil<dim> linear_stencil(const Lattice<dim> &,           \
                                       const LatticeWindow<dim> &,     \
                                       const dealii::Point<dim> &);    \
  template Stencil<dim> gimp_stencil(const Lattice<dim> &,             \
                                     const LatticeWindow<dim> &,       \
                                     const dealii::Point<dim> &,       \
                                     const dealii::Tensor<1, dim> &);  \
  template Stencil<dim> quadratic_stencil(const Lattice<dim> &,        \
                                          const LatticeWindow<dim> &,  \
                                          const dealii::Point<dim> &); \
  template Stencil<dim> make_stencil(const BasisKind,                  \
                                     const Lattice<dim> &,             \
                                     const LatticeWindow<dim> &,       \
                                     const dealii::Point<dim> &,       \
                                     const dealii::Tensor<1, dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
