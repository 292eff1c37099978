#include <kedge/porous/pressure_mapping.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  namespace
  {
    constexpr double       relative_tolerance = 1e-12; ///< of the scaled residual
    constexpr unsigned int most_iterations    = 200;

    /** (4.182): pressures by lumped volumes, from sums of volume and volume times pressure. */
    template <int dim>
    std::vector<double>
    lumped_pressures(const Patch<dim> &patch, std::vector<double> sums)
    {
      const auto &nodes = patch.nodes;
      for (const auto &tie : patch.ties.ties())
        if (tie.interpolates)
          for (unsigned int k = 0; k < tie.roots.size(); ++k)
            for (unsigned int c = 0; c < 2; ++c)
              sums[2 * std::size_t(tie.roots[k]) + c] +=
                tie.weights[k] * sums[2 * std::size_t(tie.node) + c];
      nodes.add_to_owners(sums, 2);
      nodes.update_ghosts(sums, 2);
      std::vector<double> nodal(std::size_t(nodes.n_local()) * (dim + 1), 0.);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        nodal[std::size_t(i) * (dim + 1) + dim] =
          sums[2 * i] > 0. ? sums[2 * i + 1] / sums[2 * i] : 0.;
      patch.ties.prolong(nodal, dim + 1);
      return nodal;
    }

    /** All pressures but the tied ones: the mapping does not know what is prescribed. */
    template <int dim>
    std::vector<NodalStatus>
    status_without_conditions(const Patch<dim> &patch)
    {
      std::vector<NodalStatus> status(std::size_t(patch.nodes.n_local()) * (dim + 1),
                                      NodalStatus::free);
      for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
        if (patch.ties.is_tied(i, dim))
          status[std::size_t(i) * (dim + 1) + dim] = NodalStatus::tied;
      return status;
    }
  } // namespace



  template <int dim>
  void
  PressureMapping<dim>::map(const Patch<dim>          &patch,
                            const std::vector<double> &pressure,
                            const int                  radius,
                            std::vector<double>       &unknowns) const
  {
    const auto         &points = patch.points;
    std::vector<double> volume(points.size()), at_points(2 * std::size_t(points.size()));
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        volume[slot]                         = points.volume[slot] * points.determinant[slot];
        at_points[2 * std::size_t(slot)]     = volume[slot];
        at_points[2 * std::size_t(slot) + 1] = volume[slot] * pressure[slot];
      }
    std::vector<double> sums(2 * std::size_t(patch.nodes.n_local()), 0.);
    add_scalars_to_nodes(patch, at_points, 2, sums);
    std::vector<double> nodal = lumped_pressures(patch, sums);
    if (kind == PressureMap::consistent)
      {
        std::vector<double> right_side(nodal.size(), 0.);
        for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
          right_side[std::size_t(i) * (dim + 1) + dim] = sums[2 * std::size_t(i) + 1];
        patch.ties.restrict_sums(right_side, dim + 1);
        patch.nodes.add_to_owners(right_side, dim + 1);
        NodeMatrix<dim> volumes; // Omega of this rank
        volumes.reinit(patch.nodes.n_local(), 1, radius);
        assemble_mass(patch, volume, volumes);
        MassSystem<dim> system(MassVectors::pressures);
        system.reinit(patch, volumes, status_without_conditions(patch), true);
        system.improve(right_side, relative_tolerance, most_iterations, nodal);
      }
    for (std::size_t k = dim; k < unknowns.size(); k += dim + 1)
      unknowns[k] = nodal[k];
  }

  template class PressureMapping<2>;
  template class PressureMapping<3>;
} // namespace kedge
