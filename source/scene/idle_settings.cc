#include <kedge/scene/declarations.h>
#include <kedge/scene/idle_settings.h>
#include <kedge/scene/parameter_reader.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** Collects the lines. */
    class IdleSettings
    {
    public:
      IdleSettings(const ParameterReader &reader)
        : reader(reader)
      {}

      /** Those of the entries of a section that were given have no effect: @p why. */
      void
      add(const std::vector<std::string> &section,
          const std::vector<std::string> &entries,
          const std::string              &why)
      {
        for (const std::string &entry : entries)
          if (reader.differs_from_default(section, entry))
            lines.push_back(ParameterReader::full_name(section, entry) + " = " +
                            reader.text(section, entry) + " has no effect " + why);
      }

      std::vector<std::string> lines;

    private:
      const ParameterReader &reader;
    };

    void
    add_of_time(const TimeParameters &time, IdleSettings &idle)
    {
      const SchemeKind scheme = time.scheme;
      if (scheme != SchemeKind::newmark)
        idle.add({"Time"}, {"Newmark beta", "Newmark gamma"}, "but with Time/Scheme = newmark.");
      if (scheme != SchemeKind::generalised_alpha)
        idle.add({"Time"}, {"Spectral radius"}, "but with Time/Scheme = generalised-alpha.");
      if (scheme != SchemeKind::newmark && scheme != SchemeKind::trapezoidal &&
          scheme != SchemeKind::generalised_alpha)
        idle.add({"Time"},
                 {"Carry acceleration"},
                 "but with Time/Scheme = newmark, trapezoidal or generalised-alpha.");
    }

    template <int dim>
    void
    add_of_inertia(const Scene<dim> &scene, IdleSettings &idle)
    {
      if (scene.time.scheme != SchemeKind::quasi_static &&
          scene.time.scheme != SchemeKind::clc_quasi_static)
        {
          if (scene.transfer.velocity_mapping != VelocityUpdate::flip)
            idle.add({"Mapping"}, {"Filter time"}, "but with Mapping/Velocity = flip.");
          return;
        }
      const std::string why = "without inertia (Time/Scheme).";
      idle.add({"Mapping"}, {"Velocity", "Filter time", "Lumping", "Audit"}, why);
      for (const auto &body : scene.bodies)
        idle.add({"Bodies", body.name}, {"Initial velocity"}, why);
    }

    void
    add_of_stabilisation(const StabilisationKind method, IdleSettings &idle)
    {
      if (method != StabilisationKind::ghost)
        idle.add({"Stabilisation"},
                 {"Ghost mass factor",
                  "Ghost stiffness factor",
                  "Ghost conductivity factor",
                  "Ghost storage factor"},
                 "but with Stabilisation/Method = ghost.");
      if (method != StabilisationKind::aggregation)
        idle.add({"Stabilisation"},
                 {"Smallest filling"},
                 "but with Stabilisation/Method = aggregation.");
    }

    void
    add_of_pores(const SchemeKind scheme, IdleSettings &idle)
    {
      if (scheme != SchemeKind::clc_midpoint)
        idle.add({"Pore fluid"},
                 {"Stabilisation theta", "Velocity filter"},
                 "but with Time/Scheme = clc-midpoint.");
      if (scheme != SchemeKind::midpoint)
        idle.add({"Pore fluid"}, {"Theta"}, "but with Time/Scheme = midpoint.");
    }

    /** Who writes a section of Contact mostly wants contact. */
    void
    add_of_contact(const ParameterReader                &reader,
                   const std::vector<ContactParameters> &contacts,
                   IdleSettings                         &idle)
    {
      for (const ContactParameters &contact : contacts)
        if (contact.method == ContactMethod::none &&
            reader.text({"Contact", contact.name}, "Method") != "none")
          idle.lines.push_back(
            "Contact/" + contact.name +
            " gives no law: its bodies pass through each other. To let them touch, give a "
            "Friction coefficient (0: no friction); if they are to pass, say Method = none.");
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  idle_settings(const ParameterFile &file, const Scene<dim> &scene)
  {
    const ParameterReader reader(file, declare_scene<dim>(scene.constants), scene.constants);
    IdleSettings          idle(reader);
    add_of_time(scene.time, idle);
    add_of_inertia(scene, idle);
    add_of_stabilisation(scene.stabilisation.method, idle);
    if (scene.pore_fluid)
      add_of_pores(scene.time.scheme, idle);
    if (scene.equilibrium.steps == 0)
      idle.add({"Equilibrium"}, {"Duration"}, "without Equilibrium/Steps.");
    for (const auto &body : scene.bodies)
      if (!scene.pore_fluid)
        idle.add({"Bodies", body.name}, {"Saturated"}, "without a Pore fluid.");
    const auto feels_it = [](const auto &body) {
      return body.body_force;
    };
    if (std::none_of(scene.bodies.begin(), scene.bodies.end(), feels_it) &&
        std::none_of(scene.rigid_bodies.begin(), scene.rigid_bodies.end(), feels_it))
      idle.add({"Body force"}, {"Acceleration"}, "on bodies with Body force = false.");
    if (!scene.pore_fluid)
      for (const MaterialParameters &material : scene.materials)
        idle.add({"Materials", material.name},
                 {"Hydraulic conductivity", "Conductivity law"},
                 "without a Pore fluid.");
    add_of_contact(reader, scene.contacts, idle);
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const auto &body) {
            return body.material == m;
          }))
        idle.lines.push_back("Materials/" + scene.materials[m].name +
                             " is the Material of no body.");
    return idle.lines;
  }

  template std::vector<std::string>
  idle_settings(const ParameterFile &, const Scene<2> &);
  template std::vector<std::string>
  idle_settings(const ParameterFile &, const Scene<3> &);
} // namespace kedge
