#include <kedge/base/exceptions.h>
#include <kedge/basis/stencil.h>
#include <kedge/materials/material.h>
#include <kedge/points/node_region.h>
#include <kedge/points/split_points.h>
#include <kedge/simulation/points_on_grid.h>

namespace kedge
{
  template <int dim>
  PointsOnGrid<dim>::PointsOnGrid(const GridParameters<dim> &parameters,
                                  const OpenSides<dim>      &open_sides,
                                  const RefinementRule<dim> &refinement,
                                  const PointLayout<dim>    &layout,
                                  const MPI_Comm             communicator)
    : communicator(communicator)
    , open_sides(open_sides)
    , refinement(refinement)
    , background(parameters, communicator)
    , cloud(layout)
  {
    if (refinement.any() && dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw UserError("Grid/Refinement: a refined grid runs on one process.");
  }



  template <int dim>
  void
  PointsOnGrid<dim>::begin(std::vector<PointRecord<dim>> records, const double t)
  {
    time = t;
    cover(records);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      records.clear();
    cloud.distribute(background, std::move(records));
  }



  template <int dim>
  void
  PointsOnGrid<dim>::replace(const std::vector<PointRecord<dim>> &records)
  {
    cover(records);
    cloud.distribute(background, records);
  }



  template <int dim>
  void
  PointsOnGrid<dim>::restore(const std::vector<PointRecord<dim>> &records,
                             const LatticeWindow<dim>            &covered_cells,
                             const std::vector<unsigned int>     &covered_weights,
                             const double                         t)
  {
    time    = t;
    covered = covered_cells;
    weights = covered_weights;
    cloud.clear();
    background.cover(covered, weights);
    refine([&](const auto &visit) {
      for (const auto &record : records)
        visit(record.location, record.state);
    });
    cloud.distribute(background, records);
  }



  template <int dim>
  void
  PointsOnGrid<dim>::cover(const std::vector<PointRecord<dim>> &records)
  {
    const auto       &lattice = background.lattice();
    LatticeIndex<dim> low, high;
    low.fill(std::numeric_limits<int>::max());
    high.fill(std::numeric_limits<int>::min());
    for (const auto &record : records)
      {
        const auto cell = lattice.cell_of(record.location);
        for (int d = 0; d < dim; ++d)
          {
            low[d]  = std::min(low[d], cell[d]);
            high[d] = std::max(high[d], cell[d]);
          }
      }
    MPI_Allreduce(MPI_IN_PLACE, low.data(), dim, MPI_INT, MPI_MIN, communicator);
    MPI_Allreduce(MPI_IN_PLACE, high.data(), dim, MPI_INT, MPI_MAX, communicator);

    if (low[0] > high[0]) // no points
      {
        low.fill(0);
        high.fill(0);
      }
    covered.low = low;
    for (int d = 0; d < dim; ++d)
      covered.n_cells[d] = high[d] - low[d] + 1;
    weights.clear();
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        weights.assign(covered.n_cells_total(), 0);
        for (const auto &record : records)
          ++weights[covered.cell_number(lattice.cell_of(record.location))];
        MPI_Allreduce(MPI_IN_PLACE,
                      weights.data(),
                      static_cast<int>(weights.size()),
                      MPI_UNSIGNED,
                      MPI_SUM,
                      communicator);
      }
    cloud.clear();
    background.cover(covered, weights);
    refine([&](const auto &visit) {
      for (const auto &record : records)
        visit(record.location, record.state);
    });
  }



  template <int dim>
  template <class Points>
  void
  PointsOnGrid<dim>::refine(const Points &for_points)
  {
    if (!refinement.any())
      return;
    const LatticeWindow<dim> &cells = background.levels().coarsest_cells();
    RefinementState           state;
    state.t = just_after(time);
    if (refinement.asks_plastic_strain())
      {
        const unsigned int column = memory_index("equivalent_plastic_strain");
        state.plastic_strain.assign(cells.n_cells_total(), 0.);
        for_points([&](const dealii::Point<dim> &x, const PointState<dim> &point) {
          double &here = state.plastic_strain[cells.cell_number(background.lattice().cell_of(x))];
          here         = std::max(here, point.memory[column]);
        });
      }
    if (refinement.asks_distance() && distances)
      state.distance = distances(middles_of_cells(background.lattice(), cells));
    background.refine(refinement.wanted(background.lattice(), cells, state));
  }



