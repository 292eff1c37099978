#include <kedge/base/user_errors.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/read_geometry.h>
#include <kedge/scene/rigid_section.h>
#include <kedge/scene/values.h>

namespace kedge
{
  namespace
  {
    std::optional<double>
    optional_number(const SectionReader &section, const std::string &entry)
    {
      if (section.is_empty(entry))
        return std::nullopt;
      return section.number(entry);
    }

    std::vector<double>
    optional_numbers(const SectionReader &section, const std::string &entry)
    {
      return section.is_empty(entry) ? std::vector<double>() : section.numbers(entry);
    }

    template <int dim>
    void
    read_freedoms(const SectionReader &section, RigidBodyParameters<dim> &body)
    {
      const auto read = [&](const unsigned int k, const std::string &entry) {
        RigidFreedom &freedom = body.freedoms[k];
        freedom.motion = parse_body_motion(section.text(entry), section.constants(), freedom.force);
        if (freedom.motion.kind == ConditionKind::motion)
          throw section.error(entry,
                              "A rigid body moves as a whole: give a displacement or a velocity.");
      };
      for (unsigned int k = 0; k < 3; ++k)
        {
          if (k < dim)
            read(k, std::string("Component ") + "xyz"[k]);
          if (k == 2 || dim == 3)
            read(3 + k, std::string("Rotation ") + "xyz"[k]);
        }
    }

    template <int dim>
    void
    check_counts(const SectionReader &section, const RigidBodyParameters<dim> &body)
    {
      const std::size_t n = body.inertia.size(), m = body.angular_velocity.size();
      if (n != 0 && (dim == 3 ? n != 3 && n != 6 : n != 1))
        throw section.error("Inertia",
                            dim == 3 ? "It must have 3 numbers, xx, yy, zz, or 6."
                                     : "It must be one number.");
      if (m != 0 && m != (dim == 3 ? 3 : 1))
        throw section.error("Angular velocity",
                            dim == 3 ? "It must have 3 numbers." : "It must be one number.");
    }

    /** So many times larger than the whole grid, a tool was probably given in other units. */
    constexpr double suspicious_size = 20.;

    template <int dim>
    void
    check_units(const SectionReader       &section,
                const Geometry<dim>       &geometry,
                const GridParameters<dim> &grid)
    {
      const auto box =
        geometry.bounding_box(dealii::BoundingBox<dim>({grid.origin, grid.origin + grid.extent}));
      for (unsigned int d = 0; d < dim; ++d)
        if (box.side_length(d) > suspicious_size * grid.extent[d])
          throw section.error("Geometry",
                              "The body is " + std::to_string(box.side_length(d)) +
                                " m long in direction " + "xyz"[d] + ", the grid only " +
                                std::to_string(grid.extent[d]) +
                                " m (Grid/Extent). If an STL file is in millimetres, its scale is "
                                "0.001.");
    }

    template <int dim>
    RigidBodyParameters<dim>
    read_rigid_body(const SectionReader         &section,
                    const GridParameters<dim>   &grid,
                    const std::filesystem::path &folder,
                    const bool                   has_soil)
    {
      RigidBodyParameters<dim> body;
      body.name = section.name();
      if (!section.is_empty("Geometry"))
        {
          body.geometry = read_geometry<dim>(section, grid, folder, BodyExtent::anywhere);
          if (has_soil)
            check_units(section, *body.geometry, grid);
        }
      body.spacing          = optional_number(section, "Surface spacing").value_or(0.);
      body.density          = section.number("Density");
      body.mass             = optional_number(section, "Mass");
      body.centre           = optional_numbers(section, "Centre");
      body.inertia          = optional_numbers(section, "Inertia");
      body.velocity         = section.numbers("Velocity");
      body.angular_velocity = optional_numbers(section, "Angular velocity");
      body.body_force       = section.truth("Body force");
      check_counts(section, body);
      read_freedoms(section, body);
      return body;
    }

