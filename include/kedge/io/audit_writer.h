#ifndef kedge_io_audit_writer_h
#define kedge_io_audit_writer_h

#include <kedge/io/csv_file.h>
#include <kedge/io/run_folder.h>
#include <kedge/transfer/audit.h>

#include <memory>

namespace kedge
{
  /**
   * transfer_audit.csv: one row per accepted step with what the mappings lost
   * in it (positive: lost). `p2g_lost_*` is points minus grid before the step
   * (Table 3.1), `g2p_lost_*` what the grid gained over the step beyond what
   * the points gained (Table 3.2); `*_expected` are the closed expressions of
   * these tables where they are not zero.
   */
  template <int dim>
  class AuditWriter
  {
  public:
    /** @p resume_at is what position() gave at the checkpoint. Collective. */
    AuditWriter(const RunFolder &folder, const std::optional<CsvPosition> &resume_at = {});

    /** Not collective; does nothing on ranks > 0. */
    void
    write(const std::uint64_t step, const double time, const TransferAudit<dim> &audit);

    /** Where the file ends, all of it on the disk; nothing on ranks > 0. */
    CsvPosition
    position();

  private:
    std::unique_ptr<CsvFile> file;
  };
} // namespace kedge

#endif
