#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>
#include <kedge/io/checks.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/point_fields.h>
#include <kedge/io/probe_writer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

namespace kedge
{
  namespace
  {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    /** Where the value of a check is found. */
    struct Place
    {
      bool        in_probes = false;
      std::string column; ///< of the file
    };

    Place
    place_of(const std::string &column)
    {
      const std::string history = "history.", probe = "probe.";
      if (column.compare(0, history.size(), history) == 0)
        return {false, column.substr(history.size())};
      if (column.compare(0, probe.size(), probe) == 0)
        return {true, column.substr(probe.size())};
      return {false, column};
    }

    /** Rows whose time is @p time or later, up to round-off of times that were added up. */
    std::size_t
    first_row_from(const std::vector<double> &times, const double time)
    {
      const double slack = times.empty() ? 0. : 1e-9 * std::max(std::abs(time), times.back());
      return std::lower_bound(times.begin(), times.end(), time - slack) - times.begin();
    }

    double
    value_at(const std::vector<double> &times, const std::vector<double> &values, const double time)
    {
      const std::size_t row = first_row_from(times, time);
      if (row == times.size())
        return not_a_number;
      if (times[row] <= time)
        return values[row];
      if (row == 0) // before the first row, or upon it up to round-off
        return first_row_from({time}, times[0]) == 0 ? values[0] : not_a_number;
      const double weight = (time - times[row - 1]) / (times[row] - times[row - 1]);
      return (1. - weight) * values[row - 1] + weight * values[row];
    }

    /** Twice the mean spacing of the zero crossings from @p first on, linear between rows. */
    double
    period_of(const std::vector<double> &times,
              const std::vector<double> &values,
              const std::size_t          first)
    {
      std::vector<double> crossings;
      int                 sign       = 0; // of the last value that is not zero
      double              zero_since = not_a_number;
      for (std::size_t row = first; row < values.size(); ++row)
        {
          const int new_sign = (values[row] > 0) - (values[row] < 0);
          if (new_sign == 0)
            {
              zero_since = std::isnan(zero_since) ? times[row] : zero_since;
              continue;
            }
          if (sign * new_sign < 0 && !std::isnan(zero_since))
            crossings.push_back(zero_since);
          else if (sign * new_sign < 0)
            crossings.push_back(times[row - 1] - values[row - 1] * (times[row] - times[row - 1]) /
                                                   (values[row] - values[row - 1]));
          sign       = new_sign;
          zero_since = not_a_number;
        }
      return crossings.size() < 2 ? not_a_number
                                  : 2. * (crossings.back() - crossings.front()) /
                                      static_cast<double>(crossings.size() - 1);
    }

    /** sum_p |v_p - exact(X_p)| V0_p / sum_p V0_p. Collective. */
    template <int dim>
    double
    point_error(const CheckParameters               &check,
                const std::vector<PointRecord<dim>> &local_points,
                const std::map<std::string, double> &constants,
                const MPI_Comm                       communicator)
    {
      std::vector<double> sums = {0., 0.}; // error, volume
      run_on_all(communicator, [&]() {
        const PointQuantity<dim> quantity = point_quantity<dim>(check.column);
        const Expression         exact(check.exact, {"X", "Y", "Z"}, constants);
        for (const PointRecord<dim> &point : local_points)
          {
            double place[3] = {0, 0, 0};
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = point.state.reference_position[d];
            const double volume = point.state.reference_volume;
            sums[0] += std::abs(quantity(point) - exact(place)) * volume;
            sums[1] += volume;
          }
      });
      std::vector<double> total(2);
      dealii::Utilities::MPI::sum(sums, communicator, total);
      return total[0] / total[1];
    }

