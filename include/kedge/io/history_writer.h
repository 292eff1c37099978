#ifndef kedge_io_history_writer_h
#define kedge_io_history_writer_h

#include <kedge/equations/ledger.h>
#include <kedge/io/csv_file.h>
#include <kedge/io/history_row.h>
#include <kedge/io/run_folder.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** The columns of history.csv: the step, what the ledger holds, the wall time. */
  std::vector<std::string>
  history_columns(const std::vector<Ledger::Column> &books);

  /** history.csv: one row per accepted step, written as it happens by rank 0. */
  class HistoryWriter
  {
  public:
    /**
     * @p resume_at is what position() gave at the checkpoint; rows after it
     * are cut off. Collective. Throws UserError as CsvFile does.
     */
    HistoryWriter(const RunFolder                   &folder,
                  const std::vector<Ledger::Column> &books,
                  const std::optional<CsvPosition>  &resume_at = {});

    /** Not collective; does nothing on ranks > 0. */
    void
    write(const HistoryRow &row);

    /** Where the file ends, all of it on the disk; nothing on ranks > 0. */
    CsvPosition
    position();

  private:
    std::vector<Ledger::Column> books;
    std::unique_ptr<CsvFile>    file;
  };
} // namespace kedge

#endif
