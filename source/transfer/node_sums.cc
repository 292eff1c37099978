#include <kedge/transfer/node_sums.h>

namespace kedge
{
  namespace
  {
    /** Local numbers of the nodes of a stencil. */
    template <int dim, unsigned int pattern>
    std::array<int, stencil_size<dim>(pattern)>
    local_nodes(const ActiveNodes<dim>                                     &nodes,
                const std::array<unsigned int, stencil_size<dim>(pattern)> &offsets,
                const unsigned int                                          first_node)
    {
      std::array<int, stencil_size<dim>(pattern)> result;
      for (int A = 0; A < stencil_size<dim>(pattern); ++A)
        result[A] = nodes.local(first_node + offsets[A]);
      return result;
    }

    /** Runs a function over all points as visit(slot, local nodes, basis). */
    template <int dim, typename Visit>
    struct ForEachPoint
    {
      const Patch<dim>                      &patch;
      const Visit                           &visit;
      const typename StepPoints<dim>::Batch *batch;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        std::array<int, stencil_size<dim>(pattern)> local{};
        for (unsigned int slot = batch->begin; slot < batch->end; ++slot)
          {
            const Stencil<dim> &s = patch.points.stencil[slot];
            if (slot == batch->begin || s.first_node != patch.points.stencil[slot - 1].first_node)
              local = local_nodes<dim, pattern>(patch.nodes, offsets, s.first_node);
            visit(slot, local, expand<dim, pattern>(s));
          }
      }
    };

    template <int dim, typename Visit>
    void
    for_each_point(const Patch<dim> &patch, const Visit &visit)
    {
      for (const auto &batch : patch.points.batches)
        dispatch_pattern<dim>(batch.pattern, ForEachPoint<dim, Visit>{patch, visit, &batch});
    }

    /**
     * Assembles sum_p w N_A N_B of a batch, or that of the gradients; points with
     * the same nodes are summed first.
     */
    template <int dim, bool of_gradients>
    struct AssembleProducts
    {
      const Patch<dim>                      &patch;
      const std::vector<double>             &weights;
      NodeMatrix<dim>                       &mass;
      const typename StepPoints<dim>::Batch *batch;

