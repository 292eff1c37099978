#include <kedge/solid/group_dilatation.h>
#include <kedge/stress/mean_dilatation.h>

namespace kedge
{
  namespace
  {
    /**
     * For each group, sum_p V_p dP/dp dN_A/dx and sum_p V_p dtheta/dA dN_A/dx
     * at the nodes A of a block of width^dim nodes around the group's cell.
     */
    template <int dim>
    struct GroupSlopes
    {
      using Values = std::vector<dealii::Tensor<1, dim>>; ///< [group * size + A]

      GroupSlopes(const Patch<dim> &patch, const int matrix_radius)
        : patch(patch)
        , width(std::min(matrix_radius + 1, 4))
      {
        for (int d = 0; d < dim; ++d)
          {
            strides[d] = size;
            size *= width;
          }
        stress.resize(std::size_t(size) * patch.points.group_cell.size());
        strain.resize(stress.size());
      }

      /** The lowest node of a group's block. */
      LatticeIndex<dim>
      first_node(const unsigned int group) const
      {
        LatticeIndex<dim> first = patch.window().cell_index(patch.points.group_cell[group]);
        if (width > 2)
          for (int &index : first)
            --index;
        return first;
      }

      /** Where the values of a group's node stand. */
      std::size_t
      place(const unsigned int group, const unsigned int window_node) const
      {
        const LatticeIndex<dim> first = first_node(group),
                                node  = patch.window().node_index(window_node);
        std::size_t result            = std::size_t(group) * size;
        for (int d = 0; d < dim; ++d)
          {
            Assert(node[d] >= first[d] && node[d] < first[d] + width, dealii::ExcInternalError());
            result += (node[d] - first[d]) * strides[d];
          }
        return result;
      }

      const Patch<dim>    &patch;
      const int            width;
      int                  size = 1;
      std::array<int, dim> strides;
      Values               stress, strain;
    };

    /** Fills GroupSlopes with the points of a batch. */
    template <int dim, StressRule rule>
    struct CollectSlopes
    {
      const typename StepPoints<dim>::Batch     &batch;
      const std::vector<dealii::Tensor<2, dim>> &gradients;
      const double                               alpha;
      GroupSlopes<dim>                          &slopes;

      template <unsigned int pattern>
      void
      run() const
      {
        const Patch<dim> &patch  = slopes.patch;
        const auto        places = node_offsets<dim, pattern>(slopes.strides);
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            double A[dim][dim];
            for (int i = 0; i < dim; ++i)
              for (int j = 0; j < dim; ++j)
                A[i][j] = gradients[slot][i][j];
            const VolumeSlopes<dim> slope =
              evaluate_volume_slopes<dim, rule>(patch.points.stress_state[slot], A, alpha);
            const auto        basis = expand<dim, pattern>(patch.points.stencil[slot]);
            const std::size_t first =
              slopes.place(patch.points.group[slot], patch.points.stencil[slot].first_node);
            for (int N = 0; N < stencil_size<dim>(pattern); ++N)
              for (int R = 0; R < dim; ++R)
                {
                  const double weighted = patch.points.volume[slot] * basis.gradient[R][N];
                  for (int p = 0; p < dim; ++p)
                    {
                      slopes.stress[first + places[N]][p] += weighted * slope.stress[p][R];
                      slopes.strain[first + places[N]][p] += weighted * slope.strain[p][R];
                    }
                }
          }
      }
    };

    /** Adds factor * stress (x) strain of a group, between all nodes that its points reach. */
    template <int dim>
    void
    add_group(const GroupSlopes<dim> &slopes,
              const unsigned int      group,
              const double            factor,
              NodeMatrix<dim>        &stiffness)
    {
      const Patch<dim> &patch = slopes.patch;
      struct Reached
      {
        int local, slot; ///< slot differences are those of the lattice offsets
        const dealii::Tensor<1, dim> *stress, *strain;
      };
      std::array<Reached, dim == 2 ? 16 : 64> reached;
      unsigned int                            n = 0;

      const LatticeIndex<dim> first = slopes.first_node(group);
      const int               zero  = stiffness.slot(LatticeIndex<dim>{});
      for (int A = 0; A < slopes.size; ++A)
        {
          const std::size_t place = std::size_t(group) * slopes.size + A;
          if (slopes.strain[place].norm_square() == 0. && slopes.stress[place].norm_square() == 0.)
            continue;
          LatticeIndex<dim> offset, node;
          for (int d = 0; d < dim; ++d)
            {
              offset[d] = A / slopes.strides[d] % slopes.width;
              node[d]   = first[d] + offset[d];
            }
          reached[n++] = {patch.nodes.local(patch.window().node_number(node)),
                          static_cast<int>(stiffness.slot(offset)),
                          &slopes.stress[place],
                          &slopes.strain[place]};
        }
      for (unsigned int a = 0; a < n; ++a)
        for (int p = 0; p < dim; ++p)
          {
            double      *row  = stiffness.row(reached[a].local, p);
            const double left = factor * (*reached[a].stress)[p];
            for (unsigned int b = 0; b < n; ++b)
              for (int m = 0; m < dim; ++m)
                row[(zero + reached[b].slot - reached[a].slot) * dim + m] +=
                  left * (*reached[b].strain)[m];
          }
    }

