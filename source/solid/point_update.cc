#include <kedge/solid/group_dilatation.h>
#include <kedge/solid/point_update.h>
#include <kedge/stress/mean_dilatation.h>

namespace kedge
{
  namespace
  {
    /** Updates a point that takes the change of volume @p increment of its group. */
    template <int dim, class Material>
    bool
    update_one_of_group(const Material         &material,
                        const StressState<dim> &state,
                        const MaterialHistory  &history,
                        const double (&A)[dim][dim],
                        const double      increment,
                        PointUpdate<dim> &update)
    {
      if constexpr (Material::decoupled_volume)
        {
          const double strain = state.strain[0] + state.strain[1] + state.strain[2] + increment;
          return update_point<dim>(MeanDilatation<Material>(material,
                                                            material.bulk_modulus * strain),
                                   state,
                                   history,
                                   A,
                                   update,
                                   (increment - relative_volume_strain<dim>(A)) / 3.);
        }
      else
        {
          AssertThrow(false,
                      dealii::ExcMessage("This material cannot share its change of volume."));
          return false;
        }
    }

    /**
     * Diagonal of the right stretch U = (F^T F)^{1/2}, which scales the GIMP
     * domain (Coombs et al. 2020).
     */
    template <int dim>
    dealii::Tensor<1, dim>
    stretch_diagonal(const dealii::Tensor<2, dim> &F)
    {
      double zero[dim] = {}, C[dim][dim], squares[dim], W[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            C[i][j] = 0.;
            for (int k = 0; k < dim; ++k)
              C[i][j] += F[k][i] * F[k][j];
          }
      incremental_spectrum<dim>(zero, C, squares, W);
      dealii::Tensor<1, dim> diagonal;
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          diagonal[i] += W[i][k] * W[i][k] * std::sqrt(squares[k]);
      return diagonal;
    }
  } // namespace



  template <int dim>
  unsigned int
  evaluate_point_updates(const std::vector<Material>   &materials,
                         const StepPoints<dim>         &points,
                         const LatticeWindow<dim>      &window,
                         const ActiveNodes<dim>        &nodes,
                         const std::vector<double>     &displacement,
                         std::vector<PointUpdate<dim>> &updates)
  {
    updates.resize(points.size());
    GroupDilatation   dilatation;
    const PointStatus groups =
      evaluate_group_dilatation(points, window, nodes, displacement, 1., dilatation);
    if (!groups.ok())
      return groups.failed_slot;
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(points, window, nodes, displacement, gradients);
    for (const auto &batch : points.batches)
      {
        const bool         grouped = points.is_grouped(batch);
        const unsigned int failed  = std::visit(
          [&](const auto &material) {
            for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
              {
                double A[dim][dim];
                for (int i = 0; i < dim; ++i)
                  for (int j = 0; j < dim; ++j)
                    A[i][j] = gradients[slot][i][j];
                const auto &state = points.stress_state[slot];
                const auto  history =
                  points.template history_of<std::decay_t<decltype(material)>>(slot);
                const bool ok =
                  grouped ? update_one_of_group<dim>(material,
                                                     state,
                                                     history,
                                                     A,
                                                     dilatation.increment[points.group[slot]],
                                                     updates[slot])
                           : update_point<dim>(material, state, history, A, updates[slot]);
                if (!ok)
                  return slot;
              }
            return PointStatus::none;
          },
          materials[batch.body]);
        if (failed != PointStatus::none)
          return failed;
      }
    return PointStatus::none;
  }



  template <int dim>
  void
  apply_point_update(const PointUpdate<dim> &update, PointState<dim> &state)
  {
    dealii::Tensor<2, dim> dF;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          dF[i][j]                  = (i == j ? 1. : 0.) + update.relative_gradient[i][j];
          state.elastic_frame[i][j] = update.elastic_frame[i][j];
        }
    state.deformation_gradient = dF * state.deformation_gradient;
    for (int s = 0; s < n_symmetric<dim>; ++s)
      state.kirchhoff_stress[symmetric_row<dim>[s]][symmetric_column<dim>[s]] =
        update.kirchhoff_stress[s];
    state.out_of_plane_kirchhoff_stress = update.out_of_plane_stress;
    state.strain_energy                 = update.strain_energy;
    if (dim == 2)
      state.out_of_plane_elastic_stretch *= update.out_of_plane_stretch_factor;
    state.hardening_energy = update.hardening_energy;
    state.plastic_dissipation += update.dissipation;
    state.equivalent_plastic_strain = update.equivalent_plastic_strain;
    state.plastic_volume_strain     = update.plastic_volume_strain;

    const auto stretch = stretch_diagonal<dim>(state.deformation_gradient);
    for (int d = 0; d < dim; ++d)
      state.half_lengths[d] = state.reference_half_lengths[d] * stretch[d];
  }

#define KEDGE_INSTANTIATE(dim)                                                   \
  template unsigned int evaluate_point_updates(const std::vector<Material> &,    \
                                               const StepPoints<dim> &,          \
                                               const LatticeWindow<dim> &,       \
                                               const ActiveNodes<dim> &,         \
                                               const std::vector<double> &,      \
                                               std::vector<PointUpdate<dim>> &); \
  template void         apply_point_update(const PointUpdate<dim> &, PointState<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
