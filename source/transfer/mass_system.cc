#include <kedge/transfer/mass_system.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  void
  MassSystem<dim>::reinit(const Patch<dim>               &patch,
                          const NodeMatrix<dim>          &matrix,
                          const std::vector<NodalStatus> &status,
                          const bool                      new_pattern)
  {
    this->patch  = &patch;
    this->matrix = &matrix;
    if (new_pattern)
      neighbours = node_neighbours(matrix, patch);

    const ActiveNodes<dim> &nodes = patch.nodes;
    std::vector<double>     lumped(nodes.n_local(), 0.);
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      for (unsigned int s = 0; s < matrix.n_slots(); ++s)
        lumped[i] += std::abs(matrix.row(i, 0)[s]);
    const auto &ties = patch.ties.ties();
    for (unsigned int t = 0; t < ties.size(); ++t)
      if (patch.ties.tie_of(ties[t].node, static_cast<int>(first_value())) == static_cast<int>(t))
        for (unsigned int k = 0; k < ties[t].roots.size(); ++k)
          lumped[ties[t].roots[k]] += std::abs(ties[t].weights[k]) * lumped[ties[t].node];
    nodes.add_to_owners(lumped, 1);

    inverse_lumped.assign(status.size(), 0.);
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      for (std::size_t k = std::size_t(i) * n_values() + first_value();
           k < std::size_t(i + 1) * n_values();
           ++k)
        if (status[k] == NodalStatus::free && lumped[i] > 0.)
          inverse_lumped[k] = 1. / lumped[i];
  }



  template <int dim>
  void
  MassSystem<dim>::apply(std::vector<double> &x, std::vector<double> &product) const
  {
    patch->nodes.update_ghosts(x, n_values());
    patch->ties.prolong(x, n_values());
    if (vectors == MassVectors::velocities)
      multiply_velocities(*matrix, neighbours, x, product);
    else
      multiply_pressures(*matrix, neighbours, x, product);
    patch->ties.restrict_sums(product, n_values());
    patch->nodes.add_to_owners(product, n_values());
  }



  /** The square of norm(). */
  template <int dim>
  double
  MassSystem<dim>::scaled_square(const std::vector<double> &residual) const
  {
    const std::size_t n_owned = std::size_t(patch->nodes.n_owned()) * n_values();
    double            sum     = 0.;
    for (std::size_t i = 0; i < n_owned; ++i)
      sum += residual[i] * residual[i] * inverse_lumped[i];
    return dealii::Utilities::MPI::sum(sum, patch->nodes.communicator());
  }



  template <int dim>
  double
  MassSystem<dim>::norm(const std::vector<double> &residual) const
  {
    return std::sqrt(scaled_square(residual));
  }



  /** x . y over the free components of all ranks. */
  template <int dim>
  double
  MassSystem<dim>::dot(const std::vector<double> &x, const std::vector<double> &y) const
  {
    const std::size_t n_owned = std::size_t(patch->nodes.n_owned()) * n_values();
    double            sum     = 0.;
    for (std::size_t i = 0; i < n_owned; ++i)
      if (inverse_lumped[i] != 0.)
        sum += x[i] * y[i];
    return dealii::Utilities::MPI::sum(sum, patch->nodes.communicator());
  }



  template <int dim>
  bool
  MassSystem<dim>::iterate(const Limits        &limits,
                           std::vector<double>  residual,
                           std::vector<double> &correction,
                           double              &energy) const
  {
    const std::size_t   n_owned = std::size_t(patch->nodes.n_owned()) * n_values();
    const double        enough  = limits.residual * limits.residual;
    std::vector<double> direction(residual.size(), 0.), product(residual.size());
    correction.assign(residual.size(), 0.);
    energy        = 0.;
    double square = scaled_square(residual), before = 1.;
    for (unsigned int k = 0; k < limits.most_iterations && square > enough; ++k)
      {
        if (limits.go_on && k == limits.ask_at && !limits.go_on())
          return false;
        const double beta = k == 0 ? 0. : square / before;
        for (std::size_t i = 0; i < n_owned; ++i)
          direction[i] = inverse_lumped[i] * residual[i] + beta * direction[i];
        apply(direction, product);
        const double curvature = dot(direction, product);
        if (!(curvature > 0.))
          return false;
        const double alpha = square / curvature;
        if (alpha > limits.longest_step)
          return false;
        for (std::size_t i = 0; i < n_owned; ++i)
          if (inverse_lumped[i] != 0.)
            {
              correction[i] += alpha * direction[i];
              residual[i] -= alpha * product[i];
            }
        energy += alpha * square;
        before = square;
        square = scaled_square(residual);
      }
    return square <= enough;
  }



  template <int dim>
  void
  MassSystem<dim>::improve(const std::vector<double> &right_side,
                           const double               tolerance,
                           const unsigned int         most_iterations,
                           std::vector<double>       &x) const
  {
    std::vector<double> residual(x.size()), correction;
    apply(x, residual);
    for (std::size_t k = 0; k < x.size(); ++k)
      residual[k] = right_side[k] - residual[k];
    double energy = 0.;
    iterate({tolerance * norm(right_side), most_iterations}, residual, correction, energy);
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] += correction[k];
    patch->nodes.update_ghosts(x, n_values());
    patch->ties.prolong(x, n_values());
  }

  template class MassSystem<2>;
  template class MassSystem<3>;
} // namespace kedge
