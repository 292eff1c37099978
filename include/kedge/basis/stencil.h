#ifndef kedge_basis_stencil_h
#define kedge_basis_stencil_h

#include <kedge/grid/lattice.h>
#include <kedge/points/parameters.h>

namespace kedge
{
  /**
   * The nodes that a material point reaches, and its basis functions there,
   * as one-dimensional factors: N_A = prod_d value[d][i_d] and dN_A/dx_e =
   * slope[e][i_e] prod_{d != e} value[d][i_d], node A = first_node + i. In
   * each direction there are two nodes, or three if a GIMP domain straddles a
   * grid line and in a quadratic element.
   */
  template <int dim>
  struct Stencil
  {
    unsigned int first_node; ///< number in the window of the lowest node
    unsigned int pattern;    ///< bit d is set if direction d has three nodes
    double       value[dim][3];
    double       slope[dim][3]; ///< [1/m]
  };

  /** Number of patterns: two or three nodes in each direction. */
  template <int dim>
  constexpr unsigned int n_stencil_patterns = 1u << dim;

  /** Nodes in direction @p d of a pattern. */
  constexpr int
  stencil_width(const unsigned int pattern, const int d)
  {
    return (pattern >> d) & 1u ? 3 : 2;
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
