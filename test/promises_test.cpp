#include "promises.h"

#include "bodies.h"

#include <algorithm>

namespace block_world
{
namespace
{
/// The earliest slot by looking at all of them; the lowest of equal ones.
int firstOf(const std::vector<Time>& times)
{
  return static_cast<int>(std::min_element(times.begin(), times.end()) - times.begin());
}

TEST(Promises, NothingPromised)
{
  Promises promises;
  promises.reset(3);
  EXPECT_EQ(promises.first(), 0);
  EXPECT_TRUE(promises.firstTime().isInfinite());
}

TEST(Promises, TiesComeInTheOrderOfTheSlots)
{
  Promises promises;
  promises.reset(50);
  for (int slot = 49; slot >= 0; --slot)
    promises.set(slot, Time::fromSeconds(1.0));
  for (int slot = 0; slot < 50; ++slot)
  {
    EXPECT_EQ(promises.first(), slot);
    promises.set(slot, Time::infinity());
  }
}

TEST(Promises, RandomUpdatesAgainstALinearSearch)
{
  Random random(1);
  for (const int slots : { 1, 2, 7, 100 })
  {
    Promises promises;
    promises.reset(slots);
    std::vector<Time> reference(slots, Time::infinity());
    for (int i = 0; i < 20000; ++i)
    {
      const int slot = random.below(slots);
      // Few different instants, so that many tie; some the smallest fraction apart.
      const Time time =
          random.below(5) == 0 ? Time::infinity() : Time::fromSeconds(random.below(20)) + random.below(2) * 1.2e-16;
      promises.set(slot, time);
      reference[slot] = time;
      ASSERT_EQ(promises.first(), firstOf(reference));
      ASSERT_EQ(promises.firstTime(), reference[firstOf(reference)]);
      ASSERT_EQ(promises.time(slot), time);
    }
  }
}

TEST(Promises, DrainInSortedOrder)
{
  Random random(2);
  const int slots = 300;
  Promises promises;
  promises.reset(slots);
  std::vector<std::pair<double, int>> order;
  for (int slot = 0; slot < slots; ++slot)
  {
    const double second = random.below(40);
    promises.set(slot, Time::fromSeconds(100.0 - second));
    promises.set(slot, Time::fromSeconds(second));
    order.emplace_back(second, slot);
  }
  std::sort(order.begin(), order.end());
  for (const auto& expected : order)
  {
    ASSERT_EQ(promises.first(), expected.second);
    promises.set(expected.second, Time::infinity());
  }
  EXPECT_TRUE(promises.firstTime().isInfinite());
}

TEST(Promises, ResetForgets)
{
  Promises promises;
  promises.reset(4);
  promises.set(2, Time::fromSeconds(1.0));
  promises.reset(6);
  EXPECT_EQ(promises.first(), 0);
  EXPECT_TRUE(promises.time(2).isInfinite());
  promises.set(5, Time::fromSeconds(-1.0));
  EXPECT_EQ(promises.first(), 5);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
