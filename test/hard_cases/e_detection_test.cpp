// E. Detection: fast, thin, spinning, small.

#include "hard_cases.h"

namespace block_world
{
namespace
{
/// Half the extent of a box along x.
double reach(const Vector2d& size, double angle)
{
  return 0.5 * (size.x() * std::abs(std::cos(angle)) + size.y() * std::abs(std::sin(angle)));
}

/// When a spinning box's foremost point arrives at x = 0: by looking at every step, then by halving.
double arrival(const Vector2d& size, double x, double angle, double speed, double omega, double step)
{
  const auto gap = [&](double t) { return -(x + speed * t) - reach(size, angle + omega * t); };
  double late = 0.0;
  while (gap(late) > 0.0)
    late += step;
  double early = std::max(0.0, late - step);
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (early + late);
    (gap(middle) > 0.0 ? early : late) = middle;
  }
  return late;
}

// E1: rods of 1 x 0.02 at 30 to 70 m/s, spinning at 20 to 80 rad/s, at a fixed wall 1 cm thick.
TEST(Detection, ThinFastRods)
{
  Random random(1);
  const Vector2d size(1, 0.02);
  for (int i = 0; i < 200; ++i)
  {
    SCOPED_TRACE(i);
    const double speed = random.in(30.0, 70.0), omega = random.in(20.0, 80.0) * (i % 2 ? 1.0 : -1.0),
                 angle = random.in(0.0, 6.0);
    World world(makeScene(0.0, 1.0,
                          { moving(makeBox("rod", size, { -1, 0 }, angle), { speed, 0 }, omega),
                            fixedOne(makeBox("wall", { 0.01, 20 }, { 0.005, 0 })) }));
    const double energy = world.energy().total;
    run(world, 0.1);
    // Heights of 1 m are rounded over tens of m/s: 1e-16 s of itself; but the corner may come in as slow as 1 m/s, when
    // it spins back.
    EXPECT_NEAR(firstContact(world, ContactKind::Impact).time.seconds(), arrival(size, -1, angle, speed, omega, 1e-6),
                1e-14);
    EXPECT_LT(world.state(0).position.x(), 0.0);
    EXPECT_NEAR(world.energy().total / energy, 1.0, 1e-14);
    expectExact(world, 1e-14 * energy);
  }
}

// E2: small blocks at 30 to 70 m/s at the flat side of a free one 2 cm thick, masses by area. The first hit is that of
// a point on a face.
TEST(Detection, FastBlocksAtAThinOne)
{
  Random random(2);
  const Vector2d size(0.1, 0.1);
  for (int i = 0; i < 200; ++i)
  {
    SCOPED_TRACE(i);
    const double speed = random.in(30.0, 70.0), height = random.in(-0.42, 0.42), angle = random.in(0.0, 6.0);
    World world(makeScene(0.0, 1.0,
                          { withMass(moving(makeBox("bullet", size, { -1, height }, angle), { speed, 0 }), 0.01),
                            withMass(makeBox("thin", { 0.02, 1 }, { 0, 0 }), 0.02) }));
    const double hit = (0.99 - reach(size, angle)) / speed, energy = world.energy().total;
    run(world, 1.5 / speed);
    const ContactEvent first = firstContact(world, ContactKind::Impact);
    EXPECT_NEAR(first.time.seconds(), hit, 1e-16);
    EXPECT_NEAR(first.point.x(), -0.01, 1e-15);
    EXPECT_NEAR(first.normal_velocity, -speed, 1e-13);
    EXPECT_GT(world.state(1).velocity.x(), 0.0);
    EXPECT_NEAR(world.energy().momentum_x, 0.01 * speed, 1e-15);
    EXPECT_NEAR(world.energy().total, energy, 1e-14 * energy);
    expectExact(world, 1e-14 * energy);
  }
}

// E3: a spinner at 1000 rad/s drifts to a wall, 50 s away: 8000 turns without a look, some looks near the wall, one hit
// that turns it back.
TEST(Detection, Spinner)
{
  Walls walls;
  walls.right = 0.0;
  World world(makeScene(0.0, 1.0, { moving(makeBox("a", { 0.4, 0.2 }, { -0.7, 0 }), { 0.01, 0 }, 1000.0) }, walls));
  const double energy = world.energy().total, near = 47.0;
  run(world, near);
  EXPECT_LE(world.statistics().events, 3);
  run(world, 60.0);
  EXPECT_EQ(world.statistics().impacts, 1);
  EXPECT_LE(world.statistics().events, 100);
  EXPECT_LT(world.state(0).velocity.x(), 0.0);
  // The angle of 5e4 rad is known to 4e-12.
  const double hit = arrival({ 0.4, 0.2 }, -0.7 + 0.01 * near, 1000.0 * near, 0.01, 1000.0, 1e-6);
  EXPECT_NEAR(firstContact(world, ContactKind::Impact).time.seconds(), near + hit, 1e-13);
  EXPECT_NEAR(world.energy().total / energy, 1.0, 1e-14);
  expectExact(world, 1e-14 * energy);
}

// So fast that the instants which can be told apart, 1e-16 s, leave a gap that coordinates resolve: between walls, flat
// and turned, at 10 and 1000 km/s. A hit every 2 m / v of the flat one.
TEST(Detection, FasterThanInstantsResolve)
{
  for (const double speed : { 1e4, 1e6 })
    for (const double angle : { 0.0, 0.3 })
    {
      SCOPED_TRACE(speed);
      Walls walls;
      walls.left = -1.5;
      walls.right = 1.5;
      World world(makeScene(0.0, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }, angle), { speed, 0 }) }, walls));
      const double energy = world.energy().total;
      run(world, 10000.0 / speed);  // in the middle again
      if (angle == 0.0)
      {
        EXPECT_EQ(world.statistics().impacts, 5000);
      }
      EXPECT_GT(world.statistics().impacts, 1000);
      EXPECT_NEAR(world.energy().total / energy, 1.0, 1e-12);
      expectExact(world, 1e-12 * energy);
    }
}

