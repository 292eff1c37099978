// A small cloud of material points in random states on a background grid.
#ifndef kedge_tests_transfer_cloud_h
#define kedge_tests_transfer_cloud_h

#include "../stress/random_states.h"

#include <kedge/fields/patch.h>
#include <kedge/transfer/node_sums.h>

namespace kedge::test
{
  /** Cells of 0.7 x 0.5 x 0.6 m, the origin off zero. */
  template <int dim>
  GridParameters<dim>
  some_grid(const std::array<unsigned int, dim> &n_cells)
  {
    const double        h[3] = {0.7, 0.5, 0.6}, origin[3] = {-0.3, 0.2, 1.1};
    GridParameters<dim> parameters;
    for (int d = 0; d < dim; ++d)
      {
        parameters.origin[d]  = origin[d];
        parameters.extent[d]  = h[d] * n_cells[d];
        parameters.n_cells[d] = n_cells[d];
      }
    return parameters;
  }

  /**
   * Two bodies in a block of cells of a larger box, points_per_direction^dim
   * points in each cell at random places; every rank makes all of them, so
   * that the cloud does not depend on the number of ranks. All that reads a
   * cloud as dense arrays does so by the points' ids.
   */
  template <int dim>
  class Cloud
  {
  public:
    Cloud(const std::vector<BasisKind> &basis_of_body,
          const unsigned int            points_per_direction,
          const unsigned int            seed,
          const int                     block_width  = 2,
          const double                  threshold    = 0.,
          const unsigned int            n_components = dim)
      : basis_of_body(basis_of_body)
      , grid(some_grid<dim>(box()), MPI_COMM_WORLD)
      , patch(grid, patch_parameters(basis_of_body, threshold, n_components), {{}, {}})
      , step(patch.points)
      , nodes(patch.nodes)
      , conditions(patch.conditions)
      , ties(patch.ties)
    {
      make_records(basis_of_body.size(), points_per_direction, seed, block_width);
      const bool first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      points.distribute(grid, first_rank ? records : std::vector<PointRecord<dim>>());
      patch.reinit(points, [](std::vector<unsigned char> &) {});
    }

    /** Takes other node conditions. */
    void
    prescribe(const NodeConditions<dim> &new_conditions)
    {
      patch.conditions = new_conditions;
      patch.conditions.reinit(grid, nodes);
      patch.ties.localise(nodes, patch.conditions);
      patch.constraints.reinit(nodes, patch.conditions, ties, patch.n_components());
    }

    const LatticeWindow<dim> &
    window() const
    {
      return grid.window();
    }

    /** Where a local node stands. */
    dealii::Point<dim>
    node_position(const unsigned int local) const
    {
      return grid.lattice().node_position(window().node_index(nodes.window_node(local)));
    }

    /** A value for each local node, component and kind; the same on all ranks. */
    std::vector<double>
    random_nodal(const double size, const unsigned int kind, const unsigned int width = dim) const
    {
      std::vector<double> result(std::size_t(nodes.n_local()) * width);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        {
          std::mt19937 generator(1000 * kind + nodes.window_node(i));
          for (unsigned int c = 0; c < width; ++c)
            result[std::size_t(i) * width + c] =
              size * std::uniform_real_distribution<double>(-1, 1)(generator);
        }
      return result;
    }

    /** Of the bodies 0 and 1. */
    static Hencky
    material(const unsigned int body)
    {
      MaterialParameters parameters;
      parameters.young_modulus = body == 0 ? 2.6 : 5.; // G = 1 for body 0
      parameters.poisson_ratio = body == 0 ? 0.3 : 0.;
      return Hencky(parameters);
    }

    const std::vector<BasisKind>  basis_of_body;
    std::vector<PointRecord<dim>> records; ///< of all points, on all ranks
    BackgroundGrid<dim>           grid;
    MaterialPoints<dim>           points;
    Patch<dim>                    patch; ///< nodes below the threshold, in cells, are tied
    StepPoints<dim>              &step;
    ActiveNodes<dim>             &nodes;
    NodeConditions<dim>          &conditions;
    NodeTies<dim>                &ties;

  private:
    static PatchParameters
    patch_parameters(const std::vector<BasisKind> &basis_of_body,
                     const double                  threshold,
                     const unsigned int            n_components)
    {
      PatchParameters parameters;
      parameters.basis_of_body    = basis_of_body;
      parameters.smallest_filling = threshold;
      parameters.n_components     = n_components;
      return parameters;
    }

    static std::array<unsigned int, dim>
    box()
    {
      std::array<unsigned int, dim> n_cells;
      for (int d = 0; d < dim; ++d)
        n_cells[d] = 12 - 2 * d;
      return n_cells;
    }

    void
    make_records(const unsigned int n_bodies,
                 const unsigned int points_per_direction,
                 const unsigned int seed,
                 const int          block_width)
    {
      RandomStates<dim>  random(seed);
      LatticeWindow<dim> block;
      unsigned int       n_per_cell = 1;
      for (int d = 0; d < dim; ++d)
        {
          block.low[d]     = 3;
          block.n_cells[d] = block_width;
          n_per_cell *= points_per_direction;
        }
      for (unsigned int c = 0; c < block.n_cells_total(); ++c)
        for (unsigned int k = 0; k < n_per_cell; ++k)
          {
            const auto       cell = block.cell_index(c);
            PointRecord<dim> record;
            record.id               = records.size();
            const unsigned int body = records.size() % n_bodies;
            record.state            = random.point(Spectrum::apart, material(body));
            for (int d = 0; d < dim; ++d)
              {
                record.location[d] = grid.lattice().origin[d] +
                                     (cell[d] + random.uniform(0., 1.)) * grid.lattice().h[d];
                record.state.half_lengths[d] = random.uniform(0.1, 0.5) * grid.lattice().h[d];
                record.state.velocity[d]     = random.uniform(-1., 1.);
              }
            record.state.body             = body;
            record.state.mass             = random.uniform(0.5, 2.);
            record.state.reference_volume = random.uniform(0.01, 0.02);
            records.push_back(record);
          }
      grid.cover(block, std::vector<unsigned int>(block.n_cells_total(), n_per_cell));
    }
  };
} // namespace kedge::test

#endif
