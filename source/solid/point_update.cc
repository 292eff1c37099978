#include <kedge/solid/point_update.h>

namespace kedge
{
  namespace
  {
    /**
     * Energies and history at the end of the step, and the stretches
     * exp(d eps^p_i) by which the trial elastic stretches are too long.
     */
    template <int dim, class Material>
    void
    update_history(const Material                      &material,
                   const StressState<dim>              &state,
                   const MaterialHistory               &history,
                   const RelativeStress<dim, Material> &r,
                   double (&plastic_stretch)[3],
                   PointUpdate<dim> &update)
    {
      double strain[3];
      for (int i = 0; i < 3; ++i)
        {
          strain[i]          = state.strain[i] + r.increment[i];
          plastic_stretch[i] = 1.;
          if constexpr (Material::has_history)
            {
              const double plastic = material.plastic_increment(r.response, i);
              strain[i] -= plastic;
              plastic_stretch[i] = std::exp(plastic);
            }
        }
      update.strain_energy             = material.energy(strain);
      update.hardening_energy          = 0.;
      update.dissipation               = 0.;
      update.equivalent_plastic_strain = 0.;
      if constexpr (Material::has_history)
        {
          const MaterialHistory end        = material.updated(r.response, history);
          update.hardening_energy          = material.hardening_energy(end);
          update.dissipation               = material.dissipation(r.response);
          update.equivalent_plastic_strain = end.equivalent_plastic_strain;
        }
    }

    template <int dim, class Material>
    bool
    update_one(const Material         &material,
               const StressState<dim> &state,
               const MaterialHistory  &history,
               const double (&A)[dim][dim],
               PointUpdate<dim> &update)
    {
      double E[n_symmetric<dim>];
      relative_strain<dim>(A, E);
      const auto r = evaluate_relative_stress<dim>(material, state, E, history);
      if (!r.valid || !(relative_determinant<dim>(A) > 0.))
        return false;

      const auto &tau = r.response.kirchhoff_stress;
      double      plastic_stretch[3];
      update_history(material, state, history, r, plastic_stretch, update);
      update.out_of_plane_stress         = dim == 2 ? tau[2] : 0.;
      update.out_of_plane_stretch_factor = 1. / plastic_stretch[2];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            update.relative_gradient[i][j] = A[i][j];
            update.elastic_frame[i][j]     = r.frame[i][j];
            for (int k = 0; k < dim; ++k)
              update.elastic_frame[i][j] += A[i][k] * r.frame[k][j];
          }
      for (int s = 0; s < n_symmetric<dim>; ++s)
        {
          const int i = symmetric_row<dim>[s], j = symmetric_column<dim>[s];
          update.kirchhoff_stress[s] = 0.;
          for (int k = 0; k < dim; ++k)
            update.kirchhoff_stress[s] +=
              tau[k] / r.lambda[k] * update.elastic_frame[i][k] * update.elastic_frame[j][k];
        }
      if constexpr (Material::has_history)
        for (auto &row : update.elastic_frame)
          for (int k = 0; k < dim; ++k)
            row[k] /= plastic_stretch[k];
      return true;
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
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(points, window, nodes, displacement, gradients);
    for (const auto &batch : points.batches)
      {
        const unsigned int failed = std::visit(
          [&](const auto &material) {
            for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
              {
                double A[dim][dim];
                for (int i = 0; i < dim; ++i)
                  for (int j = 0; j < dim; ++j)
                    A[i][j] = gradients[slot][i][j];
                if (!update_one<dim>(material,
                                     points.stress_state[slot],
                                     points.template history_of<std::decay_t<decltype(material)>>(
                                       slot),
                                     A,
                                     updates[slot]))
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
