#include <kedge/base/exceptions.h>
#include <kedge/base/nearest_name.h>
#include <kedge/scene/contact_section.h>

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

    /** The entries of a law; each of them asks for one. */
    void
    read_law(const SectionReader &section, ContactParameters &contact)
    {
      const std::string                       method    = section.text("Method");
      const std::pair<const char *, double *> entries[] = {
        {"Friction coefficient", &contact.friction},
        {"Adhesion", &contact.adhesion},
        {"Penalty factor", &contact.penalty_factor},
        {"Surface spacing", &contact.spacing}};
      if (method == "surface points")
        contact.method = ContactMethod::surface_points;
      for (const auto &[entry, value] : entries)
        {
          if (section.is_empty(entry))
            continue;
          if (method == "none")
            throw section.error(entry,
                                "With Method = none the bodies do not act on each other. Leave one "
                                "of the two out.");
          *value         = section.number(entry);
          contact.method = ContactMethod::surface_points;
        }
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_contact(const ValuePatterns<dim> &allow)
  {
    const auto group = allow.text("names of sections of Bodies, separated by commas");
    using Range      = NumberRange;
    return {"Contact",
            "Bodies that may move apart: those of the first group share no nodes of the grid with "
            "those of the second, and each group moves by itself. With one of the entries below "
            "they touch and slide on each other, else they pass through each other. "
            "Bodies between which no section stands move as one where they meet on the grid.",
            SectionKind::named,
            {{"First", std::nullopt, group, "The bodies of the first group."},
             {"Second", std::nullopt, group, "The bodies of the second group."},
             {"Method",
              "",
              allow.one_of({"none", "surface points"}).or_empty(),
              "How the groups act on each other: none lets them pass through each other; surface "
              "points finds contact at points of their surfaces and keeps the books of energy. "
              "Empty: surface points if one of the entries below is given, else none."},
             {"Friction coefficient",
              "",
              allow.number(Range::not_negative()).or_empty(),
              "Largest shear stress of a contact over its pressure [-]. Empty: 0."},
             {"Adhesion",
              "",
              allow.number(Range::not_negative()).or_empty(),
              "Shear stress that a closed contact bears whatever its pressure [Pa]. Empty: 0."},
             {"Penalty factor",
              "",
              allow.number(Range::positive()).or_empty(),
              "Stiffness of the contact, pressure over overlap, in M/h: the harmonic mean of the "
              "bodies' moduli of one-dimensional compression over the size of a cell [-]. "
              "Empty: 2."},
             {"Surface spacing",
              "",
              allow.number(Range::positive()).or_empty(),
              "Distance of the points of the surfaces [m]. Empty: a fifth of a cell."}}};
  }



  std::vector<ContactParameters>
  read_contacts(const ParameterReader &reader)
  {
    std::vector<ContactParameters> contacts;
    for (const std::string &name : reader.names("Contact"))
      {
        const SectionReader section(reader, {"Contact", name});
        ContactParameters   contact;
        contact.name   = name;
        contact.first  = read_group(reader, section, "First");
        contact.second = read_group(reader, section, "Second");
        read_law(section, contact);
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
} // namespace kedge
