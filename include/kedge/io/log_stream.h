#ifndef kedge_io_log_stream_h
#define kedge_io_log_stream_h

#include <filesystem>
#include <fstream>
#include <ostream>
#include <streambuf>

namespace kedge
{
  /**
   * Writes to the standard output and to a file. A terminal that is gone or a full
   * disk stops neither the other one nor the run; what could not be written is
   * remembered.
   */
  class LogStream : public std::ostream
  {
  public:
    /** Throws UserError if the file cannot be opened. */
    LogStream(const std::filesystem::path &path, const bool append);

    LogStream(const LogStream &) = delete;
    LogStream &
    operator=(const LogStream &) = delete;

    /** Throws UserError if something did not reach the file. */
    void
    check();

  private:
    class Buffer : public std::streambuf
    {
    public:
      Buffer(const std::filesystem::path &path, const bool append);

      std::ofstream file;

    private:
      int_type
      overflow(const int_type letter) override;

      std::streamsize
      xsputn(const char *text, const std::streamsize n) override;

      int
      sync() override;
    };

    const std::filesystem::path path;
    Buffer                      buffer;
  };
} // namespace kedge

#endif
