// C. Resting contact.

#include <map>

#include "hard_cases.h"

namespace block_world
{
namespace
{
/// A stack of unit squares stands on representable heights: there is nothing to round, so nothing may change. Each
/// joint carries the weight above it, half at each corner. The equations of its force balance accelerations f / m of
/// the lighter block, whose rounding the whole mass would have to follow.
void expectStackStands(World& world, const std::vector<double>& masses)
{
  const int n = static_cast<int>(masses.size());
  double weight = 0.0, mass = 0.0;
  for (int i = n - 1; i >= 0; --i)
  {
    EXPECT_EQ(world.state(i).position, Vector2d(0, i + 0.5)) << i;
    EXPECT_EQ(world.state(i).angle, 0.0) << i;
    EXPECT_EQ(world.state(i).velocity.norm() + std::abs(world.state(i).omega), 0.0) << i;
    weight += 9.8 * masses[i];
    mass += masses[i];
  }
  std::map<int, std::vector<double>> joints;  // by their heights
  for (const ContactEvent& contact : world.restingContacts())
    joints[static_cast<int>(std::lround(contact.point.y()))].push_back(contact.impulse);
  const double error = 4.0 * rounding * weight * mass / *std::min_element(masses.begin(), masses.end());
  for (int i = 0; i < n; ++i)
  {
    ASSERT_EQ(joints[i].size(), 2u) << i;
    EXPECT_NEAR(joints[i][0], 0.5 * weight, error) << i;
    EXPECT_NEAR(joints[i][1], 0.5 * weight, error) << i;
    weight -= 9.8 * masses[i];
  }
}

// C1, C2, C3: ten, fifty, one heavy on top, light and heavy in turn.
TEST(Resting, Stacks)
{
  std::vector<double> top_heavy(10, 1.0), alternating;
  top_heavy.back() = 1000.0;
  for (int i = 0; i < 50; ++i)
    alternating.push_back(i % 2 ? 1000.0 : 1.0);
  for (const auto& masses : { std::vector<double>(10, 1.0), std::vector<double>(50, 1.0), top_heavy, alternating })
  {
    SCOPED_TRACE(masses.size());
    SCOPED_TRACE(masses.back());
    World world(masses.size() == 10 && masses.back() == 1.0 ? shipped("stack") : makeStack(masses));
    run(world, 1.0);
    expectStackStands(world, masses);
    expectNothingHappens(world, 1e6);
    expectStackStands(world, masses);
    EXPECT_EQ(world.statistics().impacts, 0);
    expectExact(world, 0.0);
  }
}

// C4: a pyramid of bricks, each on the ends of two, whose contacts are redundant: only their sums are unique. Each
// brick gets from below what comes from above, and its own weight.
void expectPyramidStands(int rows)
{
  std::vector<Block> blocks;
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i)
      blocks.push_back(
          makeBox("b" + std::to_string(blocks.size()), { 1, 0.5 }, { 1.125 * i + 0.5625 * row, 0.5 * row + 0.25 }));
  World world(makeScene(9.8, 0.3, blocks, onFloor()));
  run(world, 1.0);
  expectNothingHappens(world, 60.0);
  std::vector<double> net(blocks.size(), 0.0), moment(blocks.size(), 0.0);
  for (const ContactEvent& contact : world.restingContacts())
  {
    const Vector2d force = contact.impulse * contact.normal;
    for (const auto& [body, sign] : { std::pair(contact.a, 1.0), std::pair(contact.b, -1.0) })
      if (body < world.bodyCount())
      {
        net[body] += sign * force.y();
        moment[body] += sign * closed_form::cross(contact.point - blocks[body].position, force);
      }
  }
  const double error = 1e-12 * 9.8 * blocks.size();
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    EXPECT_EQ(world.state(i).position, blocks[i].position) << i;
    EXPECT_EQ(world.state(i).angle, 0.0) << i;
    EXPECT_NEAR(net[i], 9.8, error) << i;
    EXPECT_NEAR(moment[i], 0.0, error) << i;
  }
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 9.8 * blocks.size(), error);
}

TEST(Resting, PyramidOfTenRows)
{
  expectPyramidStands(10);
}

TEST(Resting, PyramidOfTwentyRows)
{
  expectPyramidStands(20);
}

// 820 bricks: takes minutes. --gtest_also_run_disabled_tests --gtest_filter=*Forty*
TEST(Resting, DISABLED_PyramidOfFortyRows)
{
  expectPyramidStands(40);
}

