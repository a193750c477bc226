// Free motion, springs and impacts of World, against closed forms and at default tolerance unless a test says
// otherwise.

#include "closed_forms.h"
#include "world_testing.h"

namespace block_world
{
namespace
{
TEST(Flight, DampedAndSpinning)
{
  Scene scene = makeScene(9.8, 1.0, { moving(withMass(makeBox("a", { 1, 3 }, { 0, 10 }), 2.0), { 1, 2 }, 5.0) });
  scene.damping = 0.3;
  World world(scene);
  const MotionState from = world.state(0);
  const double inertia = 2.0 * 10.0 / 12.0;
  for (const double t : { 0.5, 1.0, 2.0 })
    expectState(stateAt(world, t), closed_form::dampedFlight(from, 2.0, inertia, 0.3, 0.1, 9.8, t), 1e-12);
  expectExact(world, 1e-12);
}

// F6: no limit of the damping in which anything jumps or stalls.
TEST(Flight, DampingFromNoneToHuge)
{
  for (const double damping : { 0.0, 1e-12, 1.0, 1e6 })
  {
    Scene scene = makeScene(9.8, 1.0, { moving(makeBox("a", { 1, 1 }, { 0, 0 }), { 1, 0 }, 1.0) });
    scene.damping = damping;
    World world(scene);
    const MotionState from = world.state(0);
    expectState(stateAt(world, 1.0), closed_form::dampedFlight(from, 1.0, 1.0 / 6.0, damping, 0.1, 9.8, 1.0), 1e-12);
  }
}

TEST(SpringMotion, WithRestLengthAndDamper)
{
  Scene scene =
      makeScene(3.0, 1.0, { moving(withMass(makeBox("a", { 1, 3 }, { 0, 0 }, 0.2), 1.5), { 0.4, -0.3 }, 0.5) });
  Spring spring;
  spring.from_block = "a";
  spring.from_point = Vector2d(0.15, 0.7);
  spring.to_point = Vector2d(-2.0, 3.0);
  spring.stiffness = 20.0;
  spring.rest_length = 0.75;
  spring.damping = 0.4;
  scene.springs = { spring };
  World world(scene);
  const closed_form::SpringBody body{ 1.5, 1.25, 3.0, spring.from_point, spring.to_point, 20.0, 0.75, 0.4 };
  const MotionState from = world.state(0);
  for (const double t : { 0.5, 1.5, 3.0 })
    expectState(stateAt(world, t), body.after(from, t), 1e-10);
  expectExact(world, 1e-10);
}

TEST(SpringMotion, Mouse)
{
  World world(makeScene(3.0, 1.0, { moving(makeBox("a", { 1, 3 }, { 0, 0 }, 0.2), { 0.4, -0.3 }, 0.5) }));
  const closed_form::SpringBody body{ 1.0, 10.0 / 12.0, 3.0, Vector2d(0.2, 0.9), Vector2d(1.0, 2.0), 15.0, 0.0, 0.3 };
  SpringCommand pull;
  pull.body = "a";
  pull.attach = body.point;
  pull.anchor = body.anchor;
  pull.stiffness = 15.0;
  pull.damping = 0.3;
  ASSERT_TRUE(world.apply(pull).ok);
  const MotionState from = world.state(0);
  for (const double t : { 0.5, 1.5, 3.0 })
    expectState(stateAt(world, t), body.after(from, t), 1e-10);
  expectExact(world, 1e-10);
}

// F5: the phase k^(1/2) t loses as many digits as it has; the energy none.
TEST(SpringMotion, Stiff)
{
  for (const double stiffness : { 1e2, 1e4, 1e6 })
  {
    World world(makeScene(0.0, 1.0, { makeBox("a", { 1, 1 }, { 1, 0 }) }));
    SpringCommand pull;
    pull.body = "a";
    pull.stiffness = stiffness;
    world.apply(pull);
    const double start = world.energy().total;
    EXPECT_DOUBLE_EQ(start, 0.5 * stiffness);
    EXPECT_NEAR(stateAt(world, 1.0).position.x(), closed_form::dampedOscillation(1.0, 1.0, stiffness, 0.0, 1.0), 1e-10);
    EXPECT_NEAR(world.energy().total / start, 1.0, 1e-13);
  }
}

// K5: tied blocks keep colliding; nothing but themselves acts on them.
TEST(SpringMotion, TiedBlocksKeepMomentumAndEnergy)
{
  Scene scene = makeScene(0.0, 1.0,
                          { moving(makeBox("a", { 1, 1 }, { -1.5, 0.2 }, 0.1), { 1, 0 }),
                            moving(makeBox("b", { 1, 1 }, { 0, 0 }, 0.5), { 0, 0.3 }),
                            moving(makeBox("c", { 1, 1 }, { 1.6, 0.1 }, 0.9), { -1, 0 }, 1.0) });
  for (const auto& [from, to] : { std::pair("a", "b"), std::pair("b", "c"), std::pair("c", "a") })
  {
    Spring spring;
    spring.from_block = from;
    spring.to_block = to;
    spring.stiffness = 10.0;
    scene.springs.push_back(spring);
  }
  World world(scene);
  const EnergyAccount before = world.energy();
  run(world, 60.0);
  const EnergyAccount after = world.energy();
  EXPECT_GT(world.statistics().impacts, 100);
  // Some 1e3 impacts and 1e4 arcs, each 1e-15 of values near 1.
  EXPECT_NEAR(after.momentum_x, before.momentum_x, 1e-11);
  EXPECT_NEAR(after.momentum_y, before.momentum_y, 1e-11);
  EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-11);
  EXPECT_NEAR(after.total / before.total, 1.0, 1e-11);
  expectExact(world, 1e-10);
}

// A2. Found: 3e-16 m after 10 s (11 bounces), 8e-16 after 100 s (111); each impact's time is off by rounding only.
TEST(Drop, ElasticForEver)
{
  World world(makeScene(9.8, 1.0, { makeBox("a", { 1, 1 }, { 0, 1.5 }) }, onFloor()));
  const double start = world.energy().total;
  EXPECT_NEAR(stateAt(world, 10.0).position.y(), 0.5 + closed_form::elasticDrop(1.0, 9.8, 10.0), 1e-8);
  EXPECT_NEAR(world.energy().total / start, 1.0, 1e-12);
  EXPECT_NEAR(stateAt(world, 100.0).position.y(), 0.5 + closed_form::elasticDrop(1.0, 9.8, 100.0), 1e-8);
  EXPECT_NEAR(world.energy().total / start, 1.0, 1e-12);
  expectExact(world, 1e-11);
}

TEST(Impact, OffBothCentres)
{
  for (const double e : { 0.0, 0.5, 1.0 })
  {
    World world(makeScene(0.0, e,
                          { moving(makeBox("a", { 1, 1 }, { -2, 0.7 }, 0.3), { 1, 0.1 }, 0.2),
                            withMass(makeBox("b", { 1, 3 }, { 0, 0 }), 2.0) }));
    const MotionState a = world.state(0), b = world.state(1);
    run(world, 1.4);
    const ContactEvent hit = firstContact(world, ContactKind::Impact);
    const double t = hit.time.seconds();
    const auto at = [t](MotionState state) {
      state.position += t * state.velocity;
      state.angle += t * state.omega;
      return state;
    };
    const auto after =
        closed_form::strike(at(a), 1.0, 1.0 / 6.0, at(b), 2.0, 2.0 * 10.0 / 12.0, hit.point, { -1, 0 }, e);
    EXPECT_NEAR(hit.point.x(), -0.5, 1e-14);
    EXPECT_NEAR(hit.impulse, after.impulse, 1e-13);
    for (const auto& [body, wanted] : { std::pair(0, after.a), std::pair(1, after.b) })
    {
      EXPECT_NEAR((world.state(body).velocity - wanted.velocity).norm(), 0.0, 1e-13);
      EXPECT_NEAR(world.state(body).omega, wanted.omega, 1e-13);
    }
    expectExact(world, 1e-13);
  }
}

/// Unit squares in a row that touch, at elasticity e, with these masses and speeds.
World makeRow(double e, const std::vector<double>& masses, const std::vector<double>& speeds, double gap = 0.0)
{
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < masses.size(); ++i)
    blocks.push_back(withMass(
        moving(makeBox("b" + std::to_string(i), { 1, 1 }, { (1.0 + gap) * i, 0 }), { speeds[i], 0 }), masses[i]));
  return World(makeScene(0.0, e, blocks));
}