      template <unsigned int pattern>
      void
      run() const
      {
        constexpr int n       = stencil_size<dim>(pattern);
        const auto    offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        const auto    rows    = row_slots<dim, pattern>(mass);
        // GCC 12 takes it for aligned where it has not made it so
        alignas(64) double sum[n][n];
        for (unsigned int slot = batch->begin; slot < batch->end;)
          {
            const unsigned int first = patch.points.stencil[slot].first_node;
            for (auto &row : sum)
              std::fill(std::begin(row), std::end(row), 0.);
            for (; slot < batch->end && patch.points.stencil[slot].first_node == first; ++slot)
              {
                const auto basis = expand<dim, pattern>(patch.points.stencil[slot]);
                const auto add   = [&](const double *factor) {
                  for (int A = 0; A < n; ++A)
                    {
                      const double weighted = weights[slot] * factor[A];
                      for (int B = 0; B < n; ++B)
                        sum[A][B] += weighted * factor[B];
                    }
                };
                if constexpr (of_gradients)
                  for (int d = 0; d < dim; ++d)
                    add(basis.gradient[d]);
                else
                  add(basis.value);
              }
            const auto local = local_nodes<dim, pattern>(patch.nodes, offsets, first);
            for (int A = 0; A < n; ++A)
              add_to_row<dim, pattern, 1>(rows[A], sum[A], mass.row(local[A], 0));
          }
      }
    };
  } // namespace



  template <int dim>
  void
  assemble_mass(const Patch<dim> &patch, NodeMatrix<dim> &mass)
  {
    assemble_mass(patch, patch.points.mass, mass);
  }



  template <int dim>
  void
  assemble_mass(const Patch<dim> &patch, const std::vector<double> &weights, NodeMatrix<dim> &mass)
  {
    mass.set_zero();
    for (const auto &batch : patch.points.batches)
      dispatch_pattern<dim>(batch.pattern,
                            AssembleProducts<dim, false>{patch, weights, mass, &batch});
  }



  template <int dim>
  void
  assemble_laplacian(const Patch<dim>          &patch,
                     const std::vector<double> &weights,
                     NodeMatrix<dim>           &laplacian)
  {
    laplacian.set_zero();
    for (const auto &batch : patch.points.batches)
      dispatch_pattern<dim>(batch.pattern,
                            AssembleProducts<dim, true>{patch, weights, laplacian, &batch});
  }



  template <int dim>
  void
  blend_mass(const double epsilon, NodeMatrix<dim> &mass, const unsigned int n_rows)
  {
    if (epsilon == 0.)
      return;
    LatticeIndex<dim>  zero{};
    const unsigned int diagonal = mass.slot(zero);
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        double *row    = mass.row(i, 0);
        double  lumped = 0.;
        for (unsigned int s = 0; s < mass.n_slots(); ++s)
          {
            lumped += row[s];
            row[s] *= 1. - epsilon;
          }
        row[diagonal] += epsilon * lumped;
      }
  }



  template <int dim>
  void
  add_to_nodes(const Patch<dim>                          &patch,
               const std::vector<double>                 &weights,
               const std::vector<dealii::Tensor<1, dim>> &values,
               std::vector<double>                       &sums)
  {
    for_each_point(patch, [&](const unsigned int slot, const auto &local, const auto &basis) {
      const dealii::Tensor<1, dim> weighted = weights[slot] * values[slot];
      for (std::size_t A = 0; A < local.size(); ++A)
        for (int d = 0; d < dim; ++d)
          sums[std::size_t(local[A]) * dim + d] += basis.value[A] * weighted[d];
    });
  }



  template <int dim>
  void
  add_scalars_to_nodes(const Patch<dim>          &patch,
                       const std::vector<double> &values,
                       const unsigned int         n_values,
                       std::vector<double>       &sums)
  {
    for_each_point(patch, [&](const unsigned int slot, const auto &local, const auto &basis) {
      for (std::size_t A = 0; A < local.size(); ++A)
        for (unsigned int k = 0; k < n_values; ++k)
          sums[std::size_t(local[A]) * n_values + k] +=
            basis.value[A] * values[std::size_t(slot) * n_values + k];
    });
  }



  template <int dim>
  void
  interpolate_to_points(const Patch<dim>                    &patch,
                        const std::vector<double>           &nodal,
                        std::vector<dealii::Tensor<1, dim>> &at_points)
  {
    at_points.resize(patch.points.size());
    for_each_point(patch, [&](const unsigned int slot, const auto &local, const auto &basis) {
      dealii::Tensor<1, dim> value;
      for (std::size_t A = 0; A < local.size(); ++A)
        for (int d = 0; d < dim; ++d)
          value[d] += basis.value[A] * nodal[std::size_t(local[A]) * dim + d];
      at_points[slot] = value;
    });
  }



  template <int dim>
  void
  gradients_at_points(const Patch<dim>                    &patch,
                      const std::vector<double>           &nodal,
                      std::vector<dealii::Tensor<2, dim>> &gradients)
  {
    gradients.resize(patch.points.size());
    for_each_point(patch, [&](const unsigned int slot, const auto &local, const auto &basis) {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            double sum = 0.;
            for (std::size_t A = 0; A < local.size(); ++A)
              sum += nodal[std::size_t(local[A]) * dim + i] * basis.gradient[j][A];
            gradients[slot][i][j] = sum;
          }
    });
  }



  template <int dim>
  void
  multiply(const NodeMatrix<dim>     &matrix,
           const Patch<dim>          &patch,
           const unsigned int         n_components,
           const std::vector<double> &x,
           std::vector<double>       &y)
  {
    // a matrix with one component acts alike on all components of x
    const std::vector<int> strides = matrix.slot_strides(patch.window());
    std::fill(y.begin(), y.end(), 0.);
    const int n_window = static_cast<int>(patch.window().n_nodes_total());
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      {
        const double *row = matrix.row(i, 0);
        for (unsigned int s = 0; s < matrix.n_slots(); ++s)
          if (row[s] != 0.)
            {
              const int neighbour = static_cast<int>(patch.nodes.window_node(i)) + strides[s];
              if (neighbour < 0 || neighbour >= n_window)
                continue;
              const int j = patch.nodes.local(neighbour);
              if (j < 0)
                continue;
              for (unsigned int c = 0; c < n_components; ++c)
                y[std::size_t(i) * n_components + c] +=
                  row[s] * x[std::size_t(j) * n_components + c];
            }
      }
  }

  template <int dim>
  void
  add_product(const Patch<dim>          &patch,
              const double               factor,
              const NodeMatrix<dim>     &matrix,
              const std::vector<double> &x,
              std::vector<double>       &sums)
  {
    std::vector<double> Ax(x.size());
    multiply(matrix, patch, dim, x, Ax);
    const std::size_t n_components = patch.n_components();
    for (std::size_t i = 0; i < x.size() / dim; ++i)
      for (int d = 0; d < dim; ++d)
        sums[i * n_components + d] += factor * Ax[i * dim + d];
  }

  template <int dim>
  std::vector<unsigned int>
  node_neighbours(const NodeMatrix<dim> &matrix, const Patch<dim> &patch)
  {
    std::vector<unsigned int> neighbours(std::size_t(patch.nodes.n_local()) * matrix.n_slots());
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      {
        unsigned int *row = &neighbours[std::size_t(i) * matrix.n_slots()];
        std::fill_n(row, matrix.n_slots(), i);
        for_neighbours(patch,
                       i,
                       matrix,
                       [&](const unsigned int slot, const unsigned int neighbour) {
                         row[slot] = neighbour;
                       });
      }
    return neighbours;
  }



  namespace
  {
    /** y = A x for the values [first, n_values) of each node. */
    template <unsigned int first, unsigned int n_values, int dim>
    void
    multiply_values(const NodeMatrix<dim>           &matrix,
                    const std::vector<unsigned int> &neighbours,
                    const std::vector<double>       &x,
                    std::vector<double>             &y)
    {
      constexpr unsigned int n       = n_values - first;
      const unsigned int     n_slots = matrix.n_slots();
      const std::size_t      n_nodes = neighbours.size() / n_slots;
      for (std::size_t i = 0; i < n_nodes; ++i)
        {
          const double       *row       = matrix.row(i, 0);
          const unsigned int *neighbour = &neighbours[i * n_slots];
          double              sum[n]    = {};
          for (unsigned int s = 0; s < n_slots; ++s)
            for (unsigned int d = 0; d < n; ++d)
              sum[d] += row[s] * x[std::size_t(neighbour[s]) * n_values + first + d];
          for (unsigned int d = 0; d < n; ++d)
            y[i * n_values + first + d] = sum[d];
        }
    }
  } // namespace



  template <int dim>
  void
  multiply_velocities(const NodeMatrix<dim>           &matrix,
                      const std::vector<unsigned int> &neighbours,
                      const std::vector<double>       &x,
                      std::vector<double>             &y)
  {
    multiply_values<0, dim>(matrix, neighbours, x, y);
  }



  template <int dim>
  void
  multiply_pressures(const NodeMatrix<dim>           &matrix,
                     const std::vector<unsigned int> &neighbours,
                     const std::vector<double>       &x,
                     std::vector<double>             &y)
  {
    multiply_values<dim, dim + 1>(matrix, neighbours, x, y);
  }

