#include <kedge/time_integration/clock.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace kedge;

namespace
{
  Clock
  make_clock(const double step, const double end, const std::vector<double> &break_times = {})
  {
    TimeParameters parameters;
    parameters.end         = end;
    parameters.break_times = break_times;
    Clock clock(parameters);
    clock.set_nominal_step(step);
    return clock;
  }

  unsigned int
  run(Clock &clock)
  {
    unsigned int n = 0;
    for (; !clock.finished() && n < 100000; ++n)
      clock.advance();
    return n;
  }
} // namespace

TEST(TimeIntegrationClock, EndsExactlyAfterTheExpectedSteps)
{
  Clock tenths = make_clock(0.1, 1.);
  EXPECT_EQ(run(tenths), 10u); // ten times 0.1 sums to 1 - 1e-16: no eleventh step
  EXPECT_EQ(tenths.time(), 1.);
  EXPECT_EQ(tenths.n_steps(), 10u);

  Clock uneven = make_clock(0.3, 1.); // 0.3, 0.3, 0.3 and a rest of 0.1
  EXPECT_EQ(run(uneven), 4u);
  EXPECT_EQ(uneven.time(), 1.);

  Clock many = make_clock(1e-3, 20.);
  EXPECT_EQ(run(many), 20000u); // a rest of 1e-6 steps is taken along
  EXPECT_EQ(many.time(), 20.);
}

TEST(TimeIntegrationClock, HitsBreakTimesExactly)
{
  // in any order; times at the start, beyond the end, and twice do no harm
  Clock               clock = make_clock(0.1, 1., {0.73, 0.25, 0., 0.25, 5.});
  std::vector<double> times;
  while (!clock.finished())
    {
      EXPECT_GT(clock.step_size(), 0.);
      EXPECT_LE(clock.step_size(), 0.1 * (1. + 2e-6));
      const double next = clock.next_time();
      clock.advance();
      EXPECT_EQ(clock.time(), next);
      times.push_back(clock.time());
    }
  const auto hit = [&](const double t) {
    return std::count(times.begin(), times.end(), t);
  };
  EXPECT_EQ(hit(0.25), 1);
  EXPECT_EQ(hit(0.73), 1);
  EXPECT_EQ(hit(1.), 1);
  EXPECT_EQ(times.size(), 3u + 5u + 3u); // .1 .2 .25 | .35 ... .65 .73 | .83 .93 1.
}

TEST(TimeIntegrationClock, CutsAndGrowsAgain)
{
  Clock clock = make_clock(0.1, 10.);
  EXPECT_TRUE(clock.cut_step());
  EXPECT_DOUBLE_EQ(clock.step_size(), 0.05);
  EXPECT_TRUE(clock.cut_step());
  EXPECT_DOUBLE_EQ(clock.step_size(), 0.025);
  EXPECT_EQ(clock.time(), 0.); // nothing is committed by a cut
  EXPECT_EQ(clock.n_steps(), 0u);
  // one doubling after each three accepted steps, up to the nominal step
  const double expected[] = {0.025, 0.025, 0.025, 0.05, 0.05, 0.05, 0.1, 0.1, 0.1, 0.1, 0.1};
  for (const double step : expected)
    {
      EXPECT_NEAR(clock.step_size(), step, 1e-15);
      clock.advance();
    }
}

TEST(TimeIntegrationClock, ACutForgetsTheStepsAcceptedBefore)
{
  Clock clock = make_clock(0.1, 10.);
  clock.cut_step();
  clock.advance();
  clock.advance();
  clock.cut_step();
  clock.advance(); // the third accepted step, but only the first since the cut
  EXPECT_NEAR(clock.step_size(), 0.025, 1e-15);
}

TEST(TimeIntegrationClock, CutsAShortenedStepBelowItself)
{
  Clock clock = make_clock(0.1, 10., {0.03});
  EXPECT_DOUBLE_EQ(clock.step_size(), 0.03);
  EXPECT_TRUE(clock.cut_step());
  // not 0.05, which would be shortened to 0.03 again
  EXPECT_LE(clock.step_size(), 0.75 * 0.03);
  EXPECT_GE(clock.step_size(), 0.25 * 0.03);
}

TEST(TimeIntegrationClock, StopsAtTheFloor)
{
  Clock        clock = make_clock(1., 10.);
  unsigned int cuts  = 0;
  while (clock.cut_step())
    ++cuts;
  EXPECT_EQ(cuts, 10u); // 1/1024 is allowed, 1/2048 is not
  EXPECT_EQ(clock.floor(), 1. / 1024.);
}