    LineParameters
    read_line(const ParameterReader &reader, const SectionReader &section)
    {
      LineParameters line;
      line.name       = section.name();
      line.body       = find_name(reader, section, "Body", "Rigid bodies");
      line.attachment = optional_numbers(section, "Attachment");
      if (first_is_given(section, "Anchor", "Other body"))
        {
          line.anchor = section.list("Anchor");
          if (!section.is_empty("Other attachment"))
            throw section.error("Other attachment", "There is no Other body.");
        }
      else
        {
          line.other            = find_name(reader, section, "Other body", "Rigid bodies");
          line.other_attachment = optional_numbers(section, "Other attachment");
          if (*line.other == line.body)
            throw section.error("Other body", "Both ends are attached to the same body.");
        }
      line.length    = section.text("Length");
      line.stiffness = optional_number(section, "Stiffness");
      line.pushes    = section.truth("Pushes");
      return line;
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_rigid_bodies(const ValuePatterns<dim> &allow)
  {
    SectionDeclaration section = {
      "Rigid bodies",
      "Bodies that do not deform: tools, anchors, footings, tops. They need no material points "
      "and may leave the grid.",
      SectionKind::named,
      {{"Geometry",
        "",
        allow.geometry().or_empty(),
        "Its shape, as of Bodies [m]; an STL file has units of its own (its scale). Empty: the "
        "body is known by its Mass, Centre and Inertia alone."},
       {"Surface spacing",
        "",
        allow.number(NumberRange::positive()).or_empty(),
        "Width of the facets of its surface, where that is curved [m]. Empty: a fortieth of its "
        "diagonal."},
       {"Density",
        "0",
        allow.number(NumberRange::not_negative()),
        "Of all that the surface encloses [kg/m^3]."},
       {"Mass",
        "",
        allow.number(NumberRange::positive()).or_empty(),
        "In place of what Density and surface give [kg; kg/m in 2D]."},
       {"Centre",
        "",
        allow.vector().or_empty(),
        "Place of the centre of mass at the start, in place of that of the shape [m]."},
       {"Inertia",
        "",
        allow.numbers().or_empty(),
        dim == 3 ? "Moments of inertia about the centre, along the axes at the start: xx, yy, zz "
                   "or xx, yy, zz, xy, xz, yz, in place of those of the shape [kg m^2]. Without "
                   "a shape and empty: a point, which does not turn."
                 : "Moment of inertia about the centre, in place of that of the shape [kg m]. "
                   "Without a shape and empty: a point, which does not turn."},
       {"Velocity",
        dim == 2 ? "0, 0" : "0, 0, 0",
        allow.vector(),
        "Of the centre at the start [m/s]."},
       {"Angular velocity",
        "",
        allow.numbers().or_empty(),
        dim == 3 ? "At the start, about x, y, z [rad/s]. Empty: none."
                 : "At the start [rad/s]. Empty: none."},
       {"Body force", "true", allow.truth(), "Whether the section Body force acts on it."}}};
    for (const char letter : std::string("xyz").substr(0, dim))
      section.entries.push_back(
        {std::string("Component ") + letter,
         "free",
         allow.body_motion(),
         std::string("Motion of its centre in direction ") + letter + ", or the force on it."});
    for (const char letter : std::string(dim == 3 ? "xyz" : "z"))
      section.entries.push_back(
        {std::string("Rotation ") + letter,
         "free",
         allow.body_motion(),
         std::string("Turn about ") + letter +
           ": as Component, with angles [rad] and angular velocities [rad/s]; force(..) is a "
           "moment [N m]. Turns about several axes in one step are added as vectors."});
    return section;
  }



  template <int dim>
  SectionDeclaration
  declare_lines(const ValuePatterns<dim> &allow)
  {
    const auto body = allow.text("the name of a section of Rigid bodies");
    return {
      "Lines",
      "Ropes and chains without weight that pull at rigid bodies; rods that push, too.",
      SectionKind::named,
      {{"Body", std::nullopt, body, "The body at one end."},
       {"Attachment",
        "",
        allow.vector().or_empty(),
        "Where the line is attached to it, at the start [m]. Empty: at its centre of mass."},
       {"Anchor",
        "",
        allow.expressions({"t"}, "t").or_empty(),
        "The other end: a place, which may move [m]. Either Anchor or Other body is given."},
       {"Other body", "", body.or_empty(), "The body at the other end."},
       {"Other attachment",
        "",
        allow.vector().or_empty(),
        "Where the line is attached to the other body, at the start [m]. Empty: at its centre."},
       {"Length",
        "",
        allow.expression({"t"}, "t").or_empty(),
        "Without load [m]; of a winch it changes with t. Empty: as long as its ends are apart at "
        "the start."},
       {"Stiffness",
        "",
        allow.number(NumberRange::positive()).or_empty(),
        "Force over stretch [N/m]. Empty: the line does not stretch."},
       {"Pushes",
        "false",
        allow.truth(),
        "Whether it is a rod, which pushes as well as it pulls; a line goes slack."}}};
  }



  template <int dim>
  std::vector<RigidBodyParameters<dim>>
  read_rigid_bodies(const ParameterReader       &reader,
                    const GridParameters<dim>   &grid,
                    const std::filesystem::path &folder)
  {
    const bool                            has_soil = !reader.names("Bodies").empty();
    std::vector<RigidBodyParameters<dim>> bodies;
    UserErrors                            errors;
    for (const std::string &name : reader.names("Rigid bodies"))
      errors.attempt([&]() {
        bodies.push_back(
          read_rigid_body(SectionReader(reader, {"Rigid bodies", name}), grid, folder, has_soil));
      });
    errors.throw_if_any();
    return bodies;
  }



  std::vector<LineParameters>
  read_lines(const ParameterReader &reader)
  {
    std::vector<LineParameters> lines;
    UserErrors                  errors;
    for (const std::string &name : reader.names("Lines"))
      errors.attempt([&]() {
        lines.push_back(read_line(reader, SectionReader(reader, {"Lines", name})));
      });
    errors.throw_if_any();
    return lines;
  }

#define KEDGE_INSTANTIATE(dim)                                                                     \
  template SectionDeclaration                    declare_rigid_bodies(const ValuePatterns<dim> &); \
  template SectionDeclaration                    declare_lines(const ValuePatterns<dim> &);        \
  template std::vector<RigidBodyParameters<dim>> read_rigid_bodies(const ParameterReader &,        \
                                                                   const GridParameters<dim> &,    \
                                                                   const std::filesystem::path &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
