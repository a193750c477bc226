#include "contact_group.h"

#include "bodies.h"

#include <algorithm>

namespace block_world
{
namespace
{
Body boxAt(double width, double height, const Vec2& position, const Vec2& velocity, double mass = 1.0,
           double elasticity = 1.0, const Vec2& acceleration = Vec2::Zero())
{
  Body body = block(rectangle(width, height), mass, elasticity);
  launch(body, position, 0.0, velocity, 0.0, acceleration);
  return body;
}

/// Unit squares face to face along x.
std::vector<Body> cradle(const std::vector<double>& masses, const std::vector<double>& speeds, double elasticity)
{
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < masses.size(); ++i)
    bodies.push_back(boxAt(1.0, 1.0, Vec2(static_cast<double>(i), 0.0), Vec2(speeds[i], 0.0), masses[i], elasticity));
  return bodies;
}

double velocityAt(const ContactGroup& group, const Touch& t)
{
  return normalVelocity(t, group.members[t.member_a], group.members[t.member_b]);
}

/// A box on a floor at y = 0, under gravity unless told otherwise.
ContactGroup boxOnFloor(double speed, double elasticity, double acceleration = -9.81, double gap = 0.0)
{
  return groupOf({ wall(Vec2(0.0, 1.0), 0.0), boxAt(1.0, 0.5, Vec2(0.0, 0.25 + gap), Vec2(0.0, speed), 2.0, elasticity,
                                                    Vec2(0.0, acceleration)) });
}

// Equation (11): j = -(1 + e) w / (1/m_a + 1/m_b + (r_a x n)^2/I_a + (r_b x n)^2/I_b), with arms to the point of
// contact, n from b to a.
TEST(ContactGroup, SingleContactIsEquation11)
{
  Random random(1);
  for (int i = 0; i < 200; ++i)
  {
    const double e = i % 3 == 0 ? 1.0 : random.in(0.1, 1.0), x = random.in(-0.9, 0.9),
                 angle = pi / 4.0 + random.in(-0.5, 0.5);
    Body lower = boxAt(2.0, 1.0, Vec2::Zero(), Vec2::Zero(), random.in(0.1, 10.0), e);
    launch(lower, Vec2::Zero(), 0.0, random.vector(1.0), random.in(-1.0, 1.0));
    if (i % 2 == 0)
      lower = wall(Vec2(0.0, 1.0), 0.5, e);
    Body tip = block(rectangle(1.0, 1.0), random.in(0.1, 10.0));
    const Vec2 arm = Frame(Vec2::Zero(), angle).rotate(Vec2(-0.5, -0.5));
    launch(tip, Vec2(x, 0.5) - arm, angle, Vec2(random.in(-1.0, 1.0), -5.0), random.in(-1.0, 1.0));
    ContactGroup group = groupOf({ lower, tip });
    ASSERT_EQ(group.touches.size(), 1u);
    const Vec2 n(0.0, 1.0), lower_arm(x, 0.5);
    const Member b = group.members[0], a = group.members[1];
    const double w = n.dot(a.velocity + a.omega * perp(arm) - b.velocity - b.omega * perp(lower_arm));
    const double j = -(1.0 + e) * w /
                     (a.inverse_mass + b.inverse_mass + std::pow(cross(arm, n), 2) * a.inverse_inertia +
                      std::pow(cross(lower_arm, n), 2) * b.inverse_inertia);
    group.collide(ContactScales());
    // A dozen operations on numbers below 100.
    EXPECT_NEAR(group.touches[0].impulse, j, 1e-12);
    EXPECT_NEAR(velocityAt(group, group.touches[0]), -e * w, 1e-12);
    expectNear(group.members[1].velocity, a.velocity + j * a.inverse_mass * n, 1e-12);
    EXPECT_NEAR(group.members[1].omega, a.omega + j * a.inverse_inertia * cross(arm, n), 1e-11);
    expectNear(group.members[0].velocity, b.velocity - j * b.inverse_mass * n, 1e-12);
    EXPECT_NEAR(group.members[0].omega, b.omega - j * b.inverse_inertia * cross(lower_arm, n), 1e-11);
  }
}

TEST(ContactGroup, Cradles)
{
  struct Case
  {
    const char* what;
    std::vector<double> masses, before;
    double elasticity;
    std::vector<double> after;
    double error;
  };
  const Case cases[] = {
    { "one striker", { 1, 1, 1, 1, 1 }, { 1, 0, 0, 0, 0 }, 1.0, { 0, 0, 0, 0, 1 }, 1e-15 },
    { "two strikers", { 1, 1, 1, 1, 1 }, { 1, 1, 0, 0, 0 }, 1.0, { 0, 0, 0, 1, 1 }, 1e-15 },
    { "from both ends", { 1, 1, 1, 1, 1 }, { 1, 0, 0, 0, -1 }, 1.0, { -1, 0, 0, 0, 1 }, 2e-15 },
    // The middle is struck from both sides at once: the three velocities 1, 0, -2 turn about their mean.
    { "from both ends, unequal",
      { 1, 1, 1, 1, 1 },
      { 1, 0, 0, 0, -2 },
      1.0,
      { -5 / 3., -2 / 3., 0, 0, 4 / 3. },
      2e-15 },
    // Hits one after the other between separate blocks, to the digits given.
    { "e = .9", { 1, 1, 1, 1, 1 }, { 1, 0, 0, 0, 0 }, 0.9, { .0435, .0454, .0473, .0493, .8145 }, 0.5001e-4 },
    // Two hits after each other: of 1 by 1000 and of 1000 by 1.
    { "1, 1000, 1",
      { 1, 1000, 1 },
      { 1, 0, 0 },
      1.0,
      { -999 / 1001., 2 / 1001. * 999 / 1001., 2 / 1001. * 2000 / 1001. },
      1e-15 },
    { "inelastic", { 1, 2, 3 }, { 6, 0, 0 }, 0.0, { 1, 1, 1 }, 2e-15 },
  };
  for (const Case& c : cases)
  {
    SCOPED_TRACE(c.what);
    ContactGroup group = groupOf(cradle(c.masses, c.before, c.elasticity));
    EXPECT_EQ(group.touches.size(), 2 * (c.masses.size() - 1));
    group.collide(ContactScales());
    for (std::size_t i = 0; i < c.after.size(); ++i)
    {
      EXPECT_NEAR(group.members[i].velocity.x(), c.after[i], c.error) << i;
      EXPECT_NEAR(group.members[i].velocity.y(), 0.0, 1e-15) << i;
      EXPECT_NEAR(group.members[i].omega, 0.0, 1e-14) << i;
    }
  }
}

TEST(ContactGroup, HitsOfOtherPairsWaitForTheirOwnTime)
{
  // The third block stands .3 of a tolerance apart: within the shell, but not yet struck.
  std::vector<Body> bodies = cradle({ 1.0, 2.0, 1.0 }, { 3.0, 0.0, 0.0 }, 1.0);
  bodies[2].arc.order[0].x += 3e-7;
  ContactGroup group = groupOf(bodies);
  ASSERT_EQ(group.touches.size(), 4u);
  group.collide(ContactScales());
  const double after[] = { -1.0, 2.0, 0.0 };
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(group.members[i].velocity.x(), after[i], 1e-15);
}

TEST(ContactGroup, FlatLandingDoesNotSpin)
{
  for (const double e : { 1.0, 0.5, 0.0 })
  {
    ContactGroup group = boxOnFloor(-1.0, e, 0.0);
    ASSERT_EQ(group.touches.size(), 2u);
    const double loss = group.collide(ContactScales());
    EXPECT_NEAR(group.members[1].velocity.y(), e, 1e-15);
    EXPECT_EQ(group.members[1].omega, 0.0);
    EXPECT_NEAR(loss, 0.5 * 2.0 * (1.0 - e * e), 1e-15);
    EXPECT_TRUE(group.struck());
  }
}

TEST(ContactGroup, OneBlockOnTwo)
{
  // By hand: three stages, the block on the supports, these on the floor, these on the block.
  ContactGroup group =
      groupOf({ wall(Vec2(0.0, 1.0), 0.0), boxAt(2.0, 0.5, Vec2(0.0, 1.25), Vec2(0.0, -1.0)),
                boxAt(0.6, 1.0, Vec2(-0.5, 0.5), Vec2::Zero()), boxAt(0.6, 1.0, Vec2(0.5, 0.5), Vec2::Zero()) });
  group.collide(ContactScales());
  EXPECT_NEAR(group.members[1].velocity.y(), 7.0 / 9.0, 4e-15);
  EXPECT_NEAR(group.members[2].velocity.y(), 4.0 / 9.0, 4e-15);
  EXPECT_NEAR(group.members[2].velocity.y(), group.members[3].velocity.y(), 1e-15);
  for (int i = 1; i <= 3; ++i)
  {
    EXPECT_NEAR(group.members[i].velocity.x(), 0.0, 1e-15);
    EXPECT_NEAR(group.members[i].omega, 0.0, 1e-14);
  }
  EXPECT_NEAR(kineticEnergy(group.members), 0.5, 1e-14);
}

TEST(ContactGroup, SquareInAGroove)
{
  for (const double e : { 1.0, 0.7, 0.0 })
  {
    const double half_diagonal = std::sqrt(0.5);
    Body square = block(rectangle(1.0, 1.0), 1.0, e);
    launch(square, Vec2(0.0, half_diagonal), pi / 4.0, Vec2(0.0, -1.0));
    ContactGroup group =
        groupOf({ wall(Vec2(1.0, 1.0).normalized(), 0.0), wall(Vec2(-1.0, 1.0).normalized(), 0.0), square });
    EXPECT_EQ(group.touches.size(), 4u);
    group.collide(ContactScales());
    expectNear(group.members[2].velocity, Vec2(0.0, e), 1e-14);
    EXPECT_NEAR(group.members[2].omega, 0.0, 1e-14);
  }
}

TEST(ContactGroup, LockedSlotTakesWhatCannotLeave)
{
  for (const double e : { 1.0, 0.5 })
  {
    ContactGroup group = groupOf({ wall(Vec2(1.0, 0.0), -0.5), wall(Vec2(-1.0, 0.0), -0.5),
                                   boxAt(1.0, 1.0, Vec2::Zero(), Vec2(1.0, 0.25), 2.0, e) });
    ASSERT_EQ(group.touches.size(), 4u);
    const double loss = group.collide(ContactScales());
    expectNear(group.members[2].velocity, Vec2(0.0, 0.25), 1e-12);
    EXPECT_NEAR(group.members[2].omega, 0.0, 1e-12);
    EXPECT_NEAR(loss, 1.0, 1e-12);  // m v^2 / 2, over some 50 stages that each round once or twice
    // Recognised after 50 stages of at most 2 m v, not after a thousand.
    double impulse = 0.0;
    for (const Touch& t : group.touches)
      impulse += t.impulse;
    EXPECT_LE(impulse, 51 * 2.0 * 2.0);
  }
}

// A plug in a slot that opens by two degrees: a billiard in a wedge, some 90 reflections before it leaves. Not locked.
TEST(ContactGroup, NarrowWedgeThrowsItsPlugOut)
{
  const double half = pi / 180.0, slope = std::tan(half);
  std::vector<Vec2> corners{ Vec2(-5.0 * slope, 5.0), Vec2(5.0 * slope, 5.0), Vec2(6.0 * slope, 6.0),
                             Vec2(-6.0 * slope, 6.0) };
  const Vec2 centre = areaMoments(corners).centroid;
  for (Vec2& p : corners)
    p -= centre;
  Body plug = block(corners, 2.0);
  launch(plug, centre, 0.0, Vec2(0.1, -1.0));
  ContactGroup group = groupOf(
      { wall(Vec2(std::cos(half), std::sin(half)), 0.0), wall(Vec2(-std::cos(half), std::sin(half)), 0.0), plug });
  ASSERT_EQ(group.touches.size(), 4u);
  const double loss = group.collide(ContactScales());
  // Unfolded, the plug flies straight: 1.01 m/s at a heading that no wall crosses any more. A hundred stages of a few
  // eps.
  EXPECT_NEAR(group.members[2].velocity.norm(), std::sqrt(1.01), 1e-13);
  EXPECT_GT(group.members[2].velocity.y(), 1.0);
  EXPECT_LT(std::abs(group.members[2].velocity.x()), slope * group.members[2].velocity.y());
  EXPECT_NEAR(loss, 0.0, 1e-13);
}

// Struck from both sides with unlike elasticities, the light one in the middle would leave with four times the energy
// there was.
TEST(ContactGroup, UnlikeElasticitiesGainNothing)
{
  for (const double e : { 0.0, 0.2, 0.5, 0.9 })
  {
    std::vector<Body> bodies = cradle({ 10.0, 0.1, 10.0 }, { 1.0, 0.0, -1.0 }, 1.0);
    bodies[2].elasticity = e;
    ContactGroup group = groupOf(bodies);
    EXPECT_GE(group.collide(ContactScales()), 0.0);
    EXPECT_LE(kineticEnergy(group.members), 10.0) << e;
    EXPECT_NEAR(group.members[0].velocity.x() * 10.0 + group.members[1].velocity.x() * 0.1 +
                    group.members[2].velocity.x() * 10.0,
                0.0, 1e-13);
  }
}

TEST(ContactGroup, SlowOnesArePressedOrReflected)
{
  // Capture speed sqrt(8 a tolerance) = 8.9e-3 m/s; without losses sqrt(4 a guard) = 2.5e-6 m/s.
  const struct
  {
    const char* what;
    double speed, elasticity, acceleration, gap;
    bool dissipative;
    double after;
    bool active;
  } cases[] = {
    { "slow", -1e-3, 0.5, -9.81, 0.0, false, 0.0, true },
    { "opening slowly", 1e-3, 0.5, -9.81, 0.0, false, 0.0, true },
    { "at rest", 0.0, 1.0, -9.81, 0.0, false, 0.0, true },
    { "slow, not pressed", -1e-3, 0.5, 9.81, 0.0, false, 0.5e-3, false },
    { "at rest, not pressed", 0.0, 0.5, 9.81, 0.0, false, 0.0, false },
    { "fast", -0.1, 0.5, -9.81, 0.0, false, 0.05, false },
    { "slow, lossless", -1e-3, 1.0, -9.81, 0.0, false, 1e-3, false },
    { "slow, lossless in thick air", -1e-3, 1.0, -9.81, 0.0, true, 0.0, true },
    { "slower than can be resolved, lossless", -1e-7, 1.0, -9.81, 0.0, false, 0.0, true },
    { "as fast as sinking by the guard makes it, lossless", -std::sqrt(2.0 * 9.81 * 1.6e-13), 1.0, -9.81, 0.0, false, 0.0, true },
    { "slow, not yet there", -1e-3, 0.5, -9.81, 0.3e-6, false, -1e-3, false },
    { "inelastic", -1.0, 0.0, -9.81, 0.0, false, 0.0, true },
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.what);
    ContactGroup group = boxOnFloor(c.speed, c.elasticity, c.acceleration, c.gap);
    ContactScales scales;
    scales.dissipative = c.dissipative;
    const double before = kineticEnergy(group.members);
    const double loss = group.collide(scales);
    EXPECT_NEAR(group.members[1].velocity.y(), c.after, 1e-15);
    EXPECT_NEAR(loss, before - kineticEnergy(group.members), 1e-15);
    double force = 0.0;
    for (const Touch& t : group.touches)
    {
      EXPECT_EQ(t.active, c.active);
      force += t.force;
    }
    if (c.active)
    {
      EXPECT_NEAR(force, 2.0 * 9.81, 1e-13);
    }
  }
}

