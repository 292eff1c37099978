#include <kedge/transfer/ghost_penalty.h>

namespace kedge
{
  namespace
  {
    /** What a cell holds of the material points, of all ranks. */
    enum CellContent
    {
      present_volume,
      reference_volume,
      mass_sum,
      modulus_times_volume, ///< with the reference volume
      n_contents
    };

    /** Cell contents, n_contents per cell of the window (collective). */
    template <int dim>
    std::vector<double>
    cell_contents(const Patch<dim> &patch, const std::vector<double> &modulus_of_body)
    {
      std::vector<double> contents(std::size_t(patch.window().n_cells_total()) * n_contents, 0.);
      for (const auto &batch : patch.points.batches)
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const Stencil<dim>     &s     = patch.points.stencil[slot];
            const LatticeIndex<dim> first = patch.window().node_index(s.first_node);
            for (unsigned int v = 0; v < (1u << dim); ++v)
              {
                LatticeIndex<dim> cell = first;
                double            part = 1.;
                for (int d = 0; d < dim; ++d)
                  {
                    const bool is_upper = ((v >> d) & 1u) != 0;
                    cell[d] += s.lower_cell[d] + (is_upper ? 1 : 0);
                    part *= is_upper ? 1. - s.lower_part[d] : s.lower_part[d];
                  }
                if (part == 0.)
                  continue;
                const double volume = part * patch.points.volume[slot];
                double      *content =
                  &contents[std::size_t(patch.window().cell_number(cell)) * n_contents];
                content[present_volume] += volume * patch.points.determinant[slot];
                content[reference_volume] += volume;
                content[mass_sum] += part * patch.points.mass[slot];
                content[modulus_times_volume] += volume * modulus_of_body[batch.body];
              }
          }
      if (dealii::Utilities::MPI::n_mpi_processes(patch.grid().communicator()) > 1)
        MPI_Allreduce(MPI_IN_PLACE,
                      contents.data(),
                      static_cast<int>(contents.size()),
                      MPI_DOUBLE,
                      MPI_SUM,
                      patch.grid().communicator());
      return contents;
    }

    /** Lattice offsets of a face's nodes from the lowest corner of its lower cell. */
    template <int dim>
    std::vector<LatticeIndex<dim>>
    face_nodes(const unsigned int direction)
    {
      std::vector<LatticeIndex<dim>> result(1, LatticeIndex<dim>{});
      for (unsigned int d = 0; d < dim; ++d)
        {
          const std::size_t n = result.size(); // x fastest
          for (int i = 1; i < (d == direction ? 3 : 2); ++i)
            for (std::size_t k = 0; k < n; ++k)
              {
                result.push_back(result[k]);
                result.back()[d] = i;
              }
        }
      return result;
    }

