#include <kedge/base/nearest_name.h>
#include <kedge/base/shortened.h>
#include <kedge/scene/cross_checks.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    std::string
    list_of(const std::vector<std::string> &names)
    {
      std::string list;
      for (const std::string &name : names)
        list += (list.empty() ? "" : ", ") + name;
      return shortened(list);
    }
  } // namespace



  unsigned int
  find_name(const ParameterReader &reader,
            const SectionReader   &section,
            const std::string     &entry,
            const std::string     &names_section)
  {
    const std::vector<std::string> names = reader.names(names_section);
    const std::string              name  = section.text(entry);
    const auto                     found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw section.error(entry,
                          "There is no " + names_section + "/" + name + "." +
                            (names.empty() ? " The section " + names_section + " is empty."
                                           : did_you_mean(name, names) + " There " +
                                               (names.size() == 1 ? "is only " : "are ") +
                                               list_of(names) + "."));
    return static_cast<unsigned int>(found - names.begin());
  }



  bool
  first_is_given(const SectionReader &section, const std::string &a, const std::string &b)
  {
    if (section.is_empty(a) && section.is_empty(b))
      throw section.error(a, "Either " + a + " or " + b + " must be given.");
    if (!section.is_empty(a) && !section.is_empty(b))
      throw section.error(b, "Only one of " + a + " and " + b + " may be given.");
    return !section.is_empty(a);
  }
} // namespace kedge