#define KEDGE_INSTANTIATE(dim)                                                                     \
  template void assemble_mass(const Patch<dim> &, NodeMatrix<dim> &);                              \
  template void assemble_mass(const Patch<dim> &, const std::vector<double> &, NodeMatrix<dim> &); \
  template void assemble_laplacian(const Patch<dim> &,                                             \
                                   const std::vector<double> &,                                    \
                                   NodeMatrix<dim> &);                                             \
  template void blend_mass(const double, NodeMatrix<dim> &, const unsigned int);                   \
  template void add_to_nodes(const Patch<dim> &,                                                   \
                             const std::vector<double> &,                                          \
                             const std::vector<dealii::Tensor<1, dim>> &,                          \
                             std::vector<double> &);                                               \
  template void add_scalars_to_nodes(const Patch<dim> &,                                           \
                                     const std::vector<double> &,                                  \
                                     const unsigned int,                                           \
                                     std::vector<double> &);                                       \
  template void interpolate_to_points(const Patch<dim> &,                                          \
                                      const std::vector<double> &,                                 \
                                      std::vector<dealii::Tensor<1, dim>> &);                      \
  template void gradients_at_points(const Patch<dim> &,                                            \
                                    const std::vector<double> &,                                   \
                                    std::vector<dealii::Tensor<2, dim>> &);                        \
  template std::vector<unsigned int> node_neighbours(const NodeMatrix<dim> &, const Patch<dim> &); \
  template void                      multiply_velocities(const NodeMatrix<dim> &,                  \
                                                         const std::vector<unsigned int> &,        \
                                                         const std::vector<double> &,              \
                                                         std::vector<double> &);                   \
  template void                      multiply_pressures(const NodeMatrix<dim> &,                   \
                                                        const std::vector<unsigned int> &,         \
                                                        const std::vector<double> &,               \
                                                        std::vector<double> &);                    \
  template void                      add_product(const Patch<dim> &,                               \
                                                 const double,                                     \
                                                 const NodeMatrix<dim> &,                          \
                                                 const std::vector<double> &,                      \
                                                 std::vector<double> &);                           \
  template void                      multiply(const NodeMatrix<dim> &,                             \
                                              const Patch<dim> &,                                  \
                                              const unsigned int,                                  \
                                              const std::vector<double> &,                         \
                                              std::vector<double> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
