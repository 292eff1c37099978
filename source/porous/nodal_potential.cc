#include <kedge/porous/nodal_potential.h>

namespace kedge
{
  template <int dim>
  std::vector<double>
  NodalPotential<dim>::values(const std::vector<double> &unknowns) const
  {
    std::vector<double> result = unknowns;
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      {
        double *x       = &result[std::size_t(i) * (dim + 1)];
        double  kinetic = 0.;
        for (int d = 0; d < dim; ++d)
          {
            const double velocity = x[d] / dt,
                         change   = velocity - velocity_n[std::size_t(i) * dim + d];
            kinetic += 0.5 * (velocity * velocity + change * change);
          }
        x[dim] = fluid.potential(x[dim]) - fluid.reference_density * kinetic;
      }
    patch.constraints.prolong(result);
    return result;
  }



  template <int dim>
  void
  NodalPotential<dim>::change_columns(const std::vector<double> &unknowns,
                                      NodeMatrix<dim>           &matrix) const
  {
    constexpr unsigned int n_components = dim + 1;
    std::vector<double>    slopes(unknowns.size()); // of lambda by u and p
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      {
        const std::size_t k = std::size_t(i) * n_components;
        for (int d = 0; d < dim; ++d)
          slopes[k + d] = -fluid.reference_density / dt *
                          (2. * unknowns[k + d] / dt - velocity_n[std::size_t(i) * dim + d]);
        slopes[k + dim] = fluid.potential_slope(unknowns[k + dim]);
      }
    for (unsigned int t = 0; t < patch.nodes.n_local(); ++t)
      if (patch.ties.is_tied(t, dim))
        {
          const auto &tie = patch.ties.ties()[patch.ties.tie_of(t, dim)];
          for (unsigned int c = 0; c < n_components; ++c)
            {
              double sum = 0.;
              for (std::size_t j = 0; j < tie.roots.size(); ++j)
                sum += tie.weights[j] * slopes[std::size_t(tie.roots[j]) * n_components + c];
              slopes[std::size_t(t) * n_components + c] = sum;
            }
        }
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      for_neighbours(patch, i, matrix, [&](const unsigned int slot, const unsigned int j) {
        const double *slope = &slopes[std::size_t(j) * n_components];
        for (unsigned int p = 0; p < n_components; ++p)
          {
            double *entry = matrix.row(i, p) + std::size_t(slot) * n_components;
            for (int m = 0; m < dim; ++m)
              entry[m] += slope[m] * entry[dim];
            entry[dim] *= slope[dim];
          }
      });
  }

  template class NodalPotential<2>;
  template class NodalPotential<3>;
} // namespace kedge
