#include <kedge/io/scene_settings.h>

#include <set>
#include <vector>

namespace kedge
{
  namespace
  {
    /** Of the differing settings that a message names. */
    constexpr unsigned int most_named = 5;

    std::string
    quoted(const SceneSettings &settings, const std::string &name)
    {
      const auto entry = settings.find(name);
      return entry == settings.end() ? "not there" : "'" + entry->second + "'";
    }
  } // namespace



  bool
  may_change_on_resume(const std::string &setting)
  {
    static const std::set<std::string> entries = {"Title",
                                                  "Time/End",
                                                  "Time/Step",
                                                  "Time/Smallest step factor",
                                                  "Newton/Iterations"};
    for (const char *section : {"Output/", "Checks/"})
      if (setting.rfind(section, 0) == 0)
        return true;
    return entries.count(setting) > 0;
  }



  std::string
  forbidden_changes(const SceneSettings &then, const SceneSettings &now)
  {
    std::set<std::string> names;
    for (const SceneSettings *settings : {&then, &now})
      for (const auto &entry : *settings)
        names.insert(entry.first);
    std::string  text;
    unsigned int n_changed = 0;
    for (const std::string &name : names)
      {
        const std::string before = quoted(then, name), after = quoted(now, name);
        if (before == after || may_change_on_resume(name))
          continue;
        if (++n_changed <= most_named)
          text += (n_changed > 1 ? ", " : "") + name + " was " + before + ", is " + after;
      }
    if (n_changed > most_named)
      text += ", and " + std::to_string(n_changed - most_named) + " more";
    return text;
  }
} // namespace kedge
