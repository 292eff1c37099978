#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/json.h>
#include <kedge/io/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <sys/resource.h>

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

    void
    add_final_row(JsonWriter &json, const RunSummary &summary)
    {
      const HistoryRow &row = summary.final_row;
      json.open("final", '{');
      json.add("step", row.step);
      json.add("time", row.time);
      json.add("kinetic_energy", row.kinetic_energy);
      json.add("strain_energy", row.strain_energy);
      json.add("hardening_energy", row.hardening_energy);
      json.add("plastic_dissipation", row.plastic_dissipation);
      json.add("stabilisation_energy", row.stabilisation_energy);
      json.add("external_work", row.external_work);
      json.add("total_energy", row.total_energy());
      json.add("energy_error", row.energy_error);
      json.open("linear_momentum", '[');
      for (unsigned int d = 0; d < summary.dim; ++d)
        json.add("", row.linear_momentum[d]);
      json.close();
      json.open("angular_momentum", '[');
      for (unsigned int d = (summary.dim == 3 ? 0 : 2); d < 3; ++d)
        json.add("", row.angular_momentum[d]);
      json.close();
      json.add("mass", row.mass);
      json.add("min_det_F", row.min_det_F);
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
    add_map(json, "counts", summary.counts);
    json.add("steps", summary.n_steps);
    json.add("newton_iterations", summary.n_newton_iterations);
    json.add("linear_iterations", summary.n_linear_iterations);
    json.add("rejected_attempts", summary.n_rejected_attempts);
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
