#include <kedge/fields/node_filling.h>

namespace kedge
{
  namespace
  {
    /** Volume of the cells of the level that a node of the window belongs to [m^3; m^2 in 2D]. */
    template <int dim>
    double
    cell_volume(const GridLevels<dim> &levels, const unsigned int window_node)
    {
      return levels.lattice(levels.node(window_node).level).cell_volume();
    }
  } // namespace



  template <int dim>
  std::vector<double>
  nodal_filling(const BackgroundGrid<dim>        &grid,
                const StepPoints<dim>            &points,
                const std::vector<unsigned char> &reached)
  {
    std::vector<double> filling(grid.window().n_nodes_total(), 0.);
    for (unsigned int node = 0; node < reached.size(); ++node)
      if (reached[node])
        filling[node] = std::numeric_limits<double>::min();
    const auto   strides    = grid.window().node_strides();
    const double whole_cell = grid.lattice().cell_volume();
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        const Stencil<dim> &s = points.stencil[slot];
        const double        volume =
          points.volume[slot] * points.determinant[slot] /
          (grid.is_refined() ? cell_volume(grid.levels(), s.first_node) : whole_cell);
        for (int k = 0; k < (dim == 3 ? stencil_width(s.pattern, 2) : 1); ++k)
          for (int j = 0; j < stencil_width(s.pattern, 1); ++j)
            {
              const double yz = volume * s.value[1][j] * (dim == 3 ? s.value[dim - 1][k] : 1.);
              double      *row =
                &filling[s.first_node + j * strides[1] + (dim == 3 ? k * strides[dim - 1] : 0)];
              for (int i = 0; i < stencil_width(s.pattern, 0); ++i)
                row[i] += yz * s.value[0][i];
            }
      }
    if (dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      MPI_Allreduce(MPI_IN_PLACE,
                    filling.data(),
                    static_cast<int>(filling.size()),
                    MPI_DOUBLE,
                    MPI_SUM,
                    grid.communicator());
    return filling;
  }



  template <int dim>
  std::vector<std::uint64_t>
  bodies_at_nodes(const BackgroundGrid<dim> &grid, const StepPoints<dim> &points)
  {
    unsigned int n_bodies = 0;
    for (const auto &batch : points.batches)
      n_bodies = std::max(n_bodies, batch.body + 1);
    const bool many_ranks = dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1;
    if (many_ranks)
      n_bodies = dealii::Utilities::MPI::max(n_bodies, grid.communicator());
    if (n_bodies < 2)
      return {};
    std::vector<std::uint64_t> bodies(grid.window().n_nodes_total(), 0);
    const auto                 strides = grid.window().node_strides();
    for (const auto &batch : points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        for (int k = 0; k < (dim == 3 ? stencil_width(batch.pattern, 2) : 1); ++k)
          for (int j = 0; j < stencil_width(batch.pattern, 1); ++j)
            {
              std::uint64_t *row = &bodies[points.stencil[slot].first_node + j * strides[1] +
                                           (dim == 3 ? k * strides[dim - 1] : 0)];
              for (int i = 0; i < stencil_width(batch.pattern, 0); ++i)
                row[i] |= std::uint64_t(1) << (batch.body % 64);
            }
    if (many_ranks)
      MPI_Allreduce(MPI_IN_PLACE,
                    bodies.data(),
                    static_cast<int>(bodies.size()),
                    MPI_UINT64_T,
                    MPI_BOR,
                    grid.communicator());
    return bodies;
  }



  template <int dim>
  void
  give_to_roots(const GridLevels<dim>      &levels,
                const std::vector<NodeSum> &hanging,
                std::vector<double>        &filling,
                std::vector<std::uint64_t> &bodies)
  {
    for (const NodeSum &sum : hanging)
      {
        const double volume = filling[sum.node] * cell_volume(levels, sum.node);
        for (unsigned int k = 0; k < sum.roots.size(); ++k)
          {
            filling[sum.roots[k]] += sum.weights[k] * volume / cell_volume(levels, sum.roots[k]);
            if (!bodies.empty())
              bodies[sum.roots[k]] |= bodies[sum.node];
          }
        filling[sum.node] = 0.;
      }
  }

#define KEDGE_INSTANTIATE(dim)                                                           \
  template std::vector<double>        nodal_filling(const BackgroundGrid<dim> &,         \
                                                    const StepPoints<dim> &,             \
                                                    const std::vector<unsigned char> &); \
  template std::vector<std::uint64_t> bodies_at_nodes(const BackgroundGrid<dim> &,       \
                                                      const StepPoints<dim> &);          \
  template void                       give_to_roots(const GridLevels<dim> &,             \
                                                    const std::vector<NodeSum> &,        \
                                                    std::vector<double> &,               \
                                                    std::vector<std::uint64_t> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
