#ifndef kedge_io_run_folder_h
#define kedge_io_run_folder_h

#include <kedge/io/folder_lock.h>
#include <kedge/io/log_stream.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

namespace kedge
{
  /**
   * The output folder of one run. A file `.kedge` marks a folder as written by
   * kedge. A fresh run into such a folder removes the files of the earlier
   * run, known by their names, and nothing else; in a folder without the mark
   * it refuses to replace a file that has one of these names. While the object lives
   * no other run, fresh or resumed, gets the folder.
   *
   * The log goes to the standard output and to log.txt, on rank 0 only.
   */
  class RunFolder
  {
  public:
    enum class Mode
    {
      fresh, ///< empties the folder of an earlier run's files
      resume ///< continues the run that is in the folder
    };

    /**
     * Makes the folder (and those above it) where it is missing. Collective.
     * Throws UserError if it cannot be made or written, would replace foreign
     * files, holds no run to resume, or is in use by another run.
     */
    RunFolder(const std::filesystem::path &folder, const Mode mode, const MPI_Comm communicator);

    RunFolder(const RunFolder &) = delete;
    RunFolder &
    operator=(const RunFolder &) = delete;
    ~RunFolder();

    /** A file or folder inside. */
    std::filesystem::path
    path(const std::string &name) const;

    const std::filesystem::path &
    path() const;

    Mode
    mode() const;

    MPI_Comm
    communicator() const;

    bool
    is_root() const;

    /** What is written here stands on the terminal and in log.txt. Silent on ranks > 0. */
    std::ostream &
    log() const;

    /** Throws UserError if something of the log did not reach the disk. Collective. */
    void
    check_log() const;

    /** Makes a folder inside if it is missing, on rank 0. Collective. */
    std::filesystem::path
    make_subfolder(const std::string &name) const;

  private:
    std::filesystem::path       folder;
    Mode                        run_mode;
    MPI_Comm                    mpi_communicator;
    bool                        root;
    std::unique_ptr<FolderLock> lock;    ///< on rank 0
    std::unique_ptr<LogStream>  stream;  ///< on rank 0
    mutable std::ostream        silence; ///< has no buffer: drops what it gets
  };
} // namespace kedge

#endif
