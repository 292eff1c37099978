#include "mixed_preconditioner.h"

#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>

#include <algorithm>
#include <numeric>

namespace kedge
{
  namespace
  {
    /** Marks the first equation of a node. */
    constexpr unsigned char node_begins = 128;

    bool
    begins_node(const MixedBlocks &blocks, const std::size_t row)
    {
      return row == 0 || blocks.component[row] <= blocks.component[row - 1] ||
             !std::equal(blocks.position.begin() + row * blocks.dim,
                         blocks.position.begin() + (row + 1) * blocks.dim,
                         blocks.position.begin() + (row - 1) * blocks.dim);
    }

    /** What all ranks know of their rows, one byte each. */
    std::vector<unsigned char>
    gather(const std::vector<unsigned char> &own, const SparseSystem &system)
    {
      int n_ranks = 1;
      MPI_Comm_size(system.communicator, &n_ranks);
      std::vector<int> counts(n_ranks), offsets(n_ranks, 0);
      const int        n = static_cast<int>(own.size());
      MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, system.communicator);
      std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
      std::vector<unsigned char> all(system.n_global);
      MPI_Allgatherv(own.data(),
                     n,
                     MPI_UNSIGNED_CHAR,
                     all.data(),
                     counts.data(),
                     offsets.data(),
                     MPI_UNSIGNED_CHAR,
                     system.communicator);
      return all;
    }

