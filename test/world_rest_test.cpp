// Contacts that last: coming to rest, sliding, leaving, standing. Against closed forms and references with 33 digits.

#include "closed_forms.h"
#include "world_testing.h"

namespace block_world
{
namespace
{
/// Bounces rise by four tolerances at the speed below which they are replaced by their limit.
double captureSpeed(const Scene& scene)
{
  return std::sqrt(8.0 * scene.tolerance * scene.gravity);
}

// A1, A6, K6: the pose at rest is exact; rest begins less than the hops left out before the end of infinitely many.
TEST(Drop, ComesToRest)
{
  for (const double e : { 0.0, 1e-3, 0.5, 0.9, 0.99 })
  {
    SCOPED_TRACE(e);
    Scene scene = shipped("drop");
    scene.elasticity = e;
    World world(scene);
    const closed_form::BouncingDrop drop{ 0.875, 9.8, e };
    const double end = drop.restTime() + 1.0, left_out = 2.0 * captureSpeed(scene) / (9.8 * (1.0 - e));
    MotionState rest;
    rest.position = Vector2d(0.5 * end, 0.125);
    rest.velocity = Vector2d(0.5, 0.0);
    expectState(stateAt(world, end), rest, 1e-12);
    const double begin = firstContact(world, ContactKind::RestBegin).time.seconds();
    EXPECT_LE(begin, drop.restTime() + 1e-12);
    EXPECT_GE(begin, drop.restTime() - left_out);
    EXPECT_NEAR(restingForce(world, "box"), 9.8, 1e-12);
    EXPECT_NEAR(world.energy().impact_loss, 9.8 * 0.875, 1e-10);
    expectExact(world, 1e-10);
  }
}

// K4: the landings are those faster than the capture speed, so a quarter of the tolerance adds ln 2 / ln(1/e) of them.
TEST(Drop, CountsItsBounces)
{
  for (const double tolerance : { 1e-6, 2.5e-7, 6.25e-8, 1e-10 })
    for (const double e : { 0.5, 0.9, 0.99 })
    {
      Scene scene = shipped("drop");
      scene.elasticity = e;
      scene.tolerance = tolerance;
      World world(scene);
      const closed_form::BouncingDrop drop{ 0.875, 9.8, e };
      run(world, drop.restTime() + 1.0);
      int landings = 0;  // two corners each
      for (const ContactEvent& contact : world.takeContacts())
        landings += contact.kind == ContactKind::Impact;
      // The engine takes the speed from the height of the fall, the count from powers of e: one may fall on the limit.
      EXPECT_NEAR(landings / 2, drop.landingsFasterThan(captureSpeed(scene)), 1) << e << " " << tolerance;
    }
}

// D1
TEST(Sliding, LadderLeavesTheWall)
{
  World world(shipped("ladder"));
  const closed_form::Ladder ladder{ 9.8, (1.0 + 0.05 * 0.05) / 6.0, pi / 3.0 };
  const double release = ladder.releaseTime();
  const MotionState there = stateAt(world, release);
  EXPECT_NEAR(there.omega, ladder.rate(ladder.releaseAngle()), 1e-10);
  EXPECT_NEAR(there.angle, -ladder.releaseAngle(), 1e-10);
  EXPECT_NEAR(stateAt(world, release + 0.1).velocity.x(), ladder.releaseSpeed(), 1e-10);
  EXPECT_NEAR(firstContact(world, ContactKind::RestEnd).time.seconds(), release, 1e-10);
  EXPECT_LT(world.statistics().events, 100);  // D6: it must not creep off in tiny steps
  expectExact(world, 1e-10);
}

TEST(Sliding, RodFallsWithACornerOnTheFloor)
{
  const double distance = std::hypot(1.0, 0.05), corner = std::atan(0.05), tilt = 0.5;
  const closed_form::SlidingFall fall{ 9.8, (4.0 + 0.01) / 12.0, distance, tilt + corner };
  World world(
      makeScene(9.8, 0.0, { makeBox("rod", { 2, 0.1 }, { 0, distance * std::sin(fall.start) }, tilt) }, onFloor()));
  for (const double t : { 0.1, 0.2, 0.3 })
  {
    const MotionState found = stateAt(world, t);
    const double angle = fall.angleAt(t);
    EXPECT_NEAR(found.angle, angle - corner, 1e-9);
    EXPECT_NEAR(found.omega, -fall.rate(angle), 1e-9);
    EXPECT_NEAR(found.position.y(), distance * std::sin(angle), 1e-9);
    EXPECT_NEAR(found.position.x(), 0.0, 1e-12);
  }
  run(world, 2.0);
  EXPECT_NEAR(world.state(0).angle, 0.0, 1e-12);  // and lies flat in the end
  EXPECT_NEAR(world.state(0).position.y(), 0.05, 1e-12);
  expectExact(world, 1e-10);
}

// D2: it tilts over the corner of a fixed block while it slides along it.
TEST(Sliding, RodOverACorner)
{
  const double tilt = -0.3, along = 0.2, half = 0.05;
  const Vector2d centre(along * std::cos(tilt) - half * std::sin(tilt), along * std::sin(tilt) + half * std::cos(tilt));
  World world(makeScene(
      9.8, 0.0, { makeBox("rod", { 2, 0.1 }, centre, tilt), fixedOne(makeBox("table", { 2, 1 }, { -1, -0.5 })) }));
  const double release = 0.434825390462010;
  const MotionState there = stateAt(world, release);
  EXPECT_NEAR(there.angle, -0.748950916706830, 1e-9);
  EXPECT_NEAR(there.omega, -1.762005361370255, 1e-9);
  EXPECT_NEAR(there.position.x(), 0.429994764153131, 1e-9);
  run(world, release + 0.01);
  EXPECT_NEAR(firstContact(world, ContactKind::RestEnd).time.seconds(), release, 1e-9);
}

// D3
TEST(Sliding, OffATable)
{
  World world(shipped("table_slide"));
  const MotionState box = stateAt(world, 1.5, world.find("box"));
  EXPECT_NEAR(box.position.x(), 1.053391145637, 1e-9);
  EXPECT_NEAR(box.position.y(), 0.223733130632, 1e-9);
  EXPECT_NEAR(box.angle, -5.893713751953, 1e-9);
  expectExact(world, 1e-10);
}

// C1, C2, C5: what rests needs no event, however long and however unequal the masses.
TEST(Standing, StackOfTen)
{
  for (const double top : { 1.0, 1000.0 })
  {
    Scene scene = shipped("stack");
    scene.blocks.back().mass = top;
    World world(scene);
    run(world, 60.0);
    for (int i = 0; i < 10; ++i)
    {
      EXPECT_NEAR(world.state(i).position.x(), 0.0, 1e-10);
      EXPECT_NEAR(world.state(i).position.y(), i + 0.5, 1e-10);
      EXPECT_NEAR(world.state(i).angle, 0.0, 1e-10);
    }
    EXPECT_NEAR(restingForce(world, "wall_bottom"), (9.0 + top) * 9.8, 1e-12 * 9.8 * top + 1e-12);
    const std::uint64_t hash = world.stateHash();
    const std::int64_t events = world.statistics().events;
    run(world, 1e6);
    EXPECT_EQ(world.stateHash(), hash);
    EXPECT_EQ(world.statistics().events, events);
  }
}

// C3: light and heavy blocks in turn; contact i carries what is above it.
TEST(Standing, StackOfFiftyUnequal)
{
  std::vector<Block> blocks;
  for (int i = 0; i < 50; ++i)
    blocks.push_back(withMass(makeBox("b" + std::to_string(i), { 1, 1 }, { 0, i + 0.5 }), i % 2 ? 1000.0 : 1.0));
  World world(makeScene(9.8, 0.3, blocks, onFloor()));
  for (const double t : { 1.0, 60.0 })
  {
    run(world, t);
    for (int i = 0; i < 50; ++i)
      ASSERT_NEAR((world.state(i).position - blocks[i].position).norm(), 0.0, 1e-10) << i << " at " << t;
    EXPECT_NEAR(restingForce(world, "wall_bottom"), 25.0 * 1001.0 * 9.8, 1e-7);  // 1e-13 of the force
  }
}

// C4: a pyramid of 55 bricks, in rows of 10 ... 1, whose contacts are redundant: only sums of their forces are unique.
TEST(Standing, Pyramid)
{
  std::vector<Block> blocks;
  for (int row = 0; row < 10; ++row)
    for (int i = 0; i < 10 - row; ++i)
      blocks.push_back(
          makeBox("b" + std::to_string(blocks.size()), { 1, 0.5 }, { 1.1 * i + 0.55 * row, 0.5 * row + 0.25 }));
  World world(makeScene(9.8, 0.3, blocks, onFloor()));
  run(world, 60.0);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_NEAR((world.state(i).position - blocks[i].position).norm(), 0.0, 1e-10) << i;
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 55.0 * 9.8, 1e-9);
}

// A7
TEST(Standing, BoxThatWouldBounceForEver)
{
  World world(makeScene(9.8, 1.0, { makeBox("a", { 1, 1 }, { 0, 0.5 }) }, onFloor()));
  run(world, 1.0);
  const std::int64_t events = world.statistics().events;
  EXPECT_EQ(stateAt(world, 1e4).position.y(), 0.5);
  EXPECT_EQ(world.statistics().events, events);
}

// C6: side by side on the floor, against each other and a wall without force.
TEST(Standing, ContactsWithoutLoad)
{
  Walls walls = onFloor();
  walls.left = 0.0;
  World world(
      makeScene(9.8, 0.3, { makeBox("a", { 1, 1 }, { 0.5, 0.5 }), makeBox("b", { 1, 1 }, { 1.5, 0.5 }) }, walls));
  run(world, 60.0);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_EQ(world.state(i).position, Vector2d(i + 0.5, 0.5));
    EXPECT_EQ(world.state(i).velocity.norm(), 0.0);
  }
  EXPECT_LT(world.statistics().events, 50);
}

