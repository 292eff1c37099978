#ifndef kedge_tests_solvers_elastic_block_h
#define kedge_tests_solvers_elastic_block_h

#include <kedge/solvers/mixed_blocks.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace kedge
{
  /**
   * The stiffness of elastic material points, eight to a unit cell before they move, with trilinear
   * displacements: what a tangent of kedge looks like. Held are the nodes of the lowest layer of
   * cells' floor and those with little material, which kedge would tie to others. Ranks have layers
   * of nodes of their own; x runs first.
   */
  struct ElasticBlock
  {
    using Place = std::array<double, 3>;

    std::array<int, 3> n_cells = {{8, 8, 8}};

    /** Young's modulus at a point's first place; 0: there is no point. */
    std::function<double(const Place &)> modulus = [](const Place &) {
      return 1.;
    };

    /** Where a point stands. */
    std::function<Place(const Place &)> motion = [](const Place &x) {
      return x;
    };

    double poisson = 0.3;

    /** Unsymmetric part of the stress, as the conserving scheme has it [of the modulus]. */
    double twist = 0.;

    /** Volume of material below which a node is held [cells]. */
    double smallest_share = 0.02;

    SparseSystem system;
    MixedBlocks  nodes;

    /** Assembles all (each rank the whole, for it is small) and keeps this rank's rows. */
    void
    assemble()
    {
      rows.clear();
      share.clear();
      for (int k = 0; k < 2 * n_cells[2]; ++k)
        for (int j = 0; j < 2 * n_cells[1]; ++j)
          for (int i = 0; i < 2 * n_cells[0]; ++i)
            {
              const Place x = {{0.25 + 0.5 * i, 0.25 + 0.5 * j, 0.25 + 0.5 * k}};
              if (modulus(x) > 0.)
                add_point(motion(x), modulus(x));
            }
      const int        per_layer = (n_cells[0] + 1) * (n_cells[1] + 1);
      std::vector<int> number(3 * per_layer * (n_cells[2] + 1), -1);
      const int        me      = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const int        n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const auto       rank_of = [&](const int row) {
        return std::min(n_ranks - 1, row / 3 / per_layer * n_ranks / (n_cells[2] + 1));
      };
      system              = SparseSystem();
      system.communicator = MPI_COMM_WORLD;
      for (const auto &[row, entries] : rows)
        if (row / 3 >= per_layer && share[row / 3] > smallest_share)
          {
            if (rank_of(row) < me)
              ++system.first_row;
            number[row] = static_cast<int>(system.n_global++);
          }
      nodes     = MixedBlocks();
      nodes.dim = 3;
      for (const auto &[row, entries] : rows)
        if (number[row] >= 0 && rank_of(row) == me)
          keep_row(row, entries, number);
    }

    /** A load downwards, and a little to the side. */
    std::vector<double>
    load() const
    {
      std::vector<double> b;
      for (const auto component : nodes.component)
        b.push_back(component == 2 ? -1. : 0.1);
      return b;
    }

  private:
    int
    node_number(const std::array<int, 3> &cell, const int A) const
    {
      return ((cell[2] + ((A >> 2) & 1)) * (n_cells[1] + 1) + cell[1] + ((A >> 1) & 1)) *
               (n_cells[0] + 1) +
             cell[0] + (A & 1);
    }

    /** Adds the stiffness of a point: lambda a_i b_j + mu (b_i a_j + delta_ij a.b) and the twist.
     */
    void
    add_point(const Place &place, const double E)
    {
      const double       volume = 0.125;
      const double       lambda = E * poisson / ((1. + poisson) * (1. - 2. * poisson));
      const double       mu     = E / (2. * (1. + poisson));
      std::array<int, 3> cell;
      double             value[3][2];
      for (int d = 0; d < 3; ++d)
        {
          cell[d] = std::min(std::max(static_cast<int>(std::floor(place[d])), 0), n_cells[d] - 1);
          value[d][1] = place[d] - cell[d];
          value[d][0] = 1. - value[d][1];
        }
      double slope[8][3];
      for (int A = 0; A < 8; ++A)
        {
          const int bit[3] = {A & 1, (A >> 1) & 1, (A >> 2) & 1};
          for (int d = 0; d < 3; ++d)
            {
              slope[A][d] = bit[d] ? 1. : -1.;
              for (int e = 0; e < 3; ++e)
                if (e != d)
                  slope[A][d] *= value[e][bit[e]];
            }
          share[node_number(cell, A)] +=
            volume * value[0][bit[0]] * value[1][bit[1]] * value[2][bit[2]];
        }
      for (int A = 0; A < 8; ++A)
        for (int B = 0; B < 8; ++B)
          {
            const double *a = slope[A], *b = slope[B];
            const double  product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            const double  skew    = twist * E * (a[0] * b[2] - a[2] * b[0]);
            for (int c = 0; c < 3; ++c)
              for (int d = 0; d < 3; ++d)
                rows[3 * node_number(cell, A) + c][3 * node_number(cell, B) + d] +=
                  volume *
                  (lambda * a[c] * b[d] + mu * b[c] * a[d] + (c == d ? mu * product + skew : 0.));
          }
    }

    void
    keep_row(const int row, const std::map<int, double> &entries, const std::vector<int> &number)
    {
      for (const auto &[column, value] : entries)
        if (number[column] >= 0)
          {
            system.column.push_back(number[column]);
            system.value.push_back(value);
          }
      system.row_start.push_back(static_cast<std::int64_t>(system.column.size()));
      nodes.component.push_back(static_cast<unsigned char>(row % 3));
      const int node = row / 3, nx = n_cells[0] + 1, ny = n_cells[1] + 1;
      for (const int x : {node % nx, node / nx % ny, node / (nx * ny)})
        nodes.position.push_back(x);
    }

    std::map<int, std::map<int, double>> rows; ///< of columns 3 node + component
    std::map<int, double>                share;
  };
} // namespace kedge

#endif
