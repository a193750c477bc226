#include "pacing.h"

#include <gtest/gtest.h>

namespace block_world
{
TEST(Pacer, followsTheClockAtItsFactor)
{
  Pacer pacer(2.0);
  pacer.anchor(1000, 500);
  EXPECT_EQ(pacer.due(500), 1000);
  EXPECT_EQ(pacer.due(600), 1200);
  EXPECT_EQ(pacer.clockAt(1200), 600);
}

TEST(Pacer, changesItsFactorWithoutAJump)
{
  Pacer pacer(2.0);
  pacer.anchor(1000, 500);
  pacer.setFactor(0.5, 600);
  EXPECT_EQ(pacer.due(600), 1200);
  EXPECT_EQ(pacer.due(700), 1250);
  pacer.setFactor(10.0, 700);
  EXPECT_EQ(pacer.due(700), 1250);
  EXPECT_EQ(pacer.due(701), 1260);
}

TEST(Pacer, staysExactAfterYears)
{
  Pacer pacer(1.0);
  pacer.anchor(0, 0);
  const std::int64_t month = 30ll * 86400 * 1000000000;
  EXPECT_EQ(pacer.due(month), month);
}

TEST(Pacer, catchesUpWithALittleAndForgivesMuch)
{
  Pacer pacer(0.5);
  pacer.anchor(0, 0);
  EXPECT_EQ(pacer.forgive(40, 100, 100), 0);  // 20 of the clock late
  EXPECT_EQ(pacer.due(100), 50);
  EXPECT_EQ(pacer.forgive(50, 1100, 100), 1000);
  EXPECT_EQ(pacer.due(1100), 100);  // only the last 100 of the clock are still to be made up
}

TEST(Schedule, instantsAreWholeNanosecondsWithoutDrift)
{
  const Schedule schedule(60.0);
  EXPECT_EQ(schedule.after(0), 16666667);
  EXPECT_EQ(schedule.after(16666667), 33333333);
  EXPECT_EQ(schedule.after(-1), 0);
  EXPECT_TRUE(schedule.isDue(0));
  EXPECT_TRUE(schedule.isDue(50000000));
  EXPECT_FALSE(schedule.isDue(50000001));
  const std::int64_t day = 86400ll * 1000000000;
  EXPECT_TRUE(schedule.isDue(day));
  EXPECT_EQ(schedule.after(day), day + 16666667);
}

TEST(Schedule, everyInstantComesOnce)
{
  for (const double rate : { 0.3, 30.0, 59.94, 1000.0, 10000.0 })
  {
    const Schedule schedule(rate);
    std::int64_t time = 0;
    for (int k = 1; k <= 1000; ++k)
    {
      const std::int64_t next = schedule.after(time);
      ASSERT_GT(next, time);
      ASSERT_NEAR(static_cast<double>(next), k * 1e9 / rate, 1.0) << rate;
      time = next;
    }
  }
}

}  // namespace block_world
