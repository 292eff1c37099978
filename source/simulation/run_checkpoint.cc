#include <kedge/simulation/run.h>

// How a run is kept on the disk, and taken up again.
namespace kedge
{
  template <int dim>
  void
  Run<dim>::write_checkpoint_if_due()
  {
    const OutputParameters &asked = model.scene.output;
    bool                    due =
      asked.checkpoint_every_steps > 0 && clock.n_steps() % asked.checkpoint_every_steps == 0;
    if (!due && asked.checkpoint_interval > 0.)
      due = dealii::Utilities::MPI::logical_or(wall_time() - last_checkpoint_wall >
                                                 asked.checkpoint_interval,
                                               communicator);
    if (due)
      write_checkpoint();
  }



  template <int dim>
  void
  Run<dim>::write_checkpoint()
  {
    if (last_checkpoint_step == clock.n_steps())
      return;
    CheckpointData<dim> data;
    data.settings    = model.scene.settings;
    data.n_ranks     = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const auto state = clock.state();
    data.scalars     = {{"time", state.time},
                        {"nominal_step", state.nominal},
                        {"wall_time", wall_time()},
                        {"points_times_steps", counts.points_times_steps}};
    for (const auto &[name, value] : model.ledger.save())
      data.scalars["ledger " + name] = value;
    for (const auto &[name, value] : limit.save())
      data.scalars["limit " + name] = value;
    data.counters = {{"steps", state.n_steps},
                     {"cuts", state.cuts},
                     {"accepted_since_cut", state.accepted_since_cut},
                     {"newton", counts.newton},
                     {"linear", counts.linear},
                     {"rejected", counts.rejected},
                     {"rejected_pending", counts.rejected_pending}};
    output->save(data);
    const auto &covered = model.points.covered_cells();
    auto       &window  = data.arrays["covered_cells"];
    for (int d = 0; d < dim; ++d)
      {
        window.push_back(covered.low[d]);
        window.push_back(covered.n_cells[d]);
      }
    data.arrays["covered_weights"].assign(model.points.covered_weights().begin(),
                                          model.points.covered_weights().end());
    for (const auto &term : model.terms)
      term->save(data.arrays);
    data.points = model.points.points().records();
    checkpoints.write(data);
    last_checkpoint_wall = wall_time();
    last_checkpoint_step = clock.n_steps();
  }



  template <int dim>
  void
  Run<dim>::resume()
  {
    const CheckpointData<dim> data = checkpoints.read_latest(model.scene.settings);
    LatticeWindow<dim>        covered;
    const auto               &window = data.arrays.at("covered_cells");
    for (int d = 0; d < dim; ++d)
      {
        covered.low[d]     = static_cast<int>(window[2 * d]);
        covered.n_cells[d] = static_cast<int>(window[2 * d + 1]);
      }
    const auto                     &weights = data.arrays.at("covered_weights");
    const std::vector<unsigned int> points_per_cell(weights.begin(), weights.end());
    if (data.n_ranks == dealii::Utilities::MPI::n_mpi_processes(communicator))
      model.points.restore(data.points, covered, points_per_cell, data.scalars.at("time"));
    else
      model.points.replace(data.points); // shares them out anew
    for (auto &term : model.terms)
      term->restore(data.arrays);
    model.points.renew_refinement(); // rigid bodies stand where they were
    step.points_changed();

    clock.restore({data.scalars.at("time"),
                   data.scalars.at("nominal_step"),
                   data.counters.at("steps"),
                   data.counters.at("cuts"),
                   data.counters.at("accepted_since_cut")});
    std::map<std::string, double> books, watch;
    for (const auto &[name, value] : data.scalars)
      if (name.rfind("ledger ", 0) == 0)
        books[name.substr(7)] = value;
      else if (name.rfind("limit ", 0) == 0)
        watch[name.substr(6)] = value;
    limit.restore(watch);
    counts.wall_before        = data.scalars.at("wall_time");
    counts.points_times_steps = data.scalars.at("points_times_steps");
    counts.newton             = data.counters.at("newton");
    counts.linear             = data.counters.at("linear");
    counts.rejected           = data.counters.at("rejected");
    counts.rejected_pending   = data.counters.at("rejected_pending");
    last_checkpoint_step      = clock.n_steps();
    last_checkpoint_wall      = wall_time();
    output                    = std::make_unique<RunOutput<dim>>(model, step, folder, &data);
    step.book_state();
    model.ledger.restore(books);
    fill_row();
    folder.log() << "kedge: goes on at t = " << clock.time() << " s, step " << clock.n_steps()
                 << std::endl;
  }



#define KEDGE_INSTANTIATE(dim)                       \
  template void Run<dim>::write_checkpoint();        \
  template void Run<dim>::write_checkpoint_if_due(); \
  template void Run<dim>::resume();
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
