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
          AssertThrow(grid.window().contains_cell(cell),
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
                                                                        n_state_values<dim>);
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
    handler->insert_particle(record.location,
                             unit,
                             record.id,
                             grid.cell_iterator(cell),
                             dealii::ArrayView<const double>(reinterpret_cast<const double *>(
                                                               &record.state),
                                                             n_state_values<dim>));
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
  std::uint64_t
  MaterialPoints<dim>::relocate(const BackgroundGrid<dim> &grid)
  {
    // a part of the movers at a time, whose copies take little memory
    const std::size_t most = std::max<std::size_t>(most_movers, n_local() / 8);
    while (move_some(grid, most))
      ;
    return n_global_ - handler->n_global_particles();
  }



  template <int dim>
  bool
  MaterialPoints<dim>::move_some(const BackgroundGrid<dim> &grid, const std::size_t most)
  {
    using Iterator = typename dealii::Particles::ParticleHandler<dim>::particle_iterator;
    const unsigned int    rank = dealii::Utilities::MPI::this_mpi_process(grid.communicator());
    std::vector<Iterator> movers;
    std::vector<PointRecord<dim>> staying, leaving;
    for (auto particle = handler->begin(); particle != handler->end() && movers.size() < most;
         ++particle)
      {
        const auto cell  = grid.lattice().cell_of(particle->get_location());
        const bool stays = grid.cell_owner(cell) == rank;
        if (stays && particle->get_surrounding_cell() == grid.cell_iterator(cell))
          continue;
        movers.push_back(particle);
        (stays ? staying : leaving)
          .push_back({particle->get_id(), particle->get_location(), state_of(*particle)});
      }
    const bool parallel = dealii::Utilities::MPI::n_mpi_processes(grid.communicator()) > 1;
    if (parallel || !movers.empty()) // counts the particles anew: collective
      handler->remove_particles(movers);
    for (const auto &record : staying)
      insert(grid, record);
    if (parallel)
      for (const auto &record : send_to_owners(grid, leaving))
        insert(grid, record);
    if (parallel || !movers.empty())
      handler->update_cached_numbers();
    return dealii::Utilities::MPI::logical_or(movers.size() == most, grid.communicator());
  }

  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace kedge