TEST(Cradle, PassesTheSpeedOn)
{
  World world(shipped("cradle"));
  run(world, 1.0);
  expectSpeeds(world, 0, { 0, 0, 0, 0, 1 }, 1e-15);
  World two = makeRow(1.0, { 1, 1, 1, 1, 1 }, { 1, 1, 0, 0, 0 });
  run(two, 1.0);
  expectSpeeds(two, 0, { 0, 0, 0, 1, 1 }, 1e-15);
}

// B3: touching blocks share as blocks with small gaps do, whose hits are one after the other.
TEST(Cradle, LosesAsWithGaps)
{
  const std::vector<double> masses(5, 1.0), speeds{ 1, 0, 0, 0, 0 }, shared{ 0.0435, 0.0454, 0.0473, 0.0493, 0.8145 };
  for (const double gap : { 0.0, 1e-6, 1e-4 })
  {
    SCOPED_TRACE(gap);
    World world = makeRow(0.9, masses, speeds, gap);
    run(world, 20.0);
    expectSpeeds(world, 0, shared, 1e-4);
  }
}

TEST(Cradle, UnequalMasses)
{
  World world = makeRow(1.0, { 1, 1000, 1 }, { 1, 0, 0 });
  run(world, 0.1);
  const auto [first, middle] = closed_form::centralImpact(1.0, 1.0, 1000.0, 0.0, 1.0);
  const auto [kept, last] = closed_form::centralImpact(1000.0, middle, 1.0, 0.0, 1.0);
  expectSpeeds(world, 0, { first, kept, last }, 1e-15);
}

