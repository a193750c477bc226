// K. Exact counts and thresholds.

#include "hard_cases.h"

namespace block_world
{
namespace
{
/// K1 (Galperin 2003): with masses 1 and 100^k the impacts number floor(pi 10^k).
///
/// In the coordinates sqrt(m) x the two blocks are one point that flies straight through a wedge of the angle arctan
/// 10^-k, unfolded. Each impact rounds the direction by 1e-16, n = pi 10^k of them add up to n 1e-16 at most, and the
/// count is right while that is less than what the last impact misses the next one by: the fraction of pi 10^k (0.59,
/// 0.65, 0.35 for k = 5, 6, 7) times 10^-k. So doubles end near 10^2k = 1e16 / 10: k = 7 may be right, k = 8 is luck.
/// Positions do not matter: there is only one order in which the hits can follow each other.
void expectDigitsOfPi(int k, std::int64_t impacts)
{
  Scene scene = shipped("pi_collisions");
  scene.blocks[0].mass = std::pow(100.0, k);
  World world(scene);
  world.keepContacts(false);
  run(world, 1000.0);
  EXPECT_EQ(world.statistics().impacts, impacts) << k;
  // Nothing turns, so that each hit is foreseen at once. Besides there are looks at cells of 1.6 m, which the blocks cross at up to 2 m/s.
  EXPECT_LE(world.statistics().events, impacts + impacts / 50 + 2000) << k;
  // An impact rounds the energies of its blocks by 2e-16; the same numbers again and again round the same way, so that
  // these add up.
  EXPECT_NEAR(world.energy().total / (0.5 * std::pow(100.0, k)), 1.0,
              rounding * std::max<std::int64_t>(10, 2 * impacts));
  EXPECT_GT(world.state(0).velocity.x(), world.state(1).velocity.x());
  EXPECT_GE(world.state(1).velocity.x(), 0.0);
  expectExact(world, 1e-12 * 0.5 * std::pow(100.0, k));
}

TEST(ExactCounts, DigitsOfPi)
{
  expectDigitsOfPi(0, 3);
  expectDigitsOfPi(1, 31);
  expectDigitsOfPi(2, 314);
  expectDigitsOfPi(3, 3141);
  expectDigitsOfPi(4, 31415);
  expectDigitsOfPi(5, 314159);
}

// The event rate: 3 million impacts, in some 4 s. --gtest_also_run_disabled_tests --gtest_filter=*MoreDigits*
TEST(ExactCounts, DISABLED_MoreDigitsOfPi)
{
  expectDigitsOfPi(6, 3141592);
}

// K2: a harmonic stack on a fixed block stands with a margin of 1e-6 and tips without it. The margin is a lever of 1e-6
// m, far above the rounding of coordinates and far below the size of any block, and must not be confused with the
// tolerance.
TEST(ExactCounts, OverhangingStack)
{
  for (int n = 2; n <= 8; ++n)
    for (const double margin : { 1e-6, -1e-6 })
    {
      SCOPED_TRACE(n);
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
      if (margin > 0.0)
      {
        run(world, 1.0);
        expectNothingHappens(world, 1e6);
        for (int i = 0; i < n; ++i)
        {
          EXPECT_EQ(world.state(i).position, blocks[i].position);
          EXPECT_EQ(world.state(i).angle, 0.0);
        }
        EXPECT_NEAR(restingForce(world, "b1"), 9.8 * (n - 1), 1e-13 * 9.8 * n);
      }
      else
      {
        // Tips over the edge of the fixed block with a moment of 1e-6 m times the weight: exp(t sqrt(g / l)) has grown
        // by 1e6 long before 30 s.
        run(world, 30.0);
        EXPECT_LT(world.state(n - 1).position.y(), blocks.back().position.y() - 1.0);
      }
    }
}

// K3: masses that stop each block but the last, which leaves at n times the speed of the fall and rises to n^2 times
// the height: 3 and 1, for two.
TEST(ExactCounts, StackedDrop)
{
  for (int n = 2; n <= 5; ++n)
  {
    SCOPED_TRACE(n);
    std::vector<Block> blocks(n);
    for (int k = n; k >= 1; --k)
    {
      blocks[k - 1] = makeBox("b" + std::to_string(k), { 1, 1 }, { 0, k + 0.5 });
      if (k < n)  // it comes to a stop: m_k k v - m_(k+1) v = m_(k+1) (k + 1) v
        blocks[k - 1].mass = blocks[k].mass * (k + 2.0) / k;
    }
    World world(makeScene(9.8, 1.0, blocks, onFloor()));
    const double fall = std::sqrt(2.0 / 9.8), v = 9.8 * fall;
    const MotionState top = stateAt(world, fall + n * v / 9.8, n - 1);
    // Speeds of n v are rounded n times, heights follow as their squares.
    EXPECT_NEAR(top.position.y(), n - 0.5 + n * n, 8.0 * n * rounding * n * n);
    EXPECT_NEAR(top.velocity.y(), 0.0, 8.0 * n * rounding * n * v);
    // A block that stops dead but for rounding, 1e-15 m/s, is at rest from then on.
    for (int k = 0; k + 1 < n; ++k)
      EXPECT_NEAR(world.state(k).position.y(), k + 0.5, 1e-14) << k;
    expectExact(world, 1e-14 * world.energy().total);
  }
}

/// One landing of a bouncing drop: the n-th comes at t0 (1 + 2 (e + ... + e^(n-1))) with g t0 e^(n-1).
struct Landing
{
  double time, speed;
};

Landing landing(const closed_form::BouncingDrop& drop, int n)
{
  const double e = drop.elasticity;
  return { drop.fallTime() * (1.0 + 2.0 * e * (1.0 - std::pow(e, n - 1)) / (1.0 - e)),
           drop.gravity * drop.fallTime() * std::pow(e, n - 1) };
}

/// Follows the closed form landing by landing, down to the capture speed; returns the number of landings.
int expectClosedFormDrop(double e, double tolerance)
{
  Scene scene = shipped("drop");
  scene.elasticity = e;
  scene.tolerance = tolerance;
  World world(scene);
  const closed_form::BouncingDrop drop{ 0.875, 9.8, e };
  run(world, drop.restTime() + 1.0);
  const double capture = captureSpeed(scene);

  // A contact's height is rounded as numbers below 1 m are, by 1.1e-16 m at most: v^2 is off by 2 g times that, again
  // at each landing, less e^2 each time, besides v's own roundings; each hop then lasts dv / g longer, twice.
  const double square = 2.0 * 9.8 * 2.0 * rounding / (1.0 - e * e);
  double late = 4.0 * rounding, rest_begin = 0.0;
  int n = 0, bad = 0;
  for (const ContactEvent& contact : world.takeContacts())
  {
    if (contact.kind == ContactKind::RestBegin)
      rest_begin = contact.time.seconds();
    // Both corners land at once.
    if (contact.kind != ContactKind::Impact ||
        (n > 0 && contact.time.seconds() < landing(drop, n).time + 0.5 * drop.fallTime() * std::pow(e, n)))
      continue;
    const Landing wanted = landing(drop, ++n);
    const double error = square / wanted.speed + 8.0 * n * rounding * wanted.speed;
    late += 2.0 * error / 9.8 + 2.0 * rounding;
    bad += !(std::abs(contact.time.seconds() - wanted.time) <= late) ||
           !(std::abs(-contact.normal_velocity - wanted.speed) <= error);
    if (wanted.speed < capture / e)  // the last one may be caught as it leaves
      break;
  }
  EXPECT_EQ(bad, 0);
  EXPECT_GE(rest_begin, landing(drop, n).time - late);
  EXPECT_LE(rest_begin, landing(drop, n + 1).time + late);
  EXPECT_NEAR(restingForce(world, "box"), 9.8, 1e-14 * 9.8);
  EXPECT_NEAR(world.state(0).position.y(), 0.125, 4.0 * rounding);
  EXPECT_NEAR(world.state(0).angle, 0.0, rounding);
  EXPECT_EQ(world.state(0).velocity.y(), 0.0);
  expectExact(world, 1e-12);
  return n;
}

// K4: a quarter of the tolerance is half the capture speed, and so adds ln 2 / ln(1/e) landings; one may fall on the
// limit.
TEST(ExactCounts, LandingsOfADrop)
{
  for (const double e : { 0.5, 0.9 })
  {
    SCOPED_TRACE(e);
    int before = 0;
    for (const double tolerance : { 1e-6, 2.5e-7, 6.25e-8, 1.5625e-8 })
    {
      SCOPED_TRACE(tolerance);
      Scene scene = shipped("drop");
      scene.tolerance = tolerance;
      const closed_form::BouncingDrop drop{ 0.875, 9.8, e };
      const int n = expectClosedFormDrop(e, tolerance);
      EXPECT_NEAR(n, drop.landingsFasterThan(captureSpeed(scene)), 1);
      if (before > 0)
      {
        EXPECT_NEAR(n - before, std::log(2.0) / std::log(1.0 / e), 1.0);
      }
      before = n;
    }
  }
}

// K6: lively ones too, whose bounces an engine that gives back energy at the contact's shell would never end: sqrt(2 g
// delta / (1 - e^2)) lies above the capture speed sqrt(8 g delta) for e > 0.866.
TEST(ExactCounts, LivelyBounces)
{
  for (const double e : { 0.95, 0.99, 0.999 })
  {
    SCOPED_TRACE(e);
    Scene scene = shipped("drop");
    const int n = expectClosedFormDrop(e, scene.tolerance);
    EXPECT_NEAR(n, closed_form::BouncingDrop({ 0.875, 9.8, e }).landingsFasterThan(captureSpeed(scene)), 1);
  }
}

/// Squares of 1 m in a ring, each tied to the next by an undamped spring that pulls them together, so that they keep
/// colliding.
Scene makeTied(int count, double gravity)
{
  Random random(5);
  std::vector<Block> blocks;
  const double radius = 0.5 * 1.6 / std::sin(pi / count);
  for (int i = 0; i < count; ++i)
  {
    const double turn = 2.0 * pi * i / count;
    const Vector2d velocity = random.vector(0.5);
    blocks.push_back(moving(makeBox("b" + std::to_string(i), { 1, 1 },
                                    radius * Vector2d(std::cos(turn), std::sin(turn)), random.in(0.0, pi)),
                            velocity, random.in(-0.5, 0.5)));
  }
  Scene scene = makeScene(gravity, 1.0, blocks);
  for (int i = 0; i < count; ++i)
  {
    Spring spring;
    spring.from_block = blocks[i].name;
    spring.to_block = blocks[(i + 1) % count].name;
    spring.stiffness = 10.0;
    scene.springs.push_back(spring);
  }
  return scene;
}

// K5: nothing but the blocks themselves acts on them, so momentum, angular momentum and energy stay, to 1e-11 over many
// impacts; in a field of gravity their centre follows the parabola.
void expectConserved(int count, double seconds, int least_impacts)
{
  SCOPED_TRACE(count);
  World world(makeTied(count, 0.0));
  const EnergyAccount before = world.energy();
  expectEnergyNeverGrows(world, seconds, true, 20, 1e-11);
  EXPECT_GE(world.statistics().impacts, least_impacts);
  // Relative to what the blocks have each: speeds of 5 m/s at arms of some metres.
  expectMomentumAndEnergy(world.energy(), before, 1e-11, 1e-11 * count, 1e-11 * before.total);
  expectExact(world, 1e-11 * before.total);
}

TEST(ExactCounts, ThreeTiedBlocks)
{
  expectConserved(3, 700.0, 10000);
}

TEST(ExactCounts, EightTiedBlocks)
{
  expectConserved(8, 100.0, 1000);
}

TEST(ExactCounts, TwentyTiedBlocks)
{
  expectConserved(20, 20.0, 100);
}

TEST(ExactCounts, CentreOfTiedBlocksFalls)
{
  for (const int count : { 3, 20 })
  {
    World world(makeTied(count, 9.8));
    Vector2d start = Vector2d::Zero(), velocity = Vector2d::Zero();
    for (int i = 0; i < count; ++i)
    {
      start += world.state(i).position / count;
      velocity += world.state(i).velocity / count;
    }
    for (const double t : { 0.5, 2.0, 4.0 })
    {
      run(world, t);
      Vector2d centre = Vector2d::Zero();
      for (int i = 0; i < count; ++i)
        centre += world.state(i).position / count;
      // Numbers of up to 80 m, rounded anew in each arc and impact.
      EXPECT_NEAR((centre - start - t * velocity - Vector2d(0, -4.9 * t * t)).norm(), 0.0, 1e-12 * (1.0 + 4.9 * t * t))
          << count;
    }
    EXPECT_GT(world.statistics().impacts, 10);
  }
}

}  // namespace
}  // namespace block_world
