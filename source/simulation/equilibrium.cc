#include <kedge/base/exceptions.h>
#include <kedge/simulation/equilibrium.h>
#include <kedge/simulation/scene_loads.h>
#include <kedge/simulation/step.h>

namespace kedge
{
  namespace
  {
    /** Lines of a stage in the log, however many steps it has. */
    constexpr unsigned int most_lines = 20;

    /** Forces grow over the stage, unless the bodies begin it under their stress. */
    template <int dim>
    bool
    grows(const Scene<dim> &scene)
    {
      return std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const auto &body) {
        return body.initial_stress.empty();
      });
    }

    /** The scene of the stage, from t = 0 to its duration. */
    template <int dim>
    Scene<dim>
    stage_of(const Scene<dim> &scene)
    {
      Scene<dim> stage = scene;
      for (auto &condition : stage.node_conditions)
        for (auto &component : condition.components)
          if (component.kind != ConditionKind::free)
            component.kind = ConditionKind::fixed;
      for (auto &condition : stage.body_conditions)
        for (auto &line : condition.lines)
          line.motion.kind = ConditionKind::fixed;
      stage.open_sides.clear(); // nothing may be lost before the books are opened
      stage.time.scheme       = SchemeKind::quasi_static;
      for (auto &material : stage.materials)
        material.viscosity = 0.; // its stress is none of rest
      stage.equilibrium.steps = 0;
      stage.load_control.reset(); // its loads are those of Time/Start
      return stage;
    }

    /** Makes a point's place its reference; strains and stresses stay. */
    template <int dim>
    void
    start_anew(PointRecord<dim> &record)
    {
      PointState<dim> &state    = record.state;
      state.reference_position  = record.location;
      state.displacement        = dealii::Tensor<1, dim>();
      state.plastic_dissipation = 0.;
    }
  } // namespace



  template <int dim>
  EquilibriumState<dim>
  find_equilibrium(const Scene<dim> &scene, const MPI_Comm communicator, std::ostream &log)
  {
    const double      duration  = scene.equilibrium.duration;
    const std::string bad_loads = SceneLoads(scene).not_finite_at(scene.time.start);
    Model<dim>        model(stage_of(scene),
                     communicator,
                     LoadProgram(scene.time.start, duration, grows(scene)));
    Step<dim>         stage(model);
    model.create_points();
    stage.initialise_points(0., false);
    const double       dt        = duration / scene.equilibrium.steps;
    const unsigned int n_between = (scene.equilibrium.steps + most_lines - 1) / most_lines;
    for (unsigned int step = 0; step < scene.equilibrium.steps; ++step)
      {
        const StepReport report = stage.attempt({step * dt, dt});
        if (!report.accepted)
          throw UserError("Equilibrium: step " + std::to_string(step + 1) + " of " +
                          std::to_string(scene.equilibrium.steps) +
                          " does not converge: " + report.cause + ". " +
                          (bad_loads.empty() ? "Take more (Equilibrium/Steps)." : bad_loads + "."));
        stage.commit();
        if ((step + 1) % n_between == 0 || step + 1 == scene.equilibrium.steps)
          log << "  Equilibrium: step " << step + 1 << " of " << scene.equilibrium.steps
              << ", Newton " << report.newton.iterations << std::endl;
      }
    EquilibriumState<dim>     result;
    const auto                columns = model.ledger.columns();
    const std::vector<double> values  = model.ledger.values();
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].section == Ledger::Section::force)
        result.forces[columns[k].name] = values[k];
    auto records = model.points.points().records();
    for (auto &record : records)
      start_anew(record);
    result.points = std::move(records);
    for (const auto &term : model.terms)
      term->save(result.terms);
    return result;
  }

  template EquilibriumState<2>
  find_equilibrium(const Scene<2> &, const MPI_Comm, std::ostream &);
  template EquilibriumState<3>
  find_equilibrium(const Scene<3> &, const MPI_Comm, std::ostream &);
} // namespace kedge
