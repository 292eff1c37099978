#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/json.h>
#include <kedge/io/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <sys/resource.h>

#include <cmath>

namespace kedge
{
  namespace
  {
    template <typename T>
    void
    add_map(JsonWriter &json, const std::string &key, const std::map<std::string, T> &entries)
    {
      json.open(key, '{');
      for (const auto &[name, value] : entries)
        json.add(name, value);
      json.close();
    }

    /** The components of a vector stand together; all other columns of the ledger by name. */
    void
    add_final_row(JsonWriter &json, const RunSummary &summary)
    {
      json.open("final", '{');
      json.add("step", summary.final_row.step);
      json.add("time", summary.final_row.time);
      for (const std::string vector : {"linear_momentum", "angular_momentum"})
        {
          json.open(vector, '[');
          for (const char component : {'x', 'y', 'z'})
            for (std::size_t k = 0; k < summary.columns.size(); ++k)
              if (summary.columns[k].name == vector + "_" + component)
                json.add("", summary.final_row.books[k]);
          json.close();
        }
      for (std::size_t k = 0; k < summary.columns.size(); ++k)
        if (summary.columns[k].section != Ledger::Section::momentum)
          json.add(summary.columns[k].name, summary.final_row.books[k]);
      json.close();
    }

    void
    add_checks(JsonWriter &json, const std::vector<CheckResult> &checks)
    {
      json.open("checks", '[');
      for (const CheckResult &check : checks)
        {
          json.open("", '{');
          json.add("name", check.name);
          json.add("value", check.value);
          json.add("reference", check.reference);
          json.add("tolerance", check.tolerance);
          json.add("relative", check.relative);
          json.add("pass", check.pass);
          json.add("source", check.source);
          if (!check.remark.empty())
            json.add("remark", check.remark);
          json.close();
        }
      json.close();
    }

    double
    seconds(const timeval &time)
    {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
  } // namespace



  std::string
  summary_json(const RunSummary &summary)
  {
    JsonWriter json;
    json.open("", '{');
    add_map(json, "versions", summary.versions);
    json.add("scene", summary.scene);
    json.add("title", summary.title);
    json.add("status", summary.status);
    if (!summary.reason.empty())
      json.add("reason", summary.reason);
    json.add("dimension", std::uint64_t(summary.dim));
    json.add("n_ranks", std::uint64_t(summary.n_ranks));
    json.open("bodies", '[');
    for (const std::string &body : summary.bodies)
      json.add("", body);
    json.close();
    add_map(json, "counts", summary.counts);
    json.add("steps", summary.n_steps);
    json.add("newton_iterations", summary.n_newton_iterations);
    json.add("linear_iterations", summary.n_linear_iterations);
    json.add("rejected_attempts", summary.n_rejected_attempts);
    if (std::isfinite(summary.largest_displacement))
      json.add("largest_displacement", summary.largest_displacement);
    if (summary.largest_condition_estimate > 0.)
      json.add("largest_condition_estimate", summary.largest_condition_estimate);
    json.add("wall_seconds", summary.wall_seconds);
    json.add("cpu_seconds", summary.cpu_seconds);
    add_map(json, "phase_wall_seconds", summary.phase_wall_seconds);
    add_map(json, "phase_cpu_seconds", summary.phase_cpu_seconds);
    json.add("peak_memory_bytes", summary.peak_memory_bytes);
    json.add("point_updates_per_second", summary.point_updates_per_second);
    add_final_row(json, summary);
    add_checks(json, summary.checks);
    json.close();
    return json.text() + '\n';
  }



  void
  write_summary(const RunFolder &folder, const RunSummary &summary)
  {
    run_on_root(folder.communicator(), [&]() {
      replace_file(folder.path("summary.json"), summary_json(summary));
    });
  }



  double
  peak_memory(const MPI_Comm communicator)
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return dealii::Utilities::MPI::sum(1024. * static_cast<double>(memory.VmHWM), communicator);
  }



  double
  cpu_seconds(const MPI_Comm communicator)
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return dealii::Utilities::MPI::sum(seconds(usage.ru_utime) + seconds(usage.ru_stime),
                                       communicator);
  }
} // namespace kedge
