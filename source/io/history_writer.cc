#include <kedge/io/collective.h>
#include <kedge/io/history_writer.h>

namespace kedge
{
  namespace
  {
    std::uint64_t
    whole(const unsigned int value)
    {
      return value;
    }
  } // namespace



  std::vector<std::string>
  HistoryColumns::names() const
  {
    std::vector<std::string> names = {"step",
                                      "time",
                                      "time_step",
                                      "newton_iterations",
                                      "linear_iterations",
                                      "rejected_attempts",
                                      "kinetic_energy",
                                      "strain_energy"};
    if (plasticity)
      names.insert(names.end(), {"hardening_energy", "plastic_dissipation"});
    if (stabilisation)
      names.push_back("stabilisation_energy");
    if (pores)
      names.insert(names.end(), {"fluid_energy", "darcy_dissipation"});
    names.insert(names.end(), {"external_work", "total_energy", "energy_error"});
    names.insert(names.end(), {"linear_momentum_x", "linear_momentum_y"});
    if (dim == 3)
      names.insert(names.end(), {"linear_momentum_z", "angular_momentum_x", "angular_momentum_y"});
    names.push_back("angular_momentum_z");
    names.insert(names.end(), reactions.begin(), reactions.end());
    if (pores)
      names.insert(names.end(),
                   {"solid_mass", "fluid_mass", "fluid_inflow", "fluid_error", "min_porosity"});
    names.insert(names.end(),
                 {"mass", "n_points", "n_active_cells", "n_dofs", "min_det_F", "wall_time"});
    return names;
  }



  HistoryWriter::HistoryWriter(const RunFolder                    &folder,
                               const HistoryColumns               &columns,
                               const std::optional<std::uint64_t> &resume_at)
    : columns(columns)
  {
    run_on_root(folder.communicator(), [&]() {
      file = std::make_unique<CsvFile>(folder.path("history.csv"), columns.names(), resume_at);
    });
  }



  void
  HistoryWriter::write(const HistoryRow &row)
  {
    if (!file)
      return;
    *file << row.step << row.time << row.time_step << whole(row.newton_iterations)
          << whole(row.linear_iterations) << whole(row.rejected_attempts) << row.kinetic_energy
          << row.strain_energy;
    if (columns.plasticity)
      *file << row.hardening_energy << row.plastic_dissipation;
    if (columns.stabilisation)
      *file << row.stabilisation_energy;
    if (columns.pores)
      *file << row.fluid_energy << row.darcy_dissipation;
    *file << row.external_work << row.total_energy() << row.energy_error;
    for (unsigned int d = 0; d < columns.dim; ++d)
      *file << row.linear_momentum[d];
    for (unsigned int d = (columns.dim == 3 ? 0 : 2); d < 3; ++d)
      *file << row.angular_momentum[d];
    for (unsigned int k = 0; k < columns.reactions.size(); ++k) // none before the first step
      *file << (k < row.reactions.size() ? row.reactions[k] : 0.);
    if (columns.pores)
      *file << row.solid_mass << row.fluid_mass << row.fluid_inflow << row.fluid_error
            << row.min_porosity;
    *file << row.mass << row.n_points << row.n_active_cells << row.n_dofs << row.min_det_F
          << row.wall_time;
    file->end_row();
  }



  std::uint64_t
  HistoryWriter::position()
  {
    return file ? file->position() : 0;
  }
} // namespace kedge
