#ifndef kedge_io_files_h
#define kedge_io_files_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace kedge
{
  /** When a file must have reached the disk: before a power cut can lose it, or not. */
  enum class OnDisk
  {
    now,
    later
  };

  /**
   * Replaces @p file by @p content so that whoever reads it, at any moment
   * and after a kill at any moment, finds either the old or the new text:
   * a temporary file beside it, fsync (unless it may be on the disk later),
   * rename. Throws UserError with the system's reason.
   */
  void
  replace_file(const std::filesystem::path &file,
               const std::string           &content,
               const OnDisk                 when = OnDisk::now);

  /** Writes a file from its beginning. Throws UserError with the system's reason. */
  void
  write_file(const std::filesystem::path &file, const std::string &content);

  /** Forces a file or a folder to the disk. Throws UserError with the system's reason. */
  void
  flush_to_disk(const std::filesystem::path &file_or_folder);

  /** The whole of a file. Throws UserError if it cannot be read. */
  std::string
  read_file(const std::filesystem::path &file);

  /** CRC-32 as in zlib and PNG; of a text that follows another, given that of the other. */
  std::uint64_t
  crc32_of(const std::string &content, const std::uint64_t of_what_came_before = 0);

  /** The shortest decimal text that reads back as the same double; `nan`, `inf`. */
  std::string
  exact_text(const double value);
} // namespace kedge

#endif
