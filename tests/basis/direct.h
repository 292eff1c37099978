// Basis functions evaluated one node at a time, straight from (3.108), or the quadratic B-spline,
// and its mean over the point's domain.
#ifndef kedge_tests_basis_direct_h
#define kedge_tests_basis_direct_h

#include <kedge/basis/stencil.h>

#include <cmath>

namespace kedge::test
{
  /** (3.108): the hat of a node at 0, distances in cell sizes. */
  inline double
  hat(const double xi)
  {
    return std::max(0., 1. - std::abs(xi));
  }

  /** The half length that counts: at most half a cell, and within the box. */
  template <int dim>
  double
  effective_half_length(const Lattice<dim> &lattice, const double x, const double half, const int d)
  {
    return std::min({half, 0.5 * lattice.h[d], x - lattice.origin[d], lattice.upper(d) - x});
  }

  /**
   * Mean of the hat over [xi - l, xi + l], Simpson's rule between the kinks
   * at -1, 0, 1: exact for a piecewise linear function.
   */
  inline double
  mean_of_hat(const double xi, const double l)
  {
    double cuts[] = {xi - l, -1., 0., 1., xi + l};
    for (double &cut : cuts)
      cut = std::min(std::max(cut, xi - l), xi + l);
    double integral = 0.;
    for (int i = 0; i < 4; ++i)
      {
        const double a = cuts[i], b = cuts[i + 1];
        integral += (b - a) / 6. * (hat(a) + 4. * hat(0.5 * (a + b)) + hat(b));
      }
    return integral / (2. * l);
  }

  /** The quadratic B-spline of a node at 0, distances in cell sizes. */
  inline double
  quadratic_spline(const double xi)
  {
    const double a = std::abs(xi);
    return a <= 0.5 ? 0.75 - a * a : a <= 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.;
  }

  /** Its mean over [xi - l, xi + l], Simpson's rule between its kinks: exact. */
  inline double
  mean_of_spline(const double xi, const double l)
  {
    if (l == 0.)
      return quadratic_spline(xi);
    double cuts[] = {xi - l, -1.5, -0.5, 0.5, 1.5, xi + l};
    for (double &cut : cuts)
      cut = std::min(std::max(cut, xi - l), xi + l);
    double integral = 0.;
    for (int i = 0; i < 5; ++i)
      {
        const double a = cuts[i], b = cuts[i + 1];
        integral +=
          (b - a) / 6. *
          (quadratic_spline(a) + 4. * quadratic_spline(0.5 * (a + b)) + quadratic_spline(b));
      }
    return integral / (2. * l);
  }

  /**
   * The same on a grid of @p n_cells cells: u_{-1} = 2 u_0 - u_1 gives the function of the node
   * that is missing beyond a side to the two within.
   */
  inline double
  mean_of_spline_on_grid(const double s, double l, const int node, const int n_cells)
  {
    const double middle  = std::floor(s + 0.5); // kinks stand half a cell from it
    const double overlap = std::abs(s - middle) + l - 0.5;
    if (overlap > 0. && overlap <= spline_smallest_overlap)
      l -= overlap;
    const auto weight = [&](const int missing, const int inwards) {
      return node == missing + inwards ? 2. : node == missing + 2 * inwards ? -1. : 0.;
    };
    return mean_of_spline(s - node, l) + weight(-1, 1) * mean_of_spline(s + 1, l) +
           weight(n_cells + 1, -1) * mean_of_spline(s - n_cells - 1, l);
  }

  /** The factor of direction @p d of the basis function of the node with index @p node there. */
  template <int dim>
  double
  direct_factor(const BasisKind     basis,
                const Lattice<dim> &lattice,
                const double        x,
                const double        half_length,
                const int           node,
                const int           d)
  {
    const double s = (x - lattice.origin[d]) / lattice.h[d];
    const double l = effective_half_length(lattice, x, half_length, d) / lattice.h[d];
    if (basis == BasisKind::spline)
      return mean_of_spline_on_grid(s, l, node, lattice.n_cells[d]);
    const double reach = std::max(std::floor(s) - (s - l), s + l - std::floor(s) - 1.);
    if (basis == BasisKind::linear || reach <= gimp_smallest_overlap)
      return hat(s - node);
    return mean_of_hat(s - node, l);
  }

  /** N of any node at a point, by the product of its factors. */
  template <int dim>
  double
  direct_value(const BasisKind               basis,
               const Lattice<dim>           &lattice,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &half_lengths,
               const LatticeIndex<dim>      &node)
  {
    double product = 1.;
    for (int d = 0; d < dim; ++d)
      product *= direct_factor(basis, lattice, x[d], half_lengths[d], node[d], d);
    return product;
  }
} // namespace kedge::test

#endif
