#include <kedge/fields/point_packs.h>
#include <kedge/materials/lane_by_lane.h>
#include <kedge/solid/group_dilatation.h>
#include <kedge/solid/point_update.h>
#include <kedge/stress/mean_dilatation.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kedge
{
  namespace
  {
    /** Updates a point; if it is in a group, it takes the group's change of volume @p increment. */
    template <int dim, class Material, typename Number>
    Condition<Number>
    update_one(const Material                    &material,
               const StressState<dim, Number>    &state,
               const HistoryOf<Material, Number> &history,
               const Number (&A)[dim][dim],
               const bool                grouped,
               const Number             &increment,
               PointUpdate<dim, Number> &update)
    {
      if (!grouped)
        return update_point<dim>(material, state, history, A, update);
      if constexpr (Material::decoupled_volume)
        {
          const Number strain = state.strain[0] + state.strain[1] + state.strain[2] + increment;
          const MeanDilatation<Material, Number> law(material, material.bulk_modulus * strain);
          return update_point<dim>(law,
                                   state,
                                   history,
                                   A,
                                   update,
                                   Number((increment - relative_volume_strain<dim>(A)) / 3.));
        }
      else
        {
          AssertThrow(false,
                      dealii::ExcMessage("This material cannot share its change of volume."));
          return Number(0.) > Number(1.);
        }
    }

    /** Updates the points of a batch; returns the first slot that fails. */
    template <int dim, class Material>
    unsigned int
    update_batch(const Material                            &material,
                 const StepPoints<dim>                     &points,
                 const typename StepPoints<dim>::Batch     &batch,
                 const GroupDilatation                     &dilatation,
                 const std::vector<dealii::Tensor<2, dim>> &gradients,
                 std::vector<PointUpdate<dim>>             &updates)
    {
      const InPacks<Material> law(material);
      const bool              grouped = points.is_grouped(batch);
      Pack                    A[dim][dim], increment = 0.;
      PointUpdate<dim, Pack>  update;
      for (unsigned int begin = batch.begin; begin < batch.end; begin += pack_width)
        {
          const PackOfSlots slots(begin, batch.end);
          for (unsigned int lane = 0; lane < pack_width; ++lane)
            {
              const unsigned int slot = slots.slot(lane);
              if (grouped)
                increment.set(lane, dilatation.increment[points.group[slot]]);
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  A[i][j].set(lane, gradients[slot][i][j]);
            }
          const auto         valid  = update_one<dim>(law,
                                             pack_of_states(points, slots),
                                             pack_of_histories<Material>(points, slots),
                                             A,
                                             grouped,
                                             increment,
                                             update);
          const unsigned int failed = slots.first_failure(valid, PointStatus::none);
          if (failed != PointStatus::none)
            return failed;
          for (unsigned int lane = 0; lane < slots.count; ++lane)
            get_lane(lane, update, updates[slots.slot(lane)]);
        }
      return PointStatus::none;
    }
  } // namespace



  template <int dim>
  unsigned int
  evaluate_point_updates(const std::vector<Material>   &materials,
                         const Patch<dim>              &patch,
                         const std::vector<double>     &displacement,
                         std::vector<PointUpdate<dim>> &updates)
  {
    updates.resize(patch.points.size());
    GroupDilatation   dilatation;
    const PointStatus groups = evaluate_group_dilatation(patch, displacement, 1., dilatation);
    if (!groups.ok())
      return groups.failed_slot;
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(patch, displacement, gradients);
    for (const auto &batch : patch.points.batches)
      {
        const unsigned int failed = std::visit(
          [&](const auto &material) {
            return update_batch(material, patch.points, batch, dilatation, gradients, updates);
          },
          materials[batch.body]);
        if (failed != PointStatus::none)
          return failed;
      }
    return PointStatus::none;
  }



  template <int dim>
  void
  apply_point_update(const PointUpdate<dim> &update,
                     const std::vector<unsigned int> &,
                     PointCore<dim> &state)
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
  }



  template <int dim>
  void
  apply_point_update(const PointUpdate<dim>          &update,
                     const std::vector<unsigned int> &columns,
                     PointState<dim>                 &state)
  {
    apply_point_update(update, columns, static_cast<PointCore<dim> &>(state));
    state.hardening_energy = update.hardening_energy;
    state.plastic_dissipation += update.dissipation;
    for (unsigned int c = 0; c < columns.size(); ++c)
      if (columns[c] < most_memory_columns)
        state.memory[columns[c]] = update.history[c];
  }



  namespace
  {
    /** A frame that turns by less than its square root is not turned at all. */
    constexpr double no_turn = 1e-20;

    /**
     * Edges of the box that stands for the image of a unit cube: of the cube's edges in turn, each
     * the part normal to those before. The orders are weighted by how little their frames are
     * turned.
     */
    template <int dim>
    void
    edges_of_box(const Pack (&F)[dim][dim], Pack (&edges)[dim])
    {
      std::array<int, std::size_t(dim)> order;
      std::iota(order.begin(), order.end(), 0);
      Pack sum_of_weights = 0., logarithm[dim];
      for (Pack &entry : logarithm)
        entry = 0.;
      do
        {
          Pack frame[dim][dim], edge[dim], turn = 0.;
          for (int k = 0; k < dim; ++k)
            {
              for (int i = 0; i < dim; ++i)
                frame[k][i] = F[i][order[k]];
              for (int j = 0; j < k; ++j)
                {
                  Pack along = 0.;
                  for (int i = 0; i < dim; ++i)
                    along += frame[k][i] * frame[j][i];
                  for (int i = 0; i < dim; ++i)
                    frame[k][i] -= along * frame[j][i];
                }
              Pack square = 0.;
              for (int i = 0; i < dim; ++i)
                square += frame[k][i] * frame[k][i];
              edge[k] = sqrt(square);
              for (int i = 0; i < dim; ++i)
                frame[k][i] /= edge[k];
              turn += 2. - 2. * frame[k][order[k]]; // |q - e|^2
            }
          const Pack weight = 1. / (select(turn > 0., turn, 0.) + no_turn);
          sum_of_weights += weight;
          for (int k = 0; k < dim; ++k)
            logarithm[order[k]] += weight * log1p(edge[k] - 1.);
      } while (std::next_permutation(order.begin(), order.end()));
      for (int d = 0; d < dim; ++d)
        edges[d] = exp(logarithm[d] / sum_of_weights);
    }
  } // namespace



  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  stretches_along_axes(const std::vector<dealii::Tensor<2, dim>> &deformation_gradients)
  {
    const unsigned int                  n = deformation_gradients.size();
    std::vector<dealii::Tensor<1, dim>> result(n);
    Pack                                F[dim][dim], edges[dim];
    for (unsigned int begin = 0; begin < n; begin += pack_width)
      {
        const PackOfSlots slots(begin, n);
        for (unsigned int lane = 0; lane < pack_width; ++lane)
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              F[i][j].set(lane, deformation_gradients[slots.slot(lane)][i][j]);
        edges_of_box<dim>(F, edges);
        for (unsigned int lane = 0; lane < slots.count; ++lane)
          for (int d = 0; d < dim; ++d)
            result[slots.slot(lane)][d] = edges[d][lane];
      }
    return result;
  }

#define KEDGE_INSTANTIATE(dim)                                                                          \
  template unsigned int                        evaluate_point_updates(const std::vector<Material> &,    \
                                                                      const Patch<dim> &,               \
                                                                      const std::vector<double> &,      \
                                                                      std::vector<PointUpdate<dim>> &); \
  template void                                apply_point_update(const PointUpdate<dim> &,             \
                                                                  const std::vector<unsigned int> &,    \
                                                                  PointState<dim> &);                   \
  template void                                apply_point_update(const PointUpdate<dim> &,             \
                                                                  const std::vector<unsigned int> &,    \
                                                                  PointCore<dim> &);                    \
  template std::vector<dealii::Tensor<1, dim>> stretches_along_axes(                                    \
    const std::vector<dealii::Tensor<2, dim>> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
