#ifndef kedge_io_checks_h
#define kedge_io_checks_h

#include <kedge/io/check_result.h>
#include <kedge/io/csv_file.h>
#include <kedge/io/parameters.h>
#include <kedge/io/run_folder.h>
#include <kedge/points/point_state.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace kedge
{
  /**
   * Before the run: throws UserError with the nearest valid name if a check
   * asks for a column of history.csv, a probe, a probe's column or a point
   * field that this run does not have. @p saturated as in ProbeWriter.
   */
  template <int dim>
  void
  verify_checks(const std::vector<CheckParameters> &checks,
                const std::vector<std::string>     &history_columns,
                const std::vector<std::string>     &probe_names,
                const bool                          saturated = false);

  /**
   * The value of a column-wise statistic (all but point_error) over rows
   * (@p times, @p values); NaN if the rows do not reach `time` or, for
   * `period`, hold fewer than two zero crossings.
   */
  double
  evaluate_statistic(const CheckParameters     &check,
                     const std::vector<double> &times,
                     const std::vector<double> &values);

  /**
   * At the end of the run: reads history.csv and probes.csv back and compares.
   * A value that cannot be had fails with a remark. @p constants are those of
   * the scene's expressions. The results are the same on all ranks.
   * Collective.
   */
  template <int dim>
  std::vector<CheckResult>
  evaluate_checks(const std::vector<CheckParameters>  &checks,
                  const RunFolder                     &folder,
                  const std::vector<PointRecord<dim>> &local_points,
                  const std::map<std::string, double> &constants);

  /** A line `PASS name value reference` or `FAIL name value reference` each. */
  void
  print_checks(const std::vector<CheckResult> &results, std::ostream &out);
} // namespace kedge

#endif
