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
                  double (&value)[most_stencil_nodes],
                  double (&slope)[most_stencil_nodes])
    {
      const double fraction = s - line;
      value[0]              = 1. - fraction;
      value[1]              = fraction;
      slope[0]              = -inverse_h;
      slope[1]              = inverse_h;
    }

    /**
     * Mean of the hat functions around the grid line @p line over the
     * interval [line - left, line + right].
     */
    void
    set_three_nodes(const double left,
                    const double right,
                    const double inverse_h,
                    double (&value)[most_stencil_nodes],
                    double (&slope)[most_stencil_nodes])
    {
      const double inverse_length = 1. / (left + right);
      value[0]                    = 0.5 * left * left * inverse_length;
      value[2]                    = 0.5 * right * right * inverse_length;
      value[1]                    = 1. - value[0] - value[2];
      slope[0]                    = -left * inverse_length * inverse_h;
      slope[2]                    = right * inverse_length * inverse_h;
      slope[1]                    = -slope[0] - slope[2];
    }

    /** Functions of the nodes first, first + 1 .. of one direction. */
    struct Functions
    {
      int    first, width;
      double value[most_stencil_nodes + 1] = {}, slope[most_stencil_nodes + 1] = {};
      int    lower_cell = 0; ///< see Stencil; here from the grid's first
      double lower_part = 1.;
    };

    /**
     * Adds @p weight times the mean of the quadratic B-splines over [low, high], a part of the
     * interval [line - 1/2, line + 1/2], where they are polynomials: the mean of a quadratic
     * function over a length l is its value in the middle and l^2/24 of its second derivative.
     */
    void
    add_mean_splines(const double weight,
                     const double low,
                     const double high,
                     const int    line,
                     const double inverse_h,
                     Functions   &functions)
    {
      const double t = 0.5 * (low + high) - line, bend = (high - low) * (high - low) / 24.;
      double      *value = functions.value + (line - 1 - functions.first);
      double      *slope = functions.slope + (line - 1 - functions.first);
      value[0] += weight * (0.5 * (0.5 - t) * (0.5 - t) + bend);
      value[1] += weight * (0.75 - t * t - 2. * bend);
      value[2] += weight * (0.5 * (0.5 + t) * (0.5 + t) + bend);
      slope[0] += weight * (t - 0.5) * inverse_h;
      slope[1] -= weight * 2. * t * inverse_h;
      slope[2] += weight * (t + 0.5) * inverse_h;
    }

    /** Gives the functions of nodes beyond the box to the two next to them: u_-1 = 2 u_0 - u_1. */
    void
    fold_at_sides(const int last_node, Functions &functions)
    {
      const auto fold = [](double *values, const int from, const int step) {
        values[from + step] += 2. * values[from];
        values[from + 2 * step] -= values[from];
        values[from] = 0.;
      };
      if (functions.first + functions.width - 1 > last_node)
        {
          --functions.width;
          fold(functions.value, functions.width, -1);
          fold(functions.slope, functions.width, -1);
        }
      if (functions.first < 0)
        {
          for (double *values : {functions.value, functions.slope})
            {
              fold(values, 0, 1);
              std::copy(values + 1, values + most_stencil_nodes + 1, values);
            }
          ++functions.first;
          --functions.width;
        }
    }

    /** Says how a domain [low, high] lies in its cells. */
    void
    share_out(const double low, const double high, const int n_cells, Functions &functions)
    {
      const int cell       = std::clamp(static_cast<int>(std::floor(low)), 0, n_cells - 1);
      functions.lower_cell = cell;
      if (high > cell + 1 && cell + 1 < n_cells)
        functions.lower_part = (cell + 1 - low) / (high - low);
    }

    /** The averaged splines over [s - half, s + half], in cells from the origin. */
    Functions
    mean_splines(const double s, double half, const int n_cells, const double inverse_h)
    {
      const int    line  = static_cast<int>(std::floor(s + 0.5)); // its interval holds the centre
      const double below = (line - 0.5) - (s - half), above = (s + half) - (line + 0.5);
      Functions    result{line - 1, 3};
      if (std::max(below, above) <= spline_smallest_overlap)
        {
          half = std::max(0., std::min({half, s - (line - 0.5), (line + 0.5) - s}));
          add_mean_splines(1., s - half, s + half, line, inverse_h, result);
        }
      else
        {
          const bool   at_lower = below > above;
          const double kink     = at_lower ? line - 0.5 : line + 0.5;
          const double share    = (kink - (s - half)) / (2. * half);
          const int    lower    = at_lower ? line - 1 : line;
          result                = {lower - 1, 4};
          add_mean_splines(share, s - half, kink, lower, inverse_h, result);
          add_mean_splines(1. - share, kink, s + half, lower + 1, inverse_h, result);
        }
      fold_at_sides(n_cells, result);
      share_out(s - half, s + half, n_cells, result);
      return result;
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
      {
        stencil.lower_cell[d] = 0;
        stencil.lower_part[d] = 1.;
        set_two_nodes(lattice.scaled(x[d], d),
                      cell[d],
                      1. / lattice.h[d],
                      stencil.value[d],
                      stencil.slope[d]);
      }
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
        const double reach    = std::max(below, above);
        stencil.lower_cell[d] = 0;
        if (reach <= gimp_smallest_overlap)
          {
            first[d]              = cell[d];
            stencil.lower_part[d] = 1.;
            set_two_nodes(s, cell[d], inverse_h, stencil.value[d], stencil.slope[d]);
          }
        else
          {
            const bool at_lower_line = below > above;
            const int  line          = cell[d] + (at_lower_line ? 0 : 1);
            first[d]                 = line - 1;
            stencil.pattern |= pattern_part(3, d);
            stencil.lower_part[d] = (line - (s - half)) / (2. * half);
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
        stencil.lower_cell[d]  = cell[d] % 2;
        stencil.lower_part[d]  = 1.;
      }
    stencil.pattern    = uniform_pattern<dim>(3);
    stencil.first_node = window.node_number(first);
    return stencil;
  }



  template <int dim>
  Stencil<dim>
  spline_stencil(const Lattice<dim>           &lattice,
                 const LatticeWindow<dim>     &window,
                 const dealii::Point<dim>     &x,
                 const dealii::Tensor<1, dim> &half_lengths)
  {
    Stencil<dim>      stencil;
    LatticeIndex<dim> first;
    stencil.pattern = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double s         = lattice.scaled(x[d], d);
        const double inverse_h = 1. / lattice.h[d];
        const double half = std::min({half_lengths[d] * inverse_h, 0.5, s, lattice.n_cells[d] - s});
        const Functions functions = mean_splines(s, half, lattice.n_cells[d], inverse_h);
        first[d]                  = functions.first;
        stencil.pattern |= pattern_part(functions.width, d);
        std::copy_n(functions.value, most_stencil_nodes, stencil.value[d]);
        std::copy_n(functions.slope, most_stencil_nodes, stencil.slope[d]);
        stencil.lower_cell[d] = functions.lower_cell - functions.first;
        stencil.lower_part[d] = functions.lower_part;
      }
    stencil.first_node = window.node_number(first);
    return stencil;
  }



  template <int dim>
  void
  set_splines_at(const Lattice<dim> &lattice,
                 const double        s,
                 const int           d,
                 const int           first,
                 Stencil<dim>       &stencil)
  {
    const int last    = first + stencil_width(stencil.pattern, d) - 1;
    const int lowest  = first == 0 ? 0 : first + 1; // of the intervals that have all their nodes
    const int highest = last == lattice.n_cells[d] ? last : last - 1;
    const int line    = std::clamp(static_cast<int>(std::floor(s + 0.5)), lowest, highest);
    Functions at_place{line - 1, 3};
    add_mean_splines(1., s, s, line, 1. / lattice.h[d], at_place);
    fold_at_sides(lattice.n_cells[d], at_place);
    std::fill_n(stencil.value[d], most_stencil_nodes, 0.);
    std::fill_n(stencil.slope[d], most_stencil_nodes, 0.);
    std::copy_n(at_place.value, at_place.width, stencil.value[d] + (at_place.first - first));
    std::copy_n(at_place.slope, at_place.width, stencil.slope[d] + (at_place.first - first));
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
        case BasisKind::spline:
          return spline_stencil(lattice, window, x, half_lengths);
        case BasisKind::gimp:
        default:
          return gimp_stencil(lattice, window, x, half_lengths);
      }
  }

