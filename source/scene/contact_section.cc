#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>
#include <kedge/scene/contact_section.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/values.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    bool
    holds(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    std::vector<std::string>
    read_group(const ParameterReader &reader,
               const SectionReader   &section,
               const std::string     &entry)
    {
      const std::vector<std::string> bodies = reader.names("Bodies"), group = section.list(entry);
      for (const std::string &name : group)
        if (!holds(bodies, name))
          throw section.error(entry,
                              "There is no body '" + name + "'. Did you mean '" +
                                nearest_name(name, bodies) + "'?");
      return group;
    }

    struct MethodName
    {
      const char   *name;
      ContactMethod method;
    };
    constexpr MethodName methods[] = {{"none", ContactMethod::none},
                                      {"surface points", ContactMethod::surface_points},
                                      {"augmented lagrangian", ContactMethod::augmented_lagrangian},
                                      {"lagrange multipliers", ContactMethod::lagrange_multipliers},
                                      {"penalty", ContactMethod::penalty},
                                      {"non-linear penalty", ContactMethod::nonlinear_penalty},
                                      {"contact velocity", ContactMethod::contact_velocity},
                                      {"ray tracing", ContactMethod::ray_tracing}};

    std::vector<std::string>
    method_names()
    {
      std::vector<std::string> names;
      for (const auto &known : methods)
        names.emplace_back(known.name);
      return names;
    }

    /** Of methods at nodes: r over the sum of Young's moduli, as in the thesis. */
    constexpr double nodal_penalty_factor = 5.;

    /** What entries a method has no use for. */
    void
    refuse_foreign_entries(const SectionReader &section, const ContactMethod method)
    {
      const auto refuse = [&](const std::string &entry, const std::string &why) {
        if (!section.is_empty(entry))
          throw section.error(entry, why);
      };
      const std::string text = "Method = " + section.text("Method");
      if (method == ContactMethod::none && !section.is_empty("Method"))
        for (const char *entry : {"Friction coefficient",
                                  "Adhesion",
                                  "Shear limit",
                                  "Penalty factor",
                                  "Surface spacing"})
          refuse(entry,
                 "With Method = none the bodies do not act on each other. Leave one of the two "
                 "out.");
      if (!is_nodal(method))
        return;
      for (const char *entry : {"Adhesion", "Shear limit", "Surface spacing"})
        refuse(entry,
               text + " finds contact at nodes of the grid and does not know this entry; Method "
                      "= surface points does. Leave one of the two out.");
      if (method == ContactMethod::lagrange_multipliers ||
          method == ContactMethod::contact_velocity)
        refuse("Penalty factor", text + " has no penalty. Leave one of the two out.");
    }

    void
    read_shear_limit(const SectionReader &section, ContactParameters &contact)
    {
      const std::string entry = "Shear limit";
      if (section.is_empty(entry))
        return;
      contact.shear_limit = section.text(entry);
      const Expression limit(contact.shear_limit, shear_limit_variables(), section.constants());
      if (limit.is_constant() && !(limit.value() > 0.))
        throw section.error(entry, "It must be greater than 0.");
      if (contact.method == ContactMethod::none)
        contact.method = ContactMethod::surface_points;
    }

    /** The entries of a law; without a method each of them asks for one. */
    void
    read_law(const SectionReader &section, ContactParameters &contact)
    {
      for (const auto &known : methods)
        if (section.text("Method") == known.name)
          contact.method = known.method;
      refuse_foreign_entries(section, contact.method);
      if (is_nodal(contact.method))
        contact.penalty_factor = nodal_penalty_factor;
      const std::pair<const char *, double *> entries[] = {
        {"Friction coefficient", &contact.friction},
        {"Adhesion", &contact.adhesion},
        {"Penalty factor", &contact.penalty_factor},
        {"Surface spacing", &contact.spacing}};
      for (const auto &[entry, value] : entries)
        {
          if (section.is_empty(entry))
            continue;
          *value = section.number(entry);
          if (contact.method == ContactMethod::none)
            contact.method = ContactMethod::surface_points;
        }
      read_shear_limit(section, contact);
    }

    /** A rigid body, if the section has one. */
    void
    read_tool(const ParameterReader &reader,
              const SectionReader   &section,
              ContactParameters     &contact)
    {
      if (section.is_empty("Tool"))
        return;
      contact.tool = find_name(reader, section, "Tool", "Rigid bodies");
      for (const char *entry : {"Second", "Wall", "Wall point", "Wall normal", "Wall displacement"})
        if (!section.is_empty(entry))
          throw section.error(entry, "A Tool stands in place of the second group. Leave one out.");
      if (is_nodal(contact.method) || section.text("Method") == "none")
        throw section.error("Method", "A tool is touched by surface points. Leave Method out.");
      contact.method = ContactMethod::surface_points;
    }

    /** A rigid plane, if the section has one. */
    template <int dim>
    void
    read_wall(const SectionReader &section, ContactParameters &contact)
    {
      const bool has_side   = !section.is_empty("Wall"),
                 has_normal = !section.is_empty("Wall normal");
      contact.has_wall      = has_side || has_normal;
      if (!contact.has_wall)
        {
          if (section.is_empty("Second"))
            throw section.error("Second",
                                "Name the bodies of the second group, or give a Wall or a Tool.");
          for (const char *entry : {"Wall point", "Wall displacement"})
            if (!section.is_empty(entry))
              throw section.error(entry, "There is no Wall, and no Wall normal.");
          return;
        }
      if (!section.is_empty("Second"))
        throw section.error("Second", "A Wall stands in place of the second group. Leave one out.");
      if (has_side && has_normal)
        throw section.error("Wall normal", "Wall has a normal already. Leave one of the two out.");
      if (is_nodal(contact.method) || section.text("Method") == "none")
        throw section.error("Method", "A wall is touched by surface points. Leave Method out.");
      contact.method = ContactMethod::surface_points;
      if (!section.is_empty("Wall point"))
        contact.wall_point = section.numbers("Wall point");
      if (!section.is_empty("Wall displacement"))
        contact.wall_displacement = section.list("Wall displacement");
      if (has_side)
        {
          contact.wall_side = parse_side<dim>(section.text("Wall"));
          return;
        }
      contact.wall_normal = section.numbers("Wall normal");
      double square       = 0.;
      for (const double component : contact.wall_normal)
        square += component * component;
      if (!(square > 0.))
        throw section.error("Wall normal", "It has no direction.");
      if (contact.wall_point.empty())
        throw section.error("Wall point", "A wall with a normal of its own needs a point.");
    }

    /** Of a rigid plane in place of the second group. */
    template <int dim>
    decltype(SectionDeclaration::entries)
    wall_entries(const ValuePatterns<dim> &allow)
    {
      return {
        {"Tool",
         "",
         allow.text("the name of a section of Rigid bodies").or_empty(),
         "In place of Second: a rigid body with a Geometry, which the bodies of First may touch, "
         "slide along and leave."},
        {"Wall",
         "",
         allow.side().or_empty(),
         "In place of Second: a rigid plane on this side of the grid, which the bodies of First "
         "may touch, slide along and leave. Node conditions hold as well as they push."},
        {"Wall point",
         "",
         allow.vector().or_empty(),
         "A point of the wall [m]. Empty: one of the side."},
        {"Wall normal",
         "",
         allow.vector().or_empty(),
         "In place of Wall: the direction from the wall towards the bodies [-]; needs Wall "
         "point."},
        {"Wall displacement",
         "",
         allow.expressions({"t"}, "t").or_empty(),
         "How far the wall is from where it is given at time t [m]: it pushes but does not pull. Empty: it "
         "stands still."}};
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_contact(const ValuePatterns<dim> &allow)
  {
    const auto group           = allow.text("names of sections of Bodies, separated by commas");
    using Range                = NumberRange;
    SectionDeclaration section = {
      "Contact",
      "Bodies that may move apart: those of the first group share no nodes of the grid with "
      "those of the second, and each group moves by itself. With one of the entries below "
      "they touch and slide on each other, else they pass through each other. "
      "Bodies between which no section stands move as one where they meet on the grid.",
      SectionKind::named,
      {{"First", std::nullopt, group, "The bodies of the first group."},
       {"Second", "", group.or_empty(), "The bodies of the second group."},
       {"Method",
        "",
        allow.one_of(method_names()).or_empty(),
        "How the groups act on each other: none lets them pass through each other; surface "
        "points finds contact at points of their surfaces and keeps the books of energy. The "
        "others are those of Pretti (2024), chapter 5, at the nodes that both groups have, and "
        "ray tracing from the faces of the first group's cells: "
        "bodies then touch from up to a cell away. "
        "Empty: surface points if one of the entries below is given, else none."},
       {"Friction coefficient",
        "",
        allow.number(Range::not_negative()).or_empty(),
        "Largest shear stress of a contact over its pressure, of saturated bodies over the "
        "effective one, less the pore pressure [-]. Empty: 0."},
       {"Adhesion",
        "",
        allow.number(Range::not_negative()).or_empty(),
        "Shear stress that a closed contact bears whatever its pressure [Pa]. Empty: 0."},
       {"Shear limit",
        "",
        allow.expression(shear_limit_variables(), "x, y, z, depth, s_u").or_empty(),
        "Largest shear stress of a contact whatever its pressure [Pa], of the place at a step's "
        "start, of depth below the top of Second at the run's start (with a Wall of First) [m], and of "
        "s_u, the undrained strength of the soil there; less than 0 counts as 0. Empty: none."},
       {"Penalty factor",
        "",
        allow.number(Range::positive()).or_empty(),
        "Stiffness of the contact, pressure over overlap, in M/h: the harmonic mean of the "
        "bodies' moduli of one-dimensional compression over the size of a cell [-]. Of methods "
        "at nodes: force over displacement of a node, in the sum of Young's moduli, in space "
        "times the size of a cell. Empty: 2; at nodes 5."},
       {"Surface spacing",
        "",
        allow.number(Range::positive()).or_empty(),
        "Distance of the points of the surfaces [m]. Empty: a fifth of a cell."}}};
    const auto walls = wall_entries(allow);
    section.entries.insert(section.entries.begin() + 2, walls.begin(), walls.end());
    return section;
  }



  template <int dim>
  std::vector<ContactParameters>
  read_contacts(const ParameterReader &reader)
  {
    std::vector<ContactParameters> contacts;
    for (const std::string &name : reader.names("Contact"))
      {
        const SectionReader section(reader, {"Contact", name});
        ContactParameters   contact;
        contact.name  = name;
        contact.first = read_group(reader, section, "First");
        if (!section.is_empty("Second"))
          contact.second = read_group(reader, section, "Second");
        read_law(section, contact);
        read_tool(reader, section, contact);
        if (!contact.tool)
          read_wall<dim>(section, contact);
        for (const std::string &body : contact.second)
          if (holds(contact.first, body))
            throw section.error("Second",
                                "Body '" + body +
                                  "' stands in First too: a body does not move apart from itself.");
        contacts.push_back(contact);
      }
    return contacts;
  }

  template SectionDeclaration
  declare_contact(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_contact(const ValuePatterns<3> &);
  template std::vector<ContactParameters>
  read_contacts<2>(const ParameterReader &);
  template std::vector<ContactParameters>
  read_contacts<3>(const ParameterReader &);
} // namespace kedge
