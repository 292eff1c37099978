#ifndef kedge_scene_parameter_file_h
#define kedge_scene_parameter_file_h

#include <mpi.h>

#include <istream>
#include <ostream>
#include <string>
#include <vector>

namespace kedge
{
  /** Where an entry was written: "scene.prm:12", or the option --set. */
  struct ParameterOrigin
  {
    std::string  file;     ///< empty: the option --set
    unsigned int line = 0; ///< from 1; 0: of no file, `file` is the name of a scene made otherwise

    std::string
    describe() const;

    template <class Archive>
    void
    serialize(Archive &archive, unsigned int /*version*/)
    {
      archive &file &line;
    }
  };

  /** One line "set name = value" of a parameter file. */
  struct ParameterEntry
  {
    std::vector<std::string> section; ///< names of the subsections around it
    std::string              name;
    std::string              value;
    ParameterOrigin          origin;

    template <class Archive>
    void
    serialize(Archive &archive, unsigned int /*version*/)
    {
      archive &section &name &value &origin;
    }
  };

  /** A subsection that was opened, be it empty. */
  struct ParameterSection
  {
    std::vector<std::string> path;
    ParameterOrigin          origin;

    template <class Archive>
    void
    serialize(Archive &archive, unsigned int /*version*/)
    {
      archive &path &origin;
    }
  };

  /**
   * The text of a parameter file, split into its entries and nothing more:
   * deal.II's grammar (subsection, set, end, include, comments from #, lines
   * continued by a backslash). Names keep their case, runs of blanks in them
   * count as one. What the entries mean is not known here.
   *
   * An included file is searched beside the file that includes it; a later
   * line wins over an included one, but the same entry twice in one file is
   * an error, and so is a file that includes itself.
   */
  class ParameterFile
  {
  public:
    /**
     * Reads the file on rank 0 (so that "-", standard input, works) and hands
     * its entries to all ranks. Collective.
     *
     * @throws UserError on every rank, naming file, line and cause.
     */
    static ParameterFile
    read(const std::string &file_name, MPI_Comm communicator);

    /** Reads from a stream; @p file_name is used in messages and for includes. */
    static ParameterFile
    read(std::istream &input, const std::string &file_name);

    /**
     * Takes an option --set "Section/Name = value", which wins over what the
     * file says and may add what it does not say.
     *
     * @throws UserError if the text is not of that form.
     */
    void
    set(const std::string &assignment);

    /** Sets one entry, which wins over the same one if there is one. */
    void
    set(const std::vector<std::string> &section,
        const std::string              &name,
        const std::string              &value,
        const ParameterOrigin          &origin);

    /** All sections and entries in the grammar that read() reads. */
    void
    print(std::ostream &out) const;

    /** The file's name without folder and ending; "stdin" for standard input. */
    std::string
    scene_name() const;

    std::string                   file_name;
    std::vector<ParameterEntry>   entries;  ///< in order, each section and name once
    std::vector<ParameterSection> sections; ///< each opening, in order

    template <class Archive>
    void
    serialize(Archive &archive, unsigned int /*version*/)
    {
      archive &file_name &entries &sections;
    }

  private:
    void
    print_below(const std::vector<std::string> &path, std::ostream &out) const;
  };
} // namespace kedge

#endif