#define KEDGE_INSTANTIATE(dim)                                          \
  template Stencil<dim> linear_stencil(const Lattice<dim> &,            \
                                       const LatticeWindow<dim> &,      \
                                       const dealii::Point<dim> &);     \
  template Stencil<dim> gimp_stencil(const Lattice<dim> &,              \
                                     const LatticeWindow<dim> &,        \
                                     const dealii::Point<dim> &,        \
                                     const dealii::Tensor<1, dim> &);   \
  template Stencil<dim> spline_stencil(const Lattice<dim> &,            \
                                       const LatticeWindow<dim> &,      \
                                       const dealii::Point<dim> &,      \
                                       const dealii::Tensor<1, dim> &); \
  template void         set_splines_at(const Lattice<dim> &,            \
                                       const double,                    \
                                       const int,                       \
                                       const int,                       \
                                       Stencil<dim> &);                 \
  template Stencil<dim> quadratic_stencil(const Lattice<dim> &,         \
                                          const LatticeWindow<dim> &,   \
                                          const dealii::Point<dim> &);  \
  template Stencil<dim> make_stencil(const BasisKind,                   \
                                     const Lattice<dim> &,              \
                                     const LatticeWindow<dim> &,        \
                                     const dealii::Point<dim> &,        \
                                     const dealii::Tensor<1, dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