    /** Of a law whose mean stress is K tr eps; others have no groups. */
    double
    bulk_modulus(const Material &material)
    {
      return std::visit(
        [](const auto &m) {
          if constexpr (std::decay_t<decltype(m)>::decoupled_volume)
            return m.bulk_modulus;
          else
            return std::numeric_limits<double>::signaling_NaN();
        },
        material);
    }
  } // namespace



  template <int dim>
  PointStatus
  evaluate_group_dilatation(const Patch<dim>          &patch,
                            const std::vector<double> &displacement,
                            const double               fraction,
                            GroupDilatation           &result)
  {
    const std::size_t n_groups = patch.points.group_cell.size();
    result.volume.assign(n_groups, 0.);
    result.strain_n.assign(n_groups, 0.);
    result.increment.assign(n_groups, 0.);
    PointStatus status;
    if (n_groups == 0)
      return status;

    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(patch, displacement, gradients);
    for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
      if (patch.points.group[slot] != StepPoints<dim>::no_group)
        {
          double A[dim][dim];
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              A[i][j] = fraction * gradients[slot][i][j];
          if (!(relative_determinant<dim>(A) > 0.))
            {
              status.failed_slot = slot;
              return status;
            }
          const unsigned int g      = patch.points.group[slot];
          const double       volume = patch.points.volume[slot];
          const auto        &strain = patch.points.stress_state[slot].strain;
          result.volume[g] += volume;
          result.strain_n[g] += volume * (strain[0] + strain[1] + strain[2]);
          result.increment[g] += volume * relative_volume_strain<dim>(A);
        }
    for (std::size_t g = 0; g < n_groups; ++g)
      if (result.volume[g] > 0.)
        {
          result.strain_n[g] /= result.volume[g];
          result.increment[g] /= result.volume[g];
        }
    return status;
  }



  template <int dim>
  void
  add_group_stiffness(const std::vector<Material> &materials,
                      const StressRule             rule,
                      const double                 alpha,
                      const Patch<dim>            &patch,
                      const std::vector<double>   &displacement,
                      NodeMatrix<dim>             &stiffness)
  {
    if (patch.points.group_cell.empty())
      return;
    std::vector<dealii::Tensor<2, dim>> gradients;
    gradients_at_points(patch, displacement, gradients);
    GroupSlopes<dim>    slopes(patch, stiffness.radius());
    std::vector<double> modulus(patch.points.group_cell.size(), 0.), volume = modulus;
    for (const auto &batch : patch.points.batches)
      if (patch.points.is_grouped(batch))
        {
          const double K = bulk_modulus(materials[batch.body]);
          for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
            {
              volume[patch.points.group[slot]] += patch.points.volume[slot];
              modulus[patch.points.group[slot]] = K;
            }
          if (rule == StressRule::conserving)
            dispatch_pattern<dim>(
              batch.pattern,
              CollectSlopes<dim, StressRule::conserving>{batch, gradients, alpha, slopes});
          else
            dispatch_pattern<dim>(
              batch.pattern,
              CollectSlopes<dim, StressRule::at_configuration>{batch, gradients, alpha, slopes});
        }
    const double part = rule == StressRule::conserving ? 0.5 : 1.;
    for (std::size_t g = 0; g < modulus.size(); ++g)
      add_group(slopes, g, part * modulus[g] / volume[g], stiffness);
  }

#define KEDGE_INSTANTIATE(dim)                                                \
  template PointStatus evaluate_group_dilatation(const Patch<dim> &,          \
                                                 const std::vector<double> &, \
                                                 const double,                \
                                                 GroupDilatation &);          \
  template void        add_group_stiffness(const std::vector<Material> &,     \
                                           const StressRule,                  \
                                           const double,                      \
                                           const Patch<dim> &,                \
                                           const std::vector<double> &,       \
                                           NodeMatrix<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
