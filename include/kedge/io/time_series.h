#ifndef kedge_io_time_series_h
#define kedge_io_time_series_h

#include <kedge/io/run_folder.h>

#include <string>
#include <vector>

namespace kedge
{
  /**
   * The index file of a series of outputs (points.pvd, grid.pvd, points.xdmf):
   * whole again after every output, replaced atomically by rank 0; flush() makes
   * it outlast a power cut.
   */
  class TimeSeries
  {
  public:
    enum class Format
    {
      pvd, ///< an entry is a file name
      xdmf ///< an entry is a Grid element without its Time
    };

    /** Keeps the first @p n_kept entries of the file if there is one, drops the others. Collective.
     */
    TimeSeries(const RunFolder   &folder,
               const std::string &name,
               const Format       format,
               const unsigned int n_kept);

    /** Adds an entry and rewrites the file. Collective. */
    void
    add(const double time, const std::string &entry);

    /** Forces the file to the disk, if there is one. Collective. */
    void
    flush() const;

  private:
    struct Entry
    {
      std::string time;
      std::string text;
    };

    std::string
    document() const;
    void
    read(const unsigned int n_kept);

    const RunFolder   &folder;
    std::string        name;
    Format             format;
    std::vector<Entry> entries;
  };
} // namespace kedge

#endif