// B5: both corners hit at once.
TEST(Landing, Flat)
{
  for (const double e : { 1.0, 0.5 })
  {
    World world(makeScene(0.0, e, { moving(makeBox("a", { 1, 0.5 }, { 0, 0.5 }), { 0, -1 }) }, onFloor()));
    const MotionState after = stateAt(world, 0.5);
    EXPECT_NEAR(after.velocity.y(), e, 1e-15);
    EXPECT_EQ(after.velocity.x(), 0.0);
    EXPECT_NEAR(after.omega, 0.0, 1e-15);
  }
}

// B6: rigid impact is discontinuous: tilts well below the tolerance land flat, others in three hits. Nothing else
// occurs.
TEST(Landing, TiltLadder)
{
  for (const double tolerance : { 1e-6, 1e-9, 1e-12 })
    for (const double tilt : { 0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3 })
    {
      Scene scene = makeScene(9.8, 1.0, { makeBox("a", { 1, 0.5 }, { 0, 1 }, tilt) }, onFloor());
      scene.tolerance = tolerance;
      World world(scene);
      const MotionState after = stateAt(world, 0.5);
      SCOPED_TRACE("tolerance " + std::to_string(std::log10(tolerance)) + " tilt " + std::to_string(tilt * 1e9) +
                   "e-9");
      // The corners' heights differ by the tilt times the width, 1 m; near the tolerance either may be.
      const bool flat = tilt < 0.3 * tolerance || (tilt < 3.0 * tolerance && std::abs(after.omega) < 1.0);
      EXPECT_NEAR(after.velocity.y(), flat ? 2.768116 : tilt < 1e-4 ? 2.59955 : 2.5992, flat ? 2e-6 : 5e-5);
      EXPECT_NEAR(std::abs(after.omega), flat ? 0.0 : tilt < 1e-4 ? 3.48366 : 3.4897, flat ? 2e-5 : 5e-5);
    }
}

TEST(Landing, OnTwoBlocks)
{
  World world(makeScene(0.0, 1.0,
                        { moving(makeBox("top", { 2, 0.5 }, { 0, 1.25 }), { 0, -1 }),
                          makeBox("left", { 0.6, 1 }, { -0.5, 0.5 }), makeBox("right", { 0.6, 1 }, { 0.5, 0.5 }) },
                        onFloor()));
  run(world, 0.1);
  expectSpeeds(world, 1, { 7.0 / 9.0, 4.0 / 9.0, 4.0 / 9.0 }, 1e-14);
  expectSpeeds(world, 0, { 0, 0, 0 }, 1e-14);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(world.state(i).omega, 0.0, 1e-14);
  EXPECT_NEAR(world.energy().total, 0.5, 1e-14);
}

// B8: a square, corner down, into a right-angled V of two fixed blocks.
TEST(Landing, InAV)
{
  for (const double e : { 1.0, 0.5 })
  {
    const double s = std::sqrt(0.5);
    World world(makeScene(0.0, e,
                          { moving(makeBox("a", { 0.5, 0.5 }, { 0, 1 }, pi / 4), { 0, -1 }),
                            fixedOne(makeBox("right", { 4, 1 }, { 2 * s, s }, pi / 4)),
                            fixedOne(makeBox("left", { 4, 1 }, { -2 * s, s }, -pi / 4)) }));
    const MotionState after = stateAt(world, 1.0);
    EXPECT_NEAR(after.velocity.y(), e, 1e-14);
    EXPECT_NEAR(after.velocity.x(), 0.0, 1e-14);
    EXPECT_NEAR(after.omega, 0.0, 1e-14);
  }
}

