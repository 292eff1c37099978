#include "scratch_folder.h"

#include <kedge/io/files.h>
#include <kedge/io/time_series.h>

#include <gtest/gtest.h>

using namespace kedge;

class IoTimeSeries : public testing::TestWithParam<TimeSeries::Format>
{};

TEST_P(IoTimeSeries, ResumedEqualsUninterrupted)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  {
    TimeSeries series(run, "points.pvd", GetParam(), 0);
    series.add(0., "points/a");
    series.add(1. / 3., "points/b");
  }
  const std::string at_checkpoint = read_file(scratch / "points.pvd");
  {
    TimeSeries series(run, "points.pvd", GetParam(), 2);
    series.add(0.6, "points/c");
  }
  const std::string whole = read_file(scratch / "points.pvd");
  {
    TimeSeries series(run, "points.pvd", GetParam(), 2); // drops what came after the checkpoint
    EXPECT_EQ(read_file(scratch / "points.pvd"), at_checkpoint);
    series.add(0.6, "points/c");
  }
  EXPECT_EQ(read_file(scratch / "points.pvd"), whole);
  EXPECT_NE(whole.find("0.3333333333333333"), std::string::npos); // the real time, all digits
}

TEST_P(IoTimeSeries, BeginsANewFileIfSomebodyRemovedTheOldOne)
{
  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  TimeSeries                series(run, "points.pvd", GetParam(), 7);
  series.add(1., "points/h");
  EXPECT_NE(read_file(scratch / "points.pvd").find("points/h"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         IoTimeSeries,
                         testing::Values(TimeSeries::Format::pvd, TimeSeries::Format::xdmf));
