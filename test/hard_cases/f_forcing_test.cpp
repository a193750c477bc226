// F. Forcing: thrusters, pulls, stiff springs, damping.

#include "hard_cases.h"

namespace block_world
{
namespace
{
SpringCommand pullAt(const std::string& body, const Vector2d& anchor, double stiffness)
{
  SpringCommand pull;
  pull.body = body;
  pull.anchor = anchor;
  pull.stiffness = stiffness;
  return pull;
}

// F1: a thruster pushes a falling block into the wall; both contacts bounce to rest.
TEST(Forcing, ThrusterIntoTheWall)
{
  Block block = makeBox("a", { 0.5, 0.5 }, { 0, 1 });
  block.thrusters = { Thruster{ Vector2d::Zero(), Vector2d::UnitX(), 6.0 } };
  Walls walls = onFloor();
  walls.right = 2.0;
  Scene scene = makeScene(9.8, 0.5, { block }, walls);
  scene.inputs = { { Time(), ThrustCommand{ "a", { 1.0 }, 100.0 } } };
  World world(scene);
  expectEnergyNeverGrows(world, 4.0, false);
  MotionState rest;
  rest.position = Vector2d(1.75, 0.25);
  expectState(world.state(0), rest, 8.0 * rounding);
  EXPECT_NEAR(restingForce(world, "wall_right"), 6.0, 1e-14);
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 9.8, 1e-14);
  EXPECT_NEAR(world.energy().thrust_work, 6.0 * 1.75, 1e-13);
  expectExact(world, 1e-13);
  run(world, 5.0);
  expectNothingHappens(world, 90.0);
}

// F3: the mouse pulls a block into the corner, farther away every 0.1 s. All is in balance, however strong: the forces
// to their own rounding (each of two corners), the block where it was to that of its coordinates.
TEST(Forcing, GrowingPull)
{
  Walls walls = onFloor();
  walls.right = 1.0;
  World world(makeScene(9.8, 0.5, { makeBox("a", { 0.5, 0.5 }, { 0.75, 0.25 }) }, walls));
  for (int i = 1; i <= 1000; ++i)
  {
    ASSERT_TRUE(world.apply(pullAt("a", Vector2d(0.75 + i, 0.25 - 0.5 * i), 40.0)).ok);
    run(world, 0.1 * i);
    const double force = 40.0 * i;
    ASSERT_NEAR(restingForce(world, "wall_right"), force, 1e-14 * force) << i;
    ASSERT_NEAR(restingForce(world, "wall_bottom"), 9.8 + 0.5 * force, 1e-14 * force) << i;
    ASSERT_NEAR((world.state(0).position - Vector2d(0.75, 0.25)).norm(), 0.0, 2.0 * rounding) << i;
    ASSERT_NEAR(world.state(0).angle, 0.0, 2.0 * rounding) << i;
  }
  EXPECT_EQ(world.statistics().impacts, 0);
  EXPECT_EQ(world.overlap(), 0.0);
}

// F4: a row squeezed between a wall and a pull: the same force all along, the spring's, to the rounding of ten forces.
TEST(Forcing, SqueezedRow)
{
  Walls walls;
  walls.right = 5.0;
  std::vector<Block> blocks;
  for (int i = 0; i < 5; ++i)
    blocks.push_back(makeBox("b" + std::to_string(i), { 1, 1 }, { i + 0.5, 0 }));
  World world(makeScene(0.0, 0.5, blocks, walls));
  ASSERT_TRUE(world.apply(pullAt("b0", Vector2d(1.5, 0), 1e4)).ok);
  run(world, 1.0);
  const double error = 25.0 * rounding * 1e4;
  EXPECT_NEAR(forceBetween(world, "b4", "wall_right"), 1e4, error);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(forceBetween(world, blocks[i].name, blocks[i + 1].name), 1e4, error) << i;
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(world.state(i).position, blocks[i].position) << i;
  EXPECT_EQ(world.statistics().impacts, 0);
}

// F5: no step is too stiff. The phase sqrt(k) t counts turns of 1 rad whose rounding is its own; the energy keeps
// 1e-13: some 450 arcs, each with a truncation error of 2e-16.
TEST(Forcing, StiffSpring)
{
  for (const double stiffness : { 1e2, 1e3, 1e4, 1e5, 1e6 })
  {
    SCOPED_TRACE(stiffness);
    World world(makeScene(0.0, 1.0, { makeBox("a", { 1, 1 }, { 1, 0 }) }));
    world.apply(pullAt("a", Vector2d::Zero(), stiffness));
    const double start = world.energy().total, phase = std::sqrt(stiffness);
    EXPECT_DOUBLE_EQ(start, 0.5 * stiffness);
    EXPECT_NEAR(stateAt(world, 1.0).position.x(), std::cos(phase), 8.0 * rounding * phase);
    EXPECT_NEAR(world.energy().total / start, 1.0, 1e-13);
    expectExact(world, 1e-13 * start);
  }
}

// A block shot down at 1000 m/s stops dead on the floor, up to an instant's rounding of 1.1e-16 s, which is 1e-13 m, too high or too low; it is put
// exactly there. Damping of 1e6 N does no work on that way, as no time passes: 1e-7 J, of which the account of 5e5 J would tell.
TEST(Forcing, LandingUnderHugeDamping)
{
  const double k = 1000.0, g = 9.8, speed = 1000.0;
  for (int i = 0; i < 40; ++i)
  {
    SCOPED_TRACE(i);
    const double fall = 0.3 + 0.01 * i;
    Scene scene = makeScene(g, 0.0, { moving(makeBox("a", { 1, 1 }, { 0, 0.5 + fall }), { 0, -speed }) }, onFloor());
    scene.damping = k;
    World world(scene, Time::fromSeconds(0.9));  // where the next digit of a second is 1.1e-16 s
    const double start = world.energy().total;
    run(world, 3.0);
    // With mass 1: v' = g - k v, so that v = speed + g t - k y when it has fallen y; the time by Newton's method.
    const double end_speed = g / k;
    const auto speedAt = [&](double t) { return end_speed + (speed - end_speed) * std::exp(-k * t); };
    double t = 0.0;
    for (int step = 0; step < 50; ++step)
      t -= ((speed + g * t - speedAt(t)) / k - fall) / speedAt(t);
    const EnergyAccount end = world.energy();
    EXPECT_NEAR(end.total, 0.5 * g, 4.0 * rounding * g);
    // Heights and speeds are rounded to 1e-16 of 1000 m/s and 1e-13 m times k = 1000 1/s.
    EXPECT_NEAR(end.impact_loss, 0.5 * speedAt(t) * speedAt(t), 4e-10 * speedAt(t));
    // The loss by damping is a sum over some ten arcs.
    EXPECT_NEAR(end.damping_loss + end.impact_loss, start - end.total, 16.0 * rounding * start);
    EXPECT_NEAR(end.balance_error, 0.0, 16.0 * rounding * start);
  }
}

Scene makeDamped(double damping)
{
  Scene scene = makeScene(9.8, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0 }, 1.0) });
  scene.damping = damping;
  return scene;
}

