// What the engine says it computes for, against counts that are known exactly; and when time stands still.

#include "world_testing.h"

namespace block_world
{
namespace
{
std::int64_t count(const World& world, CostKind kind, int body = 0)
{
  return world.cost(body)[kind].count;
}

std::vector<std::string> names(const IslandCost& island)
{
  return island.blocks;
}

using Names = std::vector<std::string>;

/// Unit squares at these speeds, each in a lane of its own, between two walls that leave them 1 m to go.
Scene makeLanes(const std::vector<double>& speeds)
{
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    blocks.push_back(
        moving(makeBox(std::string(1, static_cast<char>('a' + i)), { 1, 1 }, { 0, 5.0 * i }), { speeds[i], 0 }));
  Walls walls;
  walls.left = -1.0;
  walls.right = 1.0;
  return makeScene(0.0, 1.0, blocks, walls);
}

// Hits at 1/2, 3/2, 5/2, ... of the time for 1 m.
TEST(Cost, HitsOfABouncingBlock)
{
  World world(makeLanes({ 50.0 }));
  CostMeter meter;
  run(world, 10.0);
  EXPECT_EQ(count(world, CostKind::Impact), 500);
  EXPECT_EQ(world.statistics().impacts, 500);
  EXPECT_EQ(meter.read(world).at(0).cost[CostKind::Impact].count, 500);
  // The same second, read at once and in parts.
  run(world, 11.0);
  EXPECT_EQ(meter.read(world).at(0).cost[CostKind::Impact].count, 50);
  for (int i = 1; i <= 10; ++i)
  {
    run(world, 11.0 + 0.1 * i);
    EXPECT_EQ(meter.read(world).at(0).cost[CostKind::Impact].count, 5) << i;
  }
}

// Each hit asks for the same, so the units are as 1 to 3; less than what a hit costs may be different at either end of
// the time. With two more blocks, which never move, cells keep the lanes apart.
TEST(Cost, TheBusierOfTwoIslandsComesFirst)
{
  World world(makeLanes({ 30.0, 90.0, 0.0, 0.0 }));
  CostMeter meter;
  run(world, 5.0);
  const std::vector<IslandCost> islands = meter.read(world);
  ASSERT_EQ(islands.size(), 4u);
  EXPECT_EQ(names(islands[0]), Names{ "b" });
  EXPECT_EQ(names(islands[1]), Names{ "a" });
  EXPECT_EQ(islands[0].cost[CostKind::Impact].count, 450);
  EXPECT_EQ(islands[1].cost[CostKind::Impact].count, 150);
  EXPECT_NEAR(islands[0].share / (islands[0].share + islands[1].share), 0.75, 1.0 / 600);
  EXPECT_DOUBLE_EQ(islands[0].share + islands[1].share + islands[2].share + islands[3].share, 1.0);
}

// Galperin's hits come by turns: the light block hits the heavy one, then the wall, and so on: all 314 are the light
// one's, half are the heavy one's.
TEST(Cost, DigitsOfPi)
{
  World world(shipped("pi_collisions"));
  run(world, 100.0);
  const int heavy = world.find("heavy"), light = world.find("light");
  EXPECT_EQ(count(world, CostKind::Impact, light), 314);
  EXPECT_EQ(count(world, CostKind::Impact, heavy), 157);
  EXPECT_EQ(names(CostMeter().read(world).at(0)), Names{ "light" });
}

// A thrust that begins and ends far from everything: the start, the command and its end; damping makes arcs that end.
TEST(Cost, CommandsAndArcs)
{
  Scene scene = makeScene(0.0, 1.0, { makeBox("a", { 1, 1 }, { 0, 0 }) });
  World coasting(scene);
  run(coasting, 100.0);
  EXPECT_EQ(count(coasting, CostKind::Command), 1);
  EXPECT_EQ(count(coasting, CostKind::Arc), 0);
  scene.damping = 1.0;
  World world(scene);
  ASSERT_TRUE(world.apply(ThrustCommand{ "a", { 0, 0, 1, 0, 0, 0 }, 1.0 }).ok);
  run(world, 10.0);
  EXPECT_EQ(count(world, CostKind::Command), 3);
  // Nothing else can happen to a block that is alone.
  EXPECT_EQ(count(world, CostKind::Arc), world.statistics().events - 1);
  EXPECT_GT(count(world, CostKind::Arc), 0);
  EXPECT_EQ(count(world, CostKind::Look) + count(world, CostKind::Cell) + count(world, CostKind::Contact), 0);
}

// A hit in the instant of the start is a matter of the block that hits; the others start.
TEST(Cost, EachIslandHasItsOwnKind)
{
  Scene scene = makeLanes({ 1.0, 1.0, 1.0 });
  scene.blocks[1].position.x() = 0.5;
  World world(scene);
  for (const int body : { 0, 1, 2 })
  {
    EXPECT_EQ(count(world, CostKind::Impact, body), body == 1 ? 1 : 0) << body;
    EXPECT_EQ(count(world, CostKind::Command, body), body == 1 ? 0 : 1) << body;
  }
}

// A block falls on one that rests and stays there; lifted off again it is by itself. What each has cost stays with it.
// What rests elsewhere costs nothing.
TEST(Cost, IslandsMergeAndSplit)
{
  World world(makeScene(9.8, 0.0,
                        { makeBox("low", { 2, 1 }, { 0, 0.5 }), makeBox("high", { 1, 1 }, { 0, 2.5 }),
                          makeBox("asleep", { 1, 1 }, { 20, 0.5 }), makeBox("asleep too", { 1, 1 }, { 30, 0.5 }) },
                        onFloor()));
  CostMeter meter;
  EXPECT_EQ(meter.read(world).size(), 4u);
  run(world, 1.0);
  const std::vector<IslandCost> merged = meter.read(world);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].blocks.size(), 2u);
  EXPECT_EQ(world.island(1), (std::vector<int>{ 0, 1 }));
  EXPECT_EQ(merged[0].share, 1.0);

