#ifndef kedge_scene_print_parameters_h
#define kedge_scene_print_parameters_h

#include <ostream>
#include <string>

namespace kedge
{
  /**
   * Prints every parameter of a scene file with its meaning and unit, what is
   * allowed and its default, in the form of a scene file. A section of which
   * there may be any number is shown once, as <name>.
   *
   * @param which  the name of a section, to print that one alone; "json": all of them as
   * JSON, for editors and scripts; empty: all
   * @throws UserError if there is no such section
   */
  void
  print_parameters(std::ostream &out, const std::string &which = "");
} // namespace kedge

#endif
