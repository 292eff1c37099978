#ifndef kedge_contact_parameters_h
#define kedge_contact_parameters_h

#include <string>
#include <vector>

namespace kedge
{
  /**
   * Two groups of bodies that may move apart: those of one group share no nodes
   * with those of the other. Without a law between them they pass through each other.
   */
  struct ContactParameters
  {
    std::string              name;
    std::vector<std::string> first, second; ///< bodies of each group
  };
} // namespace kedge

#endif