TEST(ContactGroup, WhatIsLeftOutLetsOthersRest)
{
  // A light block hops at .9 of the capture speed s = sqrt(8 g tolerance), a heavy one on it at 1.8. To rest together the heavy one would take
  // (1.8 s)^2 / 8g = 3.24 tolerances, against the one allowed, and the light one under it, with the impulse and the load of both,
  // (.9 + 9 * 1.8) / 10 * .9 = 1.54; but alone only .9^2 = .81. So the heavy one goes on, and the light one rests.
  const double g = 9.81, u = 0.9 * std::sqrt(8.0 * g * 1e-6);
  ContactGroup group = groupOf({ wall(Vec2(0.0, 1.0), 0.0), boxAt(1.0, 0.5, Vec2(0.0, 0.25), Vec2(0.0, u), 1.0, 0.5, Vec2(0.0, -g)),
                                 boxAt(1.0, 0.5, Vec2(0.0, 0.75), Vec2(0.0, 2.0 * u), 9.0, 0.5, Vec2(0.0, -g)) });
  ASSERT_EQ(group.touches.size(), 4u);
  EXPECT_NEAR(group.collide(ContactScales()), 0.5 * u * u, 1e-15);
  EXPECT_EQ(group.members[1].velocity.y(), 0.0);
  EXPECT_EQ(group.members[2].velocity.y(), 2.0 * u);
  for (const Touch& t : group.touches)
    EXPECT_EQ(t.active, t.a == 0 || t.b == 0);
}

