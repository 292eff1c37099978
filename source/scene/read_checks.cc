#include <kedge/base/nearest_name.h>
#include <kedge/scene/read_checks.h>
#include <kedge/scene/values.h>

#include <algorithm>
#include <tuple>

namespace kedge
{
  namespace
  {
    /** The probe that a column probe.NAME.COLUMN names must exist. */
    void
    check_probe_exists(const ParameterReader &reader,
                       const SectionReader   &section,
                       const std::string     &column)
    {
      const std::string prefix = "probe.";
      if (column.rfind(prefix, 0) != 0)
        return;
      const std::string name = column.substr(prefix.size(), column.rfind('.') - prefix.size());
      const std::vector<std::string> names = reader.names("Probes");
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw section.error("Quantity",
                            "There is no Probes/" + name + "." +
                              (names.empty() ? " The section Probes is empty."
                                             : did_you_mean(name, names)));
    }

    CheckParameters
    read_check(const ParameterReader &reader,
               const SectionReader   &section,
               const TimeParameters  &run)
    {
      CheckParameters check;
      check.name                              = section.name();
      std::tie(check.statistic, check.column) = parse_quantity(section.text("Quantity"));
      const bool is_point_error               = check.statistic == CheckStatistic::point_error;
      check_probe_exists(reader, section, check.column);

      check.time = run.start;
      if (!section.is_empty("Time"))
        check.time = section.number("Time");
      else if (check.statistic == CheckStatistic::at)
        throw section.error("Time", "at(column) needs the time.");
      if (!(check.time >= run.start && check.time <= run.end))
        throw section.error("Time", "It must lie between Time/Start and Time/End.");

      check.exact = section.text("Exact");
      if (check.exact.empty() == is_point_error)
        throw section.error("Exact",
                            is_point_error ? "point_error needs the exact field."
                                           : "It has a meaning for point_error only.");

      const bool is_quantile = check.statistic == CheckStatistic::point_quantile;
      if (section.is_empty("Part") == is_quantile)
        throw section.error("Part",
                            is_quantile ? "point_quantile needs it."
                                        : "It has a meaning for point_quantile only.");
      if (is_quantile)
        check.part = section.number("Part");

      check.scale = section.number("Scale");
      if (!section.is_empty("Reference"))
        check.reference = section.number("Reference");
      else if (!is_point_error && check.statistic != CheckStatistic::drift)
        throw section.error("Reference", "The known answer must be given.");

      std::tie(check.tolerance, check.relative) =
        parse_tolerance(section.text("Tolerance"), section.constants());
      if (check.relative && check.reference == 0)
        throw section.error("Tolerance",
                            "A percentage of the reference 0 allows nothing; give a number.");
      check.source = section.text("Source");
      return check;
    }
  } // namespace



  std::vector<CheckParameters>
  read_checks(const ParameterReader &reader, const TimeParameters &run)
  {
    std::vector<CheckParameters> checks;
    for (const std::string &name : reader.names("Checks"))
      checks.push_back(read_check(reader, SectionReader(reader, {"Checks", name}), run));
    return checks;
  }
} // namespace kedge
