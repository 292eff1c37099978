#ifndef kedge_scene_declarations_h
#define kedge_scene_declarations_h

#include <kedge/scene/value_pattern.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** What may stand behind one name. */
  struct EntryDeclaration
  {
    std::string                name;
    std::optional<std::string> default_value; ///< nothing: the entry must be given
    ValuePattern               pattern;
    std::string                documentation; ///< meaning and unit
  };

  enum class SectionKind
  {
    plain,       ///< entries
    named,       ///< any number of subsections with names of the user's, all with the same entries
    free_entries ///< entries with names of the user's
  };

  /** A section of the scene file; the one without a name is the top level. */
  struct SectionDeclaration
  {
    std::string                   name;
    std::string                   documentation;
    SectionKind                   kind = SectionKind::plain;
    std::vector<EntryDeclaration> entries; ///< free_entries: one, the model of all
  };

  /** All sections of a scene file; the patterns know the user's constants. */
  template <int dim>
  std::vector<SectionDeclaration>
  declare_scene(const std::map<std::string, double> &constants);
} // namespace kedge

#endif
