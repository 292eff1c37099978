#ifndef kedge_io_folder_lock_h
#define kedge_io_folder_lock_h

#include <filesystem>

namespace kedge
{
  /**
   * Keeps a second run out of an output folder while it lives: an advisory lock
   * (flock) on a file in it. The system lets go of it when the process ends, however it
   * ends, so that a killed run blocks nobody. On file systems without such locks it
   * does nothing.
   */
  class FolderLock
  {
  public:
    /**
     * Makes @p file where it is missing, locks it and writes into it who holds it.
     * Throws UserError if another process holds it, naming that process, and if the
     * file cannot be written.
     */
    explicit FolderLock(const std::filesystem::path &file);

    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;
    ~FolderLock();

  private:
    int descriptor = -1;
  };
} // namespace kedge

#endif
