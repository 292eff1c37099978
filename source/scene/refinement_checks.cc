#include <kedge/scene/refinement_checks.h>

namespace kedge
{
  template <int dim>
  void
  check_refinement(const ParameterReader &reader, const Scene<dim> &scene)
  {
    if (scene.grid.refinement.empty())
      return;
    const std::string refined = " is not made for a refined grid (Grid/Refinement).";
    for (const BodyParameters<dim> &body : scene.bodies)
      if (body.basis == BasisKind::quadratic)
        throw SectionReader(reader, {"Bodies", body.name})
          .error("Basis", "The quadratic basis" + refined + " Take linear, gimp or spline.");
    if (scene.stabilisation.method == StabilisationKind::ghost)
      throw SectionReader(reader, {"Stabilisation"})
        .error("Method", "The ghost penalty" + refined + " Take aggregation or none.");
    if (scene.pore_fluid && scene.pore_fluid->coarse_pressure)
      throw SectionReader(reader, {"Pore fluid"})
        .error("Pressure space", "A coarse pressure" + refined + " Take equal order.");
    if (scene.pore_fluid && scene.time.scheme == SchemeKind::clc_midpoint)
      throw SectionReader(reader, {"Time"})
        .error("Scheme",
               "The conserving scheme of saturated soil" + refined +
                 " Take newmark, trapezoidal or midpoint.");
    for (const ContactParameters &contact : scene.contacts)
      if (is_nodal(contact.method))
        throw SectionReader(reader, {"Contact", contact.name})
          .error("Method", "Contact from nodes and cells" + refined + " Take surface points.");
  }

  template void
  check_refinement(const ParameterReader &, const Scene<2> &);
  template void
  check_refinement(const ParameterReader &, const Scene<3> &);
} // namespace kedge