  // The lift is a command to both, as they move as one; the next one is for the upper block alone.
  const std::int64_t low = count(world, CostKind::Command, 0), high = count(world, CostKind::Command, 1);
  ASSERT_TRUE(world.apply(WrenchCommand{ "high", Vector2d(0.0, 20.0), 0.0 }).ok);
  EXPECT_EQ(count(world, CostKind::Command, 0), low + 1);
  EXPECT_EQ(count(world, CostKind::Command, 1), high + 1);
  run(world, 1.5);
  EXPECT_EQ(world.island(1), std::vector<int>{ 1 });
  ASSERT_TRUE(world.apply(WrenchCommand{ "high", Vector2d(0.0, 21.0), 0.0 }).ok);
  EXPECT_EQ(count(world, CostKind::Command, 0), low + 1);
  EXPECT_EQ(count(world, CostKind::Command, 1), high + 2);
}

TEST(Cost, StaysWithABlockWhenOthersComeAndGo)
{
  World world(makeLanes({ 30.0, 90.0 }));
  run(world, 1.0);
  ASSERT_TRUE(world.apply(SpawnCommand{ makeBox("c", { 1, 1 }, { 0, 20 }) }).ok);
  ASSERT_TRUE(world.apply(DeleteCommand{ "a" }).ok);
  EXPECT_EQ(count(world, CostKind::Impact, world.find("b")), 90);
  ASSERT_TRUE(world.apply(ResetCommand()).ok);
  EXPECT_EQ(count(world, CostKind::Impact, world.find("b")), 90);
  EXPECT_EQ(count(world, CostKind::Impact, world.find("a")), 0);
}

// Another world with blocks of the same names, which has cost less so far.
TEST(Cost, CountsAnotherWorldFromItsStart)
{
  CostMeter meter;
  World one(makeLanes({ 50.0 })), other(makeLanes({ 50.0 }));
  run(one, 2.0);
  meter.read(one);
  run(other, 1.0);
  EXPECT_EQ(meter.read(other).at(0).cost[CostKind::Impact].count, 50);
}

TEST(Cost, BelongsToTheStateAndChangesNothing)
{
  World asked(shipped("pile")), unasked(shipped("pile"));
  CostMeter meter;
  for (int i = 1; i <= 20; ++i)
  {
    run(asked, 0.1 * i);
    meter.read(asked);
    run(unasked, 0.1 * i);
  }
  EXPECT_EQ(asked.save(), unasked.save());
  World restored = World::restore(unasked.save());
  run(restored, 3.0);
  run(unasked, 3.0);
  for (int i = 0; i < restored.bodyCount(); ++i)
    for (std::size_t k = 0; k < kCostKinds; ++k)
    {
      EXPECT_EQ(restored.cost(i).parts[k].count, unasked.cost(i).parts[k].count);
      EXPECT_EQ(restored.cost(i).parts[k].units, unasked.cost(i).parts[k].units);
    }
}

TEST(Cost, InWords)
{
  IslandCost island;
  island.blocks = { "block3", "block5" };
  island.cost[CostKind::Impact] = { 41000, 980 };
  island.cost[CostKind::Look] = { 10, 20 };
  island.first[CostKind::Impact] = { 20500, 490 };
  island.share = 0.97;
  EXPECT_EQ(island.describe(0.5), "block3, block5: 97 % of the computing; 98 % impacts, 41000 a second of block3");
  EXPECT_EQ(island.describe(0.0), "block3, block5: 97 % of the computing; 98 % impacts");
  island.blocks.assign(20, "b");
  EXPECT_EQ(island.describe(0.0).substr(0, 30), "b, b, b, b, b, b and 14 more: ");
}

/// A square in a slot of 1 nm to either side at 1e6 m/s: a hit every 2e-15 s, 500 within 1e-12 s.
Scene makeStorm()
{
  Scene scene =
      makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1e6, 0 }), makeBox("b", { 1, 1 }, { 0, 5 }) });
  scene.walls.left = -0.5 - 1e-9;
  scene.walls.right = 0.5 + 1e-9;
  scene.tolerance = 1e-12;
  return scene;
}