// B11: the normal of corner on corner is the bisector, so the mirror's symmetry stays.
TEST(Landing, CornerOnCorner)
{
  World world(makeScene(0.0, 1.0,
                        { moving(makeBox("a", { 0.5, 0.5 }, { -1, 5 }, pi / 4), { 1, 0 }),
                          moving(makeBox("b", { 0.5, 0.5 }, { 1, 5 }, pi / 4), { -1, 0 }) }));
  run(world, 2.0);
  expectSpeeds(world, 0, { -1, 1 }, 1e-14);
  expectSpeeds(world, 1, { 0, 0 }, 1e-14);
  EXPECT_NEAR(world.state(0).omega, 0.0, 1e-14);
  EXPECT_NEAR(world.state(1).omega, 0.0, 1e-14);
}

// B12: what happens at the same instant elsewhere changes no bit.
TEST(Landing, HundredAtOnce)
{
  const auto box = [](int i) { return makeBox("b" + std::to_string(i), { 0.5, 0.5 }, { 2.0 * i, 1.25 }); };
  std::vector<Block> blocks;
  for (int i = 0; i < 100; ++i)
    blocks.push_back(box(i));
  World many(makeScene(9.8, 0.5, blocks, onFloor())), one(makeScene(9.8, 0.5, { box(0) }, onFloor()));
  for (const double t : { 0.5, 0.9, 2.0 })
  {
    run(many, t);
    const MotionState alone = stateAt(one, t);
    for (int i = 0; i < 100; ++i)
    {
      EXPECT_EQ(many.state(i).position.y(), alone.position.y()) << i;
      EXPECT_EQ(many.state(i).velocity.y(), alone.velocity.y()) << i;
    }
  }
}

// A4: 33-digit reference; two impacts amplify rounding by some 1e2.
TEST(Landing, TiltedBox)
{
  World world(makeScene(9.8, 0.8, { moving(makeBox("a", { 0.5, 0.3 }, { 0, 1 }, 0.2), { 0.25, 0 }) }, onFloor()));
  const MotionState after = stateAt(world, 1.0);
  EXPECT_NEAR(after.position.x(), 0.25, 1e-14);
  EXPECT_NEAR(after.position.y(), 0.433151808042737, 1e-11);
  EXPECT_NEAR(after.angle, 4.099507681973138, 1e-11);
}

// K3: masses that stop each block but the last, which leaves at n times the speed of the fall.
TEST(Landing, StackedDrop)
{
  for (int n = 2; n <= 4; ++n)
  {
    std::vector<Block> blocks(n);
    for (int k = n; k >= 1; --k)
    {
      blocks[k - 1] = makeBox("b" + std::to_string(k), { 1, 1 }, { 0, k + 0.5 });
      if (k < n)  // it comes to a stop: m_k k v - m_(k+1) v = m_(k+1) (k + 1) v
        blocks[k - 1].mass = blocks[k].mass * (k + 2.0) / k;
    }
    World world(makeScene(9.8, 1.0, blocks, onFloor()));
    const double fall = std::sqrt(2.0 / 9.8), v = 9.8 * fall;
    const double top = stateAt(world, fall + n * v / 9.8, n - 1).position.y();
    EXPECT_NEAR(top, n - 0.5 + n * n, 1e-12 * n * n) << n;
    for (int k = 0; k + 1 < n; ++k)
      EXPECT_NEAR(world.state(k).position.y(), k + 0.5, 1e-6) << n;
    expectExact(world, 1e-11);
  }
}

// K1 (Galperin).
TEST(Counting, PiByCollisions)
{
  for (const auto& [mass, impacts] :
       { std::pair(1.0, 3), std::pair(1e2, 31), std::pair(1e4, 314), std::pair(1e6, 3141) })
  {
    Scene scene = shipped("pi_collisions");
    scene.blocks.front().mass = mass;
    World world(scene);
    run(world, 10.0);
    EXPECT_EQ(world.statistics().impacts, impacts);
    EXPECT_NEAR(world.energy().total / (0.5 * mass), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
