#include "closed_forms.h"

#include <gtest/gtest.h>

// The references themselves, against what is known of them.

namespace closed_form
{
namespace
{
const double pi = std::acos(-1.0);

TEST(ClosedForms, PhiFunctionsJoinTheirSeries)
{
  EXPECT_DOUBLE_EQ(phi1(0.0), 1.0);
  EXPECT_DOUBLE_EQ(phi2(0.0), 0.5);
  for (const double z : { 1e-9, 1e-3, 0.09, 0.11, 2.0 })
    EXPECT_NEAR(phi1(z), 1.0 - z * phi2(z), 1e-15);
  EXPECT_NEAR(phi2(0.1), phi2(0.1 + 1e-12), 2e-13);  // slope -1/6 and cancellation
}

TEST(ClosedForms, DampedFlight)
{
  MotionState from;
  from.position = Vector2d(1.0, 2.0);
  from.velocity = Vector2d(3.0, 4.0);
  from.omega = 5.0;
  const MotionState free = dampedFlight(from, 2.0, 1.0, 0.0, 0.1, 9.8, 2.0);
  EXPECT_DOUBLE_EQ(free.position.x(), 7.0);
  EXPECT_DOUBLE_EQ(free.position.y(), 10.0 - 19.6);
  EXPECT_DOUBLE_EQ(free.velocity.y(), 4.0 - 19.6);
  EXPECT_DOUBLE_EQ(free.angle, 10.0);
  const MotionState damped = dampedFlight(from, 2.0, 0.5, 4.0, 0.25, 9.8, 100.0);  // all decayed
  EXPECT_NEAR(damped.velocity.y(), -9.8 * 2.0 / 4.0, 1e-14);
  EXPECT_NEAR(damped.position.x(), 1.0 + 3.0 * 2.0 / 4.0, 1e-14);
  EXPECT_NEAR(damped.angle, 5.0 * 0.5 / (4.0 * 0.25), 1e-14);
}

TEST(ClosedForms, Drops)
{
  const double fall = std::sqrt(2.0 / 9.8);
  EXPECT_NEAR(elasticDrop(1.0, 9.8, fall), 0.0, 1e-15);
  EXPECT_NEAR(elasticDrop(1.0, 9.8, 20.0 * fall), 1.0, 1e-13);
  EXPECT_NEAR(0.125 + elasticDrop(0.875, 9.8, 100.0), 0.638016805657023, 1e-12);  // hard case A2; 118 periods
  const BouncingDrop drop{ 0.875, 9.8, 0.5 };
  EXPECT_NEAR(drop.restTime(), 1.2677314, 5e-8);
  EXPECT_EQ(drop.landingsFasterThan(4.0), 1);  // lands at 4.14, 2.07, ... m/s
  EXPECT_EQ(drop.landingsFasterThan(2.0), 2);
}

TEST(ClosedForms, ImpactsKeepWhatTheyMust)
{
  MotionState a, b;
  a.velocity = Vector2d(1.0, 0.2);
  a.omega = 0.7;
  b.position = Vector2d(1.0, 0.3);
  const Vector2d point(0.6, 0.4), normal(-0.6, 0.8);
  const Struck after = strike(a, 1.0, 0.2, b, 2.0, 0.5, point, normal, 0.5);
  const auto speed = [&](const MotionState& p, const MotionState& q) {
    return normal.dot(p.velocity - q.velocity) + cross(point - p.position, normal) * p.omega -
           cross(point - q.position, normal) * q.omega;
  };
  EXPECT_NEAR(speed(after.a, after.b), -0.5 * speed(a, b), 1e-15);
  EXPECT_NEAR((after.a.velocity + 2.0 * after.b.velocity - a.velocity).norm(), 0.0, 1e-15);
  const auto spin = [](const MotionState& p, double mass, double inertia) {
    return inertia * p.omega + mass * cross(p.position, p.velocity);
  };
  EXPECT_NEAR(spin(after.a, 1.0, 0.2) + spin(after.b, 2.0, 0.5), spin(a, 1.0, 0.2), 1e-15);
  const auto [va, vb] = centralImpact(1.0, 1.0, 1000.0, 0.0, 1.0);
  EXPECT_NEAR(va, -999.0 / 1001.0, 1e-15);
  EXPECT_NEAR(vb, 2.0 / 1001.0, 1e-15);
}

TEST(ClosedForms, Integral)
{
  EXPECT_NEAR(integral([](double x) { return std::exp(x); }, -1.0, 3.0), std::exp(3.0) - std::exp(-1.0), 1e-13);
  EXPECT_NEAR(integral([](double x) { return 1.0 / (1.0 + x * x); }, 0.0, 1.0), pi / 4.0, 1e-14);
}

TEST(ClosedForms, Ladder)
{
  const double top = pi / 3.0;
  const Ladder rod{ 9.8, 1.0 / 3.0, top };  // hard case D1
  EXPECT_NEAR(rod.releaseAngle(), 0.615479708670387, 1e-14);
  EXPECT_NEAR(rod.rate(rod.releaseAngle()), 2.059981669467899, 1e-14);
  EXPECT_NEAR(rod.releaseTime(), 0.459897288431071, 1e-13);
  const Ladder diamond{ 9.8, (1.0 + 0.05 * 0.05) / 6.0, top };
  EXPECT_NEAR(diamond.releaseTime(), 0.430271335196, 1e-12);
  EXPECT_NEAR(diamond.rate(diamond.releaseAngle()), 2.201819890171, 1e-12);
  EXPECT_NEAR(diamond.releaseSpeed(), 1.271221306297, 1e-12);
}

TEST(ClosedForms, SlidingFallSolvesItsEquation)
{
  const SlidingFall fall{ 9.8, 0.3, 1.1, 0.6 };
  // The rate is the derivative of the angle: central difference, error h^2 and rounding / h.
  for (const double t : { 0.05, 0.2, 0.35 })
  {
    const double h = 1e-5;
    EXPECT_NEAR(fall.timeAt(fall.angleAt(t)), t, 1e-14);
    EXPECT_NEAR((fall.angleAt(t - h) - fall.angleAt(t + h)) / (2.0 * h), fall.rate(fall.angleAt(t)), 1e-8);
  }
  // Against Lagrange's equation b'' (K^2 + R^2 cos^2 b) = R^2 sin b cos b b'^2 - g R cos b.
  const auto slope = [&](const Vector2d& y) {
    const double r = fall.distance, c = std::cos(y(0)), s = std::sin(y(0));
    return Vector2d(y(1), (r * r * s * c * y(1) * y(1) - fall.gravity * r * c) / (fall.gyration + r * r * c * c));
  };
  const Vector2d after = integrate<Vector2d>(slope, Vector2d(0.6, 0.0), 0.3, 3000);
  EXPECT_NEAR(fall.angleAt(0.3), after(0), 1e-13);
  EXPECT_NEAR(fall.rate(fall.angleAt(0.3)), -after(1), 1e-12);
}

TEST(ClosedForms, SpringBodyAgainstTheDampedOscillator)
{
  const SpringBody body{ 2.0, 1.0, 0.0, Vector2d::Zero(), Vector2d::Zero(), 30.0, 0.0, 1.5 };
  MotionState from;
  from.position = Vector2d(0.7, -0.2);
  const MotionState to = body.after(from, 3.0);
  EXPECT_NEAR(to.position.x(), dampedOscillation(0.7, 2.0, 30.0, 1.5, 3.0), 1e-13);
  EXPECT_NEAR(to.position.y(), dampedOscillation(-0.2, 2.0, 30.0, 1.5, 3.0), 1e-13);
}

TEST(ClosedForms, SpringBodyKeepsItsEnergy)
{
  const SpringBody body{ 2.0, 0.8, 3.0, Vector2d(0.3, -0.4), Vector2d(1.0, 2.0), 30.0, 0.75, 0.0 };
  MotionState from;
  from.omega = 1.0;
  const auto energy = [&](const MotionState& s) {
    const Vector2d arm(std::cos(s.angle) * 0.3 + std::sin(s.angle) * 0.4,
                       std::sin(s.angle) * 0.3 - std::cos(s.angle) * 0.4);
    const double stretch = (s.position + arm - body.anchor).norm() - body.rest;
    return s.velocity.squaredNorm() + 0.4 * s.omega * s.omega + 6.0 * s.position.y() + 15.0 * stretch * stretch;
  };
  EXPECT_NEAR(energy(body.after(from, 2.0)), energy(from), 1e-12);
}

}  // namespace
}  // namespace closed_form

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