// Far from where the scene began: one block creeps up on another while both go 10 km and more, where coordinates
// resolve less than at the start.
TEST(Detection, FarFromTheStart)
{
  const double time = 1e3;
  for (const double angle : { 0.0, 0.3 })
  {
    SCOPED_TRACE(angle);
    World world(makeScene(0.0, 1.0,
                          { moving(makeBox("a", { 1, 1 }, { 0, 0 }, angle), { 10.0 + 1.0 / time, 0 }),
                            moving(makeBox("b", { 1, 1 }, { 2.2, 0.1 }), { 10, 0 }) }));
    const double energy = world.energy().total;
    world.advance(Time::fromSeconds(3.0 * time), 200000);  // they cross some ten thousand cells of the broad phase
    EXPECT_EQ(world.now(), Time::fromSeconds(3.0 * time));
    EXPECT_GE(world.statistics().impacts, 1);
    EXPECT_GT(world.state(1).velocity.x(), world.state(0).velocity.x());
    EXPECT_NEAR(world.energy().total / energy, 1.0, 1e-14);
    EXPECT_EQ(world.statistics().mode, "exact");
  }
}

// E4: 1 mm in a room of 1 km. A tolerance below what the coordinates can resolve is raised, and the notes say so.
TEST(Detection, HugeSizeRatio)
{
  Scene scene = makeScene(0.0, 1.0, { moving(makeBox("a", { 2e-3, 2e-3 }, { 0, 0 }, 0.3), { 10, 3 }) });
  scene.walls = Walls{ -500.0, 500.0, -500.0, 500.0 };
  scene.tolerance = 1e-14;
  World world(scene);
  EXPECT_GE(world.scene().tolerance, 8.0 * (std::nextafter(500.0, 1e9) - 500.0));
  ASSERT_EQ(world.notes().size(), 1u);
  EXPECT_NE(world.notes()[0].find("tolerance"), std::string::npos);
  run(world, 100.0);
  EXPECT_GE(world.statistics().impacts, 1);
  EXPECT_NEAR(world.energy().total / 54.5, 1.0, 1e-13);
  expectExact(world, 1e-13 * 54.5);
}

}  // namespace
}  // namespace block_world
