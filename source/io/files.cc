#include <kedge/base/exceptions.h>
#include <kedge/io/files.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>
#include <zlib.h>

namespace kedge
{
  namespace
  {
    [[noreturn]] void
    fail(const std::string &doing, const std::filesystem::path &file)
    {
      throw UserError("Cannot " + doing + " '" + file.string() + "': " + std::strerror(errno) +
                      ".");
    }

    void
    write_all(const int descriptor, const std::string &content, const std::filesystem::path &file)
    {
      const char *next = content.data();
      std::size_t left = content.size();
      while (left > 0)
        {
          const ssize_t written = ::write(descriptor, next, left);
          if (written < 0 && errno == EINTR)
            continue;
          if (written < 0)
            {
              const int reason = errno;
              ::close(descriptor);
              errno = reason;
              fail("write", file);
            }
          next += written;
          left -= static_cast<std::size_t>(written);
        }
    }
  } // namespace



  void
  write_file(const std::filesystem::path &file, const std::string &content)
  {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0)
      fail("write", file);
    write_all(descriptor, content, file);
    if (::close(descriptor) != 0)
      fail("write", file);
  }



  void
  replace_file(const std::filesystem::path &file, const std::string &content, const OnDisk when)
  {
    std::filesystem::path temporary = file;
    temporary += ".new";
    try
      {
        write_file(temporary, content);
        if (when == OnDisk::now)
          flush_to_disk(temporary);
        if (::rename(temporary.c_str(), file.c_str()) != 0)
          fail("replace", file);
      }
    catch (...)
      {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
      }
    if (when == OnDisk::now)
      flush_to_disk(file.has_parent_path() ? file.parent_path() : ".");
  }



  void
  flush_to_disk(const std::filesystem::path &file_or_folder)
  {
    const int descriptor = ::open(file_or_folder.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      fail("open", file_or_folder);
    const int  status = ::fsync(descriptor);
    const int  reason = errno;
    const bool failed = status != 0 && reason != EINVAL && reason != ENOTSUP;
    ::close(descriptor);
    errno = reason;
    if (failed) // EINVAL: a file system that has no fsync for this kind of file
      fail("force to the disk", file_or_folder);
  }



  std::string
  read_file(const std::filesystem::path &file)
  {
    std::error_code      error;
    const std::uintmax_t n_bytes = std::filesystem::file_size(file, error); // fails for folders
    if (error)
      throw UserError("Cannot read '" + file.string() + "': " + error.message() + ".");
    std::ifstream in(file, std::ios::binary);
    std::string   content(n_bytes, '\0');
    in.read(content.data(), static_cast<std::streamsize>(n_bytes));
    if (!in)
      fail("read", file);
    return content;
  }



  std::uint64_t
  crc32_of(const std::string &content, const std::uint64_t of_what_came_before)
  {
    return crc32_z(static_cast<uLong>(of_what_came_before),
                   reinterpret_cast<const Bytef *>(content.data()),
                   content.size());
  }



  std::string
  exact_text(const double value)
  {
    if (std::isnan(value))
      return "nan";
    char       digits[32];
    const auto result = std::to_chars(digits, digits + sizeof(digits), value);
    return std::string(digits, result.ptr);
  }
} // namespace kedge
