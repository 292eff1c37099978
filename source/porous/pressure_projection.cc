#include <kedge/porous/pressure_projection.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  namespace
  {
    /** Of the scaled residual: the ghosts' storage, a small number itself, needs no more. */
    constexpr double       tolerance       = 1e-9;
    constexpr unsigned int most_iterations = 1000;
  } // namespace



  template <int dim>
  void
  project_pressure(const Patch<dim>          &patch,
                   const std::vector<double> &pressures,
                   const double               bulk_modulus,
                   const NodeMatrix<dim>     &storage,
                   std::vector<double>       &nodal)
  {
    const auto         &points = patch.points;
    std::vector<double> volumes(points.size()), at_points(points.size());
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        volumes[slot]   = points.volume[slot] * points.determinant[slot];
        at_points[slot] = volumes[slot] * pressures[slot];
      }
    NodeMatrix<dim> matrix;
    matrix.reinit(patch.nodes.n_local(), 1, storage.radius());
    assemble_mass(patch, volumes, matrix);
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      for (unsigned int s = 0; s < matrix.n_slots(); ++s)
        matrix.row(i, 0)[s] += bulk_modulus * storage.row(i, 0)[s];

    std::vector<double> sums(patch.nodes.n_local(), 0.), right_side(nodal.size(), 0.);
    add_scalars_to_nodes(patch, at_points, 1, sums);
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      right_side[std::size_t(i) * (dim + 1) + dim] = sums[i];
    patch.ties.restrict_sums(right_side, dim + 1);
    patch.nodes.add_to_owners(right_side, dim + 1);

    MassSystem<dim> system(MassVectors::pressures);
    system.reinit(patch, matrix, patch.constraints.status(), true);
    system.improve(right_side, tolerance, most_iterations, nodal);
  }

#define KEDGE_INSTANTIATE(dim)                                \
  template void project_pressure(const Patch<dim> &,          \
                                 const std::vector<double> &, \
                                 const double,                \
                                 const NodeMatrix<dim> &,     \
                                 std::vector<double> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
