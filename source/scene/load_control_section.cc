#include <kedge/base/exceptions.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/load_control_section.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** @throws UserError for what the load factor cannot be found for. */
    template <int dim>
    void
    check_loads(const SectionReader &section, const Scene<dim> &scene)
    {
      const auto refuse = [&](const std::string &problem) {
        throw section.error("Displacement", problem);
      };
      if (scene.time.scheme != SchemeKind::quasi_static &&
          scene.time.scheme != SchemeKind::clc_quasi_static)
        refuse("A load factor is found without inertia only: Time/Scheme = quasi-static or "
               "clc-quasi-static.");
      if (scene.pore_fluid)
        refuse("The bodies are saturated, and pore water flows in time: take a dry scene.");
      const LinearSolverKind kind = scene.linear_solver.kind;
      if (kind != LinearSolverKind::automatic && kind != LinearSolverKind::direct &&
          kind != LinearSolverKind::banded)
        refuse("It adds an equation without a diagonal, which iterative methods cannot solve: "
               "Linear solver/Method = auto or direct.");
      if (!scene.rigid_bodies.empty())
        refuse("Rigid bodies have loads of their own, which follow the time.");
      for (const auto &condition : scene.body_conditions)
        for (const auto &line : condition.lines)
          if (!line.force.empty())
            refuse("Body conditions/" + condition.name +
                   " gives a force, which follows the time: prescribe its motion instead, which is "
                   "a control by displacement.");
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_load_control(const ValuePatterns<dim> &allow)
  {
    return {
      "Load control",
      "Loads are found instead of given, from how a material point moves: so a "
      "quasi-static run passes a limit load and follows the fall behind it. Body force, "
      "Point loads, Traction and Pressure are then taken at the load factor in place of t, which is a "
      "column of history.csv; it begins at Time/Start.",
      SectionKind::plain,
      {{"Body",
        "",
        allow.text("the name of a section of Bodies").or_empty(),
        "Of the point; empty: loads follow t."},
       {"Place",
        "",
        allow.vector().or_empty(),
        "The material point nearest to it at the start is followed [m]."},
       {"Direction", "", allow.vector().or_empty(), "In which the point moves [-]."},
       {"Displacement",
        "",
        allow.expression({"t"}, "t").or_empty(),
        "Of the point along it since the start; it should grow steadily [m]."}}};
  }



  template <int dim>
  std::optional<LoadControlParameters<dim>>
  read_load_control(const ParameterReader &reader, const Scene<dim> &scene)
  {
    const SectionReader section(reader, {"Load control"});
    if (section.is_empty("Body"))
      {
        for (const std::string entry : {"Place", "Direction", "Displacement"})
          if (!section.is_empty(entry))
            throw section.error(entry, "It needs a Body.");
        return {};
      }
    find_name(reader, section, "Body", "Bodies");
    for (const std::string entry : {"Place", "Direction", "Displacement"})
      if (section.is_empty(entry))
        throw section.error(entry, "It must be given with a Body.");
    check_loads(section, scene);
    LoadControlParameters<dim> control;
    control.body         = section.text("Body");
    control.displacement = section.text("Displacement");
    const auto place     = section.numbers("Place");
    const auto direction = section.numbers("Direction");
    for (unsigned int d = 0; d < dim; ++d)
      {
        control.place[d]     = place[d];
        control.direction[d] = direction[d];
      }
    if (control.direction.norm() == 0.)
      throw section.error("Direction", "It must not be zero.");
    control.direction /= control.direction.norm();
    return control;
  }

#define KEDGE_INSTANTIATE(dim)                                                                  \
  template SectionDeclaration declare_load_control(const ValuePatterns<dim> &);                 \
  template std::optional<LoadControlParameters<dim>> read_load_control(const ParameterReader &, \
                                                                       const Scene<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