TEST(Stall, NamesTheIslandAndWhy)
{
  World fresh(makeStorm());
  fresh.stallAfter(100);
  World world = World::restore(fresh.save());
  const Time goal = Time::fromSeconds(1.0), stop = world.advance(goal, 10000);
  EXPECT_LT(stop, goal);
  EXPECT_LE(stop - Time(), 1e-12);
  EXPECT_TRUE(world.statistics().stalled);
  const std::string mode = world.statistics().mode;
  EXPECT_EQ(mode.find("stalled at 'a': 100 events within 1e-12 s, "), 0u) << mode;
  EXPECT_NE(mode.find(" % impacts"), std::string::npos) << mode;
  EXPECT_EQ(count(world, CostKind::Impact, 1), 0);
  // Time stands still, asked again or not, and nothing is left out: not stalled at all, the same events lead to the
  // same bits.
  const std::int64_t events = world.statistics().events;
  EXPECT_EQ(world.advance(goal), stop);
  EXPECT_EQ(world.statistics().events, events);
  World patient(makeStorm());
  EXPECT_EQ(patient.advance(goal, events - patient.statistics().events), stop);
  EXPECT_EQ(patient.statistics().mode, "exact");
  EXPECT_EQ(patient.stateHash(), world.stateHash());

  const World restored = World::restore(world.save());
  EXPECT_TRUE(restored.statistics().stalled);
  EXPECT_EQ(restored.statistics().mode, mode);
}

// What cannot be done changes nothing; slowed down to 1 nm/s the block needs a second for the slot.
TEST(Stall, EndsWhereTheCourseIsChanged)
{
  World world(makeStorm());
  world.stallAfter(100);
  const Time stop = world.advance(Time::fromSeconds(1.0), 10000);
  ASSERT_TRUE(world.statistics().stalled);
  EXPECT_FALSE(world.apply(ThrustCommand{ "nobody", {}, 1.0 }).ok);
  EXPECT_TRUE(world.check(ResetCommand()).ok);
  EXPECT_TRUE(world.statistics().stalled);
  SetStateCommand slow;
  slow.body = "a";
  slow.velocity = Vector2d(1e-9, 0.0);
  ASSERT_TRUE(world.apply(slow).ok);
  EXPECT_EQ(world.statistics().mode, "exact");
  EXPECT_EQ(world.advance(Time::fromSeconds(10.0)), Time::fromSeconds(10.0));
  EXPECT_EQ(world.statistics().mode, "exact");

  ASSERT_TRUE(world.apply(ResetCommand()).ok);
  EXPECT_LT(world.advance(Time::fromSeconds(20.0), 10000) - Time::fromSeconds(10.0), 1e-11) << "the limit stays";
  EXPECT_TRUE(world.statistics().stalled);
  EXPECT_LE(stop - Time(), 1e-12);
}

// 25 hits with their looks ahead within 1e-12 s are no 100 events, and commands, of which a controller may give any
// number at one instant, are none.
TEST(Stall, IsNoMatterOfCommands)
{
  Scene scene = makeStorm();
  scene.blocks[0].velocity.x() = 5e4;
  World world(scene);
  world.stallAfter(100);
  const Time goal = Time::fromSeconds(1e-11);
  ASSERT_LT(world.advance(goal, 20), goal);
  for (int i = 0; i < 75; ++i)
    ASSERT_TRUE(world.apply(WrenchCommand{ "a", Vector2d::Zero(), 0.0 }).ok);
  EXPECT_EQ(world.advance(goal), goal) << world.statistics().mode;
  EXPECT_EQ(count(world, CostKind::Impact), 250);
}

// Three hundred blocks that land at one instant: each has few events there.
TEST(Stall, IsNoMatterOfHowManyIslandsThereAre)
{
  std::vector<Block> blocks;
  for (int i = 0; i < 300; ++i)
    blocks.push_back(makeBox("b" + std::to_string(i), { 1, 1 }, { 2.0 * i, 1.5 }));
  World world(makeScene(9.8, 0.5, blocks, onFloor()));
  world.stallAfter(100);
  run(world, 0.5);
  EXPECT_EQ(world.statistics().impacts, 300);
  EXPECT_EQ(world.statistics().mode, "exact");
}

// A tenth of a second with 500000 hits a second is just that.
TEST(Stall, IsNoMatterOfHowManyEventsASecondHas)
{
  Scene scene = makeStorm();
  scene.walls.left = -0.5 - 1e-6;
  scene.walls.right = 0.5 + 1e-6;
  scene.blocks[0].velocity.x() = 1.0;
  World world(scene);
  world.stallAfter(100);
  run(world, 0.1);
  EXPECT_EQ(count(world, CostKind::Impact), 50000);
  EXPECT_EQ(world.statistics().mode, "exact");
}

}  // namespace
}  // namespace block_world
