#include <kedge/base/exceptions.h>
#include <kedge/io/folder_lock.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <unistd.h>

namespace kedge
{
  namespace
  {
    const char *const held_by = "Last written by ";

    std::string
    this_process()
    {
      std::array<char, 256> host = {};
      if (::gethostname(host.data(), host.size() - 1) != 0)
        host[0] = '\0';
      return "process " + std::to_string(::getpid()) +
             (host[0] == '\0' ? "" : " on " + std::string(host.data()));
    }

    /** What the holder of the lock has written about itself. */
    std::string
    holder(const int descriptor)
    {
      std::array<char, 1024> text = {};
      const ssize_t          n    = ::pread(descriptor, text.data(), text.size() - 1, 0);
      const std::string      all(text.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
      const std::size_t      begin = all.find(held_by);
      if (begin == std::string::npos)
        return "another process";
      const std::size_t name = begin + std::strlen(held_by);
      return all.substr(name, all.find_first_of(".\n", name) - name);
    }
  } // namespace



  FolderLock::FolderLock(const std::filesystem::path &file)
  {
    const auto fail = [&]() {
      const std::string reason = std::strerror(errno);
      if (descriptor >= 0)
        ::close(descriptor);
      throw UserError("Cannot write '" + file.string() + "': " + reason + ".");
    };
    descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      fail();
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      {
        const std::string who = holder(descriptor);
        ::close(descriptor);
        throw UserError("Another run of kedge, " + who + ", is writing to the folder '" +
                        file.parent_path().string() +
                        "'. Wait until it ends, or choose another folder with --output.");
      }
    const std::string text = "The output of a run of kedge; the next run may replace it.\n" +
                             (held_by + this_process()) + ".\n";
    if (::ftruncate(descriptor, 0) != 0 ||
        ::pwrite(descriptor, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
      fail();
  }



  FolderLock::~FolderLock()
  {
    ::close(descriptor);
  }
} // namespace kedge
