#include "grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random.h"

namespace block_world
{
namespace
{
// The promise of the grid: whose circles and shell can touch while both centres are within what their cells allow, is found as a neighbour, by
// both and only once. Judged by distances alone, for sizes 1:100.
TEST(Grid, FindsAllWhoCanTouch)
{
  Random random(7);
  std::vector<double> radii;
  for (int i = 0; i < 60; ++i)
    radii.push_back(std::pow(10.0, random.in(-1.0, 1.0)));
  radii.push_back(HUGE_VAL);  // a wall has no place
  const double shell = 1e-3;
  Grid grid;
  grid.configure(radii, shell);
  std::vector<Vec2> centres(60, Vec2::Zero());
  for (int round = 0; round < 20; ++round)
  {
    for (int i = 0; i < 60; ++i)
    {
      centres[i] += random.vector(round == 0 ? 40.0 : 3.0);
      const bool moved = grid.place(i, centres[i]);
      EXPECT_FALSE(grid.place(i, centres[i]));
      const Grid::Box box = grid.keeps(i);
      EXPECT_TRUE((centres[i] - box.low).minCoeff() > 0.0 && (box.high - centres[i]).minCoeff() > 0.0);
      EXPECT_TRUE(round > 0 || moved);
    }
    for (int i = 0; i < 60; ++i)
    {
      std::vector<int> found;
      grid.neighbours(i, found);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (int j = 0; j < 60; ++j)
      {
        if (i == j)
          continue;
        // Nearest that the two centres may come without either changing its cell.
        const Grid::Box a = grid.keeps(i), b = grid.keeps(j);
        const Vec2 apart = (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(Vec2::Zero());
        const bool listed = std::binary_search(found.begin(), found.end(), j);
        EXPECT_EQ(listed, grid.near(i, j));
        const double reach = radii[i] + radii[j] + shell;
        EXPECT_TRUE(listed || apart.norm() > reach || std::max(apart.x(), apart.y()) <= 0.0) << i << " " << j;
        EXPECT_TRUE(listed || (centres[i] - centres[j]).norm() > reach) << i << " " << j;
      }
    }
  }
}

TEST(Grid, ASingleBodyHasNobodyToMeet)
{
  Grid grid;
  grid.configure({ 1.0, HUGE_VAL }, 1e-6);
  EXPECT_TRUE(grid.place(0, Vec2(1e6, -3.0)));
  std::vector<int> found{ 1 };
  grid.neighbours(0, found);
  EXPECT_TRUE(found.empty());
  EXPECT_TRUE(std::isinf(grid.keeps(0).high.x()));
}

// Three bodies make three pairs, wherever they are and whatever their sizes; none of them ever leaves its cell.
TEST(Grid, AFewAreNearEachOther)
{
  Grid grid;
  grid.configure({ 0.1, 1e6, HUGE_VAL, 3.0 }, 1e-6);
  const Vec2 centres[] = { Vec2(-1e300, 1e300), Vec2(1e6, 0.0), Vec2::Zero(), Vec2(-2.0, -1e200) };
  const std::vector<int> listed{ 0, 1, 3 };
  for (int i : listed)
    EXPECT_TRUE(grid.place(i, centres[i]));
  for (int i : listed)
  {
    std::vector<int> found;
    grid.neighbours(i, found);
    found.push_back(i);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, listed);
    EXPECT_TRUE(std::isinf(grid.keeps(i).low.y()));
    for (int j : listed)
      EXPECT_TRUE(grid.near(i, j));
  }
}
}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
