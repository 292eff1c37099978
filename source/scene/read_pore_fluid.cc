#include <kedge/base/expression.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/read_pore_fluid.h>
#include <kedge/scene/values.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** Refuses pressures in a scene without a fluid. */
    template <int dim>
    void
    check_dry(const ParameterReader &reader, const Scene<dim> &scene)
    {
      for (const auto &condition : scene.node_conditions)
        if (!condition.pore_pressure.empty())
          throw SectionReader(reader, {"Node conditions", condition.name})
            .error("Pore pressure", "The bodies are dry: give Pore fluid/Density.");
      const SectionReader stabilisation(reader, {"Stabilisation"});
      for (const char *factor : {"Ghost conductivity factor", "Ghost storage factor"})
        if (!stabilisation.is_empty(factor))
          throw stabilisation.error(factor, "The bodies are dry: give Pore fluid/Density.");
      for (const std::string &name : reader.names("Surface pressures"))
        throw SectionReader(reader, {"Surface pressures", name})
          .error("Pressure", "The bodies are dry: give Pore fluid/Density.");
      for (const std::string &name : reader.names("Surface fluxes"))
        throw SectionReader(reader, {"Surface fluxes", name})
          .error("Flux", "The bodies are dry: give Pore fluid/Density.");
    }

    /** Refuses what the u-p balance does not have. */
    template <int dim>
    void
    check_saturated(const ParameterReader &reader, const Scene<dim> &scene)
    {
      const SchemeKind scheme = scene.time.scheme;
      if (scheme != SchemeKind::quasi_static && scheme != SchemeKind::newmark &&
          scheme != SchemeKind::trapezoidal && scheme != SchemeKind::midpoint &&
          scheme != SchemeKind::clc_midpoint)
        throw SectionReader(reader, {"Time"})
          .error("Scheme",
                 "Saturated bodies (Pore fluid) go with clc-midpoint, quasi-static, newmark, "
                 "trapezoidal and midpoint.");
      const bool of_nodes = scene.time.step_kind == StepSizeKind::cfl_nodal ||
                            scene.time.step_kind == StepSizeKind::cfl_density;
      if (scene.time.step_kind != StepSizeKind::fixed &&
          !(of_nodes && scheme == SchemeKind::clc_midpoint))
        throw SectionReader(reader, {"Time"})
          .error("Step",
                 "Saturated bodies (Pore fluid) need a size in seconds or, with Scheme = "
                 "clc-midpoint, a FACTOR cfl or FACTOR density cfl, of the skeleton's waves.");
      for (const auto &body : scene.bodies)
        {
          const MaterialParameters &material = scene.materials[body.material];
          if (material.initial_porosity == 0.)
            throw SectionReader(reader, {"Materials", material.name})
              .error("Initial porosity",
                     "Body '" + body.name + "' is saturated, it must be given.");
        }
      for (const auto &material : scene.materials)
        if (material.viscosity > 0.)
          throw SectionReader(reader, {"Materials", material.name})
            .error("Viscosity", "In saturated bodies (Pore fluid) it must be 0: the fluid damps.");
      for (const auto &material : scene.materials)
        if (material.volume_change != VolumeChange::pointwise)
          throw SectionReader(reader, {"Materials", material.name})
            .error("Volume change", "In saturated bodies (Pore fluid) it must be pointwise.");
      if (scene.transfer.lumping > 0.)
        throw SectionReader(reader, {"Mapping"})
          .error("Lumping", "In saturated bodies (Pore fluid) the mass matrix must be consistent.");
    }

    /** Refuses what the conserving balance does not have, and reads what it alone has. */
    template <int dim>
    void
    read_conserving(const ParameterReader &reader, const Scene<dim> &scene, PorousParameters &pores)
    {
      const SectionReader section(reader, {"Pore fluid"});
      if (scene.time.scheme == SchemeKind::clc_midpoint)
        {
          if (pores.coarse_pressure)
            throw section.error("Pressure space",
                                "With Time/Scheme = clc-midpoint it must be equal: velocities are "
                                "no fields of a coarser space.");
          if (scene.stabilisation.method == StabilisationKind::ghost)
            throw SectionReader(reader, {"Stabilisation"})
              .error("Method",
                     "In saturated bodies (Pore fluid) with Time/Scheme = clc-midpoint it must be "
                     "aggregation or none.");
        }
      const bool smooth =
        std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const BodyParameters<dim> &body) {
          return body.basis == BasisKind::gimp || body.basis == BasisKind::spline;
        });
      pores.velocity_filter     = section.number("Velocity filter");
      pores.stabilisation_theta = !section.is_empty("Stabilisation theta")
                                    ? section.number("Stabilisation theta")
                                  : smooth ? 0.5
                                           : 0.55;
    }

    /** What its material says of a body's pores, and where it says nothing the fluid. */
    template <int dim>
    BodyPores
    read_pores(const ParameterReader     &reader,
               const Scene<dim>          &scene,
               const BodyParameters<dim> &body)
    {
      const std::string   conductivity = "Hydraulic conductivity", law = "Conductivity law";
      const SectionReader fluid(reader, {"Pore fluid"});
      const SectionReader material(reader, {"Materials", scene.materials[body.material].name});
      const auto          of = [&](const std::string &entry) -> const SectionReader          &{
        return material.is_empty(entry) ? fluid : material;
      };
      BodyPores pores;
      pores.is_dry        = !SectionReader(reader, {"Bodies", body.name}).truth("Saturated");
      pores.kozeny_carman = of(law).text(law) == "kozeny-carman";
      if (!of(conductivity).is_empty(conductivity))
        pores.hydraulic_conductivity = of(conductivity).number(conductivity);
      else if (!pores.is_dry)
        throw fluid.error(conductivity,
                          "It must be given where there is a pore fluid, here or of Materials/" +
                            scene.materials[body.material].name + ".");
      return pores;
    }

    template <int dim>
    std::vector<BodyPores>
    read_bodies(const ParameterReader &reader, const Scene<dim> &scene)
    {
      std::vector<BodyPores> bodies;
      for (const auto &body : scene.bodies)
        {
          const SectionReader section(reader, {"Bodies", body.name});
          bodies.push_back(read_pores(reader, scene, body));
          if (!bodies.back().is_dry)
            continue;
          const Expression pressure(body.initial_pore_pressure, {"x", "y", "z"}, scene.constants);
          if (!(pressure.is_constant() && pressure.value() == 0.))
            throw section.error("Initial pore pressure", "The body is dry: Saturated = false.");
          for (const char *surfaces : {"Surface pressures", "Surface fluxes"})
            for (const std::string &name : reader.names(surfaces))
              if (SectionReader(reader, {surfaces, name}).text("Body") == body.name)
                throw SectionReader(reader, {surfaces, name})
                  .error("Body", "The body is dry (Bodies/" + body.name + "/Saturated).");
          if (scene.stabilisation.method == StabilisationKind::ghost)
            throw section.error("Saturated",
                                "The ghost penalty couples pressures of all bodies; with dry ones "
                                "take Stabilisation/Method = aggregation or none.");
        }
      if (std::all_of(bodies.begin(), bodies.end(), [](const BodyPores &pores) {
            return pores.is_dry;
          }))
        throw SectionReader(reader, {"Pore fluid"})
          .error("Density", "No body is Saturated; leave the Pore fluid out.");
      return bodies;
    }
  } // namespace



  template <int dim>
  std::optional<PorousParameters>
  read_pore_fluid(const ParameterReader &reader, const Scene<dim> &scene)
  {
    const SectionReader section(reader, {"Pore fluid"});
    if (section.is_empty("Density"))
      {
        if (!section.is_empty("Hydraulic conductivity"))
          throw section.error("Hydraulic conductivity",
                              "Without a Density there is no pore fluid.");
        check_dry(reader, scene);
        return {};
      }
    check_saturated(reader, scene);

    PorousParameters result;
    result.fluid.fluid_density      = section.number("Density");
    result.fluid.fluid_bulk_modulus = section.number("Bulk modulus");
    result.fluid.reference_gravity  = section.number("Reference gravity");
    result.fluid.porosity_watch =
      section.text("Lost porosity") == "stop" ? PorosityWatch::stop : PorosityWatch::warn;
    result.coarse_pressure = section.text("Pressure space") == "coarse";
    result.stabilisation   = !section.is_empty("Stabilisation") ? section.number("Stabilisation")
                             : result.coarse_pressure           ? 0.
                                                                : 1.;
    if (result.coarse_pressure && result.stabilisation > 0.)
      throw section.error("Stabilisation",
                          "It is made for Pressure space = equal; coarse needs none: leave it "
                          "empty.");
    if (scene.bodies[0].basis == BasisKind::quadratic &&
        scene.time.scheme == SchemeKind::clc_midpoint)
      throw SectionReader(reader, {"Time"})
        .error("Scheme",
               "clc-midpoint of saturated bodies goes with linear, gimp and spline bases, not with "
               "the quadratic one.");
    if (!result.coarse_pressure && scene.bodies[0].basis == BasisKind::quadratic)
      throw section.error("Pressure space",
                          "With the quadratic basis of the bodies it must be coarse.");
    result.pressure_map    = SectionReader(reader, {"Mapping"}).text("Pressure") == "lumped"
                               ? PressureMap::lumped
                               : PressureMap::consistent;
    result.surface_penalty = section.number("Surface penalty");
    result.bodies          = read_bodies(reader, scene);
    read_conserving(reader, scene, result);
    return result;
  }



  template <int dim>
  void
  read_surfaces(const ParameterReader &reader, Scene<dim> &scene)
  {
    const auto place = [&](const SectionReader &section) {
      find_name(reader, section, "Body", "Bodies");
      return SurfaceParameters{section.name(),
                               section.text("Body"),
                               parse_side_or_all<dim>(section.text("Side")),
                               section.text("Where")};
    };
    for (const std::string &name : reader.names("Surface pressures"))
      {
        const SectionReader section(reader, {"Surface pressures", name});
        scene.surface_pressures.push_back(
          {place(section), section.text("Pressure"), section.text("Flow") == "out"});
      }
    for (const std::string &name : reader.names("Surface fluxes"))
      {
        const SectionReader section(reader, {"Surface fluxes", name});
        scene.surface_fluxes.push_back({place(section), section.text("Flux")});
      }
  }



  template void
  read_surfaces<2>(const ParameterReader &, Scene<2> &);
  template void
  read_surfaces<3>(const ParameterReader &, Scene<3> &);
  template std::optional<PorousParameters>
  read_pore_fluid<2>(const ParameterReader &, const Scene<2> &);
  template std::optional<PorousParameters>
  read_pore_fluid<3>(const ParameterReader &, const Scene<3> &);
} // namespace kedge