TEST(TimeIntegrationClock, ABreakTimeNearbyLowersTheFloor)
{
  // the step to 0.0005 is half of the ordinary floor, 0.001: it may be cut ten times as any other
  Clock        clock = make_clock(1.024, 10., {0.0005});
  unsigned int cuts  = 0;
  EXPECT_EQ(clock.step_size(), 0.0005);
  while (clock.cut_step())
    ++cuts;
  EXPECT_GE(cuts, 9u); // the first cut may go below one half
  EXPECT_LE(cuts, 10u);

  // once there, the cuts below the ordinary floor are forgotten
  Clock other = make_clock(1.024, 10., {0.0005});
  EXPECT_TRUE(other.cut_step());
  while (other.time() < 0.0005)
    other.advance();
  EXPECT_EQ(other.time(), 0.0005);
  EXPECT_GE(other.step_size(), 0.001 * (1. - 1e-12));
  EXPECT_NEAR(other.floor(), 0.001, 1e-15);
}

TEST(TimeIntegrationClock, GoesOnFromARestoredStateBitForBit)
{
  Clock clock = make_clock(0.017, 1., {0.4});
  for (int i = 0; i < 7; ++i)
    {
      if (i == 3)
        clock.cut_step();
      clock.advance();
    }
  Clock resumed = make_clock(0.5, 1., {0.4});
  resumed.restore(clock.state());
  while (!clock.finished())
    {
      ASSERT_EQ(resumed.time(), clock.time());
      ASSERT_EQ(resumed.step_size(), clock.step_size());
      ASSERT_EQ(resumed.n_steps(), clock.n_steps());
      clock.advance();
      resumed.advance();
    }
  EXPECT_TRUE(resumed.finished());
}

namespace
{
  Clock
  adaptive_clock(const double largest)
  {
    TimeParameters parameters;
    parameters.end                 = 100.;
    parameters.adapt_step          = true;
    parameters.maximum_step_factor = largest;
    Clock clock(parameters);
    clock.set_nominal_step(0.1);
    return clock;
  }
} // namespace

TEST(TimeIntegrationClock, AdaptsToTheWorkOfNewtonsMethod)
{
  // 5 is easy, 10 hard, three easy steps in a row let it grow, to 4 times 0.1 at most
  Clock              clock        = adaptive_clock(5.);
  const unsigned int iterations[] = {5, 5, 5, 4, 4, 4, 4, 10, 6, 4, 4, 9, 4, 4, 4, 4};
  const double       steps[] = {.1, .1, .1, .2, .2, .2, .4, .4, .2, .2, .2, .2, .2, .2, .2, .4};
  for (unsigned int k = 0; k < 16; ++k)
    {
      EXPECT_NEAR(clock.step_size(), steps[k], 1e-14) << "step " << k;
      clock.advance(iterations[k]);
    }
}

TEST(TimeIntegrationClock, HardStepsDoNotReachTheFloor)
{
  Clock clock = adaptive_clock(1.);
  for (unsigned int k = 0; k < 30; ++k)
    clock.advance(20);
  EXPECT_NEAR(clock.step_size(), 0.1 / 1024, 1e-15);
}

TEST(TimeIntegrationClock, AdaptedStepsGoOnFromARestoredStateBitForBit)
{
  Clock clock = adaptive_clock(8.);
  for (unsigned int k = 0; k < 5; ++k)
    clock.advance(3);
  Clock resumed = adaptive_clock(8.);
  resumed.restore(clock.state());
  for (unsigned int k = 0; k < 20; ++k)
    {
      ASSERT_EQ(resumed.time(), clock.time());
      ASSERT_EQ(resumed.step_size(), clock.step_size());
      clock.advance(k % 7 == 6 ? 12 : 3);
      resumed.advance(k % 7 == 6 ? 12 : 3);
    }
}

TEST(TimeIntegrationClock, HitsOutputTimesExactlyAlsoWithGrowingSteps)
{
  Clock clock = adaptive_clock(8.);
  clock.set_output_times(0., 0.7);
  unsigned int n_hit = 0;
  while (!clock.finished())
    {
      EXPECT_GT(clock.step_size(), 1e-6);
      clock.advance(3);
      n_hit += clock.time() == 0.7 * (n_hit + 1) ? 1 : 0; // in doubles: exactly
    }
  EXPECT_EQ(n_hit, 142u); // all multiples up to 99.4
}
