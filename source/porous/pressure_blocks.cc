#include <kedge/porous/pressure_blocks.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  template <int dim>
  void
  PressureBlocks<dim>::reinit(const Patch<dim>          &patch,
                              const EquationSystem<dim> &equations,
                              const int                  radius)
  {
    matrix.reinit(patch.nodes.n_local(), 1, radius);
    pressures.reinit(patch, patch.constraints.status_of(dim), matrix);

    const unsigned int n = equations.system().n_rows();
    blocks_.dim          = dim;
    blocks_.component.resize(n);
    blocks_.position.resize(std::size_t(n) * dim);
    for (unsigned int e = 0; e < n; ++e)
      {
        const unsigned int k = equations.nodal_index(e);
        const auto         x = patch.node_position(k / (dim + 1));
        blocks_.component[e] = static_cast<unsigned char>(k % (dim + 1));
        for (int d = 0; d < dim; ++d)
          blocks_.position[std::size_t(e) * dim + d] = x[d];
      }
  }



  template <int dim>
  void
  PressureBlocks<dim>::assemble(const Patch<dim>          &patch,
                                const std::vector<double> &modulus_of_body,
                                const double               stiffness_factor,
                                const double               inertia_factor)
  {
    weights.resize(patch.points.size());
    for (const auto &batch : patch.points.batches)
      for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
        weights[slot] = stiffness_factor * patch.points.volume[slot] *
                        patch.points.determinant[slot] / modulus_of_body[batch.body];
    assemble_mass(patch, weights, matrix);
    pressures.fill(patch, matrix);
    blocks_.by_stiffness = pressures.system();

    blocks_.by_inertia = SparseSystem();
    if (inertia_factor == 0.)
      return;
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      {
        const double volume = patch.points.volume[slot] * patch.points.determinant[slot];
        weights[slot]       = inertia_factor * volume * volume / patch.points.mass[slot];
      }
    assemble_laplacian(patch, weights, matrix);
    pressures.fill(patch, matrix);
    blocks_.by_inertia = pressures.system();
  }

  template class PressureBlocks<2>;
  template class PressureBlocks<3>;
} // namespace kedge
