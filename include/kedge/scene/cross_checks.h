#ifndef kedge_scene_cross_checks_h
#define kedge_scene_cross_checks_h

#include <kedge/scene/parameter_reader.h>

#include <string>

namespace kedge
{
  /**
   * The index of the name that an entry holds among those of a section.
   *
   * @throws UserError with the nearest name if it is not among them.
   */
  unsigned int
  find_name(const ParameterReader &reader,
            const SectionReader   &section,
            const std::string     &entry,
            const std::string     &names_section);

  /**
   * Exactly one of two entries must be given; true if it is the first.
   *
   * @throws UserError if none or both are.
   */
  bool
  first_is_given(const SectionReader &section, const std::string &a, const std::string &b);
} // namespace kedge

#endif
