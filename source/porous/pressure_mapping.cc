#include <kedge/porous/pressure_mapping.h>

namespace kedge
{
  namespace
  {
    constexpr double       relative_tolerance = 1e-12; ///< of the scaled residual
    constexpr unsigned int most_iterations    = 200;
  } // namespace



  template <int dim>
  void
  PressureMapping<dim>::map(const StepPoints<dim>     &points,
                            const LatticeWindow<dim>  &window,
                            const ActiveNodes<dim>    &nodes,
                            const NodeTies<dim>       &ties,
                            const std::vector<double> &pressure,
                            const int                  radius,
                            std::vector<double>       &unknowns)
  {
    std::vector<double> volume(points.size()), at_points(2 * std::size_t(points.size()));
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        volume[slot]                         = points.volume[slot] * points.determinant[slot];
        at_points[2 * std::size_t(slot)]     = volume[slot];
        at_points[2 * std::size_t(slot) + 1] = volume[slot] * pressure[slot];
      }
    std::vector<double> sums(2 * std::size_t(nodes.n_local()), 0.);
    add_scalars_to_nodes(points, window, nodes, at_points, 2, sums);
    nodal.assign(unknowns.size(), 0.);
    right_side.assign(unknowns.size(), 0.);
    weights.assign(unknowns.size(), 0.);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        weights[std::size_t(i) * (dim + 1) + dim]    = sums[2 * std::size_t(i)];
        right_side[std::size_t(i) * (dim + 1) + dim] = sums[2 * std::size_t(i) + 1];
      }
    map_lumped(nodes, ties, sums);
    if (kind == PressureMap::consistent)
      {
        volumes.reinit(nodes.n_local(), 1, radius);
        assemble_mass(points, window, nodes, volume, volumes);
        improve(window, nodes, ties);
      }
    for (std::size_t k = dim; k < unknowns.size(); k += dim + 1)
      unknowns[k] = nodal[k];
  }



  /** @param sums volume and volume times pressure of each node */
  template <int dim>
  void
  PressureMapping<dim>::map_lumped(const ActiveNodes<dim> &nodes,
                                   const NodeTies<dim>    &ties,
                                   std::vector<double>    &sums)
  {
    for (const auto &tie : ties.ties())
      if (tie.interpolates)
        for (unsigned int k = 0; k < tie.roots.size(); ++k)
          for (unsigned int c = 0; c < 2; ++c)
            sums[2 * std::size_t(tie.roots[k]) + c] +=
              tie.weights[k] * sums[2 * std::size_t(tie.node) + c];
    nodes.add_to_owners(sums, 2);
    nodes.update_ghosts(sums, 2);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      nodal[std::size_t(i) * (dim + 1) + dim] =
        sums[2 * i] > 0. ? sums[2 * i + 1] / sums[2 * i] : 0.;
    ties.prolong(nodal, dim + 1);
  }



  /** y = C^T Omega C x at the owned nodes; ghosts and tied nodes of @p x are set. */
  template <int dim>
  void
  PressureMapping<dim>::multiply_volumes(const LatticeWindow<dim> &window,
                                         const ActiveNodes<dim>   &nodes,
                                         const NodeTies<dim>      &ties,
                                         std::vector<double>      &x,
                                         std::vector<double>      &y) const
  {
    nodes.update_ghosts(x, dim + 1);
    ties.prolong(x, dim + 1);
    multiply(volumes, window, nodes, dim + 1, x, y);
    ties.restrict_sums(y, dim + 1);
    nodes.add_to_owners(y, dim + 1);
  }



  /** Conjugate gradients from the lumped solution, scaled by the lumped Omega. */
  template <int dim>
  void
  PressureMapping<dim>::improve(const LatticeWindow<dim> &window,
                                const ActiveNodes<dim>   &nodes,
                                const NodeTies<dim>      &ties)
  {
    const std::size_t   n_owned = std::size_t(nodes.n_owned()) * (dim + 1);
    std::vector<double> residual(nodal.size(), 0.), direction(nodal.size(), 0.),
      product(nodal.size(), 0.);
    // the lumped volumes of roots, with what is tied to them
    for (const auto &tie : ties.ties())
      if (ties.is_tied(tie.node, dim))
        for (unsigned int k = 0; k < tie.roots.size(); ++k)
          weights[std::size_t(tie.roots[k]) * (dim + 1) + dim] +=
            std::abs(tie.weights[k]) * weights[std::size_t(tie.node) * (dim + 1) + dim];
    nodes.add_to_owners(weights, dim + 1);
    ties.restrict_sums(right_side, dim + 1);
    nodes.add_to_owners(right_side, dim + 1);
    const auto is_free = [&](const std::size_t k) {
      return weights[k] > 0. && !ties.is_tied(k / (dim + 1), dim);
    };
    const auto square = [&](const std::vector<double> &r) {
      double sum = 0.;
      for (std::size_t k = dim; k < n_owned; k += dim + 1)
        if (is_free(k))
          sum += r[k] * r[k] / weights[k];
      return dealii::Utilities::MPI::sum(sum, nodes.communicator());
    };

    multiply_volumes(window, nodes, ties, nodal, product);
    for (std::size_t k = dim; k < n_owned; k += dim + 1)
      residual[k] = right_side[k] - product[k];
    const double limit = relative_tolerance * relative_tolerance * square(right_side);
    double       norm = square(residual), before = 1.;
    for (unsigned int n = 0; n < most_iterations && norm > limit; ++n)
      {
        for (std::size_t k = dim; k < n_owned; k += dim + 1)
          direction[k] = is_free(k)
                           ? residual[k] / weights[k] + (n == 0 ? 0. : norm / before) * direction[k]
                           : 0.;
        multiply_volumes(window, nodes, ties, direction, product);
        double curvature = 0.;
        for (std::size_t k = dim; k < n_owned; k += dim + 1)
          if (is_free(k))
            curvature += direction[k] * product[k];
        curvature = dealii::Utilities::MPI::sum(curvature, nodes.communicator());
        if (!(curvature > 0.))
          break;
        const double alpha = norm / curvature;
        for (std::size_t k = dim; k < n_owned; k += dim + 1)
          if (is_free(k))
            {
              nodal[k] += alpha * direction[k];
              residual[k] -= alpha * product[k];
            }
        before = norm;
        norm   = square(residual);
      }
    nodes.update_ghosts(nodal, dim + 1);
    ties.prolong(nodal, dim + 1);
  }

  template class PressureMapping<2>;
  template class PressureMapping<3>;
} // namespace kedge
