#include <kedge/base/exceptions.h>
#include <kedge/points/attachment_checks.h>
#include <kedge/simulation/nodal_means.h>
#include <kedge/simulation/run.h>

namespace kedge
{
  namespace
  {
    /** Adds the cells of a field, all of whose nodes are active. */
    template <int dim>
    void
    add_cells(const Patch<dim> &patch, GridSnapshot<dim> &snapshot)
    {
      const auto  first = static_cast<unsigned int>(snapshot.nodes.size());
      const auto &nodes = patch.nodes;
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        snapshot.nodes.push_back(patch.node_position(i));
      for (unsigned int c = 0; c < patch.window().n_cells_total(); ++c)
        {
          const auto                           cell = patch.window().cell_index(c);
          std::array<unsigned int, (1 << dim)> vertices;
          bool                                 complete = true;
          for (unsigned int v = 0; v < (1u << dim); ++v)
            {
              auto node = cell;
              for (int d = 0; d < dim; ++d)
                node[d] += (v >> d) & 1u;
              const int local = nodes.local(patch.window().node_number(node));
              complete        = complete && local >= 0;
              vertices[v]     = first + static_cast<unsigned int>(local);
            }
          if (complete)
            snapshot.cells.push_back(vertices);
        }
    }
  } // namespace



  template <int dim>
  std::vector<Probe>
  Run<dim>::find_probes() const
  {
    std::vector<Probe> result;
    for (const auto &parameters : model.scene.probes)
      {
        Probe                   probe{parameters.name, {}};
        double                  nearest       = std::numeric_limits<double>::max();
        const PointOrigin<dim> *nearest_point = nullptr;
        for (const auto &point : model.generated_points())
          {
            if (!parameters.body.empty() && model.bodies.names[point.body] != parameters.body)
              continue;
            if (parameters.face_mean)
              {
                if ((point.exposed_sides >> parameters.side) & 1u)
                  probe.points.emplace_back(point.id,
                                            point.volume /
                                              (2. * point.half_lengths[parameters.side / 2]));
                continue;
              }
            const double distance = point.location.distance_square(parameters.place);
            if (distance < nearest)
              {
                nearest       = distance;
                nearest_point = &point;
                probe.points  = {{point.id, 1.}};
              }
          }
        if (nearest_point != nullptr)
          check_nearness<dim>("Probe '" + parameters.name + "'",
                              parameters.place,
                              nearest_point->location,
                              nearest_point->half_lengths);
        result.push_back(std::move(probe));
      }
    return result;
  }



  template <int dim>
  std::string
  Run<dim>::write_probes()
  {
    if (probes->empty())
      return "";
    probes->begin();
    model.points.points().for_each([&](const unsigned int,
                                       const std::uint64_t       id,
                                       const dealii::Point<dim> &location,
                                       const PointState<dim>    &state) {
      if (probes->tracks(id))
        probes->add({id, location, state});
    });
    return probes->end_row(clock.time());
  }



  template <int dim>
  void
  Run<dim>::write_points(const bool force)
  {
    const OutputParameters &output  = model.scene.output;
    const bool              enabled = output.points_interval > 0. || output.points_every_steps > 0;
    bool                    due     = force;
    if (output.points_every_steps > 0 && clock.n_steps() % output.points_every_steps == 0)
      due = true;
    const double tolerance = 1e-9 * output.points_interval;
    if (output.points_interval > 0. && clock.time() >= counts.next_output_time - tolerance)
      due = true;
    if (!enabled || !due || (!output.vtu && !output.hdf5))
      return;
    if (output.points_interval > 0. && counts.next_output_time <= clock.time() + tolerance)
      {
        const double past = clock.time() + tolerance - counts.next_output_time;
        counts.next_output_time +=
          (std::floor(past / output.points_interval) + 1.) * output.points_interval;
      }
    if (last_points_step && *last_points_step == clock.n_steps())
      return;
    last_points_step = clock.n_steps();
    points_output->write(clock.time(), model.points.points().records());
    write_grid();
  }



  template <int dim>
  void
  Run<dim>::write_grid()
  {
    if (!grid_output)
      return;
    step.activate();
    GridSnapshot<dim> snapshot;
    const auto        records = model.points.points().records();
    for (const auto &field : model.fields)
      {
        add_cells(field->patch, snapshot);
        add_nodal_means(field->patch, records, model.scene.output.fields, snapshot);
      }
    grid_output->write(clock.time(), snapshot);
  }



