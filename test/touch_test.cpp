#include "touch.h"

#include "bodies.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace block_world
{
namespace
{
constexpr double tolerance = 1e-6, closed = 1e-13;

std::vector<Touch> touchesOf(const Body& a, const Body& b)
{
  std::vector<Touch> touches;
  TouchFinder().find(a, memberAt(a, 0), b, memberAt(b, 1), tolerance, touches, closed, 0.0, true);
  return touches;
}

Body boxAt(double width, double height, const Vec2& position, const Vec2& velocity = Vec2::Zero(), double angle = 0.0)
{
  Body body = block(rectangle(width, height), 1.0);
  launch(body, position, angle, velocity);
  return body;
}

/// World points of the touches in ascending order of x.
std::vector<Vec2> pointsOf(const std::vector<Touch>& touches, const Body& a, const Body& b)
{
  std::vector<Vec2> points;
  for (const Touch& t : touches)
    points.push_back((t.a == 0 ? a : b).at(Time()).position + t.arm);
  std::sort(points.begin(), points.end(), [](const Vec2& p, const Vec2& q) { return p.x() < q.x(); });
  return points;
}

// Positions below are sums of a few numbers around one: 1e-15.
TEST(TouchFinder, BoxOnAWall)
{
  const Body floor = wall(Vec2(0.0, 1.0), 0.0), box = boxAt(1.0, 0.5, Vec2(3.0, 0.25));
  for (const bool swapped : { false, true })
  {
    const std::vector<Touch> touches = swapped ? touchesOf(box, floor) : touchesOf(floor, box);
    ASSERT_EQ(touches.size(), 2u);
    for (const Touch& t : touches)
    {
      EXPECT_EQ(t.a, swapped ? 0 : 1);
      expectNear(t.normal, Vec2(0.0, 1.0), 1e-15);
      EXPECT_NEAR(t.gap, 0.0, 1e-15);
      EXPECT_NEAR(t.separation, 0.0, 1e-15);
      EXPECT_FALSE(t.corner);
    }
    EXPECT_EQ(touches[0].vertex + touches[1].vertex, 1);  // its two lower corners
  }
}

TEST(TouchFinder, FlatOnFlat)
{
  struct Case
  {
    const char* what;
    double upper_width, shift;
    std::vector<double> x;  // of the touches, by hand: where the ends of each face lie within the other
  };
  const Case cases[] = {
    { "narrow on wide", 1.0, 0.25, { -0.25, 0.75 } },
    { "wide on narrow", 4.0, 0.5, { -1.0, 1.0 } },
    { "overhang", 2.0, 1.5, { 0.5, 1.0 } },
    { "corners coincide", 2.0, 0.0, { -1.0, 1.0 } },
    { "one corner coincides", 1.0, 0.5, { 0.0, 1.0 } },
    { "overhang by less than the tolerance", 2.0, 0.4e-6, { -1.0, 1.0 } },
  };
  for (const Case& c : cases)
  {
    SCOPED_TRACE(c.what);
    const Body lower = boxAt(2.0, 1.0, Vec2(0.0, 0.0)), upper = boxAt(c.upper_width, 0.5, Vec2(c.shift, 0.75));
    const std::vector<Touch> touches = touchesOf(lower, upper);
    ASSERT_EQ(touches.size(), c.x.size());
    const std::vector<Vec2> points = pointsOf(touches, lower, upper);
    for (std::size_t i = 0; i < points.size(); ++i)
      expectNear(points[i], Vec2(c.x[i], 0.5), tolerance);
    for (const Touch& t : touches)
    {
      EXPECT_NEAR(t.normal.y(), t.a == 1 ? 1.0 : -1.0, 1e-15);  // from b to a
      EXPECT_GE(t.along, -tolerance);
      EXPECT_LE(t.along, (t.b == 0 ? 2.0 : c.upper_width) + tolerance);
    }
  }
}

// Corners that are on each other but for rounding: the lighter block's count, in either order, to either side.
TEST(TouchFinder, CornersOnEachOtherAreTheLighterOnes)
{
  for (const double side : { -1.0, 1.0 })
    for (const double off : { -4e-16, 0.0, 4e-16 })
      for (const bool swapped : { false, true })
      {
        const Body heavy = boxAt(1.0, 0.75, Vec2(0.0, 0.0));
        Body light = block(rectangle(1.0, 0.75), 0.1);
        launch(light, Vec2(side, off));
        const std::vector<Touch> touches = swapped ? touchesOf(light, heavy) : touchesOf(heavy, light);
        ASSERT_EQ(touches.size(), 2u);
        for (const Touch& t : touches)
          EXPECT_EQ(t.a, swapped ? 0 : 1) << side << " " << off;
      }
}

TEST(TouchFinder, VertexOnFace)
{
  const double half_diagonal = std::sqrt(0.5);
  const Body lower = boxAt(2.0, 1.0, Vec2(0.0, 0.0)),
             tip = boxAt(1.0, 1.0, Vec2(0.25, 0.5 + half_diagonal), Vec2::Zero(), pi / 4.0);
  const std::vector<Touch> touches = touchesOf(lower, tip);
  ASSERT_EQ(touches.size(), 1u);
  const Touch& t = touches.front();
  EXPECT_EQ(t.a, 1);
  EXPECT_EQ(t.vertex, 0);
  EXPECT_EQ(t.b, 0);
  expectNear(t.normal, Vec2(0.0, 1.0), 1e-15);
  expectNear(t.arm, Vec2(0.0, -half_diagonal), 1e-15);
  expectNear(t.reach, Vec2(0.25, 0.5), 1e-15);
  EXPECT_NEAR(t.along, 0.75, 1e-15);  // the upper face runs from (1, .5) to the left
  EXPECT_NEAR(t.gap, 0.0, 1e-15);
}

TEST(TouchFinder, ShellAndExtentEndAtHalfTheTolerance)
{
  const double half_diagonal = std::sqrt(0.5);
  const struct
  {
    double x, height;
    std::size_t count;
  } cases[] = { { 0.0, 0.4e-6, 1 }, { 0.0, 0.6e-6, 0 },       { 0.0, -0.4e-6, 1 },
                { 0.0, -3e-6, 1 },  { 1.0 + 0.4e-6, 0.0, 1 }, { 1.0 + 0.8e-6, 0.0, 0 } };
  for (const auto& c : cases)
  {
    const Body lower = boxAt(2.0, 1.0, Vec2(0.0, 0.0));
    const Body tip = boxAt(1.0, 1.0, Vec2(c.x, 0.5 + half_diagonal + c.height), Vec2(0.0, -1.0), pi / 4.0);
    EXPECT_EQ(touchesOf(lower, tip).size(), c.count) << c.x << " " << c.height;
  }
}

TEST(TouchFinder, CornerOnCornerChoosesByTheVelocity)
{
  // Unit squares that touch at (.5, .5) only. Each is in the other's way only if it approaches by both faces.
  const struct
  {
    const char* what;
    Vec2 velocity;
    bool corner;
    Vec2 normal;  // from the first to the second
  } cases[] = {
    { "head on", Vec2(-1.0, -1.0), true, Vec2(std::sqrt(0.5), std::sqrt(0.5)) },
    { "askew", Vec2(-1.0, -0.1), true, Vec2(std::sqrt(0.5), std::sqrt(0.5)) },
    { "passes to the right", Vec2(1.0, -2.0), false, Vec2(1.0, 0.0) },
    { "passes above", Vec2(-2.0, 1.0), false, Vec2(0.0, 1.0) },
    { "leaves", Vec2(1.0, 2.0), false, Vec2(0.0, 1.0) },
  };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.what);
    const Body first = boxAt(1.0, 1.0, Vec2::Zero()), second = boxAt(1.0, 1.0, Vec2(1.0, 1.0), c.velocity);
    std::vector<Touch> touches;
    TouchFinder finder;
    finder.find(first, memberAt(first, 0), second, memberAt(second, 1), tolerance, touches, closed, 0.0, true);
    EXPECT_TRUE(finder.velocityDecided());
    ASSERT_EQ(touches.size(), 1u);
    const Touch& t = touches.front();
    EXPECT_EQ(t.corner, c.corner);
    expectNear(t.a == 1 ? t.normal : Vec2(-t.normal), c.normal, 1e-15);
    expectNear(pointsOf(touches, first, second).front(), Vec2(0.5, 0.5), 1e-15);
  }
}