// C5: after a million seconds without an event a block slides into the lowest of the stack, 4 m on at 1 m/s. Its impact
// is at that second exactly; both share the speed as 1 + e to 1 - e, and those above only stand on what slides off.
TEST(Resting, WaitsAMillionSecondsAndIsHit)
{
  std::vector<double> masses(10, 1.0);
  masses.back() = 1000.0;
  Scene scene = makeStack(masses);
  scene.blocks.push_back(makeBox("hammer", { 1, 1 }, { -5, 0.5 }));
  World world(scene);
  run(world, 1.0);
  world.takeContacts();
  expectNothingHappens(world, 1e6);
  SetStateCommand push;
  push.body = "hammer";
  push.position = Vector2d(-5, 0.5);
  push.velocity = Vector2d(1, 0);
  ASSERT_TRUE(world.apply(push).ok);
  run(world, 1e6 + 4.5);
  const ContactEvent hit = firstContact(world, ContactKind::Impact);
  EXPECT_EQ(hit.time.wholeSeconds(), 1000004);
  EXPECT_NEAR(hit.time.fraction(), 0.0, 4.0 * rounding);
  EXPECT_NEAR(world.state(world.find("hammer")).velocity.x(), 0.35, 1e-13);
  EXPECT_NEAR(world.state(0).velocity.x(), 0.65, 1e-13);
  EXPECT_NEAR(world.state(0).position.x(), 0.325, 1e-13);
  // A tilt of 1e-14 by roundings turns the load of 9.8 kN on blocks of 1 kg into 1e-10 m/s^2 sideways, for half a second.
  for (int i = 1; i < 10; ++i)
    EXPECT_NEAR((world.state(i).position - Vector2d(0, i + 0.5)).norm(), 0.0, 1e-11) << i;
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 1010.0 * 9.8, 1e-12 * 1010.0 * 9.8);
  // While the lowest block slides, ten gaps under 10 kN drift by roundings of coordinates of 10 m, some 5e-15 m each.
  expectExact(world, 1e-14 * world.energy().gravity);
}

// C6: side by side on the floor, against each other and a wall without force.
TEST(Resting, ContactsWithoutLoad)
{
  Walls walls = onFloor();
  walls.left = 0.0;
  World world(
      makeScene(9.8, 0.3, { makeBox("a", { 1, 1 }, { 0.5, 0.5 }), makeBox("b", { 1, 1 }, { 1.5, 0.5 }) }, walls));
  run(world, 1.0);
  expectNothingHappens(world, 60.0);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_EQ(world.state(i).position, Vector2d(i + 0.5, 0.5));
    EXPECT_EQ(world.state(i).velocity.norm(), 0.0);
  }
  EXPECT_LT(world.statistics().events, 20);
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

// C7: one foot too many: no unique forces but their sum and moment.
TEST(Resting, OnThreeFeet)
{
  World world = makeFeet(0.0, 0.0);
  run(world, 60.0);
  EXPECT_NEAR((world.state(0).position - Vector2d(0.0, 0.35)).norm(), 0.0, 8.0 * rounding);
  EXPECT_EQ(world.state(0).velocity.norm() + std::abs(world.state(0).omega), 0.0);
  EXPECT_NEAR(restingForce(world, "box"), 9.8, 1e-14 * 9.8);
  EXPECT_NEAR(restingForce(world, "foot1"), restingForce(world, "foot3"), 1e-14 * 9.8);
}

// C7: the middle one too low by 1 mm: the law of the lever.
TEST(Resting, OnTheOuterFeet)
{
  World world = makeFeet(0.3, -1e-3);
  run(world, 60.0);
  EXPECT_NEAR(restingForce(world, "foot1"), 0.3125 * 9.8, 1e-14 * 9.8);
  EXPECT_EQ(restingForce(world, "foot2"), 0.0);
  EXPECT_NEAR(restingForce(world, "foot3"), 0.6875 * 9.8, 1e-14 * 9.8);
}

// C7: the middle one too high by 1 mm: tips onto the right one and rests on both, tilted; without friction it then
// slides down along them.
TEST(Resting, OnTiltedFeet)
{
  World world = makeFeet(0.3, 1e-3);
  const double tilt = std::asin(1e-3 / std::hypot(0.8, 1e-3));
  run(world, 1.0);
  EXPECT_NEAR(world.state(0).angle, -tilt, 8.0 * rounding);  // heights of 0.1 over an arm of 0.8
  EXPECT_NEAR(world.state(0).omega, 0.0, 8.0 * rounding);
  EXPECT_NEAR(restingForce(world, "box"), 9.8 * std::cos(tilt), 1e-14 * 9.8);
  const double before = world.state(0).velocity.norm();
  run(world, 2.0);
  EXPECT_NEAR(world.state(0).velocity.norm() - before, 9.8 * std::sin(tilt), 1e-13);
  EXPECT_EQ(restingForce(world, "foot1"), 0.0);
}

}  // namespace
}  // namespace block_world
