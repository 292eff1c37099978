#include <kedge/base/user_errors.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/joint_section.h>
#include <kedge/scene/values.h>

#include <deal.II/base/numbers.h>

namespace kedge
{
  namespace
  {
    constexpr const char *hinge = "hinge", *fixed = "fixed";

    /** Of two stops the lower one lies below the start and the higher one above it. */
    void
    read_stops(const SectionReader &section, JointParameters &joint)
    {
      const auto angle = [&](const std::string &entry, const double sign) -> std::optional<double> {
        if (section.is_empty(entry))
          return std::nullopt;
        const double value = section.number(entry);
        if (sign * value < 0. || sign * value >= dealii::numbers::PI)
          throw section.error(entry,
                              sign > 0. ? "It must be from 0 to less than pi: angles are counted "
                                          "from the start."
                                        : "It must be from more than -pi to 0: angles are counted "
                                          "from the start.");
        return value;
      };
      joint.lowest  = angle("Lowest angle", -1.);
      joint.highest = angle("Highest angle", 1.);
      if (!joint.lowest && !joint.highest)
        return;
      if (section.is_empty("Stop stiffness"))
        throw section.error("Stop stiffness", "A hinge with stops needs it.");
      joint.stop_stiffness = section.number("Stop stiffness");
    }

    /** What only a hinge can have. */
    void
    refuse_on_fixed(const SectionReader &section)
    {
      for (const char *entry : {"Lowest angle", "Highest angle", "Stop stiffness"})
        if (!section.is_empty(entry))
          throw section.error(entry, "A fixed joint does not turn.");
      if (section.number("Friction moment") > 0.)
        throw section.error("Friction moment", "A fixed joint does not turn.");
    }

    template <int dim>
    JointParameters
    read_joint(const ParameterReader &reader, const SectionReader &section)
    {
      JointParameters joint;
      joint.name = section.name();
      joint.body = find_name(reader, section, "Body", "Rigid bodies");
      if (!section.is_empty("Other body"))
        joint.other = find_name(reader, section, "Other body", "Rigid bodies");
      if (joint.other && *joint.other == joint.body)
        throw section.error("Other body", "A joint is between two bodies.");
      joint.place = section.numbers("Place");
      joint.turns = section.text("Kind") == hinge;
      if (!joint.turns)
        {
          refuse_on_fixed(section);
          return joint;
        }
      if (dim == 3)
        {
          if (section.is_empty("Axis"))
            throw section.error("Axis", "A hinge in space needs an axis.");
          joint.axis = section.numbers("Axis");
          if (joint.axis == std::vector<double>(3, 0.))
            throw section.error("Axis", "It must point somewhere.");
        }
      read_stops(section, joint);
      joint.friction = section.number("Friction moment");
      return joint;
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_joints(const ValuePatterns<dim> &allow)
  {
    const auto         body    = allow.text("the name of a section of Rigid bodies");
    SectionDeclaration section = {
      "Joints",
      "What ties rigid bodies to each other, or to a place in space.",
      SectionKind::named,
      {{"Body", std::nullopt, body, "The body that is tied."},
       {"Other body", "", body.or_empty(), "To which it is tied. Empty: to space."},
       {"Kind",
        hinge,
        allow.one_of({hinge, fixed}),
        "A hinge lets the bodies turn against each other about its axis; a fixed joint holds them "
        "as they are at the start."},
       {"Place", std::nullopt, allow.vector(), "Where the joint is at the start [m]."},
       {"Lowest angle",
        "",
        allow.number().or_empty(),
        "A stop: the smallest angle that the body turns against the other, counted from the start "
        "[rad]. Empty: no stop."},
       {"Highest angle",
        "",
        allow.number().or_empty(),
        "Another stop: the largest angle [rad]. Empty: no stop."},
       {"Stop stiffness",
        "",
        allow.number(NumberRange::positive()).or_empty(),
        "Moment over angle by which stops give [N m]; what a stop stores it gives back."},
       {"Friction moment",
        "0",
        allow.number(NumberRange::not_negative()),
        "Largest moment of friction about the axis: up to it the hinge sticks [N m]."}}};
    if (dim == 3)
      section.entries.insert(section.entries.begin() + 4,
                             {"Axis",
                              "",
                              allow.vector().or_empty(),
                              "Direction of a hinge's axis at the start, of any length."});
    return section;
  }



  template <int dim>
  std::vector<JointParameters>
  read_joints(const ParameterReader &reader)
  {
    std::vector<JointParameters> joints;
    UserErrors                   errors;
    for (const std::string &name : reader.names("Joints"))
      errors.attempt([&]() {
        joints.push_back(read_joint<dim>(reader, SectionReader(reader, {"Joints", name})));
      });
    errors.throw_if_any();
    return joints;
  }

  template SectionDeclaration
  declare_joints(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_joints(const ValuePatterns<3> &);
  template std::vector<JointParameters>
  read_joints<2>(const ParameterReader &);
  template std::vector<JointParameters>
  read_joints<3>(const ParameterReader &);
} // namespace kedge
