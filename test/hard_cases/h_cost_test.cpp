// H. Where events crowd: all of them are true, and each must be cheap.

#include "hard_cases.h"

namespace block_world
{
namespace
{
/// A unit square at 1 m/s in a slot with this clearance to either side.
Scene makeSlot(double clearance, double tolerance)
{
  Scene scene = makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0 }) });
  scene.walls.left = -0.5 - clearance;
  scene.walls.right = 0.5 + clearance;
  scene.tolerance = tolerance;
  return scene;
}

// H1: hits at c, 3c, 5c, ...: 500 a second at 1 mm, 500000 at 1 um. Looked at between two hits.
TEST(Cost, Slot)
{
  for (const auto& [clearance, seconds] : { std::pair(1e-3, 1.0), std::pair(1e-6, 0.01) })
  {
    SCOPED_TRACE(clearance);
    World world(makeSlot(clearance, 1e-9));
    run(world, seconds);
    const int hits = static_cast<int>(std::lround(0.5 * seconds / clearance));
    EXPECT_EQ(world.statistics().impacts, hits);
    EXPECT_LE(world.statistics().events, 8 * hits);
    EXPECT_NEAR(world.energy().total, 0.5, 1e-12);
    EXPECT_NEAR(std::abs(world.state(0).velocity.x()), 1.0, 1e-12);
    // Both corners of a side hit at once; a hit leaves a turn of its own rounding, at random.
    EXPECT_NEAR(world.state(0).omega, 0.0, hits * rounding);
    expectExact(world, 1e-12);
  }
}

// H1: below the tolerance the gaps are still true: the tolerance only tells what lands together.
TEST(Cost, SlotBelowTheTolerance)
{
  World world(makeSlot(1e-7, 1e-6));
  run(world, 1e-3);
  EXPECT_NEAR(world.energy().total, 0.5, 1e-12);
  EXPECT_NEAR(static_cast<double>(world.statistics().impacts), 5000, 1);
  expectExact(world, 1e-12);
}

/// Squares with this side at random places and turns on a grid of cells of 1 m in a closed room; speeds up to 1 m/s.
Scene makeGas(int side_by_side, double side, double tolerance)
{
  Random random(3);
  std::vector<Block> blocks;
  for (int i = 0; i < side_by_side * side_by_side; ++i)
  {
    const double angle = random.in(0.0, pi);
    const double room = 0.5 - 0.5 * side * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
    const Vector2d cell(i % side_by_side + 0.5, i / side_by_side + 0.5), place = cell + random.vector(0.99 * room);
    const Vector2d velocity = random.vector(1.0);
    blocks.push_back(
        moving(makeBox("b" + std::to_string(i), { side, side }, place, angle), velocity, random.in(-1.0, 1.0)));
  }
  Scene scene = makeScene(0.0, 1.0, blocks);
  scene.walls = Walls{ 0.0, 1.0 * side_by_side, 0.0, 1.0 * side_by_side };
  scene.tolerance = tolerance;
  return scene;
}

/// Kinetic energy is kept to a rounding per hit, momentum by no more than the walls' hits, and nothing overlaps.
void expectGas(int side_by_side, double seconds, int least_impacts)
{
  World world(makeGas(side_by_side, std::sqrt(0.4), 1e-6));
  const double energy = world.energy().total;
  expectEnergyNeverGrows(world, seconds, true, 10);
  EXPECT_GE(world.statistics().impacts, least_impacts);
  EXPECT_NEAR(world.energy().total / energy, 1.0, 1e-14 * std::sqrt(world.statistics().impacts));
  expectExact(world, 1e-12 * energy);
}

// H2: area fraction 0.4.
TEST(Cost, GasOfHundred)
{
  expectGas(10, 5.0, 1000);
}

TEST(Cost, GasOfThousand)
{
  expectGas(32, 0.5, 500);
}

/// Boxes with masses of 1 to 100 kg at random turns over one another in a bin.
Scene makeHeap(int count)
{
  Random random(4);
  std::vector<Block> blocks;
  for (int i = 0; i < count; ++i)
  {
    const Vector2d size(random.in(0.4, 1.0), random.in(0.4, 1.0)), place(1.5 * (i % 4) - 2.25, 1.0 + 1.5 * (i / 4));
    blocks.push_back(withMass(makeBox("b" + std::to_string(i), size, place, random.in(-pi, pi)),
                              std::pow(10.0, random.in(0.0, 2.0))));
  }
  Walls walls = onFloor();
  walls.left = -3.2;
  walls.right = 3.2;
  return makeScene(9.8, 0.3, blocks, walls);
}

// H3: a heap settles: never stuck, no overlap, no energy made. Without friction it does not freeze, but its centre
// comes down to rest: over the last second the floor carries the weight. At one instant it need not, as a block may just
// slide down.
void expectHeapSettles(int count, double seconds)
{
  const Scene scene = makeHeap(count);
  double weight = 0.0;
  for (const Block& block : scene.blocks)
    weight += 9.8 * block.mass;
  World world(scene);
  const double start = world.energy().total;
  expectEnergyNeverGrows(world, seconds - 1.0, false, 20);
  constexpr int kReadings = 20;
  double carried = 0.0;
  for (int i = 1; i <= kReadings; ++i)
  {
    run(world, seconds - 1.0 + static_cast<double>(i) / kReadings);
    carried += restingForce(world, "wall_bottom") / kReadings;
  }
  EXPECT_EQ(world.now(), Time::fromSeconds(seconds));
  EXPECT_LT(world.energy().translational + world.energy().rotational, 0.02 * start);
  EXPECT_NEAR(carried, weight, 0.1 * weight);
  expectExact(world, 1e-12 * start);
}

TEST(Cost, HeapOfTwelve)
{
  expectHeapSettles(12, 12.0);
}

TEST(Cost, HeapOfTwentyFour)
{
  expectHeapSettles(24, 4.0);
}

// Takes minutes. --gtest_also_run_disabled_tests --gtest_filter=*HeapOfFifty*
TEST(Cost, DISABLED_HeapOfFifty)
{
  expectHeapSettles(50, 4.0);
}

}  // namespace
}  // namespace block_world
