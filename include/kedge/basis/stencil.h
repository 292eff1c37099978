#ifndef kedge_basis_stencil_h
#define kedge_basis_stencil_h

#include <kedge/grid/lattice.h>
#include <kedge/points/parameters.h>

namespace kedge
{
  /** Most nodes that a stencil has in a direction. */
  constexpr int most_stencil_nodes = 4;

  /**
   * The nodes that a material point reaches, and its basis functions there,
   * as one-dimensional factors: N_A = prod_d value[d][i_d] and dN_A/dx_e =
   * slope[e][i_e] prod_{d != e} value[d][i_d], node A = first_node + i. In
   * each direction there are two nodes; three if a GIMP domain straddles a
   * grid line, in a quadratic element, and of splines; four if a spline's domain
   * straddles the middle of a cell.
   */
  template <int dim>
  struct Stencil
  {
    unsigned int first_node; ///< number in the window of the lowest node
    unsigned int pattern;    ///< how many nodes in each direction, see stencil_width()
    double       value[dim][most_stencil_nodes];
    double       slope[dim][most_stencil_nodes]; ///< [1/m]
    int    lower_cell[dim]; ///< of the two cells at most that the domain touches, from first_node
    double lower_part[dim]; ///< of the domain's length that lies in it
  };

  /** Patterns are smaller than this number: two bits for each direction. */
  template <int dim>
  constexpr unsigned int n_stencil_patterns = 1u << (2 * dim);

  /** Nodes in direction @p d of a pattern: two, three or four. */
  constexpr int
  stencil_width(const unsigned int pattern, const int d)
  {
    return 2 + static_cast<int>((pattern >> (2 * d)) & 3u);
  }

  /** The part of a pattern that says that there are @p width nodes in direction @p d. */
  constexpr unsigned int
  pattern_part(const int width, const int d)
  {
    return static_cast<unsigned int>(width - 2) << (2 * d);
  }

  /** The pattern with as many nodes in all directions. */
  template <int dim>
  constexpr unsigned int
  uniform_pattern(const int width)
  {
    unsigned int pattern = 0;
    for (int d = 0; d < dim; ++d)
      pattern |= pattern_part(width, d);
    return pattern;
  }

  /** Nodes of a pattern. */
  template <int dim>
  constexpr int
  stencil_size(const unsigned int pattern)
  {
    int n = 1;
    for (int d = 0; d < dim; ++d)
      n *= stencil_width(pattern, d);
    return n;
  }

  /**
   * A GIMP domain that reaches past a grid line by less than this part of a
   * cell is shrunk about its centre to end at the line: it keeps nodes of
   * vanishing mass (and the noise they bring) out of the system, while the
   * basis stays a partition of unity that reproduces linear fields exactly.
   */
  constexpr double gimp_smallest_overlap = 1e-6;

  /**
   * The stencil of the original MPM: the linear functions (3.108) of the cell
   * around @p x.
   */
  template <int dim>
  Stencil<dim>
  linear_stencil(const Lattice<dim>       &lattice,
                 const LatticeWindow<dim> &window,
                 const dealii::Point<dim> &x);

  /**
   * The GIMP stencil (3.109), its central branch corrected to
   * 1 - xi^2/(2 h l_p) - l_p/(2 h), of a box-shaped domain with the given half
   * lengths about @p x. Half lengths over h/2 count as h/2, and a domain does
   * not reach past the grid's box (it shrinks about its centre).
   */
  template <int dim>
  Stencil<dim>
  gimp_stencil(const Lattice<dim>           &lattice,
               const LatticeWindow<dim>     &window,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &half_lengths);

  /**
   * The quadratic Lagrange functions of the element around @p x, whose nodes
   * are those of 2^dim cells of the lattice: with xi in [0, 1] along an edge
   *   N_0 = (1 - xi)(1 - 2 xi),  N_1 = 4 xi (1 - xi),  N_2 = xi (2 xi - 1).
   * They span the space of deal.II's FE_Q(2) on the elements.
   */
  template <int dim>
  Stencil<dim>
  quadratic_stencil(const Lattice<dim>       &lattice,
                    const LatticeWindow<dim> &window,
                    const dealii::Point<dim> &x);

  /**
   * The same of splines, whose kinks stand in the middle of the cells; their functions at the
   * node beyond grow with the cube of the overlap.
   */
  constexpr double spline_smallest_overlap = 1e-4;

  /**
   * Quadratic B-splines about the nodes, averaged over a box-shaped domain with the given half
   * lengths about @p x: the mean of N(s - i), s in cells from the origin, with
   *   N(t) = 3/4 - t^2 for |t| <= 1/2,  (3/2 - |t|)^2/2 for 1/2 <= |t| <= 3/2.
   * Half lengths and the box's sides as in gimp_stencil(). At a side of the box the function of
   * the node that is missing beyond it goes to the first two of those within, u_{-1} = 2 u_0 -
   * u_1: the basis stays a partition of unity that reproduces linear fields with their values at
   * the nodes, and on the side itself it is that of the side's own nodes.
   */
  template <int dim>
  Stencil<dim>
  spline_stencil(const Lattice<dim>           &lattice,
                 const LatticeWindow<dim>     &window,
                 const dealii::Point<dim>     &x,
                 const dealii::Tensor<1, dim> &half_lengths);

  /**
   * Sets the factors of a stencil in direction @p d to the splines at one place, not averaged.
   * Beyond the intervals between kinks that have all their nodes in the stencil, the
   * polynomials of the last one are continued.
   *
   * @param s     the place [cells from the origin]
   * @param first the stencil's lowest node in this direction
   */
  template <int dim>
  void
  set_splines_at(const Lattice<dim> &lattice,
                 const double        s,
                 const int           d,
                 const int           first,
                 Stencil<dim>       &stencil);

  /** The stencil of any kind. */
  template <int dim>
  Stencil<dim>
  make_stencil(const BasisKind               basis,
               const Lattice<dim>           &lattice,
               const LatticeWindow<dim>     &window,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &half_lengths);
} // namespace kedge

#endif