/// A box of 2.4 x 0.5 at x on the upper corners, at height 0.1, of three fixed diamonds at -0.8, 0 and 0.8.
World makeFeet(double x, double middle)
{
  std::vector<Block> blocks{ makeBox("box", { 2.4, 0.5 }, { x, 0.35 + std::max(0.0, middle) }) };
  for (const double foot : { -0.8, 0.0, 0.8 })
  {
    Block block =
        fixedOne(makeBox("foot" + std::to_string(blocks.size()), { 1, 1 }, { foot, foot == 0.0 ? middle : 0.0 }));
    block.size.reset();
    block.vertices = { { 0.1, 0 }, { 0, 0.1 }, { -0.1, 0 }, { 0, -0.1 } };
    blocks.push_back(block);
  }
  return World(makeScene(9.8, 0.3, blocks));
}

// C7: one foot too many; the middle one too low; the middle one too high.
TEST(Standing, OnThreeFeet)
{
  World even = makeFeet(0.0, 0.0);
  run(even, 60.0);
  EXPECT_NEAR((even.state(0).position - Vector2d(0.0, 0.35)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(restingForce(even, "box"), 9.8, 1e-12);

  World low = makeFeet(0.3, -1e-3);
  run(low, 60.0);
  EXPECT_NEAR(restingForce(low, "foot1"), 0.3125 * 9.8, 1e-12);
  EXPECT_EQ(restingForce(low, "foot2"), 0.0);
  EXPECT_NEAR(restingForce(low, "foot3"), 0.6875 * 9.8, 1e-12);

  World high = makeFeet(0.3, 1e-3);  // rests tilted, and so slides off slowly
  run(high, 1.0);
  EXPECT_NEAR(high.state(0).angle, -std::asin(1e-3 / std::hypot(0.8, 1e-3)), 1e-12);
  EXPECT_NEAR(high.state(0).omega, 0.0, 1e-12);
}

// K2: a harmonic stack on a fixed block stands with a margin of 1e-6 and tips without it.
TEST(Standing, OverhangingStack)
{
  for (int n = 2; n <= 8; ++n)
    for (const double margin : { 1e-6, -1e-6 })
    {
      std::vector<Block> blocks;
      double x = 0.0;
      for (int i = 1; i <= n; ++i)
      {
        if (i > 1)
          x += (1.0 - margin) / (n - i + 1);
        blocks.push_back(makeBox("b" + std::to_string(i), { 2, 0.5 }, { x, 0.5 * i }));
        blocks.back().fixed = i == 1;
      }
      Scene scene = makeScene(9.8, 0.3, blocks);
      scene.tolerance = 1e-9;
      World world(scene);
      const MotionState top = stateAt(world, 60.0, n - 1);
      if (margin > 0.0)
      {
        EXPECT_NEAR((top.position - blocks.back().position).norm(), 0.0, 1e-12) << n;
      }
      else
        EXPECT_LT(top.position.y(), blocks.back().position.y() - 1.0) << n;
    }
}

// F1: pushed into the wall by a thruster, both contacts bouncing to rest.
TEST(Pushed, IntoTheWall)
{
  Block block = makeBox("a", { 0.5, 0.5 }, { 0, 1 });
  block.thrusters = { Thruster{ Vector2d::Zero(), Vector2d::UnitX(), 6.0 } };
  Walls walls = onFloor();
  walls.right = 2.0;
  Scene scene = makeScene(9.8, 0.5, { block }, walls);
  scene.inputs = { { Time(), ThrustCommand{ "a", { 1.0 }, 100.0 } } };
  World world(scene);
  const MotionState rest = stateAt(world, 4.0);
  EXPECT_NEAR(rest.position.x(), 1.75, 1e-12);
  EXPECT_NEAR(rest.position.y(), 0.25, 1e-12);
  EXPECT_NEAR(rest.angle, 0.0, 1e-12);
  EXPECT_NEAR(restingForce(world, "wall_right"), 6.0, 1e-12);
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 9.8, 1e-12);
  expectExact(world, 1e-10);
}

// F3: the mouse pulls a block into the corner, farther away every 0.1 s.
TEST(Pushed, ByAGrowingPull)
{
  Walls walls = onFloor();
  walls.right = 1.0;
  World world(makeScene(9.8, 0.5, { makeBox("a", { 0.5, 0.5 }, { 0.75, 0.25 }) }, walls));
  SpringCommand pull;
  pull.body = "a";
  pull.stiffness = 40.0;
  for (int i = 1; i <= 100; ++i)
  {
    pull.anchor = Vector2d(0.75 + i, 0.25 - 0.5 * i);
    ASSERT_TRUE(world.apply(pull).ok);
    run(world, 0.1 * i);
    EXPECT_NEAR(restingForce(world, "wall_right"), 40.0 * i, 1e-12 * 40.0 * i);
    EXPECT_NEAR(restingForce(world, "wall_bottom"), 9.8 + 20.0 * i, 1e-12 * 40.0 * i);
    EXPECT_NEAR((world.state(0).position - Vector2d(0.75, 0.25)).norm(), 0.0, 1e-14);
  }
  EXPECT_EQ(world.statistics().impacts, 0);
  EXPECT_EQ(world.overlap(), 0.0);
}

// F4: a row squeezed between a wall and a pull: the same force all along, the spring's.
TEST(Pushed, Row)
{
  Walls walls;
  walls.right = 5.0;
  std::vector<Block> blocks;
  for (int i = 0; i < 5; ++i)
    blocks.push_back(makeBox("b" + std::to_string(i), { 1, 1 }, { i + 0.5, 0 }));
  World world(makeScene(0.0, 0.5, blocks, walls));
  SpringCommand pull;
  pull.body = "b0";
  pull.anchor = Vector2d(1.5, 0);
  pull.stiffness = 1e4;
  world.apply(pull);
  run(world, 1.0);
  EXPECT_NEAR(restingForce(world, "wall_right"), 1e4, 1e-8);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(restingForce(world, "b" + std::to_string(i)), i == 0 ? 1e4 : 2e4, 1e-8);
}

// The stack is knocked over by a fast block between two walls; nothing known of the end but that it comes.
TEST(Pushed, StackKnockedOver)
{
  Scene scene = shipped("stack");
  scene.walls.left = -8.0;
  scene.walls.right = 8.0;
  scene.damping = 0.5;
  scene.blocks.push_back(moving(makeBox("hammer", { 1, 1 }, { -5, 6.3 }), { 5, 0 }));
  World world(scene);
  run(world, 30.0);
  EXPECT_EQ(world.now(), Time::fromSeconds(30.0));
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 11 * 9.8, 1e-3);
  expectExact(world, 1e-9);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
