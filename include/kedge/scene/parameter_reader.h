#ifndef kedge_scene_parameter_reader_h
#define kedge_scene_parameter_reader_h

#include <kedge/base/exceptions.h>
#include <kedge/scene/declarations.h>
#include <kedge/scene/parameter_file.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * The entries of the section Constants, worked out; each may use the others,
   * in any order.
   *
   * @throws UserError for a name that expressions use already and for a value
   * that cannot be worked out.
   */
  std::map<std::string, double>
  read_constants(const ParameterFile &file);

  /**
   * A parameter file that fits its declarations: every section and entry is
   * known, every value is allowed, everything that must be given is there.
   * The values stand in a deal.II ParameterHandler, defaults included.
   *
   * @throws UserError for all entries that do not fit (SeveralUserErrors), each with its full
   * name, file and line, value, what is allowed, and a valid name that is like it.
   */
  class ParameterReader
  {
  public:
    ParameterReader(const ParameterFile                   &file,
                    const std::vector<SectionDeclaration> &declarations,
                    const std::map<std::string, double>   &constants);

    /** The user's names within a section, in the order of the file. */
    std::vector<std::string>
    names(const std::string &section) const;

    /** The value of an entry as text; without blanks at its ends. */
    std::string
    text(const std::vector<std::string> &section, const std::string &name) const;

    /** Whether the value of an entry is another one than its default. */
    bool
    differs_from_default(const std::vector<std::string> &section, const std::string &name) const;

    /** Where an entry was set; where its section was opened if it was not. */
    std::string
    place(const std::vector<std::string> &section, const std::string &name) const;

    const std::map<std::string, double> &
    constants() const;

    /** "Bodies/beam/Geometry" */
    static std::string
    full_name(const std::vector<std::string> &section, const std::string &entry);

    /** All values, defaults included, as a parameter file. */
    std::string
    print() const;

    /** All values, defaults included, by their full names: "Materials/clay/Density". */
    std::map<std::string, std::string>
    settings() const;

  private:
    void
    check() const;

    void
    check_section(const ParameterSection &section) const;

    void
    check_entry(const ParameterEntry &entry) const;

    /** Whether a section of this path is opened in the file. */
    bool
    is_opened(const std::vector<std::string> &path) const;

    /** All sections that the scene has, with the names that the user gave. */
    void
    for_each_declared(const std::function<void(const std::vector<std::string> &,
                                               const SectionDeclaration &)> &action) const;

    void
    declare(const std::vector<std::string> &path, const SectionDeclaration &section);

    void
    require(const std::vector<std::string> &section, const EntryDeclaration &entry) const;

    const SectionDeclaration &
    declaration(const std::string &section, const std::string &place) const;

    const ParameterFile                   file;
    const std::vector<SectionDeclaration> declarations;
    const std::map<std::string, double>   user_constants;
    dealii::ParameterHandler              handler;
  };

  /** Reads typed values out of one section of a ParameterReader. */
  class SectionReader
  {
  public:
    /** @p path: "Grid", or "Bodies" and the body's name; nothing: the top level. */
    SectionReader(const ParameterReader &reader, const std::vector<std::string> &path);

    /** The last name of the path. */
    const std::string &
    name() const;

    std::string
    text(const std::string &entry) const;

    bool
    is_empty(const std::string &entry) const;

    double
    number(const std::string &entry) const;

    unsigned int
    whole_number(const std::string &entry) const;

    bool
    truth(const std::string &entry) const;

    /** The parts of a list. */
    std::vector<std::string>
    list(const std::string &entry) const;

    /** The numbers of a list. */
    std::vector<double>
    numbers(const std::string &entry) const;

    const std::map<std::string, double> &
    constants() const;

    /** An error about an entry: its place, name and value, and then @p problem. */
    UserError
    error(const std::string &entry, const std::string &problem) const;

  private:
    const ParameterReader         &reader;
    const std::vector<std::string> path;
  };
} // namespace kedge

#endif
