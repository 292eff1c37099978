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
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_contact(const ValuePatterns<dim> &allow)
  {
    const auto group = allow.text("names of sections of Bodies, separated by commas");
    return {"Contact",
            "Bodies that may move apart: those of the first group share no nodes of the grid with "
            "those of the second, each group moves by itself, and they pass through each other. "
            "Bodies between which no section stands move as one where they meet on the grid.",
            SectionKind::named,
            {{"First", std::nullopt, group, "The bodies of the first group."},
             {"Second", std::nullopt, group, "The bodies of the second group."}}};
  }



  std::vector<ContactParameters>
  read_contacts(const ParameterReader &reader)
  {
    std::vector<ContactParameters> contacts;
    for (const std::string &name : reader.names("Contact"))
      {
        const SectionReader     section(reader, {"Contact", name});
        const ContactParameters contact{name,
                                        read_group(reader, section, "First"),
                                        read_group(reader, section, "Second")};
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
