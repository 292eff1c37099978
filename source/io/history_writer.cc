#include <kedge/io/collective.h>
#include <kedge/io/history_writer.h>

#include <cmath>

namespace kedge
{
  std::vector<std::string>
  history_columns(const std::vector<Ledger::Column> &books)
  {
    std::vector<std::string> names =
      {"step", "time", "time_step", "newton_iterations", "linear_iterations", "rejected_attempts"};
    for (const auto &column : books)
      names.push_back(column.name);
    names.push_back("wall_time");
    return names;
  }



  HistoryWriter::HistoryWriter(const RunFolder                   &folder,
                               const std::vector<Ledger::Column> &books,
                               const std::optional<CsvPosition>  &resume_at)
    : books(books)
  {
    run_on_root(folder.communicator(), [&]() {
      file =
        std::make_unique<CsvFile>(folder.path("history.csv"), history_columns(books), resume_at);
    });
  }



  void
  HistoryWriter::write(const HistoryRow &row)
  {
    if (!file)
      return;
    *file << row.step << row.time << row.time_step << std::uint64_t(row.newton_iterations)
          << std::uint64_t(row.linear_iterations) << std::uint64_t(row.rejected_attempts);
    for (std::size_t k = 0; k < books.size(); ++k)
      if (books[k].whole)
        *file << static_cast<std::uint64_t>(std::llround(row.books[k]));
      else
        *file << row.books[k];
    *file << row.wall_time;
    file->end_row();
  }



  CsvPosition
  HistoryWriter::position()
  {
    return file ? file->position() : CsvPosition();
  }
} // namespace kedge
