#include <kedge/io/audit_writer.h>
#include <kedge/io/collective.h>

namespace kedge
{
  namespace
  {
    /** In 2D the angular momentum has its z component only. */
    constexpr unsigned int
    first_rotation(const int dim)
    {
      return dim == 3 ? 0 : 2;
    }

    void
    add_names(std::vector<std::string> &names, const int dim, const std::string &mapping)
    {
      const char axes[] = {'x', 'y', 'z'};
      for (int d = 0; d < dim; ++d)
        names.push_back(mapping + "_lost_linear_momentum_" + axes[d]);
      for (int d = first_rotation(dim); d < 3; ++d)
        names.push_back(mapping + "_lost_angular_momentum_" + axes[d]);
      names.push_back(mapping + "_lost_kinetic_energy");
      if (mapping == "g2p")
        for (int d = first_rotation(dim); d < 3; ++d)
          names.push_back(mapping + "_expected_angular_momentum_" + axes[d]);
      names.push_back(mapping + "_expected_kinetic_energy");
    }
  } // namespace



  template <int dim>
  AuditWriter<dim>::AuditWriter(const RunFolder                  &folder,
                                const std::optional<CsvPosition> &resume_at)
  {
    std::vector<std::string> names = {"step", "time"};
    add_names(names, dim, "p2g");
    add_names(names, dim, "g2p");
    run_on_root(folder.communicator(), [&]() {
      file = std::make_unique<CsvFile>(folder.path("transfer_audit.csv"), names, resume_at);
    });
  }



  template <int dim>
  void
  AuditWriter<dim>::write(const std::uint64_t       step,
                          const double              time,
                          const TransferAudit<dim> &audit)
  {
    if (!file)
      return;
    *file << step << time;
    const auto put = [&](const MotionTotals<dim> &lost, const double sign) {
      for (int d = 0; d < dim; ++d)
        *file << sign * lost.linear_momentum[d];
      for (int d = first_rotation(dim); d < 3; ++d)
        *file << sign * lost.angular_momentum[d];
      *file << sign * lost.kinetic_energy;
    };
    put(audit.measured_p2g(), 1.);
    *file << audit.expected_p2g.kinetic_energy;
    put(audit.measured_step(), -1.);
    for (int d = first_rotation(dim); d < 3; ++d)
      *file << -audit.expected_step.angular_momentum[d];
    *file << -audit.expected_step.kinetic_energy;
    file->end_row();
  }



  template <int dim>
  CsvPosition
  AuditWriter<dim>::position()
  {
    return file ? file->position() : CsvPosition();
  }

  template class AuditWriter<2>;
  template class AuditWriter<3>;
} // namespace kedge
