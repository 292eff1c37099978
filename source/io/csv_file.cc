#include <kedge/base/exceptions.h>
#include <kedge/io/csv_file.h>
#include <kedge/io/files.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <sys/stat.h>
#include <unistd.h>

namespace kedge
{
  namespace
  {
    [[noreturn]] void
    fail(const std::filesystem::path &file)
    {
      throw UserError("Cannot write '" + file.string() + "': " + std::strerror(errno) + ".");
    }

    std::string
    header_line(const std::vector<std::string> &columns)
    {
      std::string line;
      for (const std::string &column : columns)
        line += (line.empty() ? "" : ",") + column;
      return line + '\n';
    }

    void
    check_before_resume(const std::filesystem::path &file,
                        const std::string           &header,
                        const CsvPosition           &at)
    {
      const std::string remedy   = " The run cannot be resumed; start it afresh without --resume.";
      const std::string content  = read_file(file);
      const auto        position = at.n_bytes;
      if (content.compare(0, header.size(), header) != 0)
        throw UserError("'" + file.string() +
                        "' does not have the columns of this run: it belongs to another scene." +
                        remedy);
      if (content.size() < position || position < header.size())
        throw UserError("'" + file.string() + "' has " + std::to_string(content.size()) +
                        " bytes, the checkpoint was written at " + std::to_string(position) +
                        ": somebody has shortened it." + remedy);
      if (content[position - 1] != '\n' ||
          (at.checksum && *at.checksum != crc32_of(content.substr(0, position))))
        throw UserError("'" + file.string() + "' has been changed since the checkpoint." + remedy);
    }
  } // namespace



  CsvFile::CsvFile(const std::filesystem::path      &file_name,
                   const std::vector<std::string>   &columns,
                   const std::optional<CsvPosition> &position)
    : file(file_name)
    , columns(columns)
  {
    const std::string header = header_line(columns);
    if (position)
      check_before_resume(file, header, *position);

    descriptor = ::open(file.c_str(),
                        O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (position ? 0 : O_TRUNC),
                        0666);
    if (descriptor < 0)
      fail(file);
    if (!position)
      write(header);
    else if (::ftruncate(descriptor, static_cast<off_t>(position->n_bytes)) == 0)
      {
        length   = position->n_bytes;
        checksum = crc32_of(read_file(file));
      }
    else
      fail(file);
  }



  CsvFile::~CsvFile()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }



  CsvFile &
  CsvFile::operator<<(const double value)
  {
    if (!std::isfinite(value) && bad_number.empty() && n_filled < columns.size())
      bad_number = columns[n_filled] + " is " + exact_text(value);
    row += (n_filled++ == 0 ? "" : ",") + exact_text(value);
    return *this;
  }



  CsvFile &
  CsvFile::operator<<(const std::uint64_t value)
  {
    row += (n_filled++ == 0 ? "" : ",") + std::to_string(value);
    return *this;
  }



  const std::string &
  CsvFile::not_finite() const
  {
    return bad_number;
  }



  void
  CsvFile::end_row()
  {
    AssertThrow(n_filled == columns.size(), dealii::ExcDimensionMismatch(n_filled, columns.size()));
    write(row + '\n');
    row.clear();
    bad_number.clear();
    n_filled = 0;
  }



  void
  CsvFile::write(const std::string &text)
  {
    for (std::size_t done = 0; done < text.size();)
      {
        const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
        if (written < 0 && errno != EINTR)
          fail(file);
        done += written < 0 ? 0 : static_cast<std::size_t>(written);
      }
    length += text.size();
    checksum = crc32_of(text, checksum);
  }



  CsvPosition
  CsvFile::position()
  {
    if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP)
      fail(file);
    return {length, checksum};
  }



  const std::vector<double> *
  CsvTable::find(const std::string &column) const
  {
    const auto found = std::find(columns.begin(), columns.end(), column);
    return found == columns.end() ? nullptr : &values[found - columns.begin()];
  }



  namespace
  {
    /** The end of the cell that begins at @p begin: its comma or line end. */
    const char *
    cell_end(const char *begin, const char *const end)
    {
      return std::find_if(begin, end, [](const char c) {
        return c == ',' || c == '\n';
      });
    }
  } // namespace



  CsvTable
  read_csv(const std::filesystem::path &file)
  {
    const std::string content = read_file(file);
    CsvTable          table;
    const char       *next = content.data();
    const char *const end  = next + (content.rfind('\n') + 1); // npos + 1 = 0: nothing whole

    for (bool in_header = next != end; in_header;)
      {
        const char *const stop = cell_end(next, end);
        table.columns.emplace_back(next, stop);
        in_header = *stop == ',';
        next      = stop + 1;
      }
    table.values.resize(table.columns.size());

    for (std::size_t column = 0; next != end;)
      {
        const char *const stop  = cell_end(next, end);
        double            value = std::numeric_limits<double>::quiet_NaN();
        std::from_chars(next, stop, value);
        AssertThrow(column < table.columns.size(), dealii::ExcMessage(file.string()));
        table.values[column].push_back(value);
        column = *stop == '\n' ? 0 : column + 1;
        next   = stop + 1;
      }
    return table;
  }
} // namespace kedge