    std::unique_ptr<Epetra_CrsMatrix>
    make_matrix(const MPI_Comm          communicator,
                const int               n_global,
                const std::vector<int> &row_lengths)
    {
      const Epetra_MpiComm epetra_communicator(communicator);
      const Epetra_Map map(n_global, static_cast<int>(row_lengths.size()), 0, epetra_communicator);
      return std::make_unique<Epetra_CrsMatrix>(Copy, map, row_lengths.data());
    }
  } // namespace



  void
  MixedPreconditioner::analyse(const SparseSystem &system)
  {
    dim = blocks.dim;
    std::vector<unsigned char> own(blocks.component);
    for (std::size_t i = 0; i < own.size(); ++i)
      if (begins_node(blocks, i))
        own[i] |= node_begins;
    const auto all = gather(own, system);

    place.resize(all.size());
    n_pressures = n_displacements = n_global_pressures = n_global_displacements = 0;
    first_pressure = first_displacement = 0;
    bool node_has_place                 = false;
    for (std::size_t e = 0; e <= all.size(); ++e)
      {
        const auto row = static_cast<std::int64_t>(e);
        if (row == system.first_row)
          {
            first_pressure     = n_global_pressures;
            first_displacement = n_global_displacements;
          }
        if (row == system.first_row + system.n_rows())
          {
            n_pressures     = n_global_pressures - first_pressure;
            n_displacements = n_global_displacements - first_displacement;
          }
        if (e == all.size())
          break;
        if (all[e] & node_begins)
          node_has_place = false;
        const int component = all[e] & ~node_begins;
        if (component == dim)
          place[e] = n_global_pressures++;
        else
          {
            if (!node_has_place)
              n_global_displacements += dim;
            node_has_place = true;
            place[e]       = -1 - (n_global_displacements - dim + component);
          }
      }
  }



  std::unique_ptr<Epetra_CrsMatrix>
  MixedPreconditioner::displacement_matrix(const DistributedMatrix &matrix) const
  {
    const SparseSystem &system = matrix.values();
    const auto         &scale  = matrix.scaling();
    std::vector<int>    lengths(n_displacements, 1);
    for (unsigned int i = 0; i < system.n_rows(); ++i)
      if (place[system.first_row + i] < 0)
        lengths[-1 - place[system.first_row + i] - first_displacement] =
          static_cast<int>(system.row_start[i + 1] - system.row_start[i]);
    auto result = make_matrix(system.communicator, n_global_displacements, lengths);

    std::vector<unsigned char> is_unknown(n_displacements, 0);
    std::vector<int>           columns;
    std::vector<double>        values;
    for (unsigned int i = 0; i < system.n_rows(); ++i)
      {
        const int row = -1 - place[system.first_row + i];
        if (row < 0)
          continue;
        columns.clear();
        values.clear();
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          if (place[system.column[k]] < 0 && system.value[k] != 0.)
            {
              columns.push_back(-1 - place[system.column[k]]);
              values.push_back(scale[i] * scale[matrix.columns()[k]] * system.value[k]);
            }
        is_unknown[row - first_displacement] = 1;
        result->InsertGlobalValues(row,
                                   static_cast<int>(columns.size()),
                                   values.data(),
                                   columns.data());
      }
    const double one = 1.;
    for (int k = 0; k < n_displacements; ++k)
      if (!is_unknown[k])
        {
          const int row = first_displacement + k;
          result->InsertGlobalValues(row, 1, &one, &row);
        }
    result->FillComplete();
    result->OptimizeStorage();
    return result;
  }



  std::unique_ptr<Epetra_CrsMatrix>
  MixedPreconditioner::pressure_matrix(const DistributedMatrix &matrix,
                                       const SparseSystem      &added) const
  {
    const SparseSystem &system = matrix.values();
    const auto         &scale  = matrix.scaling();
    std::vector<int>    lengths(n_pressures, 0);
    for (unsigned int i = 0; i < system.n_rows(); ++i)
      if (place[system.first_row + i] >= 0)
        lengths[place[system.first_row + i] - first_pressure] =
          static_cast<int>(system.row_start[i + 1] - system.row_start[i]);
    auto result = make_matrix(system.communicator, n_global_pressures, lengths);

    std::vector<int>    columns;
    std::vector<double> values;
    for (unsigned int i = 0; i < system.n_rows(); ++i)
      {
        const int row = place[system.first_row + i];
        if (row < 0)
          continue;
        columns.clear();
        values.clear();
        // both matrices have the columns of a row in the same order
        std::int64_t       next = added.row_start[row - first_pressure];
        const std::int64_t end  = added.row_start[row - first_pressure + 1];
        for (std::int64_t k = system.row_start[i]; k < system.row_start[i + 1]; ++k)
          if (place[system.column[k]] >= 0)
            {
              const int column = place[system.column[k]];
              double    value  = system.value[k];
              while (next < end && added.column[next] < column)
                ++next;
              if (next < end && added.column[next] == column)
                value += added.value[next];
              columns.push_back(column);
              values.push_back(scale[i] * scale[matrix.columns()[k]] * value);
            }
        result->InsertGlobalValues(row,
                                   static_cast<int>(columns.size()),
                                   values.data(),
                                   columns.data());
      }
    result->FillComplete();
    result->OptimizeStorage();
    return result;
  }



  /** Translations and rotations of the scaled unknowns, zero at those that are none. */
  std::vector<double>
  MixedPreconditioner::rigid_motions(const DistributedMatrix &matrix) const
  {
    const int           n_rotations = dim == 2 ? 1 : 3;
    const auto          n           = static_cast<std::size_t>(n_displacements);
    std::vector<double> motions((dim + n_rotations) * n, 0.);
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      {
        const int row = -1 - place[matrix.values().first_row + i];
        if (row < 0)
          continue;
        const std::size_t k         = row - first_displacement;
        const int         component = blocks.component[i];
        const double      unscaled  = 1. / matrix.scaling()[i];
        motions[component * n + k]  = unscaled;
        for (int r = 0; r < n_rotations; ++r)
          {
            const int a = dim == 2 ? 0 : (r + 1) % 3, b = dim == 2 ? 1 : (r + 2) % 3;
            if (component == a)
              motions[(dim + r) * n + k] = -unscaled * blocks.position[i * dim + b];
            if (component == b)
              motions[(dim + r) * n + k] = unscaled * blocks.position[i * dim + a];
          }
      }
    return motions;
  }



  void
  MixedPreconditioner::factorise(const DistributedMatrix &matrix)
  {
    displacements.reinit(displacement_matrix(matrix), dim, rigid_motions(matrix), dim == 2 ? 3 : 6);
    u.resize(n_displacements);
    residual_u.resize(n_displacements);
    if (n_global_pressures == 0)
      return;
    std::vector<double> constant(n_pressures);
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      if (place[matrix.values().first_row + i] >= 0)
        constant[place[matrix.values().first_row + i] - first_pressure] = 1. / matrix.scaling()[i];
    pressures.reinit(pressure_matrix(matrix, blocks.by_stiffness), 1, constant, 1);
    with_inertia = !blocks.by_inertia.column.empty();
    if (with_inertia)
      inertial_pressures.reinit(pressure_matrix(matrix, blocks.by_inertia), 1, constant, 1);
    p.resize(n_pressures);
    residual_p.resize(n_pressures);
    padded.resize(matrix.n_rows());
    product.resize(matrix.n_rows());
  }



  /** Pressures first, and what is left then for the displacements. */
  void
  MixedPreconditioner::multiply(const DistributedMatrix &matrix, const double *x, double *y)
  {
    const unsigned int n     = matrix.n_rows();
    const int         *where = place.data() + matrix.values().first_row;
    std::fill(residual_u.begin(), residual_u.end(), 0.);
    if (n_global_pressures == 0)
      product.assign(n, 0.);
    else
      multiply_pressures(matrix, x);
    for (unsigned int i = 0; i < n; ++i)
      if (where[i] < 0)
        residual_u[-1 - where[i] - first_displacement] = x[i] - product[i];
    displacements.multiply(residual_u, u);
    for (unsigned int i = 0; i < n; ++i)
      y[i] = where[i] >= 0 ? p[where[i] - first_pressure] : u[-1 - where[i] - first_displacement];
  }



  /** p = S^-1 x_p, and its part G p in the residual of the displacements. */
  void
  MixedPreconditioner::multiply_pressures(const DistributedMatrix &matrix, const double *x)
  {
    const unsigned int n     = matrix.n_rows();
    const int         *where = place.data() + matrix.values().first_row;
    for (unsigned int i = 0; i < n; ++i)
      if (where[i] >= 0)
        residual_p[where[i] - first_pressure] = x[i];
    pressures.multiply(residual_p, p);
    if (with_inertia)
      {
        inertial_pressures.multiply(residual_p, more);
        for (int k = 0; k < n_pressures; ++k)
          p[k] += more[k];
      }
    for (unsigned int i = 0; i < n; ++i)
      padded[i] = where[i] >= 0 ? p[where[i] - first_pressure] : 0.;
    matrix.multiply(padded.data(), product.data());
  }
} // namespace kedge