    template <int dim>
    LatticeIndex<dim>
    shifted(const LatticeIndex<dim> &a, const LatticeIndex<dim> &b)
    {
      LatticeIndex<dim> sum;
      for (int d = 0; d < dim; ++d)
        sum[d] = a[d] + b[d];
      return sum;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  ghost_face_matrix(const dealii::Tensor<1, dim> &h, const unsigned int direction)
  {
    constexpr double jump[3]           = {1., -2., 1.}; // of dN/dn, times h
    constexpr double linear_mass[2][2] = {{1. / 3., 1. / 6.}, {1. / 6., 1. / 3.}};

    const auto          nodes = face_nodes<dim>(direction);
    std::vector<double> matrix;
    for (const auto &A : nodes)
      for (const auto &B : nodes)
        {
          double entry = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            entry *=
              d == direction ? h[d] / 3. * jump[A[d]] * jump[B[d]] : h[d] * linear_mass[A[d]][B[d]];
          matrix.push_back(entry);
        }
    return matrix;
  }



  template <int dim>
  void
  GhostPenalty<dim>::find(const Patch<dim>           &patch,
                          const std::vector<double>  &modulus_of_body,
                          std::vector<unsigned char> &reached)
  {
    faces_.clear();
    const std::vector<double> contents = cell_contents(patch, modulus_of_body);
    double                    full     = full_cell;
    for (int d = 0; d < dim; ++d)
      full *= patch.grid().lattice().h[d];
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(patch.grid().communicator());
    for (unsigned int c = 0; c < patch.window().n_cells_total(); ++c)
      {
        const double *lower = &contents[std::size_t(c) * n_contents];
        if (lower[present_volume] == 0.)
          continue;
        const LatticeIndex<dim> cell = patch.window().cell_index(c);
        if (patch.grid().cell_owner(cell) != rank)
          continue;
        for (unsigned int d = 0; d < dim; ++d)
          {
            LatticeIndex<dim> neighbour = cell;
            ++neighbour[d];
            if (!patch.window().contains_cell(neighbour))
              continue;
            const double *upper =
              &contents[std::size_t(patch.window().cell_number(neighbour)) * n_contents];
            if (upper[present_volume] == 0. ||
                std::min(lower[present_volume], upper[present_volume]) >= full)
              continue;
            const double volume = lower[reference_volume] + upper[reference_volume];
            faces_.push_back(
              {c,
               d,
               (lower[mass_sum] + upper[mass_sum]) / volume,
               (lower[modulus_times_volume] + upper[modulus_times_volume]) / volume});
            for (const auto &offset : face_nodes<dim>(d))
              reached[patch.window().node_number(shifted<dim>(cell, offset))] = 1;
          }
      }
  }



  template <int dim>
  void
  GhostPenalty<dim>::add(const Patch<dim>                               &patch,
                         const std::function<double(const GhostFace &)> &coefficient,
                         NodeMatrix<dim>                                &matrix) const
  {
    std::array<std::vector<double>, dim>            entries;
    std::array<std::vector<LatticeIndex<dim>>, dim> offsets;
    for (unsigned int d = 0; d < dim; ++d)
      {
        entries[d] = ghost_face_matrix<dim>(patch.grid().lattice().h, d);
        offsets[d] = face_nodes<dim>(d);
      }
    for (const GhostFace &face : faces_)
      {
        const auto  &face_offsets = offsets[face.direction];
        const auto   cell         = patch.window().cell_index(face.lower_cell);
        const double scale        = coefficient(face);
        auto         entry        = entries[face.direction].begin();
        for (const auto &A : face_offsets)
          {
            double *row =
              matrix.row(patch.nodes.local(patch.window().node_number(shifted<dim>(cell, A))), 0);
            for (const auto &B : face_offsets)
              {
                LatticeIndex<dim> offset;
                for (int d = 0; d < dim; ++d)
                  offset[d] = B[d] - A[d];
                row[matrix.slot(offset)] += scale * *entry++;
              }
          }
      }
  }



  template <int dim>
  void
  GhostPenalty<dim>::add_mass(const Patch<dim> &patch,
                              const double      factor,
                              NodeMatrix<dim>  &mass) const
  {
    add(
      patch,
      [&](const GhostFace &face) {
        return factor * face.density;
      },
      mass);
  }



  template <int dim>
  void
  GhostPenalty<dim>::add_stiffness(const Patch<dim> &patch,
                                   const double      factor,
                                   NodeMatrix<dim>  &stiffness) const
  {
    const auto &h = patch.grid().lattice().h;
    add(
      patch,
      [&](const GhostFace &face) {
        return factor * face.modulus / (h[face.direction] * h[face.direction]);
      },
      stiffness);
  }



  template <int dim>
  void
  GhostPenalty<dim>::add_gradient_penalty(const Patch<dim> &patch,
                                          const double      factor,
                                          NodeMatrix<dim>  &matrix) const
  {
    const auto &h = patch.grid().lattice().h;
    add(
      patch,
      [&](const GhostFace &face) {
        return factor / (h[face.direction] * h[face.direction]);
      },
      matrix);
  }



  template <int dim>
  void
  GhostPenalty<dim>::add_value_penalty(const Patch<dim> &patch,
                                       const double      factor,
                                       NodeMatrix<dim>  &matrix) const
  {
    add(
      patch,
      [&](const GhostFace &) {
        return factor;
      },
      matrix);
  }



  template <int dim>
  double
  lumped_mass_ratio(const Patch<dim> &patch, const NodeMatrix<dim> &mass)
  {
    std::vector<double> lumped(patch.nodes.n_local(), 0.);
    for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
      for (unsigned int s = 0; s < mass.n_slots(); ++s)
        lumped[i] += mass.row(i, 0)[s];
    patch.nodes.add_to_owners(lumped, 1);
    double smallest = std::numeric_limits<double>::max(), largest = 0.;
    for (unsigned int i = 0; i < patch.nodes.n_owned(); ++i)
      {
        smallest = std::min(smallest, lumped[i]);
        largest  = std::max(largest, lumped[i]);
      }
    smallest = dealii::Utilities::MPI::min(smallest, patch.nodes.communicator());
    largest  = dealii::Utilities::MPI::max(largest, patch.nodes.communicator());
    return smallest / largest;
  }

#define KEDGE_INSTANTIATE(dim)                                                                      \
  template std::vector<double> ghost_face_matrix<dim>(const dealii::Tensor<1, dim> &,               \
                                                      const unsigned int);                          \
  template double              lumped_mass_ratio<dim>(const Patch<dim> &, const NodeMatrix<dim> &); \
  template class GhostPenalty<dim>;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
