#include <kedge/points/material_points.h>

#include <cstring>

namespace kedge
{
  namespace
  {
    /** So many points may change cell at a time in any case. */
    constexpr std::size_t most_movers = 4096;

    template <int dim>
    constexpr std::size_t record_values = sizeof(PointRecord<dim>) / sizeof(double);

    /** Sends each record to the rank that owns its cell. */
    template <int dim>
    std::vector<PointRecord<dim>>
    send_to_owners(const BackgroundGrid<dim> &grid, const std::vector<PointRecord<dim>> &records)
    {
      std::map<unsigned int, std::vector<double>> outgoing;
      for (const auto &record : records)
        {
          const auto cell = grid.lattice().cell_of(record.location);
          AssertThrow(grid.covers(cell),
                      dealii::ExcMessage("A material point lies outside the grid's window."));
          auto             &buffer = outgoing[grid.cell_owner(cell)];
          const std::size_t begin  = buffer.size();
          buffer.resize(begin + record_values<dim>);
          std::memcpy(&buffer[begin], &record, sizeof(record));
        }
      const auto incoming = dealii::Utilities::MPI::some_to_some(grid.communicator(), outgoing);

      std::vector<PointRecord<dim>> mine;
      for (const auto &[rank, buffer] : incoming)
        {
          (void)rank;
          for (std::size_t i = 0; i < buffer.size(); i += record_values<dim>)
            {
              mine.emplace_back();
              std::memcpy(static_cast<void *>(&mine.back()), &buffer[i], sizeof(mine.back()));
            }
        }
      return mine;
    }
  } // namespace



  template <int dim>
  void
  MaterialPoints<dim>::distribute(const BackgroundGrid<dim>    &grid,
                                  std::vector<PointRecord<dim>> records)
  {
    static_assert(sizeof(PointRecord<dim>) % sizeof(double) == 0);
    if (dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      records = send_to_owners(grid, records);

    handler.reset();
    handler = std::make_unique<dealii::Particles::ParticleHandler<dim>>(grid.triangulation(),
                                                                        grid.mapping(),
                                                                        layout.n_values());
    handler->get_property_pool().reserve(records.size());
    for (const auto &record : records)
      insert(grid, record);
    handler->update_cached_numbers();
    n_global_ = handler->n_global_particles();
  }



  template <int dim>
  void
  MaterialPoints<dim>::insert(const BackgroundGrid<dim> &grid, const PointRecord<dim> &record)
  {
    const auto         cell = grid.lattice().cell_of(record.location);
    dealii::Point<dim> unit;
    for (int d = 0; d < dim; ++d)
      unit[d] = grid.lattice().scaled(record.location[d], d) - cell[d];
    std::array<double, n_state_values<dim>> values;
    layout.store(record.state, values.data());
    handler->insert_particle(record.location,
                             unit,
                             record.id,
                             grid.cell_iterator(cell),
                             dealii::ArrayView<const double>(values.data(), layout.n_values()));
  }



  template <int dim>
  std::vector<PointRecord<dim>>
  MaterialPoints<dim>::records() const
  {
    std::vector<PointRecord<dim>> result;
    result.reserve(n_local());
    for_each([&](const unsigned int,
                 const std::uint64_t       id,
                 const dealii::Point<dim> &location,
                 const PointState<dim>    &state) {
      result.push_back({id, location, state});
    });
    return result;
  }



  template <int dim>
  std::optional<PointMemory<dim>>
  MaterialPoints<dim>::memory() const
  {
    PointMemory<dim> result;
    result.layout = layout;
    if (n_local() == 0)
      return result;
    const std::less<const double *> before;
    for (const auto &particle : *handler)
      {
        const double *state = particle.get_properties().data();
        if (result.states == nullptr || before(state, result.states))
          {
            result.states    = state;
            result.locations = &particle.get_location();
          }
      }
    result.ids.resize(n_local());
    for (const auto &particle : *handler)
      {
        const auto row =
          static_cast<std::size_t>(particle.get_properties().data() - result.states) /
          layout.n_values();
        if (row >= result.ids.size())
          return {};
        result.ids[row] = particle.get_id();
      }
    return result;
  }



  template <int dim>
  std::uint64_t
  MaterialPoints<dim>::relocate(const BackgroundGrid<dim> &grid)
  {
    // a part of the movers at a time, whose copies take little memory
    const std::size_t most = std::max<std::size_t>(most_movers, n_local() / 8);
    auto              cell = grid.triangulation().begin_active();
    do
      move_some(grid, most, cell);
    while (
      dealii::Utilities::MPI::logical_or(cell != grid.triangulation().end(), grid.communicator()));
    handler->update_cached_numbers();
    return n_global_ - handler->n_global_particles();
  }



  template <int dim>
  void
  MaterialPoints<dim>::move_some(const BackgroundGrid<dim> &grid,
                                 const std::size_t          most,
                                 ActiveCell                &cell)
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
    std::vector<PointRecord<dim>> staying, leaving;
    for (; cell != grid.triangulation().end() && staying.size() + leaving.size() < most; ++cell)
      if (cell->is_locally_owned())
        take_movers(grid, cell, rank, staying, leaving);
    for (const auto &record : staying)
      insert(grid, record);
    if (dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      for (const auto &record : send_to_owners(grid, leaving))
        insert(grid, record);
  }



  template <int dim>
  void
  MaterialPoints<dim>::take_movers(const BackgroundGrid<dim>     &grid,
                                   const ActiveCell              &cell,
                                   const unsigned int             rank,
                                   std::vector<PointRecord<dim>> &staying,
                                   std::vector<PointRecord<dim>> &leaving)
  {
    std::vector<unsigned int> places; // of the movers in the cell
    unsigned int              place     = 0;
    const auto                particles = handler->particles_in_cell(cell);
    for (auto particle = particles.begin(); particle != particles.end(); ++particle, ++place)
      {
        const auto new_cell = grid.lattice().cell_of(particle->get_location());
        const bool stays    = grid.cell_owner(new_cell) == rank;
        if (stays && cell == grid.cell_iterator(new_cell))
          continue;
        places.push_back(place);
        (stays ? staying : leaving)
          .push_back({particle->get_id(), particle->get_location(), state_of(*particle)});
      }
    // to remove one invalidates the iterators of its cell: those before it keep their places
    for (auto last = places.rbegin(); last != places.rend(); ++last)
      handler->remove_particle(std::next(handler->particles_in_cell(cell).begin(), *last));
  }

  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace kedge
