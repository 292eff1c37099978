#include <kedge/porous/pressure_blocks.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  void
  PressureBlocks<dim>::reinit(const BackgroundGrid<dim>      &grid,
                              const ActiveNodes<dim>         &nodes,
                              const NodeTies<dim>            &ties,
                              const std::vector<NodalStatus> &status,
                              const EquationSystem<dim>      &equations,
                              const int                       radius)
  {
    std::vector<NodalStatus> pressure_status(nodes.n_local());
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      pressure_status[i] = status[std::size_t(i) * (dim + 1) + dim];
    matrix.reinit(nodes.n_local(), 1, radius);
    pressures.reinit(grid, nodes, ties, pressure_status, matrix);

    const unsigned int n = equations.system().n_rows();
    blocks_.dim          = dim;
    blocks_.component.resize(n);
    blocks_.position.resize(std::size_t(n) * dim);
    for (unsigned int e = 0; e < n; ++e)
      {
        const unsigned int k = equations.nodal_index(e);
        const auto         x =
          grid.lattice().node_position(grid.window().node_index(nodes.window_node(k / (dim + 1))));
        blocks_.component[e] = static_cast<unsigned char>(k % (dim + 1));
        for (int d = 0; d < dim; ++d)
          blocks_.position[std::size_t(e) * dim + d] = x[d];
      }
  }



  template <int dim>
  void
  PressureBlocks<dim>::assemble(const StepPoints<dim>     &points,
                                const LatticeWindow<dim>  &window,
                                const ActiveNodes<dim>    &nodes,
                                const std::vector<double> &modulus_of_body,
                                const double               stiffness_factor,
                                const double               inertia_factor)
  {
    weights.resize(points.size());
    for (const auto &batch : points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        weights[slot] = stiffness_factor * points.volume[slot] * points.determinant[slot] /
                        modulus_of_body[batch.body];
    assemble_mass(points, window, nodes, weights, matrix);
    pressures.fill(nodes, matrix);
    blocks_.by_stiffness = pressures.system();

    blocks_.by_inertia = SparseSystem();
    if (inertia_factor == 0.)
      return;
    for (unsigned int slot = 0; slot < points.size(); ++slot)
      {
        const double volume = points.volume[slot] * points.determinant[slot];
        weights[slot]       = inertia_factor * volume * volume / points.mass[slot];
      }
    assemble_laplacian(points, window, nodes, weights, matrix);
    pressures.fill(nodes, matrix);
    blocks_.by_inertia = pressures.system();
  }

  template class PressureBlocks<2>;
  template class PressureBlocks<3>;
} // namespace kedge
