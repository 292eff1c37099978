#ifndef kedge_io_csv_file_h
#define kedge_io_csv_file_h

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** Where a table stood when a checkpoint was written. */
  struct CsvPosition
  {
    std::uint64_t                n_bytes  = 0;
    std::optional<std::uint64_t> checksum = {}; ///< CRC-32 of them; none: not known
  };

  /**
   * A comma-separated table that grows by whole rows. Each row is handed to
   * the system as it is written, so a killed process loses none; doubles are
   * written so that they read back as the same number.
   */
  class CsvFile
  {
  public:
    /**
     * Begins the file with a header line of @p columns or, given the
     * @p position of a checkpoint (bytes), cuts off what came after it and
     * goes on from there. Throws UserError if the file cannot be written, is
     * shorter than @p position, has other columns, or was changed before it.
     */
    CsvFile(const std::filesystem::path      &file,
            const std::vector<std::string>   &columns,
            const std::optional<CsvPosition> &position = {});
    CsvFile(const CsvFile &) = delete;
    CsvFile &
    operator=(const CsvFile &) = delete;
    ~CsvFile();

    CsvFile &
    operator<<(const double value);
    CsvFile &
    operator<<(const std::uint64_t value);

    /** "column is nan" for the first number of the row so far that is not finite; else empty. */
    const std::string &
    not_finite() const;

    /** Ends the row and writes it. Throws UserError with the system's reason (disk full). */
    void
    end_row();

    /** Where the table ends; all of it is on the disk when this returns. */
    CsvPosition
    position();

  private:
    void
    write(const std::string &text);

    std::filesystem::path    file;
    std::vector<std::string> columns;
    std::size_t              n_filled = 0;
    std::string              row;
    std::string              bad_number;
    int                      descriptor = -1;
    std::uint64_t            length     = 0;
    std::uint64_t            checksum   = 0; ///< of all that was written
  };

  /** A table read back: one vector of equal length per column. */
  struct CsvTable
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> values;

    /** The values of a column; nullptr if there is none of that name. */
    const std::vector<double> *
    find(const std::string &column) const;
  };

  /** Reads a table written by CsvFile; an unfinished last row is left out. */
  CsvTable
  read_csv(const std::filesystem::path &file);
} // namespace kedge

#endif