TEST(ContactGroup, SettlingClosesGaps)
{
  // 3e-7 above the floor, turned by 1e-7: both corners down to the floor.
  Body box = block(rectangle(1.0, 0.5), 2.0, 0.5);
  launch(box, Vec2(0.0, 0.25 + 3e-7), 1e-7, Vec2(0.0, -1e-3), 0.0, Vec2(0.0, -9.81));
  const std::vector<Body> bodies{ wall(Vec2(0.0, 1.0), 0.0), box };
  ContactGroup group = groupOf(bodies);
  ASSERT_EQ(group.touches.size(), 2u);
  for (Touch& t : group.touches)
    t.active = true;
  EXPECT_NEAR(group.settlePositions(1e-14).gap, 3.5e-7, 1e-12);
  EXPECT_NEAR(group.members[1].frame.position.y(), 0.25, 1e-13);  // the square of the turn
  EXPECT_NEAR(group.members[1].angle, 0.0, 1e-13);
  EXPECT_EQ(group.members[0].frame.position, Vec2(0.0, 0.0));
  const double before = kineticEnergy(group.members);
  EXPECT_NEAR(group.holdActive(), before, 1e-18);
  expectNear(group.members[1].velocity, Vec2::Zero(), 1e-18);
}

TEST(ContactGroup, HoldingLeavesWhatIsAboutToHit)
{
  // On a box that rests another one comes down, its gap just closed by the moves of others: its impact is still to come.
  Body low = block(rectangle(1.0, 0.5), 2.0, 0.5), high = block(rectangle(1.0, 0.5), 1.0, 0.5);
  launch(low, Vec2(0.0, 0.25), 0.0, Vec2(0.0, -1e-12), 0.0, Vec2(0.0, -9.81));
  launch(high, Vec2(0.0, 0.75), 0.0, Vec2(0.0, -0.01), 0.0, Vec2(0.0, -9.81));
  ContactGroup group = groupOf({ wall(Vec2(0.0, 1.0), 0.0), low, high });
  for (Touch& t : group.touches)
    t.active = t.a == 0 || t.b == 0;
  EXPECT_NEAR(group.holdActive(), 1e-24, 1e-39);
  EXPECT_EQ(group.members[1].velocity, Vec2(0.0, 0.0));
  EXPECT_EQ(group.members[2].velocity, Vec2(0.0, -0.01));
}

TEST(ContactGroup, OnlyWhatIsDeepIsLifted)
{
  for (const double gap : { 2e-7, -2e-7 })
  {
    ContactGroup group = boxOnFloor(0.0, 0.5, 9.81, gap);
    EXPECT_NEAR(group.settlePositions(1e-14).gap, gap < 0.0 ? -gap : 0.0, 1e-15);
    EXPECT_NEAR(group.members[1].frame.position.y(), 0.25 + std::max(gap, 0.0), 1e-15);
  }
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
