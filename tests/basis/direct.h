// Basis functions evaluated one node at a time, straight from (3.108) and its
// mean over the point's domain.
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
    const double s     = (x - lattice.origin[d]) / lattice.h[d];
    const double l     = effective_half_length(lattice, x, half_length, d) / lattice.h[d];
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
