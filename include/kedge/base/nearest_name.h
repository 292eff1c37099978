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

  /**
   * " Did you mean 'X'?" with the candidate that @p name is like; nothing if it is like
   * none. Alike are names that differ in few letters for their length, and names of which
   * one holds the other's words; case and the kind of blanks (_ - and spaces) do not count.
   */
  std::string
  did_you_mean(const std::string &name, const std::vector<std::string> &candidates);
} // namespace kedge

#endif
