#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/probe_writer.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace kedge
{
  namespace
  {
    template <int dim>
    std::vector<PointQuantity<dim>>
    quantities(const bool saturated)
    {
      std::vector<const char *> fields = {"position",
                                          "displacement",
                                          "velocity",
                                          "cauchy_stress",
                                          "pressure"};
      if (saturated)
        fields.insert(fields.end(), {"pore_pressure", "porosity", "darcy_velocity"});
      std::vector<PointQuantity<dim>> result;
      for (const char *name : fields)
        for (const auto &component : point_field<dim>(name).components())
          result.push_back({&point_field<dim>(name), component.index});
      return result;
    }

    void
    check_names(const std::vector<Probe> &probes)
    {
      std::set<std::string> seen;
      for (const Probe &probe : probes)
        {
          if (probe.name.empty() || probe.name.find_first_of(",\"\n\r") != std::string::npos)
            throw UserError("The probe name '" + probe.name +
                            "' cannot stand in the header of probes.csv: use letters, digits and "
                            "underscores.");
          if (!seen.insert(probe.name).second)
            throw UserError("Two probes are called '" + probe.name + "'; give each its own name.");
          if (probe.points.empty())
            throw UserError("The probe '" + probe.name +
                            "' has no material point: nothing of its body is there.");
        }
    }
  } // namespace



  template <int dim>
  ProbeWriter<dim>::ProbeWriter(const RunFolder                  &folder,
                                const std::vector<Probe>         &probes,
                                const std::optional<CsvPosition> &resume_at,
                                const bool                        saturated,
                                const bool                        points_leave)
    : communicator(folder.communicator())
    , all(quantities<dim>(saturated))
    , points_leave(points_leave)
  {
    check_names(probes);
    std::vector<std::string> columns = {"time"};
    for (const Probe &probe : probes)
      {
        double sum = 0;
        for (const auto &[id, weight] : probe.points)
          sum += weight;
        for (const auto &[id, weight] : probe.points)
          tracked.push_back({id, static_cast<unsigned int>(names.size()), weight / sum});
        names.push_back(probe.name);
        for (const std::string &quantity : quantity_names(saturated))
          columns.push_back(probe.name + '.' + quantity);
      }
    std::stable_sort(tracked.begin(), tracked.end(), [](const Tracked &a, const Tracked &b) {
      return a.id < b.id;
    });

    std::size_t n_bits = 64; // a power of two; 16 per tracked point pass 1 foreign id in 16
    while (n_bits < 16 * tracked.size())
      n_bits *= 2;
    mask.assign(n_bits, false);
    for (const Tracked &point : tracked)
      mask[point.id & (n_bits - 1)] = true;

    if (!empty())
      run_on_root(communicator, [&]() {
        file = std::make_unique<CsvFile>(folder.path("probes.csv"), columns, resume_at);
      });
    begin();
  }



  template <int dim>
  bool
  ProbeWriter<dim>::empty() const
  {
    return names.empty();
  }



  template <int dim>
  bool
  ProbeWriter<dim>::tracks(const std::uint64_t id) const
  {
    if (!mask[id & (mask.size() - 1)])
      return false;
    const auto found = std::lower_bound(tracked.begin(),
                                        tracked.end(),
                                        id,
                                        [](const Tracked &a, const std::uint64_t b) {
                                          return a.id < b;
                                        });
    return found != tracked.end() && found->id == id;
  }



  template <int dim>
  void
  ProbeWriter<dim>::begin()
  {
    sums.assign(names.size() * (all.size() + 1), 0.);
  }



  template <int dim>
  void
  ProbeWriter<dim>::add(const PointRecord<dim> &point)
  {
    auto next = std::lower_bound(tracked.begin(),
                                 tracked.end(),
                                 point.id,
                                 [](const Tracked &a, const std::uint64_t b) {
                                   return a.id < b;
                                 });
    for (; next != tracked.end() && next->id == point.id; ++next)
      {
        double *sum = &sums[next->probe * (all.size() + 1)];
        for (const PointQuantity<dim> &quantity : all)
          *sum++ += next->weight * quantity(point);
        *sum += next->weight;
      }
  }



  template <int dim>
  void
  ProbeWriter<dim>::divide_by_weights(std::vector<double> &total) const
  {
    const std::size_t n = all.size() + 1;
    for (std::size_t probe = 0; probe < names.size(); ++probe)
      {
        const auto   begin  = total.begin() + static_cast<std::ptrdiff_t>(probe * n);
        const double weight = begin[static_cast<std::ptrdiff_t>(all.size())];
        if (std::abs(weight - 1.) < 1e-9)
          continue;
        AssertThrow(points_leave,
                    dealii::ExcMessage("The probe '" + names[probe] +
                                       "' lost material points: the weights found sum to " +
                                       std::to_string(weight) + " instead of 1."));
        if (weight > 0.)
          std::transform(begin, begin + static_cast<std::ptrdiff_t>(n), begin, [&](const double v) {
            return v / weight;
          });
        else if (!last.empty())
          std::copy_n(last.begin() + static_cast<std::ptrdiff_t>(probe * n), n, begin);
      }
  }



  template <int dim>
  std::string
  ProbeWriter<dim>::end_row(const double time)
  {
    if (empty())
      return "";
    std::vector<double> total(sums.size());
    dealii::Utilities::MPI::sum(sums, communicator, total);

    const std::size_t n_columns = all.size();
    divide_by_weights(total);
    for (std::size_t i = 0; i < total.size(); ++i)
      if (!std::isfinite(total[i]))
        {
          const PointQuantity<dim> &quantity = all[i % (n_columns + 1)];
          for (const auto &component : quantity.field->components())
            if (component.index == quantity.index)
              return quantity.field->component_name(component) + " at the probe '" +
                     names[i / (n_columns + 1)] + "' is " + exact_text(total[i]);
        }
    last = total;
    if (!file)
      return "";
    *file << time;
    for (std::size_t i = 0; i < total.size(); ++i)
      if (i % (n_columns + 1) != n_columns)
        *file << total[i];
    file->end_row();
    return "";
  }



  template <int dim>
  void
  ProbeWriter<dim>::write(const double time, const std::vector<PointRecord<dim>> &local_points)
  {
    if (empty())
      return;
    begin();
    for (const PointRecord<dim> &point : local_points)
      if (tracks(point.id))
        add(point);
    end_row(time);
  }



  template <int dim>
  CsvPosition
  ProbeWriter<dim>::position()
  {
    return file ? file->position() : CsvPosition();
  }



  template <int dim>
  std::vector<std::string>
  ProbeWriter<dim>::quantity_names(const bool saturated)
  {
    std::vector<std::string> result;
    for (const PointQuantity<dim> &quantity : quantities<dim>(saturated))
      for (const auto &component : quantity.field->components())
        if (component.index == quantity.index)
          result.push_back(quantity.field->component_name(component));
    return result;
  }



  template class ProbeWriter<2>;
  template class ProbeWriter<3>;
} // namespace kedge
