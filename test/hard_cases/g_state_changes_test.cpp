// G. State changes: spawning, moving and removing blocks.

#include "hard_cases.h"

namespace block_world
{
namespace
{
/// Refused, with all of these words in the reason, and nothing changed: neither bits nor what follows.
void expectRefused(const Scene& scene, const Command& command, const std::vector<std::string>& words)
{
  World world(scene), untouched(scene);
  run(world, 0.5);
  run(untouched, 0.5);
  const Applied answer = world.apply(command);
  EXPECT_FALSE(answer.ok);
  for (const std::string& word : words)
    EXPECT_NE(answer.reason.find(word), std::string::npos) << answer.reason;
  EXPECT_EQ(world.stateHash(), untouched.stateHash());
  EXPECT_EQ(world.bodyCount(), untouched.bodyCount());
  EXPECT_EQ(writeScene(world.scene()), writeScene(untouched.scene()));
  run(world, 2.0);
  run(untouched, 2.0);
  EXPECT_EQ(world.stateHash(), untouched.stateHash());
  EXPECT_EQ(world.statistics().events, untouched.statistics().events);
}

// G1
TEST(StateChanges, SpawnThatOverlaps)
{
  expectRefused(
      makeScene(0.0, 1.0,
                { makeBox("old", { 1, 1 }, { 0, 0 }), moving(makeBox("other", { 1, 1 }, { 5, 0 }), { 1, 0 }) }),
      SpawnCommand{ makeBox("new", { 1, 1 }, { 0.9, 0 }) }, { "old", "new" });
}

// G1: an overlap below the tolerance is taken out, each block moving half, and gives no velocity.
TEST(StateChanges, SpawnThatBarelyOverlaps)
{
  for (const double overlap : { 4e-7, 1e-9, 1e-12 })
  {
    World world(makeScene(0.0, 1.0, { makeBox("a", { 1, 1 }, { 0, 0 }) }));
    ASSERT_TRUE(world.apply(SpawnCommand{ makeBox("b", { 1, 1 }, { 1.0 - overlap, 0 }) }).ok);
    EXPECT_NEAR(world.state(0).position.x(), -0.5 * overlap, 4.0 * rounding);
    EXPECT_NEAR(world.state(1).position.x(), 1.0 - 0.5 * overlap, 4.0 * rounding);
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(world.state(i).velocity.norm() + std::abs(world.state(i).omega), 0.0);
    expectNothingHappens(world, 10.0);
    expectExact(world, 0.0);
  }
}

// G2: a block of 1 into 0.9, between fixed blocks and between walls.
TEST(StateChanges, SpawnWithoutRoom)
{
  expectRefused(
      makeScene(9.8, 1.0,
                { fixedOne(makeBox("left", { 1, 1 }, { -0.95, 0 })), fixedOne(makeBox("right", { 1, 1 }, { 0.95, 0 })),
                  makeBox("falling", { 1, 1 }, { 0, 9 }) }),
      SpawnCommand{ makeBox("new", { 1, 1 }, { 0, 0 }) }, { "new", "left" });
  Walls walls;
  walls.left = 0.0;
  walls.right = 0.9;
  expectRefused(makeScene(9.8, 1.0, { makeBox("falling", { 0.5, 0.5 }, { 0.4, 9 }) }, walls),
                SpawnCommand{ makeBox("new", { 1, 1 }, { 0.45, 0 }) }, { "new", "wall_left" });
}

// G3: in flight: from the next instant on it flies from there.
TEST(StateChanges, SetStateInFlight)
{
  World world(makeScene(9.8, 0.5, { moving(makeBox("a", { 1, 1 }, { 0, 10 }), { 1, 2 }, 3.0) }, onFloor()));
  run(world, 0.5);
  SetStateCommand put;
  put.body = "a";
  put.position = Vector2d(-3, 20);
  put.angle = 0.25;
  put.velocity = Vector2d(-1, 4);
  put.omega = -2.0;
  ASSERT_TRUE(world.apply(put).ok);
  const MotionState from = world.state(0);
  EXPECT_EQ(from.position, put.position);
  EXPECT_EQ(from.velocity, put.velocity);
  expectState(stateAt(world, 1.5), closed_form::dampedFlight(from, 1.0, 1.0 / 6.0, 0.0, 0.1, 9.8, 1.0),
              8.0 * rounding * 20.0);
  expectExact(world, 1e-13);
}

// G3, G4: what stood on a block that is taken away falls freely from that instant, as one; what is below stays.
TEST(StateChanges, SupportTakenAway)
{
  for (const bool deleted : { false, true })
  {
    World world(shipped("stack"));
    run(world, 1.0);
    SetStateCommand away;
    away.body = "block5";
    away.position = Vector2d(5.0, 0.5);
    ASSERT_TRUE((deleted ? world.apply(DeleteCommand{ "block5" }) : world.apply(away)).ok);
    for (const double t : { 1e-9, 0.25 })
    {
      run(world, 1.0 + t);
      for (int k = 1; k <= 10; ++k)
      {
        const int body = world.find("block" + std::to_string(k));
        if (k == 5)
        {
          EXPECT_EQ(body, deleted ? -1 : 4);
          continue;
        }
        EXPECT_NEAR(world.state(body).velocity.y(), k > 5 ? -9.8 * t : 0.0, 1e-15) << k;
        EXPECT_NEAR(world.state(body).position.y(), k - 0.5 - (k > 5 ? 4.9 * t * t : 0.0), 16.0 * rounding) << k;
        EXPECT_EQ(world.state(body).position.x(), 0.0) << k;
        EXPECT_EQ(world.state(body).omega, 0.0) << k;
      }
      EXPECT_NEAR(restingForce(world, "wall_bottom"), (deleted ? 4 : 5) * 9.8, 1e-14 * 49.0);
    }
    EXPECT_NEAR(world.energy().command_work, deleted ? -9.8 * 4.5 : -9.8 * 4.0, 1e-14 * 490.0);
    run(world, 5.0);
    expectExact(world, 1e-13 * 490.0);
  }
}

}  // namespace
}  // namespace block_world
