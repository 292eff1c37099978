#include <kedge/base/exceptions.h>
#include <kedge/simulation/equilibrium.h>
#include <kedge/simulation/step_engine.h>

#include <regex>

namespace kedge
{
  namespace
  {
    /** Expressions of a scene as they are at its start, and as they grow in the stage. */
    class Freeze
    {
    public:
      Freeze(const double start, const double duration, const bool grows)
      {
        std::ostringstream text;
        text << std::setprecision(17) << '(' << start << ')';
        time = text.str();
        text.str("");
        text << std::setprecision(17) << "t/" << duration << "*(";
        ramp = grows ? text.str() : "(";
      }

      std::string
      frozen(const std::string &expression) const
      {
        return std::regex_replace(expression, std::regex("\\bt\\b"), time);
      }

      template <std::size_t n>
      void
      grow(std::array<std::string, n> &expressions) const
      {
        for (std::string &expression : expressions)
          expression = ramp + frozen(expression) + ")";
      }

    private:
      std::string time, ramp;
    };

    /** The scene of the stage, from t = 0 to its duration. */
    template <int dim>
    Scene<dim>
    stage_of(const Scene<dim> &scene)
    {
      Scene<dim>   stage = scene;
      const bool   grows = std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const auto &b) {
        return b.initial_stress.empty();
      });
      const Freeze at_start(scene.time.start, scene.equilibrium.duration, grows);
      at_start.grow(stage.body_force);
      for (auto &load : stage.point_loads)
        at_start.grow(load.force);
      for (auto &traction : stage.tractions)
        at_start.grow(traction.traction);
      for (auto &surface : stage.surface_pressures)
        surface.pressure = at_start.frozen(surface.pressure);
      for (auto &surface : stage.surface_fluxes)
        surface.flux = at_start.frozen(surface.flux);
      for (auto &condition : stage.node_conditions)
        {
          condition.pore_pressure = at_start.frozen(condition.pore_pressure);
          for (auto &component : condition.components)
            if (component.kind != ConditionKind::free)
              component.kind = ConditionKind::fixed;
        }
      stage.time.scheme       = SchemeKind::quasi_static;
      stage.equilibrium.steps = 0;
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
  std::vector<PointRecord<dim>>
  points_in_equilibrium(const Scene<dim> &scene, const MPI_Comm communicator)
  {
    StepEngine<dim> engine(stage_of(scene), communicator);
    engine.create_points();
    engine.initialise_points(0.);
    const double dt = scene.equilibrium.duration / scene.equilibrium.steps;
    for (unsigned int step = 0; step < scene.equilibrium.steps; ++step)
      {
        const StepReport report = engine.try_step(step * dt, dt);
        if (!report.accepted)
          throw UserError("Equilibrium: step " + std::to_string(step + 1) + " of " +
                          std::to_string(scene.equilibrium.steps) + " does not converge: " +
                          report.cause + ". Take more (Equilibrium/Steps).");
        engine.accept_step();
      }
    auto records = engine.points().records();
    for (auto &record : records)
      start_anew(record);
    return records;
  }

  template std::vector<PointRecord<2>>
  points_in_equilibrium(const Scene<2> &, const MPI_Comm);
  template std::vector<PointRecord<3>>
  points_in_equilibrium(const Scene<3> &, const MPI_Comm);
} // namespace kedge
