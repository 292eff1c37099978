#include "scratch_folder.h"

#include <kedge/base/exceptions.h>
#include <kedge/io/checks.h>
#include <kedge/io/history_writer.h>
#include <kedge/io/probe_writer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace kedge;

namespace
{
  CheckParameters
  make_check(const CheckStatistic statistic, const double time = 0)
  {
    CheckParameters check;
    check.name      = "check";
    check.statistic = statistic;
    check.column    = "history.kinetic_energy";
    check.time      = time;
    return check;
  }

  double
  statistic(const CheckStatistic       statistic,
            const double               time,
            const std::vector<double> &times,
            const std::vector<double> &values)
  {
    return evaluate_statistic(make_check(statistic, time), times, values);
  }
} // namespace

TEST(IoChecks, StatisticsOfRows)
{
  // By hand; all values are exact in binary.
  const std::vector<double> t = {0, 1, 2, 4};
  const std::vector<double> v = {3, -8, 2, 4};
  EXPECT_EQ(statistic(CheckStatistic::last, 0, t, v), 4);
  EXPECT_EQ(statistic(CheckStatistic::at, 1, t, v), -8);
  EXPECT_EQ(statistic(CheckStatistic::at, 3, t, v), 3); // half-way between 2 and 4
  EXPECT_EQ(statistic(CheckStatistic::minimum, 0, t, v), -8);
  EXPECT_EQ(statistic(CheckStatistic::minimum, 1.5, t, v), 2);
  EXPECT_EQ(statistic(CheckStatistic::maximum, 0, t, v), 4);
  EXPECT_EQ(statistic(CheckStatistic::max_abs, 0, t, v), 8);
  EXPECT_EQ(statistic(CheckStatistic::max_abs, 2, t, v), 4);
  EXPECT_EQ(statistic(CheckStatistic::drift, 0, t, v), 11); // |-8 - 3|
  EXPECT_EQ(statistic(CheckStatistic::drift, 1.5, t, v), 2);
}

TEST(IoChecks, TimesMayBeOffByRoundOff)
{
  // 0.1 added ten times is 1 - 1.1e-16: "at 1" and "from 1 on" mean this row.
  std::vector<double> t = {0.}, v = {0.};
  for (int step = 1; step <= 10; ++step)
    {
      t.push_back(t.back() + 0.1);
      v.push_back(step);
    }
  ASSERT_NE(t.back(), 1.);
  EXPECT_EQ(statistic(CheckStatistic::at, 1, t, v), 10);
  EXPECT_EQ(statistic(CheckStatistic::maximum, 1, t, v), 10);
  EXPECT_TRUE(std::isnan(statistic(CheckStatistic::at, 1.001, t, v)));
  EXPECT_TRUE(std::isnan(statistic(CheckStatistic::maximum, 1.001, t, v)));
  // The first row may stand after the start.
  EXPECT_TRUE(std::isnan(statistic(CheckStatistic::at, 0.5, {1., 2.}, {3., 4.})));
  EXPECT_EQ(statistic(CheckStatistic::at, 1 - 1e-15, {1., 2.}, {3., 4.}), 3);
  EXPECT_TRUE(std::isnan(statistic(CheckStatistic::last, 0, {}, {})));
}

TEST(IoChecks, PeriodOfACosine)
{
  // Period 2. The zeros of the cosine lie half-way between two rows, where the
  // interpolation is exact by symmetry: only round-off remains.
  std::vector<double> t, v;
  for (int row = 0; row < 200; ++row)
    {
      t.push_back(0.05 * row + 0.025);
      v.push_back(std::cos(M_PI * t.back()));
    }
  EXPECT_NEAR(statistic(CheckStatistic::period, 0, t, v), 2., 1e-12);
  EXPECT_NEAR(statistic(CheckStatistic::period, 3.3, t, v), 2., 1e-12);
  EXPECT_TRUE(std::isnan(statistic(CheckStatistic::period, 9., t, v))); // one crossing left
  // A row may stand on the crossing, a touch of zero is none: crossings at 1 and 5.
  EXPECT_EQ(statistic(CheckStatistic::period, 0, {0, 1, 2, 3, 4, 5, 6}, {1, 0, -1, 0, -1, 0, 1}),
            8.);
}

