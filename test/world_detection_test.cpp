// Fast, thin and grazing: no contact may be missed, and none invented.

#include <random>

#include "world_testing.h"

namespace block_world
{
namespace
{
// E1: rods of 1 x 0.02 at 30..70 m/s, spinning at 20..80 rad/s, at a fixed wall 1 cm thick.
TEST(Detection, ThinFastRods)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 200; ++i)
  {
    const double speed = 30.0 + 40.0 * share(random), omega = (20.0 + 60.0 * share(random)) * (i % 2 ? 1.0 : -1.0);
    World world(makeScene(0.0, 1.0,
                          { moving(makeBox("rod", { 1, 0.02 }, { -1, 0 }, 6.0 * share(random)), { speed, 0 }, omega),
                            fixedOne(makeBox("wall", { 0.01, 20 }, { 0.005, 0 })) }));
    const double energy = world.energy().total;
    run(world, 0.1);
    EXPECT_LT(world.state(0).position.x(), 0.0) << i;
    EXPECT_GE(world.statistics().impacts, 1) << i;
    EXPECT_NEAR(world.energy().total / energy, 1.0, 1e-12) << i;
    expectExact(world, 1e-9);
  }
}

// E2: small blocks at 30..70 m/s at a free thin one, masses by area.
TEST(Detection, FastBlocksAtAThinOne)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 200; ++i)
  {
    const double speed = 30.0 + 40.0 * share(random), height = 0.9 * (share(random) - 0.5);
    World world(makeScene(
        0.0, 1.0,
        { withMass(moving(makeBox("bullet", { 0.1, 0.1 }, { -1, height }, 6.0 * share(random)), { speed, 0 }), 0.01),
          withMass(makeBox("thin", { 0.02, 1 }, { 0, 0 }), 0.02) }));
    run(world, 1.5 / speed);
    EXPECT_GE(world.statistics().impacts, 1) << i;
    EXPECT_GT(world.state(1).velocity.x(), 0.0) << i;
    EXPECT_NEAR(world.energy().momentum_x, 0.01 * speed, 1e-13) << i;
    expectExact(world, 1e-10);
  }
}

// E3: a spinner at 1000 rad/s drifts to a wall for a minute.
TEST(Detection, Spinner)
{
  Walls walls;
  walls.right = 0.0;
  World world(makeScene(0.0, 1.0, { moving(makeBox("a", { 0.4, 0.2 }, { -0.7, 0 }), { 0.01, 0 }, 1000.0) }, walls));
  run(world, 40.0);
  EXPECT_EQ(world.statistics().impacts, 0);
  run(world, 60.0);
  EXPECT_EQ(world.statistics().impacts, 1);
  EXPECT_LT(world.statistics().events, 1000);
  expectExact(world, 1e-9);
}

// D7: a corner passes the floor at c. It comes in at w = sqrt(2 |c| omega^2 rho) = 2.4e-4 m/s at most, its arm upright,
// so the block leaves at 2 w; at c > 0 nothing happens.
TEST(Detection, Grazing)
{
  for (const double tolerance : { 1e-6, 1e-10 })
    for (const double c : { 1e-9, 0.0, -1e-9 })
    {
      SCOPED_TRACE(c);
      const double radius = std::hypot(0.25, 0.15);
      Scene scene =
          makeScene(0.0, 1.0, { moving(makeBox("a", { 0.5, 0.3 }, { 0, radius + c }), { 1, 0 }, 10.0) }, onFloor());
      scene.tolerance = tolerance;
      World world(scene);
      const MotionState after = stateAt(world, 2.0);
      EXPECT_NEAR(after.velocity.x(), 1.0, 1e-15);
      EXPECT_GE(after.velocity.y(), 0.0);
      EXPECT_LE(after.velocity.y(), c > 0.0 ? 0.0 : 1.0001 * 2.0 * std::sqrt(2.0 * 1e-9 * 100.0 * radius));
      EXPECT_GE(world.statistics().impacts, c < 0.0 ? 1 : 0);
      EXPECT_LE(world.statistics().impacts, c > 0.0 ? 0 : 1);
      expectExact(world, 1e-12);
    }
}

// H1: a square in a slot with 1 mm to either side: 500 hits a second, all true.
TEST(Detection, Slot)
{
  Walls walls;
  walls.left = -0.501;
  walls.right = 0.501;
  World world(makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0 }) }, walls));
  run(world, 1.0);
  EXPECT_EQ(world.statistics().impacts, 500);
  EXPECT_NEAR(world.energy().total, 0.5, 1e-12);
  EXPECT_NEAR(world.state(0).omega, 0.0, 1e-11);
}

// B10: no room at all: nothing can move sideways, so the energy is lost.
TEST(Detection, SlotWithoutRoom)
{
  Walls walls;
  walls.left = -0.5;
  walls.right = 0.5;
  World world(makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0.25 }) }, walls));
  const MotionState after = stateAt(world, 1.0);
  EXPECT_NEAR(after.velocity.x(), 0.0, 1e-15);
  EXPECT_NEAR(after.velocity.y(), 0.25, 1e-15);
  EXPECT_NEAR(after.position.x(), 0.0, 1e-12);
  EXPECT_NEAR(world.energy().total, 0.03125, 1e-15);
}

// B13: bricks on the floor are hit from the side: no unique outcome, but energy and momentum are kept.
TEST(Detection, BrickWall)
{
  std::vector<Block> blocks{ moving(makeBox("ball", { 1, 0.4 }, { -1.5, 0.75 }), { 3, 0 }) };
  for (const double x : { -0.5, 0.5 })
    for (const double y : { 0.25, 0.75 })
      blocks.push_back(makeBox("brick" + std::to_string(blocks.size()), { 1, 0.5 }, { x, y }));
  World world(makeScene(0.0, 1.0, blocks, onFloor()));
  run(world, 0.05);
  EXPECT_NEAR(world.energy().total / 4.5, 1.0, 1e-12);
  EXPECT_NEAR(world.energy().momentum_x, 3.0, 1e-12);
  expectExact(world, 1e-11);
}

// E4: a tolerance below what the coordinates can resolve is raised, and the notes say so.
TEST(Detection, HugeSizeRatio)
{
  Scene scene = makeScene(0.0, 1.0, { moving(makeBox("a", { 1e-3, 1e-3 }, { 0, 0 }, 0.3), { 10, 3 }) });
  scene.walls = Walls{ -500.0, 500.0, -500.0, 500.0 };
  scene.tolerance = 1e-15;
  World world(scene);
  EXPECT_GT(world.scene().tolerance, 1e-14);
  EXPECT_FALSE(world.notes().empty());
  run(world, 100.0);
  EXPECT_NEAR(world.energy().total / 54.5, 1.0, 1e-12);
  EXPECT_EQ(world.statistics().mode, "exact");
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