  template <int dim>
  void
  PointsOnGrid<dim>::renew_refinement()
  {
    if (refinement.may_change())
      refine([&](const auto &visit) {
        cloud.for_each([&](const unsigned int,
                           const std::uint64_t,
                           const dealii::Point<dim> &x,
                           const PointState<dim>    &state) {
          visit(x, state);
        });
      });
  }



  template <int dim>
  bool
  PointsOnGrid<dim>::take_out(std::vector<PointRecord<dim>> &gone)
  {
    bool any = false;
    cloud.for_each([&](const unsigned int,
                       const std::uint64_t,
                       const dealii::Point<dim> &x,
                       const PointState<dim> &) {
      any = any || open_sides.let_out(background.lattice(), x);
    });
    if (!dealii::Utilities::MPI::logical_or(any, communicator))
      return false;
    std::vector<PointRecord<dim>> staying;
    for (auto &record : cloud.records())
      (open_sides.let_out(background.lattice(), record.location) ? gone : staying)
        .push_back(record);
    // sums over them must not depend on how the cloud is stored
    std::sort(gone.begin(), gone.end(), [](const auto &a, const auto &b) {
      return a.id < b.id;
    });
    replace(staying);
    return true;
  }



  template <int dim>
  bool
  PointsOnGrid<dim>::split_large_points()
  {
    std::vector<PointRecord<dim>> parts;
    const GridLevels<dim>        &levels = background.levels();
    bool                          any    = false;
    std::uint64_t                 last   = 0;
    const auto parts_of = [&](const dealii::Point<dim> &x, const PointCore<dim> &state) {
      // of the cells that it touches, whose functions it has
      const unsigned int level = levels.level_at(x, state.half_lengths, gimp_smallest_overlap);
      return parts_for_cell<dim>(state, level > 0 ? &levels.lattice(level) : nullptr);
    };
    cloud.for_each_core([&](const unsigned int,
                            const std::uint64_t       id,
                            const dealii::Point<dim> &x,
                            const PointCore<dim>     &state) {
      last = std::max(last, id);
      any  = any || is_many(parts_of(x, state));
    });
    if (!any)
      return false;
    for (const PointRecord<dim> &record : cloud.records())
      split_point<dim>(record, parts_of(record.location, record.state), last, parts);
    replace(parts);
    return true;
  }



  template <int dim>
  std::vector<PointRecord<dim>>
  PointsOnGrid<dim>::follow(const double t)
  {
    time = t;
    std::vector<PointRecord<dim>> gone;
    if (open_sides.any() && take_out(gone))
      return gone;
    bool close = false, outside = false;
    cloud.for_each_core([&](const unsigned int,
                            const std::uint64_t,
                            const dealii::Point<dim> &x,
                            const PointCore<dim> &) {
      const auto cell = background.lattice().cell_of(x);
      close           = close || background.too_close_to_border(cell);
      outside         = outside || !background.covers(cell);
    });
    if (dealii::Utilities::MPI::logical_or(close || outside, communicator))
      {
        replace(cloud.records());
        if (background.is_refined())
          split_large_points();
        return gone;
      }
    renew_refinement();
    if (background.is_refined() && split_large_points())
      return gone;
    const std::uint64_t missing = cloud.relocate(background);
    AssertThrow(missing == 0,
                dealii::ExcMessage(std::to_string(missing) +
                                   " material points were lost while they were sorted into "
                                   "the cells of the background grid."));
    return gone;
  }

  template class PointsOnGrid<2>;
  template class PointsOnGrid<3>;
} // namespace kedge
