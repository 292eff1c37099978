#include <kedge/base/exceptions.h>
#include <kedge/io/log_stream.h>

#include <cerrno>
#include <cstring>
#include <iostream>

namespace kedge
{
  LogStream::Buffer::Buffer(const std::filesystem::path &path, const bool append)
    : file(path, append ? std::ios::app : std::ios::trunc)
  {}



  LogStream::LogStream(const std::filesystem::path &path, const bool append)
    : std::ostream(nullptr)
    , path(path)
    , buffer(path, append)
  {
    if (!buffer.file)
      throw UserError("Cannot write '" + path.string() + "': " + std::strerror(errno) + ".");
    rdbuf(&buffer);
  }



  void
  LogStream::check()
  {
    flush();
    if (!buffer.file)
      throw UserError("Cannot write '" + path.string() +
                      "' to its end: the disk is full, or has failed. All other files of the run "
                      "are whole.");
  }



  LogStream::Buffer::int_type
  LogStream::Buffer::overflow(const int_type letter)
  {
    if (traits_type::eq_int_type(letter, traits_type::eof()))
      return traits_type::not_eof(letter);
    const char text = traits_type::to_char_type(letter);
    xsputn(&text, 1);
    return letter;
  }



  std::streamsize
  LogStream::Buffer::xsputn(const char *text, const std::streamsize n)
  {
    std::cout.write(text, n); // main() asks whether it could be written
    file.write(text, n);
    return n;
  }



  int
  LogStream::Buffer::sync()
  {
    std::cout.flush();
    file.flush();
    return 0;
  }
} // namespace kedge