TEST(TouchFinder, TipOnTipMeetsAlongTheBisector)
{
  const double half_diagonal = std::sqrt(0.5);
  const Body left = boxAt(1.0, 1.0, Vec2(-half_diagonal, 0.0), Vec2(1.0, 0.0), pi / 4.0);
  const Body right = boxAt(1.0, 1.0, Vec2(half_diagonal, 0.0), Vec2(-1.0, 0.0), pi / 4.0);
  const std::vector<Touch> touches = touchesOf(left, right);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_TRUE(touches.front().corner);
  expectNear(touches.front().normal, Vec2(touches.front().a == 1 ? 1.0 : -1.0, 0.0), 1e-15);
}

TEST(TouchFinder, CornerIsDecidedByTheLargerGapFirst)
{
  // Corners that hook by 1e-8 one way or the other: the face that still separates the squares counts, whatever the
  // velocity.
  for (const Vec2& hook : { Vec2(0.0, -1e-8), Vec2(-1e-8, 0.0) })
    for (const Vec2& velocity : { Vec2(-1.0, -1.0), Vec2(-1.0, 1.0), Vec2(1.0, -1.0) })
    {
      const Body first = boxAt(1.0, 1.0, Vec2::Zero()), second = boxAt(1.0, 1.0, Vec2(1.0, 1.0) + hook, velocity);
      std::vector<Touch> touches;
      TouchFinder finder;
      finder.find(first, memberAt(first, 0), second, memberAt(second, 1), tolerance, touches, closed, 0.0, true);
      EXPECT_FALSE(finder.velocityDecided());
      ASSERT_EQ(touches.size(), 1u);
      const Touch& t = touches.front();
      EXPECT_FALSE(t.corner);
      expectNear(t.a == 1 ? t.normal : Vec2(-t.normal), hook.x() == 0.0 ? Vec2(1.0, 0.0) : Vec2(0.0, 1.0), 1e-15);
    }
}

