// D. Sliding, release, edges.

#include "hard_cases.h"

namespace block_world
{
namespace
{
/// Events between two times, the later one in the world's future.
std::int64_t eventsWithin(World& world, double from, double to)
{
  run(world, from);
  const std::int64_t before = world.statistics().events;
  run(world, to);
  return world.statistics().events - before;
}

// D1. The wall's force reaches zero with a finite slope, so the instant is as exact as the force, some 1e-15 of g.
TEST(Sliding, LadderLeavesTheWall)
{
  World world(shipped("ladder"));
  const closed_form::Ladder ladder{ 9.8, (1.0 + 0.05 * 0.05) / 6.0, pi / 3.0 };
  const double release = ladder.releaseTime();
  EXPECT_NEAR(release, 0.430271335196, 1e-12);
  const MotionState there = stateAt(world, release);
  EXPECT_NEAR(there.omega, ladder.rate(ladder.releaseAngle()), 1e-13);
  EXPECT_NEAR(there.angle, -ladder.releaseAngle(), 1e-13);
  EXPECT_NEAR(stateAt(world, release + 0.1).velocity.x(), ladder.releaseSpeed(), 1e-13);
  EXPECT_NEAR(firstContact(world, ContactKind::RestEnd).time.seconds(), release, 1e-13);
  expectExact(world, 1e-13);
}

// D6: at that instant the gap, its rate and its acceleration are all zero, so that it opens as the time cubed. That
// takes the release itself, the end of arcs and a few looks, and no creeping.
TEST(Sliding, ReleaseTakesFewEvents)
{
  for (const double tolerance : { 1e-6, 1e-12 })
  {
    Scene scene = shipped("ladder");
    scene.tolerance = tolerance;
    World world(scene);
    const double release = closed_form::Ladder{ 9.8, (1.0 + 0.05 * 0.05) / 6.0, pi / 3.0 }.releaseTime();
    EXPECT_LE(eventsWithin(world, release - 1e-3, release + 1e-3), 10) << tolerance;
    EXPECT_LE(eventsWithin(world, release + 1e-3, release + 0.05), 10) << tolerance;
    int ends = 0;
    for (const ContactEvent& contact : world.takeContacts())
      ends += contact.kind == ContactKind::RestEnd;
    EXPECT_EQ(ends, 1);
    EXPECT_EQ(world.statistics().impacts, 0);
  }
}

// A rod that falls over with one corner on the floor; nothing pushes it sideways.
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
    EXPECT_NEAR(found.angle, angle - corner, 1e-13);
    EXPECT_NEAR(found.omega, -fall.rate(angle), 1e-13);
    EXPECT_NEAR(found.position.y(), distance * std::sin(angle), 1e-13);
    EXPECT_NEAR(found.position.x(), 0.0, 1e-15);
  }
  run(world, 2.0);
  EXPECT_NEAR(world.state(0).angle, 0.0, 1e-15);  // and lies flat in the end
  EXPECT_NEAR(world.state(0).position.y(), 0.05, 1e-15);
  expectExact(world, 1e-12);
}

// D2: it tilts over the corner of a fixed block while it slides along it. The reference has 15 digits; an error of the
// start grows by a fifth at most (found by differences of runs).
TEST(Sliding, RodOverACorner)
{
  const double tilt = -0.3, along = 0.2, half = 0.05;
  const Vector2d centre(along * std::cos(tilt) - half * std::sin(tilt), along * std::sin(tilt) + half * std::cos(tilt));
  World world(makeScene(
      9.8, 0.0, { makeBox("rod", { 2, 0.1 }, centre, tilt), fixedOne(makeBox("table", { 2, 1 }, { -1, -0.5 })) }));
  const double release = 0.434825390462010;
  const MotionState there = stateAt(world, release);
  EXPECT_NEAR(there.angle, -0.748950916706830, 1e-14);
  EXPECT_NEAR(there.omega, -1.762005361370255, 1e-14);
  EXPECT_NEAR(there.position.x(), 0.429994764153131, 1e-14);
  run(world, release + 0.01);
  EXPECT_NEAR(firstContact(world, ContactKind::RestEnd).time.seconds(), release, 1e-13);
  expectExact(world, 1e-13);
}

// D3: slides off a table, tips over its edge, tumbles: two releases, four impacts, which turn an error of the start
// into 26 times as much (found by differences of runs). Reference with 33 digits, given to 12 decimals.
TEST(Sliding, OffATable)
{
  for (const double tolerance : { 1e-6, 1e-9, 1e-12 })
  {
    SCOPED_TRACE(tolerance);
    Scene scene = shipped("table_slide");
    scene.tolerance = tolerance;
    World world(scene);
    const MotionState box = stateAt(world, 1.5, world.find("box"));
    const double error = 5e-13 + 26.0 * 8.0 * rounding;
    EXPECT_NEAR(box.position.x(), 1.053391145637, error);
    EXPECT_NEAR(box.position.y(), 0.223733130632, error);
    EXPECT_NEAR(box.angle, -5.893713751953, error);
    EXPECT_EQ(world.statistics().impacts, 4);
    expectExact(world, 1e-12);
  }
}

// D7: a spinning block's corner passes the floor at height c. Where it dips below, it comes in at w = sqrt(2 |c|
// omega^2 rho) = 2.4e-4 m/s at most, its arm nearly upright, so the block leaves at 2 w; above, nothing happens.
TEST(Sliding, Grazing)
{
  const double radius = std::hypot(0.25, 0.15);
  for (const double tolerance : { 1e-6, 1e-10, 1e-12 })
    for (const double c : { 1e-9, 0.0, -1e-9 })
    {
      SCOPED_TRACE(c);
      Scene scene =
          makeScene(0.0, 1.0, { moving(makeBox("a", { 0.5, 0.3 }, { 0, radius + c }), { 1, 0 }, 10.0) }, onFloor());
      scene.tolerance = tolerance;
      World world(scene);
      const MotionState after = stateAt(world, 2.0);
      const double in = std::sqrt(2.0 * 1e-9 * 100.0 * radius);
      EXPECT_NEAR(after.velocity.x(), 1.0, rounding);
      if (c > 0.0)
      {
        EXPECT_EQ(world.statistics().impacts, 0);
        EXPECT_EQ(after.velocity.y(), 0.0);
        EXPECT_EQ(after.omega, 10.0);
      }
      else if (c < 0.0)
      {
        // j = 2 w / (1 + x^2 / I) at the arm's x = w / omega, the dip's series in c ending after its first term.
        EXPECT_EQ(world.statistics().impacts, 1);
        EXPECT_NEAR(after.velocity.y(), 2.0 * in, 1e-6 * in);
      }
      else
      {
        EXPECT_LE(world.statistics().impacts, 1);
        EXPECT_GE(after.velocity.y(), 0.0);
        // The height is rounded by 1e-16: w = 8e-8 m/s.
        EXPECT_LE(after.velocity.y(), 2.0 * std::sqrt(2.0 * 1.2e-16 * 100.0 * radius));
      }
      expectExact(world, 1e-12);
    }
}

}  // namespace
}  // namespace block_world
