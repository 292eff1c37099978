#include <kedge/simulation/scene_loads.h>

#include <cmath>
#include <sstream>

namespace kedge
{
  template <int dim>
  SceneLoads::SceneLoads(const Scene<dim> &scene)
  {
    const auto texts = [](const auto &components) {
      return std::vector<std::string>(components.begin(), components.end());
    };
    const bool follow_time = !scene.load_control; // else they follow the load factor
    if (follow_time)
      add("Body force", texts(scene.body_force), scene.constants);
    for (const auto &load : scene.point_loads)
      if (follow_time)
        add("Point loads/" + load.name, texts(load.force), scene.constants);
    for (const auto &traction : scene.tractions)
      {
        const std::string name = "Tractions/" + traction.name;
        if (!traction.traction[0].empty() && follow_time)
          add(name, texts(traction.traction), scene.constants);
        if (!traction.pressure.empty())
          add(name, {traction.pressure}, scene.constants);
      }
    for (const auto &pressure : scene.surface_pressures)
      add("Surface pressures/" + pressure.name, {pressure.pressure}, scene.constants);
    for (const auto &condition : scene.node_conditions)
      {
        std::vector<std::string> displacements;
        for (const auto &component : condition.components)
          if (component.kind == ConditionKind::displacement)
            displacements.push_back(component.expression);
        add("Node conditions/" + condition.name, displacements, scene.constants, true);
      }
    for (const auto &condition : scene.body_conditions)
      {
        std::vector<std::string> forces, motions;
        for (const auto &line : condition.lines)
          if (!line.force.empty())
            forces.push_back(line.force);
          else if (line.motion.kind == ConditionKind::displacement)
            motions.push_back(line.motion.expression);
        add("Body conditions/" + condition.name, forces, scene.constants);
        add("Body conditions/" + condition.name, motions, scene.constants, true);
      }
  }



  void
  SceneLoads::add(const std::string                   &name,
                  const std::vector<std::string>      &texts,
                  const std::map<std::string, double> &constants,
                  const bool                           is_support)
  {
    Load load{name, {}, is_support};
    try
      {
        for (const std::string &text : texts)
          load.components.emplace_back(text, std::vector<std::string>{"t"}, constants);
      }
    catch (const std::exception &)
      {
        return; // it depends on the place too, and the scene was read: nothing is wrong with it
      }
    loads.push_back(load);
  }



  std::string
  SceneLoads::not_finite_at(const double t) const
  {
    std::ostringstream result;
    for (const Load &load : loads)
      for (const Expression &component : load.components)
        if (const double value = component({t}); !std::isfinite(value))
          result << (result.tellp() > 0 ? ", " : "") << load.name << " = " << component.text()
                 << " is " << value << " at t = " << t << " s";
    return result.str();
  }



  std::string
  SceneLoads::factors_at(const double t, const double end, const bool with_supports) const
  {
    std::ostringstream result;
    result.precision(4);
    for (const Load &load : loads)
      {
        if (load.is_support && !with_supports)
          continue;
        double product = 0., square = 0.;
        bool   changes = false;
        for (const Expression &component : load.components)
          {
            const double at_end = component({end});
            product += component({t}) * at_end;
            square += at_end * at_end;
            changes = changes || !component.is_constant();
          }
        if (changes && square > 0. && std::isfinite(product / square))
          result << (result.tellp() > 0 ? ", " : "") << load.name << " " << product / square;
      }
    return result.str();
  }

  template SceneLoads::SceneLoads(const Scene<2> &);
  template SceneLoads::SceneLoads(const Scene<3> &);
} // namespace kedge
