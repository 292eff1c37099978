#include "../io/scratch_folder.h"

#include <kedge/io/files.h>
#include <kedge/simulation/limit_watch.h>
#include <kedge/simulation/outlook.h>
#include <kedge/simulation/rejections.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace kedge;

TEST(SimulationOutlook, SaysEarlyThatStepsAreTooSmall)
{
  const test::ScratchFolder scratch;
  testing::internal::CaptureStdout();
  const RunFolder run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  Outlook         outlook(run, 0., 1.);
  EXPECT_EQ(outlook.warning(0.1, 0.1, 1., ""), "");
  EXPECT_EQ(outlook.warning(0.2, 0.1, 10., ""), ""); // .02 s/s: 40 s to go
  // a step of 1e-6 in 10 s: 8e6 s = 92 days to go
  const std::string text = outlook.warning(0.2 + 1e-6, 1e-6, 20., "det F <= 0");
  EXPECT_NE(text.find("another 92d"), std::string::npos) << text;
  EXPECT_NE(text.find("1e-05 of the largest"), std::string::npos) << text;
  EXPECT_NE(text.find("det F <= 0"), std::string::npos) << text;
  EXPECT_EQ(outlook.warning(0.2 + 2e-6, 1e-6, 30., ""), "");             // said already
  EXPECT_NE(outlook.warning(0.2 + 2e-6 + 1e-8, 1e-8, 40., ""), "");      // ten times worse
  EXPECT_EQ(Outlook(run, 0., 1.).warning(1e-6, 1e-6, 20., "det F"), ""); // slow, but as asked for
  testing::internal::GetCapturedStdout();
}

TEST(SimulationRejections, ThoseThatRepeatAreSummedUp)
{
  const test::ScratchFolder scratch;
  testing::internal::CaptureStdout();
  const RunFolder run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  Rejections      rejections(run);
  for (int i = 0; i < 1000; ++i)
    rejections.cut(0.5, i, "cause " + std::to_string(i));
  rejections.stop(0.125, 1000., "last cause", "; the step is at its floor");
  testing::internal::GetCapturedStdout();
  const std::string log = read_file(scratch / "log.txt");
  // 20 in full, a word, the sum, the last one
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 23);
  EXPECT_NE(log.find("980 more steps rejected, up to t = 999 s, the smallest of 0.5 s"),
            std::string::npos);
  EXPECT_NE(log.find("t = 1000 s rejected: last cause; the step is at its floor"),
            std::string::npos);
  EXPECT_EQ(rejections.last_cause(), "last cause");
}

TEST(SimulationLimitWatch, TellsALimitLoadByHowDisplacementsGrow)
{
  LimitWatch watch(0.05);
  EXPECT_EQ(watch.growth(), "");
  watch.add(0.5, 0.); // nothing has moved yet
  EXPECT_EQ(watch.growth(), "");
  watch.add(0.5, 0.005); // .01 m/s
  watch.add(0.5, 0.025); // four times as fast
  EXPECT_FALSE(watch.runs_away());
  EXPECT_FALSE(watch.has_failed());
  watch.add(0.25, 0.05); // ten times
  EXPECT_TRUE(watch.runs_away());
  EXPECT_TRUE(watch.has_failed());
  EXPECT_EQ(
    watch.growth(),
    "the largest displacement, 0.05 m, was still growing at 0.1 m/s, 10 times as fast as in "
    "the first step");
  LimitWatch other(0.);
  other.restore(watch.save());
  EXPECT_EQ(other.growth(), watch.growth());
  EXPECT_FALSE(other.has_failed()); // no failure displacement
  other.add(0.5, 0.05);
  EXPECT_NE(other.growth().find("was not growing"), std::string::npos);
  EXPECT_FALSE(other.runs_away());
}