    /** The least value that no more than `part` of V0 lies below. Collective. */
    template <int dim>
    double
    point_quantile(const CheckParameters               &check,
                   const std::vector<PointRecord<dim>> &local_points,
                   const MPI_Comm                       communicator)
    {
      std::vector<std::pair<double, double>> values; // and volumes
      run_on_all(communicator, [&]() {
        const PointQuantity<dim> quantity = point_quantity<dim>(check.column);
        for (const PointRecord<dim> &point : local_points)
          values.emplace_back(quantity(point), point.state.reference_volume);
      });
      std::vector<std::pair<double, double>> all;
      for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, values))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      std::sort(all.begin(), all.end());
      double volume = 0., below = 0., value = not_a_number;
      for (const auto &point : all)
        volume += point.second;
      for (const auto &point : all)
        {
          value = point.first;
          below += point.second;
          if (below > check.part * volume)
            break;
        }
      return value;
    }

    bool
    passes(const CheckResult &result)
    {
      const double allowed =
        result.relative ? result.tolerance * std::abs(result.reference) : result.tolerance;
      return std::abs(result.value - result.reference) <= allowed; // false for NaN
    }

    /** The value from the tables, on rank 0. */
    double
    table_value(const CheckParameters &check, const RunFolder &folder, std::string &remark)
    {
      const Place       place = place_of(check.column);
      const std::string name  = place.in_probes ? "probes.csv" : "history.csv";
      if (!std::filesystem::exists(folder.path(name)))
        {
          remark = "there is no " + name;
          return not_a_number;
        }
      const CsvTable             table  = read_csv(folder.path(name));
      const std::vector<double> *times  = table.find("time");
      const std::vector<double> *values = table.find(place.column);
      if (times == nullptr || values == nullptr)
        {
          remark = name + " has no column " + place.column;
          return not_a_number;
        }
      const double value = evaluate_statistic(check, *times, *values);
      if (std::isnan(value))
        remark = name + " has no such value: too few rows, or none at or after the time " +
                 exact_text(check.time);
      return value;
    }

    void
    demand(const std::string              &name,
           const std::vector<std::string> &valid,
           const CheckParameters          &check,
           const std::string              &what)
    {
      if (std::find(valid.begin(), valid.end(), name) != valid.end())
        return;
      std::string list;
      for (const std::string &candidate : valid)
        list += (list.empty() ? "" : ", ") + candidate;
      throw UserError("The check '" + check.name + "' asks for '" + check.column +
                      "', but there is no " + what + " '" + name + "' in this run." +
                      (valid.empty() ? " There is none at all."
                                     : did_you_mean(name, valid) + " Valid are: " + list + '.'));
    }
  } // namespace



  template <int dim>
  void
  verify_checks(const std::vector<CheckParameters> &checks,
                const std::vector<std::string>     &history_columns,
                const std::vector<std::string>     &probe_names,
                const bool                          saturated)
  {
    for (const CheckParameters &check : checks)
      {
        const Place       place  = place_of(check.column);
        const std::size_t dot    = place.column.rfind('.');
        const bool        prefix = place.column.size() != check.column.size();
        if (is_of_points(check.statistic))
          point_quantity<dim>(check.column);
        else if (place.in_probes && dot == std::string::npos)
          throw UserError("The check '" + check.name + "' asks for '" + check.column +
                          "': write probe.NAME.COLUMN, such as probe.tip.displacement_y.");
        else if (place.in_probes)
          {
            demand(place.column.substr(0, dot), probe_names, check, "probe");
            demand(place.column.substr(dot + 1),
                   ProbeWriter<dim>::quantity_names(saturated),
                   check,
                   "column of probes");
          }
        else if (prefix)
          demand(place.column, history_columns, check, "column of history.csv");
        else
          throw UserError("The check '" + check.name + "' asks for '" + check.column +
                          "': write history.COLUMN or probe.NAME.COLUMN. A point field's name "
                          "goes with the statistics point_error and point_quantile only.");
      }
  }



  double
  evaluate_statistic(const CheckParameters     &check,
                     const std::vector<double> &times,
                     const std::vector<double> &values)
  {
    const std::size_t first = first_row_from(times, check.time);
    if (times.empty() || first == times.size())
      return not_a_number;
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::any_of(begin, values.end(), [](const double v) {
          return std::isnan(v);
        }))
      return not_a_number;

    const auto largest = [&](const double origin) {
      double result = 0;
      for (auto value = begin; value != values.end(); ++value)
        result = std::max(result, std::abs(*value - origin));
      return result;
    };
    switch (check.statistic)
      {
        case CheckStatistic::at:
          return value_at(times, values, check.time);
        case CheckStatistic::last:
          return values.back();
        case CheckStatistic::minimum:
          return *std::min_element(begin, values.end());
        case CheckStatistic::maximum:
          return *std::max_element(begin, values.end());
        case CheckStatistic::max_abs:
          return largest(0.);
        case CheckStatistic::drift:
          return largest(*begin);
        case CheckStatistic::period:
          return period_of(times, values, first);
        default:
          return not_a_number;
      }
  }



  template <int dim>
  std::vector<CheckResult>
  evaluate_checks(const std::vector<CheckParameters>  &checks,
                  const RunFolder                     &folder,
                  const std::vector<PointRecord<dim>> &local_points,
                  const std::map<std::string, double> &constants)
  {
    const MPI_Comm           communicator = folder.communicator();
    std::vector<CheckResult> results;
    for (const CheckParameters &check : checks)
      {
        double      value = not_a_number;
        std::string remark;
        if (check.statistic == CheckStatistic::point_error)
          value = point_error(check, local_points, constants, communicator);
        else if (check.statistic == CheckStatistic::point_quantile)
          value = point_quantile(check, local_points, communicator);
        else
          run_on_root(communicator, [&]() {
            value = table_value(check, folder, remark);
          });
        CheckResult result{check.name,
                           dealii::Utilities::MPI::broadcast(communicator, value) / check.scale,
                           check.reference,
                           check.tolerance,
                           check.relative,
                           false,
                           check.source,
                           dealii::Utilities::MPI::broadcast(communicator, remark)};
        result.pass = passes(result);
        results.push_back(result);
      }
    return results;
  }



  void
  print_checks(const std::vector<CheckResult> &results, std::ostream &out)
  {
    for (const CheckResult &result : results)
      {
        std::ostringstream line;
        line << (result.pass ? "PASS " : "FAIL ") << result.name << ' ' << std::setprecision(10)
             << result.value << ' ' << result.reference;
        if (!result.remark.empty())
          line << " (" << result.remark << ')';
        out << line.str() << std::endl;
      }
  }



  template void
  verify_checks<2>(const std::vector<CheckParameters> &,
                   const std::vector<std::string> &,
                   const std::vector<std::string> &,
                   const bool);
  template void
  verify_checks<3>(const std::vector<CheckParameters> &,
                   const std::vector<std::string> &,
                   const std::vector<std::string> &,
                   const bool);
  template std::vector<CheckResult>
  evaluate_checks<2>(const std::vector<CheckParameters> &,
                     const RunFolder &,
                     const std::vector<PointRecord<2>> &,
                     const std::map<std::string, double> &);
  template std::vector<CheckResult>
  evaluate_checks<3>(const std::vector<CheckParameters> &,
                     const RunFolder &,
                     const std::vector<PointRecord<3>> &,
                     const std::map<std::string, double> &);
} // namespace kedge
