#include <kedge/simulation/support_watch.h>

#include <algorithm>
#include <sstream>

namespace kedge
{
  namespace
  {
    /** Parts of the material at which a line is due, one after the other. */
    constexpr std::array<double, 2> due = {{0.25, 1e-6}};

    constexpr std::uint64_t first_steps = 10; ///< that are all looked at, and then each so many

    template <int dim>
    bool
    moves(const NodeConditionParameters<dim> &condition)
    {
      return std::any_of(condition.components.begin(),
                         condition.components.end(),
                         [](const ComponentCondition &component) {
                           return component.kind != ConditionKind::free &&
                                  component.kind != ConditionKind::fixed;
                         });
    }

    template <int dim>
    bool
    gives_displacement(const NodeConditionParameters<dim> &condition)
    {
      return std::any_of(condition.components.begin(),
                         condition.components.end(),
                         [](const ComponentCondition &component) {
                           return component.kind == ConditionKind::displacement;
                         });
    }
  } // namespace



  template <int dim>
  std::string
  entries_that_follow(const NodeConditionParameters<dim> &condition)
  {
    const bool holds = std::any_of(condition.components.begin(),
                                   condition.components.end(),
                                   [](const ComponentCondition &component) {
                                     return component.kind != ConditionKind::free;
                                   });
    if (condition.pore_pressure.empty())
      return "Body conditions, on a body's surface or on a section of it, go with the body";
    return holds ? "Body conditions and Surface pressures go with the body's surface"
                 : "Surface pressures go with the body's surface, wherever it is";
  }



  template <int dim>
  SupportWatch<dim>::SupportWatch(const Model<dim> &model)
    : model(model)
  {
    for (const auto &condition : model.scene.node_conditions)
      {
        const NodeRegion<dim> region(condition, model.scene.constants);
        if (region.follows_time() || // it says itself what it holds when
            !(region.has_limits() ||
              (condition.on_side && (moves(condition) || !condition.pore_pressure.empty()))))
          continue;
        std::vector<bool> holds_body(model.bodies.names.size(), condition.body.empty());
        for (std::size_t b = 0; b < holds_body.size(); ++b)
          for (std::size_t other = 0; other < holds_body.size(); ++other)
            if (model.bodies.names[other] == condition.body &&
                model.bodies.field[other] == model.bodies.field[b])
              holds_body[b] = true;
        watched.push_back(&condition);
        conditions.push_back({region, holds_body});
      }
    n_said.resize(watched.size(), 0);
    if (!watched.empty())
      held.emplace(conditions, model.points.grid().levels().finest());
  }



  template <int dim>
  typename SupportWatch<dim>::Finding
  SupportWatch<dim>::look(const std::uint64_t step, const double time, const bool must)
  {
    Finding finding;
    if (!held || !(must || step <= first_steps || step % first_steps == 0))
      return finding;
    const std::vector<double> parts = held->parts(model.points.points(), model.communicator);
    for (std::size_t c = 0; c < parts.size(); ++c)
      {
        if (n_said[c] == due.size() || parts[c] > due[n_said[c]])
          continue;
        while (n_said[c] < due.size() && parts[c] <= due[n_said[c]])
          ++n_said[c];
        const std::string text = line(*watched[c], parts[c], time);
        finding.lines.push_back(text);
        if (n_said[c] == due.size() && !model.scheme.dynamic && gives_displacement(*watched[c]) &&
            finding.stop.empty())
          finding.stop = text;
      }
    return finding;
  }



  template <int dim>
  std::string
  SupportWatch<dim>::line(const NodeConditionParameters<dim> &condition,
                          const double                        part,
                          const double                        time) const
  {
    std::ostringstream text;
    text << "Node conditions/" << condition.name << " holds ";
    if (part <= due.back())
      text << "nothing any more";
    else
      text << "no more than " << std::lround(100. * part) << " %";
    text << " of the material that it held at the start (t = " << time
         << " s): its nodes stay where they are; " << entries_that_follow(condition);
    return text.str();
  }

  template class SupportWatch<2>;
  template class SupportWatch<3>;
  template std::string
  entries_that_follow(const NodeConditionParameters<2> &);
  template std::string
  entries_that_follow(const NodeConditionParameters<3> &);
} // namespace kedge
