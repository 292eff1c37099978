#include "scratch_folder.h"

#include <kedge/io/files.h>
#include <kedge/io/progress.h>
#include <kedge/io/signals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

using namespace kedge;

namespace
{
  HistoryRow
  make_row(const std::uint64_t step)
  {
    HistoryRow row;
    row.step              = step;
    row.time              = 0.25 * static_cast<double>(step);
    row.time_step         = 0.25;
    row.newton_iterations = 3;
    row.n_points          = 400;
    return row;
  }

  std::ptrdiff_t
  n_lines(const std::filesystem::path &file)
  {
    const std::string text = read_file(file);
    return std::count(text.begin(), text.end(), '\n');
  }
} // namespace

TEST(IoProgress, LineSaysWhereTheRunStands)
{
  EXPECT_EQ(Progress::line(make_row(4), 10, 187),
            "step      4  time 1 of 10 s  dt 0.25 s  Newton 3  points 400  to go 3m 07s");
  EXPECT_EQ(Progress::line(make_row(4), 10, -1),
            "step      4  time 1 of 10 s  dt 0.25 s  Newton 3  points 400");
}

TEST(IoProgress, AtMostOneLinePerInterval)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  testing::internal::CaptureStdout();
  {
    Progress rare(run, 1000, 0, 10); // the first one, then none for 1000 s, then the last
    for (std::uint64_t step = 1; step <= 5; ++step)
      rare.report(make_row(step));
    EXPECT_EQ(n_lines(scratch / "log.txt"), 1);
    rare.finish(make_row(5));
    rare.finish(make_row(5));
    EXPECT_EQ(n_lines(scratch / "log.txt"), 2);
  }
  Progress each(run, 0, 0, 10);
  for (std::uint64_t step = 1; step <= 5; ++step)
    each.report(make_row(step));
  each.finish(make_row(5)); // stands already
  EXPECT_EQ(n_lines(scratch / "log.txt"), 2 + 5);
  testing::internal::GetCapturedStdout();
}

TEST(IoSignalsMpi, OneRanksSignalStopsAll)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int last = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) - 1;
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1})
    {
      const StopSignals signals(MPI_COMM_WORLD);
      EXPECT_FALSE(signals.stop_requested());
      if (rank == last)
        {
          std::raise(signal);
          std::raise(signal); // `timeout` sends it twice in a row: still only a flag
        }
      EXPECT_TRUE(signals.stop_requested());
    }
  struct sigaction after;
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(after.sa_handler == SIG_DFL || rank > 0 || last > 0, true); // put back
}

TEST(IoSignalsMpi, OnlyOneAtATime)
{
  const StopSignals signals(MPI_COMM_WORLD);
  EXPECT_ANY_THROW(StopSignals(MPI_COMM_WORLD));
}