TEST(IoChecksMpi, FromTheFilesAndThePoints)
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  // Strain energy 2 X + 1 everywhere, but off by 3 on a point of a quarter of the volume.
  std::vector<PointRecord<2>> points = test::make_points<2>(2, 10 * rank);
  for (unsigned int p = 0; p < 2; ++p)
    {
      const double x                     = rank + 0.5 * p;
      points[p].state.reference_position = dealii::Point<2>(x, 7.);
      points[p].state.reference_volume   = p == 0 ? 3. : 1.;
      points[p].state.strain_energy      = 2. * x + 1. + (p == 1 ? 3. : 0.);
    }
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    HistoryWriter  history(run, {{"kinetic_energy", "J", Ledger::Section::energy, false}});
    ProbeWriter<2> probes(run, {{"tip", {{0, 1.}}}});
    HistoryRow     row;
    row.step  = 1;
    row.time  = 1;
    row.books = {20.};
    history.write(row);
    probes.write(1, points);
  }
  std::vector<CheckParameters> checks(7, make_check(CheckStatistic::last));
  checks[0].scale     = 10; // 20 / 10 against 2.1 with 5 % of 2.1 = 0.105
  checks[0].reference = 2.1;
  checks[0].tolerance = 0.05;
  checks[1]           = checks[0];
  checks[1].relative  = false; // 0.1 against 0.05
  checks[2].column    = "probe.tip.position_x";
  checks[2].reference = 0;
  checks[2].relative  = false;
  checks[3]           = make_check(CheckStatistic::point_error);
  checks[3].column    = "strain_energy";
  checks[3].exact     = "a*X + 1 + 0*(Y - 7) + Z";
  checks[3].reference = 0.75; // 3 * 1 / (3 + 1), on every rank
  checks[3].tolerance = 1e-14;
  checks[4].column    = "history.no_such";
  checks[5]           = make_check(CheckStatistic::at, 2);
  // strain energies 2 rank + 1 of three quarters of the volume, 2 rank + 5 of the rest
  checks[6]           = make_check(CheckStatistic::point_quantile);
  checks[6].column    = "strain_energy";
  checks[6].part      = 1. - 0.2 / n_ranks; // in the last quarter of the last rank
  checks[6].reference = 2. * n_ranks + 3.;
  checks[6].tolerance = 1e-14;

  const auto              results  = evaluate_checks<2>(checks, run, points, {{"a", 2.}});
  const std::vector<bool> expected = {true, false, true, true, false, false, true};
  ASSERT_EQ(results.size(), expected.size());
  for (unsigned int i = 0; i < results.size(); ++i)
    EXPECT_EQ(results[i].pass, expected[i]) << i << ": " << results[i].value << " on " << n_ranks;
  EXPECT_EQ(results[0].value, 2);
  EXPECT_NEAR(results[3].value, 0.75, 1e-15);
  EXPECT_FALSE(results[4].remark.empty());
  EXPECT_FALSE(results[5].remark.empty());

  std::ostringstream out;
  print_checks({results[0], results[1]}, out);
  EXPECT_EQ(out.str(), "PASS check 2 2.1\nFAIL check 2 2.1\n");
}

TEST(IoChecks, NamesAreVerifiedBeforeTheRun)
{
  std::vector<CheckParameters> checks = {make_check(CheckStatistic::last)};
  const auto error = [&](const CheckStatistic statistic, const std::string &column) -> std::string {
    checks[0].statistic = statistic;
    checks[0].column    = column;
    try
      {
        verify_checks<2>(
          checks,
          {"time", "kinetic_energy", "strain_energy", "total_energy", "energy_error", "mass"},
          {"tip"});
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  };
  const auto suggests = [&](const std::string &column, const std::string &nearest) {
    const std::string message = error(CheckStatistic::last, column);
    EXPECT_NE(message.find("Did you mean '" + nearest + "'"), std::string::npos) << message;
  };
  EXPECT_EQ(error(CheckStatistic::last, "history.kinetic_energy"), "");
  EXPECT_EQ(error(CheckStatistic::last, "probe.tip.cauchy_stress_zz"), "");
  EXPECT_EQ(error(CheckStatistic::point_error, "cauchy_stress_yy"), "");
  suggests("history.kinetic_enrgy", "kinetic_energy");
  suggests("probe.top.displacement_y", "tip");
  suggests("probe.tip.displacment_y", "displacement_y");
  EXPECT_NE(error(CheckStatistic::last, "probe.tip"), "");
  EXPECT_NE(error(CheckStatistic::last, "kinetic_energy"), "");
  EXPECT_NE(error(CheckStatistic::point_error, "history.mass"), "");
  EXPECT_NE(error(CheckStatistic::last, "history.hardening_energy"), ""); // not in this run
}
