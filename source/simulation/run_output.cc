#include <kedge/points/attachment_checks.h>
#include <kedge/simulation/nodal_means.h>
#include <kedge/simulation/run_output.h>

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
          const auto cell = patch.window().cell_index(c);
          if (!patch.grid().levels().is_cell(cell))
            continue;
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

    /** The terms that have surfaces in contact to show. */
    template <int dim>
    std::vector<const ShownContact<dim> *>
    shown_contacts(const Terms<dim> &terms)
    {
      std::vector<const ShownContact<dim> *> result;
      for (const auto &term : terms)
        if (const auto *contact = dynamic_cast<const ShownContact<dim> *>(term.get()))
          result.push_back(contact);
      return result;
    }

    /** Whether there are rigid bodies that have a shape. */
    template <int dim>
    bool
    has_rigid_shapes(const RigidBodies<dim> *bodies)
    {
      for (unsigned int b = 0; bodies != nullptr && b < bodies->size(); ++b)
        if (!bodies->surface(b).facets.empty())
          return true;
      return false;
    }

    /** The points that the scene's probes follow. */
    template <int dim>
    std::vector<Probe>
    find_probes(const Model<dim> &model)
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

    /** What the mappings of the last step lost, of all fields together. */
    template <int dim>
    TransferAudit<dim>
    audit_of(const Model<dim> &model)
    {
      TransferAudit<dim> sum = *model.fields.front()->transfer->audit();
      for (std::size_t f = 1; f < model.fields.size(); ++f)
        sum += *model.fields[f]->transfer->audit();
      return sum;
    }
  } // namespace



  template <int dim>
  RunOutput<dim>::RunOutput(Model<dim>                &model,
                            Step<dim>                 &step,
                            const RunFolder           &folder,
                            const CheckpointData<dim> *resumed)
    : model(model)
    , step(step)
    , folder(folder)
    , next_time(model.scene.time.start)
  {
    open(resumed);
    if (resumed == nullptr)
      return;
    next_time = resumed->scalars.at("next_output_time");
    if (resumed->counters.at("points_written") > 0)
      last_step = resumed->counters.at("last_points_step");
    if (const auto last = resumed->arrays.find("last_probes"); last != resumed->arrays.end())
      probes->set_last_row(last->second);
  }



  template <int dim>
  void
  RunOutput<dim>::open(const CheckpointData<dim> *resumed)
  {
    const auto position = [&](const std::string &table) -> std::optional<CsvPosition> {
      if (resumed == nullptr)
        return {};
      CsvPosition end{resumed->counters.at(table + "_position")};
      if (resumed->counters.count(table + "_checksum") > 0)
        end.checksum = resumed->counters.at(table + "_checksum");
      return end;
    };
    const auto n_written = [&](const std::string &what) {
      return resumed == nullptr
               ? 0u
               : static_cast<unsigned int>(resumed->counters.at(what + "_written"));
    };
    const Scene<dim> &scene = model.scene;
    history = std::make_unique<HistoryWriter>(folder, model.ledger.columns(), position("history"));
    probes  = std::make_unique<ProbeWriter<dim>>(folder,
                                                find_probes(model),
                                                position("probes"),
                                                scene.pore_fluid.has_value(),
                                                !scene.open_sides.empty());
    points  = std::make_unique<PointsOutput<dim>>(folder, scene.output, n_written("points"));
    if (scene.output.grid)
      grid = std::make_unique<GridOutput<dim>>(folder, n_written("grid"));
    if (!shown_contacts(model.terms).empty())
      surfaces = std::make_unique<SurfaceOutput<dim>>(folder, n_written("surfaces"));
    if (has_rigid_shapes(model.rigid()))
      rigid = std::make_unique<RigidOutput<dim>>(folder, n_written("rigid_bodies"));
    if (scene.newton.log)
      newton = std::make_unique<NewtonLog>(folder, position("newton"));
    if (scene.transfer.audit && model.fields.front()->transfer)
      audit = std::make_unique<AuditWriter<dim>>(folder, position("audit"));
  }



  template <int dim>
  std::string
  RunOutput<dim>::write_start(const HistoryRow &row)
  {
    const std::string bad = write_probes(row.time);
    if (bad.empty())
      history->write(row);
    return bad;
  }



  template <int dim>
  std::string
  RunOutput<dim>::write_step(const HistoryRow &row, const NewtonReport &report)
  {
    const Stopwatch   stopwatch(spent);
    const std::string bad = write_probes(row.time);
    if (!bad.empty())
      return bad;
    if (newton)
      newton->write(row.step, row.time, true, report);
    if (audit)
      audit->write(row.step, row.time, audit_of(model));
    history->write(row);
    return "";
  }



  template <int dim>
  void
  RunOutput<dim>::write_rejected(const std::uint64_t step,
                                 const double        time,
                                 const NewtonReport &report)
  {
    if (newton)
      newton->write(step, time, false, report);
  }



  template <int dim>
  std::string
  RunOutput<dim>::write_probes(const double time)
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
    return probes->end_row(time);
  }



  template <int dim>
  bool
  RunOutput<dim>::is_due(const Clock &clock)
  {
    const OutputParameters &output   = model.scene.output;
    const double            interval = output.points_interval, tolerance = 1e-9 * interval;
    bool due = output.points_every_steps > 0 && clock.n_steps() % output.points_every_steps == 0;
    if (interval > 0. && clock.time() >= next_time - tolerance)
      {
        due = true;
        next_time +=
          (std::floor((clock.time() + tolerance - next_time) / interval) + 1.) * interval;
      }
    return due;
  }



  template <int dim>
  void
  RunOutput<dim>::write_points(const Clock &clock, const bool force)
  {
    const OutputParameters &output = model.scene.output;
    if ((output.points_interval <= 0. && output.points_every_steps == 0) ||
        (!output.vtu && !output.hdf5))
      return;
    if (!is_due(clock) && !force)
      return;
    if (last_step && *last_step == clock.n_steps())
      return;
    const Stopwatch stopwatch(spent);
    last_step = clock.n_steps();
    points->write(clock.time(), model.points.points().records());
    write_grid(clock.time());
    write_surfaces(clock.time());
    if (rigid)
      rigid->write(clock.time(), *model.rigid());
  }



  template <int dim>
  void
  RunOutput<dim>::write_first_pictures(const Clock &clock)
  {
    write_points(clock, true);
    if (!last_step)
      write_grid(clock.time());
  }



  template <int dim>
  void
  RunOutput<dim>::write_grid(const double time)
  {
    if (!grid)
      return;
    step.activate();
    GridSnapshot<dim> snapshot;
    const auto        records = model.points.points().records();
    for (const auto &field : model.fields)
      {
        add_cells(field->patch, snapshot);
        add_nodal_means(field->patch, records, model.scene.output.fields, snapshot);
      }
    grid->write(time, snapshot);
  }



  template <int dim>
  void
  RunOutput<dim>::write_surfaces(const double time)
  {
    if (!surfaces)
      return;
    ContactPicture<dim> picture;
    for (const ShownContact<dim> *contact : shown_contacts(model.terms))
      contact->show(picture);
    surfaces->write(time, picture);
  }



  template <int dim>
  void
  RunOutput<dim>::save(CheckpointData<dim> &data)
  {
    points->flush();
    if (grid)
      grid->flush();
    if (surfaces)
      surfaces->flush();
    if (rigid)
      rigid->flush();
    const auto put = [&](const std::string &table, const CsvPosition &end) {
      data.counters[table + "_position"] = end.n_bytes;
      data.counters[table + "_checksum"] = end.checksum.value_or(0);
    };
    put("history", history->position());
    put("probes", probes->position());
    put("newton", newton ? newton->position() : CsvPosition());
    put("audit", audit ? audit->position() : CsvPosition());
    data.counters["points_written"]       = points->n_written();
    data.counters["grid_written"]         = grid ? grid->n_written() : 0;
    data.counters["surfaces_written"]     = surfaces ? surfaces->n_written() : 0;
    data.counters["rigid_bodies_written"] = rigid ? rigid->n_written() : 0;
    data.counters["last_points_step"]     = last_step.value_or(0);
    data.scalars["next_output_time"]      = next_time;
    if (!model.scene.open_sides.empty())
      data.arrays["last_probes"] = probes->last_row();
  }

  template class RunOutput<2>;
  template class RunOutput<3>;
} // namespace kedge