TEST(TouchFinder, ApartIsNoTouchAndNoChoice)
{
  const Body a = boxAt(1.0, 1.0, Vec2::Zero());
  for (const Vec2& place : { Vec2(1.1, 0.0), Vec2(0.0, -1.1), Vec2(1.0 + 1e-5, 1.0 + 1e-5), Vec2(40.0, 0.0) })
    EXPECT_TRUE(touchesOf(a, boxAt(1.0, 1.0, place, Vec2(-1.0, -1.0))).empty());
}

TEST(TouchFinder, ElasticityIsTheSmaller)
{
  Body floor = wall(Vec2(0.0, 1.0), 0.0), box = boxAt(1.0, 1.0, Vec2(0.0, 0.5));
  floor.elasticity = 0.5;
  EXPECT_EQ(touchesOf(floor, box).front().elasticity, 0.5);
  box.elasticity = 0.25;
  EXPECT_EQ(touchesOf(floor, box).front().elasticity, 0.25);
}

TEST(TouchFinder, OrderOfTheBodiesDoesNotMatter)
{
  Random random(1);
  for (int i = 0; i < 500; ++i)
  {
    // Squares side by side, turned together; sometimes a corner on a corner.
    const double angle = random.in(-3.0, 3.0), shift = random.below(3) == 0 ? 1.0 : random.in(-0.9, 0.9);
    const Frame turn(Vec2::Zero(), angle);
    const Body a = boxAt(1.0, 1.0, Vec2::Zero(), random.vector(1.0), angle);
    const Body b = boxAt(1.0, 1.0, turn.rotate(Vec2(1.0, shift)), random.vector(1.0), angle);
    std::vector<Touch> straight, swapped;
    const Member member_a = memberAt(a, 0), member_b = memberAt(b, 1);
    TouchFinder().find(a, member_a, b, member_b, tolerance, straight, closed, 0.0, true);
    TouchFinder().find(b, member_b, a, member_a, tolerance, swapped, closed, 0.0, true);
    ASSERT_EQ(straight.size(), swapped.size()) << i;
    ASSERT_EQ(straight.size(), shift == 1.0 ? 1u : 2u) << i;
    Vec2 normal = Vec2::Zero();
    for (const Touch& t : straight)
      normal += t.a == 0 ? t.normal : Vec2(-t.normal);
    for (const Touch& t : swapped)
      normal -= t.a == 0 ? t.normal : Vec2(-t.normal);
    expectNear(normal, Vec2::Zero(), 1e-14);  // of the same points: the same directions
    const std::vector<Vec2> points = pointsOf(straight, a, b), other_points = pointsOf(swapped, a, b);
    for (std::size_t k = 0; k < points.size(); ++k)
      expectNear(points[k], other_points[k], 1e-14);
  }
}

