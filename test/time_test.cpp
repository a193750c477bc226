#include "block_world/time.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace block_world
{
namespace
{
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double half_eps = std::numeric_limits<double>::epsilon() / 2.0;  // the step of fractions from 1/2 on

TEST(Time, DefaultIsZero)
{
  EXPECT_EQ(Time().wholeSeconds(), 0);
  EXPECT_EQ(Time().fraction(), 0.0);
  EXPECT_EQ(Time(), Time::fromSeconds(0.0));
}

TEST(Time, SecondsSplitIntoWholeAndFraction)
{
  const struct
  {
    double seconds;
    std::int64_t whole;
    double fraction;
  } cases[] = { { 0.25, 0, 0.25 },   { 3.0, 3, 0.0 },   { 3.75, 3, 0.75 },
                { -0.25, -1, 0.75 }, { -3.0, -3, 0.0 }, { -3.5, -4, 0.5 } };
  for (const auto& c : cases)
  {
    const Time time = Time::fromSeconds(c.seconds);
    EXPECT_EQ(time.wholeSeconds(), c.whole) << c.seconds;
    EXPECT_EQ(time.fraction(), c.fraction) << c.seconds;
    EXPECT_EQ(time.seconds(), c.seconds);
  }
}

TEST(Time, SpansAddAndSubtract)
{
  const Time start = Time::fromSeconds(10.75);
  EXPECT_EQ(start + 0.25, Time::fromSeconds(11.0));
  EXPECT_EQ(start + 0.5, Time::fromSeconds(11.25));
  EXPECT_EQ(start + -0.75, Time::fromSeconds(10.0));
  EXPECT_EQ(start + -11.0, Time::fromSeconds(-0.25));
  EXPECT_EQ((start + 5.5) - start, 5.5);
  EXPECT_EQ(start - (start + 5.5), -5.5);
  EXPECT_EQ(start + 0.0, start);
}

TEST(Time, FractionStaysBelowOne)
{
  // The largest fraction there is, moved by spans that round up to a whole second, and zero by one too small to be seen
  // below 1.
  const Time last = Time::fromSeconds(1.0 - half_eps);
  for (const double span : { half_eps, half_eps / 2.0, 1.0 - half_eps, half_eps / 8.0, -half_eps })
    for (const Time& time : { last + span, Time() + span, Time() + -span })
    {
      EXPECT_GE(time.fraction(), 0.0) << span;
      EXPECT_LT(time.fraction(), 1.0) << span;
    }
  EXPECT_EQ(last + half_eps, Time::fromSeconds(1.0));
  EXPECT_LE(Time() + -1e-20, Time());
}

TEST(Time, ResolutionDoesNotAge)
{
  for (const double age : { 0.0, 1.0, 1e6, 1e9, 1e12 })
  {
    const Time old = Time::fromSeconds(age) + 0.5;
    EXPECT_GT(old + 2.0 * half_eps, old) << age;
    EXPECT_EQ((old + 1e-15) - old, (Time::fromSeconds(0.5) + 1e-15) - Time::fromSeconds(0.5)) << age;
  }
}

TEST(Time, OriginMovedByWholeSecondsChangesNoBit)
{
  Time here = Time::fromSeconds(0.1), there = Time::fromSeconds(1000000.0) + 0.1;
  for (int i = 0; i < 1000; ++i)
  {
    const double span = 0.013 * (i % 7) - 0.02 + 1e-9 * i;
    here = here + span;
    there = there + span;
    ASSERT_EQ(here.fraction(), there.fraction());
    ASSERT_EQ(here.wholeSeconds() + 1000000, there.wholeSeconds());
    ASSERT_EQ(there - here, 1e6);
  }
}

TEST(Time, NanosecondsRoundTrip)
{
  for (const std::int64_t second :
       { std::int64_t(0), std::int64_t(-5), std::int64_t(1000000), std::int64_t(1700000000), std::int64_t(9223372035) })
    for (const std::int64_t rest : { 0, 1, 2, 499999999, 500000000, 999999998, 999999999 })
    {
      const std::int64_t nanoseconds = second * 1000000000 + rest;
      const Time time = Time::fromNanoseconds(nanoseconds);
      EXPECT_EQ(time.nanoseconds(), nanoseconds);
      EXPECT_EQ(time.wholeSeconds(), second);
      EXPECT_LT(time.fraction(), 1.0);
    }
}

TEST(Time, NanosecondsRoundToTheNearest)
{
  EXPECT_EQ(Time::fromSeconds(1.4e-9).nanoseconds(), 1);
  EXPECT_EQ(Time::fromSeconds(1.6e-9).nanoseconds(), 2);
  EXPECT_EQ((Time::fromSeconds(2.0) + -0.3e-9).nanoseconds(), 2000000000);
  EXPECT_EQ((Time() + -1.6e-9).nanoseconds(), -2);
}

TEST(Time, InfinityIsLaterThanEverything)
{
  const Time never = Time::infinity();
  EXPECT_TRUE(never.isInfinite());
  EXPECT_FALSE(Time::fromSeconds(1e14).isInfinite());
  EXPECT_LT(Time::fromSeconds(1e14), never);
  EXPECT_EQ(never, Time::infinity());
  EXPECT_EQ(never + 1.0, never);
  EXPECT_EQ(never + -1.0, never);
  EXPECT_EQ(never.seconds(), inf);
  EXPECT_EQ(never - Time(), inf);
  EXPECT_TRUE((Time() + inf).isInfinite());
  EXPECT_TRUE((Time() + 1e15).isInfinite());
  EXPECT_TRUE((Time() + std::nan("")).isInfinite());
}

TEST(Time, WholeNanosecondsAddUpToWholeOnes)
{
  for (int ms = 0; ms < 10000; ms += 7)
  {
    const Time time = Time::fromNanoseconds(ms * std::int64_t{ 1000000 });
    EXPECT_EQ(time.after(Time()), time);
    EXPECT_EQ(time.after(Time::fromNanoseconds(4838000001)), Time::fromNanoseconds(4838000001 + ms * std::int64_t{ 1000000 }));
  }
  EXPECT_EQ((Time() + 0.5 + half_eps).after(Time::fromSeconds(3.0)), Time::fromSeconds(3.0) + (0.5 + half_eps));
  EXPECT_TRUE(Time::infinity().after(Time()).isInfinite());
}

TEST(Time, ComparisonsAgree)
{
  const Time ascending[] = {
    Time::fromSeconds(-1.5), Time::fromSeconds(-1.0),      Time(),          Time() + half_eps, Time::fromSeconds(0.5),
    Time::fromSeconds(1.0),  Time::fromSeconds(1.0) + 0.1, Time::infinity()
  };
  const int count = sizeof(ascending) / sizeof(*ascending);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
    {
      EXPECT_EQ(ascending[i] < ascending[j], i < j);
      EXPECT_EQ(ascending[i] > ascending[j], i > j);
      EXPECT_EQ(ascending[i] <= ascending[j], i <= j);
      EXPECT_EQ(ascending[i] >= ascending[j], i >= j);
      EXPECT_EQ(ascending[i] == ascending[j], i == j);
      EXPECT_EQ(ascending[i] != ascending[j], i != j);
    }
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
