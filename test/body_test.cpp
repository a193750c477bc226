#include "body.h"

#include "bodies.h"

namespace block_world
{
namespace
{
constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(Body, ParabolaByHand)
{
  Body body;
  launch(body, Vec2(1.0, 2.0), 0.5, Vec2(3.0, -1.0), 2.0, Vec2(0.0, -8.0), 4.0);
  body.arc.start = Time::fromSeconds(1e6);
  const Snapshot now = body.at(Time::fromSeconds(1e6) + 0.5);
  EXPECT_EQ(now.position, Vec2(2.5, 0.5));
  EXPECT_EQ(now.velocity, Vec2(3.0, -5.0));
  EXPECT_EQ(now.acceleration, Vec2(0.0, -8.0));
  EXPECT_EQ(now.angle, 2.0);
  EXPECT_EQ(now.omega, 4.0);
  EXPECT_EQ(now.alpha, 4.0);
}

TEST(Body, FixedBodyStaysAtAnyTime)
{
  Body body;
  body.arc.order[0].x = 3.0;
  body.arc.order[0].angle = -1.0;
  for (const Time& time : { Time(), Time::fromSeconds(1e12), Time::infinity() })
  {
    const Snapshot now = body.at(time);
    EXPECT_EQ(now.position, Vec2(3.0, 0.0));
    EXPECT_EQ(now.angle, -1.0);
    EXPECT_EQ(now.velocity, Vec2(0.0, 0.0));
    EXPECT_EQ(body.stateAt(time).position, Vec2(3.0, 0.0));
  }
}

// Every arc of degree n is c (1 + s)^n, whose derivatives are powers too; all terms are positive: 2 eps per order.
TEST(Body, EveryDegreeAgainstPowers)
{
  for (int degree = 0; degree <= kOrder; ++degree)
  {
    Body body;
    Series c{};
    c[0] = 1.0;
    for (int n = 1; n <= degree; ++n)
      c[n] = c[n - 1] * (degree + 1 - n) / n;
    for (int n = 0; n <= degree; ++n)
    {
      body.arc.order[n].x = c[n];
      body.arc.order[n].y = -2.0 * c[n];
      body.arc.order[n].angle = 3.0 * c[n];
    }
    body.arc.degree = degree;
    body.arc.start = Time::fromSeconds(5.0);
    for (const double s : { 0.0, 0.25, 1.5 })
    {
      SCOPED_TRACE(testing::Message() << "degree " << degree << " at " << s);
      const double value = std::pow(1.0 + s, degree), rate = degree * std::pow(1.0 + s, degree - 1),
                   second = degree * (degree - 1) * std::pow(1.0 + s, degree - 2);
      const double error = 3.0 * 40 * eps * std::max({ value, rate, second });
      const Time time = body.arc.start + s;
      const Snapshot now = body.at(time);
      expectNear(now.position, Vec2(value, -2.0 * value), error);
      expectNear(now.velocity, Vec2(rate, -2.0 * rate), error);
      expectNear(now.acceleration, Vec2(second, -2.0 * second), error);
      EXPECT_NEAR(now.angle, 3.0 * value, error);
      EXPECT_NEAR(now.omega, 3.0 * rate, error);
      EXPECT_NEAR(now.alpha, 3.0 * second, error);
      const MotionState state = body.stateAt(time);
      expectNear(state.position, now.position, error);
      expectNear(state.velocity, now.velocity, error);
      EXPECT_NEAR(state.angle, now.angle, error);
      EXPECT_NEAR(state.omega, now.omega, error);
    }
  }
}

TEST(Body, PushedAndSprung)
{
  Body body;
  EXPECT_FALSE(body.pushed() || body.sprung());
  body.twist = 1.0;
  EXPECT_TRUE(body.pushed());
  body.twist = 0.0;
  body.push.y() = -1.0;
  EXPECT_TRUE(body.pushed());
  body.springs.push_back(0);
  EXPECT_TRUE(body.sprung());
  body.springs.clear();
  body.mouse.active = true;
  EXPECT_TRUE(body.sprung());
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