/// A touch of two members, its vertex at arm from a's centre.
Touch touchBetween(const Member& a, const Member& b, const Vec2& arm, const Vec2& normal)
{
  Touch t;
  t.arm = arm;
  t.reach = a.frame.position + arm - b.frame.position;
  t.normal = normal;
  return t;
}

Member randomMember(Random& random)
{
  Member m;
  m.frame = Frame(random.vector(1.0), random.in(-3.0, 3.0));
  m.velocity = random.vector(1.0);
  m.omega = random.in(-1.0, 1.0);
  m.acceleration = random.vector(1.0);
  m.alpha = random.in(-1.0, 1.0);
  m.inverse_mass = random.in(0.1, 2.0);
  m.inverse_inertia = random.in(0.1, 20.0);
  return m;
}

TEST(Touch, RatesAreTheDerivativesOfTheGap)
{
  Random random(2);
  for (int i = 0; i < 300; ++i)
  {
    const Member a = randomMember(random), b = randomMember(random);
    const Vec2 arm = random.vector(1.0), normal = Vec2(random.in(0.1, 1.0), random.in(-1.0, 1.0)).normalized();
    const Touch touch = touchBetween(a, b, arm, normal);
    const auto gap = [&](double s) {
      const Frame turn_a(Vec2::Zero(), s * (a.omega + 0.5 * s * a.alpha)),
          turn_b(Vec2::Zero(), s * (b.omega + 0.5 * s * b.alpha));
      const Vec2 between = a.frame.position - b.frame.position +
                           s * (a.velocity - b.velocity + 0.5 * s * (a.acceleration - b.acceleration));
      return turn_b.rotate(normal).dot(between + turn_a.rotate(arm));
    };
    // Central differences: h^2 / 12 of derivatives below 200, and four times a rounding of 1e-15 / h^2.
    const double h = 1e-4;
    EXPECT_NEAR(normalVelocity(touch, a, b), (gap(h) - gap(-h)) / (2.0 * h), 1e-6);
    EXPECT_NEAR(normalAcceleration(touch, a, b), (gap(h) - 2.0 * gap(0.0) + gap(-h)) / (h * h), 2e-6);
  }
}

TEST(Touch, GramIsTheAnswerToAnImpulse)
{
  Random random(3);
  for (int i = 0; i < 500; ++i)
  {
    std::vector<Member> members;
    for (int k = 0; k < 3; ++k)
      members.push_back(randomMember(random));
    if (i % 4 == 0)
      members[2].inverse_mass = members[2].inverse_inertia = 0.0;
    const auto between = [&](int p, int q) {
      Touch t = touchBetween(members[p], members[q], random.vector(1.0), random.vector(1.0).normalized());
      t.member_a = p;
      t.member_b = q;
      return t;
    };
    const Touch touches[] = { between(0, 1), between(1, 0), between(1, 2), between(2, 0), between(0, 1) };
    for (const Touch& p : touches)
      for (const Touch& q : touches)
      {
        // Equations (7)-(10) of a unit impulse at q.
        std::vector<Member> pushed = members;
        Member &a = pushed[q.member_a], &b = pushed[q.member_b];
        a.velocity += a.inverse_mass * q.normal;
        a.omega += a.inverse_inertia * cross(q.arm, q.normal);
        b.velocity -= b.inverse_mass * q.normal;
        b.omega -= b.inverse_inertia * cross(q.reach, q.normal);
        const double change = normalVelocity(p, pushed[p.member_a], pushed[p.member_b]) -
                              normalVelocity(p, members[p.member_a], members[p.member_b]);
        EXPECT_NEAR(contactGram(p, q, members), change, 1e-13);  // differences of velocities up to 200
      }
  }
}

TEST(Touch, GramOfStrangersAndImmovableOnesIsZero)
{
  std::vector<Member> members(4);
  members[0].inverse_mass = members[0].inverse_inertia = 1.0;
  members[1] = members[2] = members[0];
  Touch p = touchBetween(members[0], members[1], Vec2(0.0, 1.0), Vec2(0.0, 1.0)), q = p;
  p.member_a = 0;
  p.member_b = 3;
  q.member_a = 1;
  q.member_b = 3;
  EXPECT_EQ(contactGram(p, q, members), 0.0);  // both on the immovable one
  EXPECT_EQ(contactGram(p, p, members), 1.0);  // 1/m, through the centre
  p.member_b = q.member_b = -1;
  EXPECT_EQ(contactGram(p, p, members), 1.0);
  EXPECT_EQ(contactGram(p, q, members), 0.0);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
