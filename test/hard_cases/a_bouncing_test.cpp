// A. Bouncing and its end. The box: 0.5 x 0.25, lower face 0.875 over the floor (scene `drop`).

#include "hard_cases.h"

namespace block_world
{
namespace
{
Scene makeDrop(double elasticity, double sideways)
{
  Scene scene = shipped("drop");
  scene.elasticity = elasticity;
  scene.blocks[0].velocity.x() = sideways;
  return scene;
}

// A1, A6: infinitely many bounces end at t0 (1 + e) / (1 - e); from there on the box slides, flat. (Lively ones: K6.)
TEST(Bouncing, FlatDropToRest)
{
  for (const double e : { 0.0, 1e-3, 0.5 })
  {
    SCOPED_TRACE(e);
    const Scene scene = makeDrop(e, 0.5);
    World world(scene);
    const closed_form::BouncingDrop drop{ 0.875, 9.8, e };
    run(world, 4.0);
    // Of x only the time's rounding is left, of the height that of numbers below 1 m, of the rest nothing.
    MotionState rest;
    rest.position = Vector2d(2.0, 0.125);
    rest.velocity = Vector2d(0.5, 0.0);
    expectState(world.state(0), rest, 8.0 * rounding);
    // The hops left out take 2 v / g (1 + e + ...) <= 2 v_c / (g (1 - e)).
    const double begin = firstContact(world, ContactKind::RestBegin).time.seconds();
    EXPECT_LE(begin, drop.restTime() + 8.0 * rounding);
    EXPECT_GE(begin, drop.restTime() - 2.0 * captureSpeed(scene) / (9.8 * (1.0 - e)));
    EXPECT_NEAR(restingForce(world, "box"), 9.8, 16.0 * rounding * 9.8);
    EXPECT_NEAR(world.energy().impact_loss, 9.8 * 0.875, 1e-14 * 9.8);  // some 20 terms
    expectExact(world, 1e-13);
  }
}

// A1: each bounce left out is one that the closed form has below the capture speed, none above.
TEST(Bouncing, NineteenBouncesAtTheFinestTolerance)
{
  Scene scene = makeDrop(0.5, 0.5);
  scene.tolerance = 1e-12;
  World world(scene);
  run(world, 4.0);
  EXPECT_EQ(world.statistics().impacts, 19);
}

// A2. An instant of contact is known to the rounding of the time and of a height over a speed of 4 m/s, some 2e-16 s;
// so is each period's length. After n of them their sum is off by n, and the speed's own errors (1e-16 each, relative)
// by n^2/2, times 0.85 s.
TEST(Bouncing, ElasticForEver)
{
  World world(makeDrop(1.0, 0.0));
  run(world, 100.0);
  const double n = 118.0, late = rounding * (2.0 * n + 0.5 * n * n * 0.85);
  EXPECT_EQ(world.statistics().impacts, 118);
  EXPECT_NEAR(world.state(0).position.y(), 0.638016805657023, 4.2 * late);
  EXPECT_NEAR(world.state(0).position.y(), 0.125 + closed_form::elasticDrop(0.875, 9.8, 100.0), 4.2 * late);
  EXPECT_EQ(world.state(0).angle, 0.0);
  expectExact(world, 1e-12);
}

// A4: reference with 33 digits. Two impacts turn an error of the start into 20 times as much (found by
// differences of runs), here some roundings of numbers up to 6 (rad/s).
TEST(Bouncing, TiltedBoxStillInFlight)
{
  World world(makeScene(9.8, 0.8, { moving(makeBox("a", { 0.5, 0.3 }, { 0, 1 }, 0.2), { 0.25, 0 }) }, onFloor()));
  const MotionState after = stateAt(world, 1.0);
  const double error = 20.0 * 8.0 * rounding * 6.0;
  EXPECT_NEAR(after.position.x(), 0.25, rounding);
  EXPECT_NEAR(after.position.y(), 0.433151808042737, error);
  EXPECT_NEAR(after.angle, 4.099507681973138, error);
  expectExact(world, 1e-13);
}

// A7
TEST(Bouncing, RestsWhereNothingIsLost)
{
  World world(makeScene(9.8, 1.0, { makeBox("a", { 1, 1 }, { 0, 0.5 }) }, onFloor()));
  run(world, 1.0);
  EXPECT_EQ(world.state(0).position.y(), 0.5);
  expectNothingHappens(world, 1e4);
  EXPECT_EQ(world.statistics().impacts, 0);
}

// What approaches slower than the capture speed (9 mm/s) without being pressed is reflected like anything else: beside
// one another in free fall, and from below against a ceiling.
TEST(Bouncing, SlowApproachThatNothingPresses)
{
  for (const double e : { 0.3, 0.9 })
    for (const double slow : { 1e-3, 1e-5 })
    {
      SCOPED_TRACE(slow);
      World pair(makeScene(9.8, e,
                           { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 0.5 * slow, 0 }),
                             moving(makeBox("b", { 1, 1 }, { 1.0 + 0.5 * slow, 0 }), { -0.5 * slow, 0 }) }));
      run(pair, 1.0);
      // Speeds are reflected to rounding of one another; that of the fall, 5 m/s by then, is in another component.
      expectSpeeds(pair, 0, { -0.5 * e * slow, 0.5 * e * slow }, 1e-13 * slow);
      EXPECT_EQ(pair.statistics().impacts, 1);
      expectExact(pair, 1e-12);

      Walls ceiling;
      ceiling.top = 1.0;
      const double up = std::sqrt(2.0 * 9.8 * 0.5 + slow * slow);
      World below(makeScene(9.8, e, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 0, up }) }, ceiling));
      const double hit = (up - slow) / 9.8;
      const MotionState after = stateAt(below, hit + 0.1);
      // slow^2 is a difference of numbers near 10: it is known to 2e-15, slow itself to 1e-15 / slow.
      EXPECT_NEAR(after.velocity.y(), -e * slow - 0.98, 4e-15 / slow);
      EXPECT_EQ(below.statistics().impacts, 1);
      expectExact(below, 1e-12);
    }
}

// The energy never grows, and where nothing is lost it stays: upright and tumbling, short and long, resting and
// gliding.
TEST(Bouncing, EnergyNeverGrows)
{
  const auto tumbling = [](double e) {
    return makeScene(9.8, e, { moving(makeBox("a", { 0.5, 0.3 }, { 0, 1 }, 0.2), { 0.25, 0 }) }, onFloor());
  };
  const struct
  {
    const char* what;
    Scene scene;
    double seconds;
  } cases[] = {
    { "flat, elastic", makeDrop(1.0, 0.5), 1000.0 }, { "flat, to rest", makeDrop(0.5, 0.5), 3.0 },
    { "flat, lively", makeDrop(0.999, 0.5), 900.0 }, { "tumbling, elastic", tumbling(1.0), 1000.0 },
    { "tumbling, lively", tumbling(0.99), 100.0 },   { "tumbling, to rest", tumbling(0.5), 10.0 },
    { "tumbling, inelastic", tumbling(0.0), 10.0 },  { "ladder", shipped("ladder"), 3.0 },
    { "off a table", shipped("table_slide"), 5.0 },
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.what);
    World world(c.scene);
    expectEnergyNeverGrows(world, c.seconds, c.scene.elasticity == 1.0);
    expectExact(world, 1e-11);
  }
}

}  // namespace
}  // namespace block_world
