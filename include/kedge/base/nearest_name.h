#ifndef kedge_base_nearest_name_h
#define kedge_base_nearest_name_h

#include <string>
#include <vector>

namespace kedge
{
  /**
   * The name in @p candidates with the smallest edit distance to @p name
   * (insertions, deletions, replacements and swaps of neighbours, each 1;
   * upper and lower case count as equal), or an empty text if there is no
   * candidate.
   */
  std::string
  nearest_name(const std::string &name, const std::vector<std::string> &candidates);
} // namespace kedge

#endif