// F6: from none to huge, nothing jumps. Positions are as exact as the arcs, 1e-15 m; a speed of k times that may hide
// in them.
TEST(Forcing, DampingFromNoneToHuge)
{
  MotionState undamped;
  for (const double damping : { 0.0, 1e-12, 1.0, 1e3, 1e6 })
  {
    SCOPED_TRACE(damping);
    World world(makeDamped(damping));
    const MotionState from = world.state(0), found = stateAt(world, 1.0),
                      wanted = closed_form::dampedFlight(from, 1.0, 1.0 / 6.0, damping, 0.1, 9.8, 1.0);
    const double size = 9.8, error = 32.0 * rounding * size;
    EXPECT_NEAR((found.position - wanted.position).norm(), 0.0, error);
    EXPECT_NEAR(found.angle, wanted.angle, error);
    EXPECT_NEAR((found.velocity - wanted.velocity).norm(), 0.0, error + 1e-15 * damping);
    EXPECT_NEAR(found.omega, wanted.omega, error + 1e-15 * damping);
    if (damping == 0.0)
      undamped = found;
    if (damping == 1e-12)  // x'' = -g - k x' to first order in k
      expectState(found, undamped, 9.8 * damping);
  }
}

// F6: at 1e6 1/s the decay is over after 40 microseconds; what remains is a straight line at g/k, which needs no small
// steps.
TEST(Forcing, HugeDampingNeedsNoSmallSteps)
{
  World world(makeDamped(1e6));
  run(world, 1.0);
  EXPECT_NEAR(world.state(0).velocity.y(), -9.8e-6, 1e-12 * 9.8e-6);
  EXPECT_LT(world.statistics().events, 1000);
}

}  // namespace
}  // namespace block_world