  template <int dim>
  void
  Run<dim>::write_checkpoint_if_due()
  {
    const OutputParameters &output = model.scene.output;
    bool                    due =
      output.checkpoint_every_steps > 0 && clock.n_steps() % output.checkpoint_every_steps == 0;
    if (!due && output.checkpoint_interval > 0.)
      due = dealii::Utilities::MPI::logical_or(wall_time() - last_checkpoint_wall >
                                                 output.checkpoint_interval,
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
    points_output->flush();
    if (grid_output)
      grid_output->flush();
    CheckpointData<dim> data;
    data.settings    = model.scene.settings;
    data.n_ranks     = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const auto state = clock.state();
    data.scalars     = {{"time", state.time},
                        {"nominal_step", state.nominal},
                        {"wall_time", wall_time()},
                        {"points_times_steps", counts.points_times_steps},
                        {"next_output_time", counts.next_output_time}};
    for (const auto &[name, value] : model.ledger.save())
      data.scalars["ledger " + name] = value;
    data.counters  = {{"steps", state.n_steps},
                      {"cuts", state.cuts},
                      {"accepted_since_cut", state.accepted_since_cut},
                      {"newton", counts.newton},
                      {"linear", counts.linear},
                      {"rejected", counts.rejected},
                      {"rejected_pending", counts.rejected_pending},
                      {"points_written", points_output->n_written()},
                      {"last_points_step", last_points_step.value_or(0)},
                      {"grid_written", grid_output ? grid_output->n_written() : 0}};
    const auto put = [&](const std::string &table, const CsvPosition &end) {
      data.counters[table + "_position"] = end.n_bytes;
      data.counters[table + "_checksum"] = end.checksum.value_or(0);
    };
    put("history", history->position());
    put("probes", probes->position());
    put("newton", newton_log ? newton_log->position() : CsvPosition());
    put("audit", audit_writer ? audit_writer->position() : CsvPosition());
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
    if (!model.scene.open_sides.empty())
      data.arrays["last_probes"] = probes->last_row();
    data.points = model.points.points().records();
    checkpoints.write(data);
    last_checkpoint_wall = wall_time();
    last_checkpoint_step = clock.n_steps();
  }



  /** Opens the files of the run, at their ends or where a checkpoint has left them. */
  template <int dim>
  void
  Run<dim>::open_output(const std::map<std::string, std::uint64_t> &positions)
  {
    const bool resumed  = !positions.empty();
    const auto position = [&](const std::string &table) -> std::optional<CsvPosition> {
      if (!resumed)
        return {};
      CsvPosition end{positions.at(table + "_position")};
      if (positions.count(table + "_checksum") > 0)
        end.checksum = positions.at(table + "_checksum");
      return end;
    };
    const auto n_written = [&](const std::string &what) {
      return resumed ? static_cast<unsigned int>(positions.at(what + "_written")) : 0u;
    };
    const Scene<dim> &scene = model.scene;
    history = std::make_unique<HistoryWriter>(folder, model.ledger.columns(), position("history"));
    probes  = std::make_unique<ProbeWriter<dim>>(folder,
                                                find_probes(),
                                                position("probes"),
                                                scene.pore_fluid.has_value(),
                                                !scene.open_sides.empty());
    points_output = std::make_unique<PointsOutput<dim>>(folder, scene.output, n_written("points"));
    if (scene.output.grid)
      grid_output = std::make_unique<GridOutput<dim>>(folder, n_written("grid"));
    if (scene.newton.log)
      newton_log = std::make_unique<NewtonLog>(folder, position("newton"));
    if (scene.transfer.audit && model.fields.front()->transfer)
      audit_writer = std::make_unique<AuditWriter<dim>>(folder, position("audit"));
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
      model.points.restore(data.points, covered, points_per_cell);
    else
      model.points.replace(data.points); // shares them out anew
    for (auto &term : model.terms)
      term->restore(data.arrays);
    step.points_changed();

    clock.restore({data.scalars.at("time"),
                   data.scalars.at("nominal_step"),
                   data.counters.at("steps"),
                   data.counters.at("cuts"),
                   data.counters.at("accepted_since_cut")});
    std::map<std::string, double> books;
    for (const auto &[name, value] : data.scalars)
      if (name.rfind("ledger ", 0) == 0)
        books[name.substr(7)] = value;
    counts.wall_before        = data.scalars.at("wall_time");
    counts.points_times_steps = data.scalars.at("points_times_steps");
    counts.next_output_time   = data.scalars.at("next_output_time");
    counts.newton             = data.counters.at("newton");
    counts.linear             = data.counters.at("linear");
    counts.rejected           = data.counters.at("rejected");
    counts.rejected_pending   = data.counters.at("rejected_pending");
    last_checkpoint_step      = clock.n_steps();
    last_checkpoint_wall      = wall_time();
    if (data.counters.at("points_written") > 0)
      last_points_step = data.counters.at("last_points_step");
    open_output(data.counters);
    if (const auto last = data.arrays.find("last_probes"); last != data.arrays.end())
      probes->set_last_row(last->second);
    step.book_state();
    model.ledger.restore(books);
    fill_row();
    folder.log() << "kedge: goes on at t = " << clock.time() << " s, step " << clock.n_steps()
                 << std::endl;
  }



#define KEDGE_INSTANTIATE(dim)                                                                     \
  template std::vector<Probe> Run<dim>::find_probes() const;                                       \
  template std::string        Run<dim>::write_probes();                                            \
  template void               Run<dim>::write_points(const bool);                                  \
  template void               Run<dim>::write_grid();                                              \
  template void               Run<dim>::write_checkpoint();                                        \
  template void               Run<dim>::write_checkpoint_if_due();                                 \
  template void               Run<dim>::open_output(const std::map<std::string, std::uint64_t> &); \
  template void               Run<dim>::resume();
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
