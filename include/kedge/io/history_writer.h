#ifndef kedge_io_history_writer_h
#define kedge_io_history_writer_h

#include <kedge/io/csv_file.h>
#include <kedge/io/history_row.h>
#include <kedge/io/run_folder.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** Which physics a run has; the others leave their columns out of history.csv. */
  struct HistoryColumns
  {
    unsigned int dim           = 2;
    bool         plasticity    = false; ///< hardening_energy, plastic_dissipation
    bool         stabilisation = false; ///< stabilisation_energy
    bool         pores         = false; ///< fluid_energy, darcy_dissipation, the masses

    std::vector<std::string> reactions = {}; ///< reaction_NAME_x.., of HistoryRow::reactions

    /** In the order of the file. */
    std::vector<std::string>
    names() const;
  };

  /** history.csv: one row per accepted step, written as it happens by rank 0. */
  class HistoryWriter
  {
  public:
    /**
     * @p resume_at is what position() gave at the checkpoint; rows after it
     * are cut off. Collective. Throws UserError as CsvFile does.
     */
    HistoryWriter(const RunFolder                    &folder,
                  const HistoryColumns               &columns,
                  const std::optional<std::uint64_t> &resume_at = {});

    /** Not collective; does nothing on ranks > 0. */
    void
    write(const HistoryRow &row);

    /** Length in bytes of the file, all of it on the disk; 0 on ranks > 0. */
    std::uint64_t
    position();

  private:
    HistoryColumns           columns;
    std::unique_ptr<CsvFile> file;
  };
} // namespace kedge

#endif
