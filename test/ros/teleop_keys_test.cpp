#include "teleop_keys.h"

#include <gtest/gtest.h>

namespace block_world
{
namespace
{
std::vector<int> read(const std::string& bytes)
{
  KeyReader reader;
  std::vector<int> keys;
  for (const char byte : bytes)
    if (const auto key = reader.read(static_cast<unsigned char>(byte)))
      keys.push_back(*key);
  return keys;
}

std::vector<double> levelsOf(int key, int block)
{
  HeldKeys held(500, 100);
  held.press(key, 0);
  return held.levels(block, 1);
}

const std::vector<double> NONE = { 0, 0, 0, 0, 0, 0 };
}  // namespace

TEST(KeyReader, readsLettersAndArrows)
{
  EXPECT_EQ(read("eS "), (std::vector<int>{ 'e', 'S', ' ' }));
  EXPECT_EQ(read("\033[A\033[B\033[C\033[D"), (std::vector<int>{ keys::UP, keys::DOWN, keys::RIGHT, keys::LEFT }));
  EXPECT_EQ(read("\033OAe"), (std::vector<int>{ keys::UP, 'e' }));
  EXPECT_EQ(read("\033[1;2De"), (std::vector<int>{ keys::LEFT, 'e' }));
  EXPECT_EQ(read("\033[3~e"), (std::vector<int>{ 'e' })) << "other function keys are passed over";
}

TEST(Drive, keysPushTheWayTheyPoint)
{
  EXPECT_EQ(levelsOf('e', 0), (std::vector<double>{ 0, 0, 1, 0, 0, 0 }));
  EXPECT_EQ(levelsOf('d', 0), (std::vector<double>{ 0, 0, 0, 1, 0, 0 }));
  EXPECT_EQ(levelsOf('s', 0), (std::vector<double>{ 1, 0, 0, 0, 1, 0 }));
  EXPECT_EQ(levelsOf('f', 0), (std::vector<double>{ 0, 1, 0, 0, 0, 1 }));
  EXPECT_EQ(levelsOf('S', 0), (std::vector<double>{ 1, 0, 0, 0, 0, 1 }));
  EXPECT_EQ(levelsOf('F', 0), (std::vector<double>{ 0, 1, 0, 0, 1, 0 }));
  for (const auto& same : { std::make_pair(int('i'), int('e')), std::make_pair(int(keys::DOWN), int('d')),
                            std::make_pair(int('j'), int('s')), std::make_pair(int(keys::RIGHT), int('f')),
                            std::make_pair(int('J'), int('S')), std::make_pair(int('L'), int('F')) })
  {
    EXPECT_EQ(levelsOf(same.first, 1), levelsOf(same.second, 0));
    EXPECT_EQ(levelsOf(same.first, 0), NONE);
  }
  EXPECT_FALSE(driveOf('q'));
  EXPECT_FALSE(driveOf('E'));
}

TEST(HeldKeys, aTapEndsAndARepeatedKeyLasts)
{
  HeldKeys held(500, 100);
  held.press('e', 0);
  EXPECT_NE(held.levels(0, 499), NONE);
  EXPECT_EQ(held.levels(0, 500), NONE);

  held.press('e', 1000);
  for (std::int64_t now = 1490; now < 3000; now += 40)
  {
    held.press('e', now);
    EXPECT_NE(held.levels(0, now + 39), NONE);
  }
  EXPECT_EQ(held.levels(0, 3100), NONE) << "let go: over after the shorter hold";
}

TEST(HeldKeys, twoKeysAddUp)
{
  HeldKeys held(500, 100);
  held.press('e', 0);
  held.press('F', 10);
  EXPECT_EQ(held.levels(0, 20), (std::vector<double>{ 0, 1, 1, 0, 1, 0 }));
  held.releaseAll();
  EXPECT_EQ(held.levels(0, 20), NONE);
}

}  // namespace block_world
