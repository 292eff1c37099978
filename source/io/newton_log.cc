#include <kedge/io/collective.h>
#include <kedge/io/newton_log.h>

#include <cmath>
#include <limits>

namespace kedge
{
  NewtonLog::NewtonLog(const RunFolder &folder, const std::optional<CsvPosition> &resume_at)
  {
    const std::vector<std::string> columns =
      {"step", "time", "accepted", "iteration", "residual", "correction", "ratio", "order"};
    run_on_root(folder.communicator(), [&]() {
      file = std::make_unique<CsvFile>(folder.path("newton.csv"), columns, resume_at);
    });
  }



  void
  NewtonLog::write(const std::uint64_t step,
                   const double        time,
                   const bool          accepted,
                   const NewtonReport &report)
  {
    if (!file)
      return;
    const std::vector<double> &r = report.residual_norms;
    for (std::size_t k = 0; k < r.size(); ++k)
      {
        double ratio = std::numeric_limits<double>::quiet_NaN(), order = ratio;
        if (k >= 1)
          ratio = r[k] / r[k - 1];
        if (k >= 2 && k <= report.iterations)
          order = std::log(ratio) / std::log(r[k - 1] / r[k - 2]);
        *file << step << time << std::uint64_t(accepted) << std::uint64_t(k) << r[k]
              << (k == 0 ? 0. : report.correction_norms[k - 1]) << ratio << order;
        file->end_row();
      }
  }



  CsvPosition
  NewtonLog::position()
  {
    return file ? file->position() : CsvPosition();
  }
} // namespace kedge
