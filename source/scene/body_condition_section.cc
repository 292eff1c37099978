#include <kedge/base/exceptions.h>
#include <kedge/base/user_errors.h>
#include <kedge/scene/body_condition_section.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/values.h>

namespace kedge
{
  namespace
  {
    /** The entry of a direction, with its motion; nothing if that is free. */
    template <int dim>
    void
    read_line(const SectionReader              &section,
              const std::string                &entry,
              const dealii::Tensor<1, dim>     &direction,
              std::vector<PrescribedLine<dim>> &lines)
    {
      PrescribedLine<dim> line;
      line.direction = direction;
      line.motion    = parse_body_motion(section.text(entry), section.constants(), line.force);
      if (!line.force.empty() || line.motion.kind != ConditionKind::free)
        lines.push_back(line);
    }

    template <int dim>
    void
    read_oblique_line(const SectionReader &section, BodyConditionParameters<dim> &condition)
    {
      if (section.is_empty("Direction"))
        {
          if (section.text("Along direction") != "free")
            throw section.error("Along direction", "It needs a Direction.");
          return;
        }
      const std::vector<double> numbers = section.numbers("Direction");
      dealii::Tensor<1, dim>    direction;
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = numbers[d];
      if (direction.norm() == 0.)
        throw section.error("Direction", "It must not be zero.");
      const std::size_t n = condition.lines.size();
      read_line<dim>(section, "Along direction", direction / direction.norm(), condition.lines);
      if (condition.lines.size() == n)
        throw section.error("Along direction",
                            "Nothing is prescribed along the Direction; give one of the two.");
      if (n + 1 > dim)
        throw section.error("Along direction",
                            "All components are prescribed already; leave one of them free.");
    }

    template <int dim>
    BodyConditionParameters<dim>
    read_body_condition(const ParameterReader &reader, const SectionReader &section)
    {
      find_name(reader, section, "Body", "Bodies");
      BodyConditionParameters<dim> condition;
      condition.name     = section.name();
      condition.body     = section.text("Body");
      condition.where    = section.text("Where");
      condition.reaction = section.truth("Reaction");
      if (first_is_given(section, "Side", "Section"))
        condition.side = parse_side_or_all<dim>(section.text("Side"));
      else
        {
          const auto [d, place] = parse_section<dim>(section.text("Section"), section.constants());
          condition.side        = 2 * d;
          condition.section     = place;
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          dealii::Tensor<1, dim> direction;
          direction[d] = 1.;
          read_line<dim>(section, std::string("Component ") + "xyz"[d], direction, condition.lines);
        }
      read_oblique_line(section, condition);
      if (condition.lines.empty())
        throw section.error("Component x",
                            "All components are free, so the condition does nothing; fix or move "
                            "one, give a force, or leave the condition out.");
      return condition;
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_body_conditions(const ValuePatterns<dim> &allow)
  {
    const std::string letters = std::string("xyz").substr(0, dim);
    const std::string words   = dim == 2 ? "x, y" : "x, y, z";
    const auto        coordinates =
      dim == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
    std::vector<std::string> of_surface = coordinates;
    for (const char letter : letters)
      of_surface.push_back(std::string("n") + letter);
    const std::string  surface_words = words + (dim == 2 ? ", nx, ny" : ", nx, ny, nz");
    SectionDeclaration section       = {
            "Body conditions",
            "What moves a body at its own surface, or at a plane section within it; it carries the "
                  "condition along, whatever nodes of the grid it passes. Either Side or Section says where.",
            SectionKind::named,
            {{"Body",
              std::nullopt,
              allow.text("the name of a section of Bodies"),
              "The body that is moved."},
             {"Side",
              "",
              allow.side_or_all().or_empty(),
              "Its outer faces that look to this side at the start; all: its whole surface."},
             {"Section",
              "",
              allow.section().or_empty(),
              "The plane normal to a direction through it, at this place at the start [m]."},
             {"Where",
              "",
              allow.expression(of_surface, surface_words).or_empty(),
              "The part of the faces where this is true at the start, of the place and the outward "
                    "normal; empty: all; 0: none."},
             {"Reaction",
              "false",
              allow.truth(),
              "Whether history.csv shows the force on the body, reaction_NAME_x.. [N; N/m in 2D]."}}};
    for (const char letter : letters)
      section.entries.push_back({std::string("Component ") + letter,
                                 "free",
                                 allow.body_motion(),
                                 std::string("Motion of the faces in direction ") + letter +
                                   "; by a force, all of them move alike."});
    section.entries.push_back({"Direction",
                               "",
                               allow.vector().or_empty(),
                               "Any other direction, of an inclined roller [-]."});
    section.entries.push_back({"Along direction",
                               "free",
                               allow.body_motion(),
                               "Motion of the faces along it; what is normal to it stays free."});
    return section;
  }



  template <int dim>
  std::vector<BodyConditionParameters<dim>>
  read_body_conditions(const ParameterReader &reader)
  {
    std::vector<BodyConditionParameters<dim>> conditions;
    UserErrors                                errors;
    for (const std::string &name : reader.names("Body conditions"))
      errors.attempt([&]() {
        conditions.push_back(
          read_body_condition<dim>(reader, SectionReader(reader, {"Body conditions", name})));
      });
    errors.throw_if_any();
    return conditions;
  }

#define KEDGE_INSTANTIATE(dim)                                                     \
  template SectionDeclaration declare_body_conditions(const ValuePatterns<dim> &); \
  template std::vector<BodyConditionParameters<dim>> read_body_conditions(const ParameterReader &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
