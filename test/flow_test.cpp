#include "flow.h"

#include "motion.h"

#include <algorithm>

namespace block_world
{
namespace
{
TEST(Flow, FreeFlightIsTheParabola)
{
  Motion run;
  run.field.gravity = 9.81;
  run.bodies = { block(rectangle(1.0, 0.5), 2.0) };
  launch(run.bodies[0], Vec2(1.0, 2.0), 0.5, Vec2(3.0, 4.0), 5.0);
  run.expand();
  const Arc& arc = run.bodies[0].arc;
  EXPECT_EQ(arc.degree, 2);
  EXPECT_TRUE(std::isinf(arc.horizon));
  EXPECT_TRUE(arc.end.isInfinite());
  EXPECT_EQ(arc.series(&Coefficients::x), (Series{ 1.0, 3.0 }));
  EXPECT_EQ(arc.series(&Coefficients::y), (Series{ 2.0, 4.0, -9.81 / 2.0 }));
  EXPECT_EQ(arc.series(&Coefficients::angle), (Series{ 0.5, 5.0 }));
  EXPECT_EQ(arc.jerk, 0.0);
  EXPECT_EQ(arc.angular_jerk, 0.0);
}

TEST(Flow, NothingActsNothingMoves)
{
  Motion run;
  run.bodies = { block(rectangle(1.0, 0.5), 2.0) };
  launch(run.bodies[0], Vec2(1.0, 2.0), 0.5);
  run.expand();
  EXPECT_EQ(run.bodies[0].arc.degree, 0);
  launch(run.bodies[0], Vec2(1.0, 2.0), 0.5, Vec2(1.0, 0.0));
  run.expand();
  EXPECT_EQ(run.bodies[0].arc.degree, 1);
}

TEST(Flow, DampedFlightIsExponential)
{
  for (const double damping : { 1e-6, 0.5, 4.0, 200.0 })
  {
    SCOPED_TRACE(damping);
    Motion run;
    run.field = { 9.81, damping, 0.25 * damping };
    run.bodies = { block(rectangle(1.0, 0.5), 2.0) };
    launch(run.bodies[0], Vec2(1.0, 2.0), 0.5, Vec2(3.0, 4.0), 5.0);
    const double t = 3.0, k = damping / 2.0, turn = 0.25 * damping * run.bodies[0].inverse_inertia;
    run.runTo(t);
    // (1 - exp(-kt)) / k, and what is left of t after it, by its series where it cancels.
    const double phi = -std::expm1(-k * t) / k, psi = k * t < 1e-3 ? t * t * (0.5 - k * t / 6.0) : (t - phi) / k;
    const Snapshot now = run.at(0);
    // Rounding per arc, several hundred arcs at most: 1e-15 times positions below 30.
    expectNear(now.position, Vec2(1.0 + 3.0 * phi, 2.0 + 4.0 * phi - 9.81 * psi), 1e-11);
    EXPECT_NEAR(now.angle, 0.5 + 5.0 * -std::expm1(-turn * t) / turn, 1e-11);
    expectNear(now.velocity, Vec2(3.0 * std::exp(-k * t), 4.0 * std::exp(-k * t) - 9.81 * phi), 1e-11);
    EXPECT_NEAR(now.omega, 5.0 * std::exp(-turn * t), 1e-11);
  }
}

TEST(Flow, ThrustAndTorqueAgainstRungeKutta)
{
  Motion run;
  run.field = { 9.81, 0.3, 0.02 };
  run.bodies = { block(rectangle(1.0, 0.5), 2.0) };
  Body& body = run.bodies[0];
  launch(body, Vec2(1.0, 2.0), 0.5, Vec2(3.0, 4.0), -2.0);
  body.push = Vec2(3.0, 15.0);
  body.twist = 0.7;
  const double m = body.mass, inertia = body.inertia;
  const State y = integrate(
      [&](const State& y) {
        const double c = std::cos(y[2]), s = std::sin(y[2]);
        return State{ y[3],
                      y[4],
                      y[5],
                      (3.0 * c - 15.0 * s - 0.3 * y[3]) / m,
                      (3.0 * s + 15.0 * c - 0.3 * y[4]) / m - 9.81,
                      (0.7 - 0.02 * y[5]) / inertia };
      },
      { 1.0, 2.0, 0.5, 3.0, 4.0, -2.0 }, 2.0, 20000);
  run.runTo(2.0);
  expectState(run.at(0), y, 1e-11);  // h^4 = 1e-16 times derivatives below 1e3, 2e4 steps of rounding
}

TEST(Flow, SpringWithoutLengthIsTheDampedOscillator)
{
  Motion run;
  run.bodies = { block(rectangle(1.0, 0.5), 2.0) };
  Body& body = run.bodies[0];
  launch(body, Vec2(1.5, -0.5), 0.0, Vec2(0.0, 3.0), 1.0);
  body.mouse.active = true;
  body.mouse.anchor = Vec2(0.5, 0.5);
  body.mouse.stiffness = 50.0;
  body.mouse.damping = 0.8;
  const double t = 4.0, decay = 0.8 / 2.0 / 2.0, w = std::sqrt(25.0 - decay * decay);
  run.runTo(t);
  const double c = std::exp(-decay * t) * std::cos(w * t), s = std::exp(-decay * t) * std::sin(w * t) / w;
  const auto position = [&](const Vec2& d, const Vec2& v) { return Vec2(c * d + s * (v + decay * d)); };
  // 1e-15 per arc, about a hundred arcs.
  expectNear(run.at(0).position, Vec2(0.5, 0.5) + position(Vec2(1.0, -1.0), Vec2(0.0, 3.0)), 1e-12);
  EXPECT_NEAR(run.at(0).angle, t, 1e-12);  // held at its centre: the turn is free
}

TEST(Flow, TwoBlocksOnASpringSwingAboutTheirCentre)
{
  Motion run;
  run.bodies = { block(rectangle(1.0, 0.5), 2.0), block(rectangle(0.5, 0.5), 3.0) };
  launch(run.bodies[0], Vec2(0.0, 0.0), 0.0, Vec2(1.0, 0.0));
  launch(run.bodies[1], Vec2(2.0, 0.0), 0.0, Vec2(0.0, 0.0));
  run.links = { SpringLink{ 0, 1, Vec2::Zero(), Vec2::Zero(), 30.0, 1.5, 0.0 } };
  for (Body& body : run.bodies)
    body.springs = { 0 };
  const double t = 2.0, w = std::sqrt(30.0 * (1.0 / 2.0 + 1.0 / 3.0));
  run.runTo(t);
  // Along a line: length 1.5 + .5 cos wt - sin wt / w about a centre that moves at 2/5 m/s from 6/5 m.
  const double length = 1.5 + 0.5 * std::cos(w * t) - std::sin(w * t) / w, centre = 1.2 + 0.4 * t;
  expectNear(run.at(0).position, Vec2(centre - 0.6 * length, 0.0), 1e-12);
  expectNear(run.at(1).position, Vec2(centre + 0.4 * length, 0.0), 1e-12);
}

TEST(Flow, SpringWithLengthAndDamperAgainstRungeKutta)
{
  const Vec2 attach(0.4, 0.2), anchor(0.3, 3.0);
  for (const bool anchored_first : { false, true })
  {
    // The other end in the world, or on a fixed block, which the spring may name first.
    Motion run;
    run.field.gravity = 9.81;
    run.bodies = { block(rectangle(1.0, 0.5), 2.0), block(rectangle(1.0, 1.0), 1.0) };
    launch(run.bodies[0], Vec2(1.0, 2.0), 0.5, Vec2(1.0, 0.0), -2.0);
    run.bodies[1].fixed = true;
    run.bodies[1].arc.order[0].x = anchor.x();
    run.bodies[1].arc.order[0].y = anchor.y() - 0.25;
    run.bodies[1].arc.order[0].angle = pi / 2.0;
    run.links = { anchored_first ? SpringLink{ 1, 0, Vec2(0.25, 0.0), attach, 40.0, 1.2, 0.9 } :
                                   SpringLink{ 0, -1, attach, anchor, 40.0, 1.2, 0.9 } };
    run.bodies[0].springs = { 0 };
    const double inertia = run.bodies[0].inertia;
    const State y = integrate(
        [&](const State& y) {
          const Vec2 arm = Frame(Vec2::Zero(), y[2]).rotate(attach), d = Vec2(y[0], y[1]) + arm - anchor;
          const double length = d.norm(), rate = d.dot(Vec2(y[3], y[4]) + y[5] * perp(arm)) / length;
          const Vec2 force = -(40.0 * (length - 1.2) + 0.9 * rate) / length * d;
          return State{ y[3], y[4], y[5], force.x() / 2.0, force.y() / 2.0 - 9.81, cross(arm, force) / inertia };
        },
        { 1.0, 2.0, 0.5, 1.0, 0.0, -2.0 }, 1.5, 30000);
    run.runTo(1.5);
    expectState(run.at(0), y, 1e-10);  // h^4 = 6e-18 times derivatives of order five, below 1e6
  }
}

TEST(Flow, StackCarriesTheWeightAboveEachJoint)
{
  Motion run;
  run.field.gravity = 9.81;
  run.bodies = { wall(Vec2(0.0, 1.0), 0.0) };
  for (int i = 0; i < 10; ++i)
  {
    run.bodies.push_back(block(rectangle(1.0, 0.5), i == 9 ? 1000.0 : 1.0));
    launch(run.bodies.back(), Vec2(0.0, 0.25 + 0.5 * i));
  }
  run.findRests();
  EXPECT_EQ(run.rests.size(), 20u);
  run.expand();
  for (int i = 1; i <= 10; ++i)
  {
    double force = 0.0;
    for (const Rest& rest : run.rests)
      if (std::max(rest.touch.a, rest.touch.b) == i)
        force += rest.force[0];
    const double weight = (1000.0 + (10 - i)) * 9.81;
    EXPECT_NEAR(force / weight, 1.0, 1e-12) << i;  // eps times a condition of some thousands
    EXPECT_LT(run.at(i).acceleration.norm() + std::abs(run.at(i).alpha), 1e-12 * 9.81) << i;
  }
}

TEST(Flow, ForceOfALoadOffCentreIsSharedByTheLever)
{
  // A block on a floor, pushed down by 6 N at a quarter of its width from the middle: torque -6 * .25.
  Motion run;
  run.field.gravity = 10.0;
  run.bodies = { wall(Vec2(0.0, 1.0), 0.0), block(rectangle(1.0, 0.5), 2.0) };
  launch(run.bodies[1], Vec2(0.0, 0.25));
  run.findRests();
  run.bodies[1].push = Vec2(0.0, -6.0);
  run.bodies[1].twist = -6.0 * 0.25;
  run.expand();
  ASSERT_EQ(run.rests.size(), 2u);
  for (const Rest& rest : run.rests)
    EXPECT_NEAR(rest.force[0], rest.touch.arm.x() > 0.0 ? 10.0 + 4.5 : 10.0 + 1.5, 1e-13);
}

// A rhombus that slides down between floor and wall: (I + m l^2) q'' = -m g l cos q with l half its length, q its angle
// to the floor.
TEST(Flow, LadderFollowsItsEquation)
{
  Motion run;
  run.field.gravity = 9.81;
  const double l = 1.0, q = 1.1;
  Body ladder = block({ Vec2(-l, 0.0), Vec2(0.0, -0.1), Vec2(l, 0.0), Vec2(0.0, 0.1) }, 3.0, 0.0);
  launch(ladder, Vec2(l * std::cos(q), l * std::sin(q)), -q);  // foot at (2 l cos q, 0), head at (0, 2 l sin q)
  run.bodies = { wall(Vec2(0.0, 1.0), 0.0), wall(Vec2(1.0, 0.0), 0.0), ladder };
  run.findRests();
  ASSERT_EQ(run.rests.size(), 2u);
  const double m = 3.0, moment = ladder.inertia + m * l * l;
  run.expand();
  EXPECT_NEAR(2.0 * run.bodies[2].arc.order[2].angle, m * 9.81 * l * std::cos(q) / moment, 1e-13);
  // At the start x'' = -l sin q q'' > 0 and y'' = l cos q q'' < 0 are what the wall and the floor leave of the forces.
  const double turn = -m * 9.81 * l * std::cos(q) / moment;
  for (const Rest& rest : run.rests)
    EXPECT_NEAR(rest.force[0], rest.touch.b == 1 ? -m * l * std::sin(q) * turn : m * (9.81 + l * std::cos(q) * turn),
                1e-12);

  const State y = integrate(
      [&](const State& y) {
        return State{ y[1], -m * 9.81 * l * std::cos(y[0]) / moment };
      },
      { q, 0.0 }, 0.4, 4000);
  run.runTo(0.4);
  // 1e-15 per arc, some ten arcs; the reference h^4 = 1e-16.
  EXPECT_NEAR(-run.at(2).angle, y[0], 1e-13);
  EXPECT_NEAR(-run.at(2).omega, y[1], 1e-12);
  expectNear(run.at(2).position, Vec2(l * std::cos(y[0]), l * std::sin(y[0])), 1e-13);
  EXPECT_LT(run.worst_gap, 1e-14 * run.arcs);
}

// A block on the slope of a wedge that is free to slide back.
TEST(Flow, BlockOnAWedge)
{
  Motion run;
  run.field.gravity = 9.81;
  Body wedge =
      block({ Vec2(-2.0 / 3.0, -1.0 / 3.0), Vec2(4.0 / 3.0, -1.0 / 3.0), Vec2(-2.0 / 3.0, 2.0 / 3.0) }, 4.0, 0.0);
  launch(wedge, Vec2(0.0, 1.0 / 3.0));
  Body tip = block(rectangle(0.4, 0.4), 1.0, 0.0);
  const double angle = -std::atan(0.5);  // flat on the slope
  const Vec2 up = Vec2(1.0, 2.0).normalized(), middle(1.0 / 3.0, 0.5);
  launch(tip, middle + 0.2 * up, angle);
  run.bodies = { wall(Vec2(0.0, 1.0), 0.0), wedge, tip };
  run.findRests();
  ASSERT_EQ(run.rests.size(), 4u);
  run.runTo(0.2);
  // Textbook: the wedge slides back with a = m g sin c cos c / (M + m sin^2 c), here with tan c = 1/2.
  const double sine = std::sqrt(0.2), cosine = std::sqrt(0.8);
  const double back = 9.81 * sine * cosine / (4.0 + sine * sine);
  const double along = back * cosine + 9.81 * sine;  // of the block down the slope, relative to it
  const Vec2 slope(cosine, -sine);
  const double half = 0.5 * 0.2 * 0.2;
  // Sums of a few numbers around one in few arcs.
  expectNear(run.at(1).position, Vec2(-back * half, 1.0 / 3.0), 1e-14);
  expectNear(run.at(2).position, middle + 0.2 * up + half * (Vec2(-back, 0.0) + along * slope), 1e-14);
  EXPECT_NEAR(run.at(2).angle, angle, 1e-14);
  EXPECT_LT(run.worst_gap, 1e-14);
  for (const Rest& rest : run.rests)
    if (rest.touch.b == 1)
    {
      EXPECT_NEAR(evaluate(rest.along, rest.degree, 0.0), rest.touch.along, 1e-15);
    }
}

// A tip that slides on a seesaw that turns: the contact force changes at every order.
TEST(Flow, TurningSupportKeepsTheGapClosed)
{
  Motion run;
  run.field = { 9.81, 0.2, 0.05 };
  Body seesaw = block(rectangle(4.0, 0.2), 5.0, 0.0), tip = block(rectangle(0.5, 0.5), 2.0, 0.0);
  const double half_diagonal = std::sqrt(0.125);
  launch(seesaw, Vec2::Zero(), 0.0, Vec2::Zero(), -0.4);
  // Rides along: the same normal velocity as the point below it.
  launch(tip, Vec2(0.8, 0.1 + half_diagonal), pi / 4.0, Vec2(-0.3, -0.4 * 0.8), 0.3);
  seesaw.mouse.active = true;
  seesaw.mouse.stiffness = 400.0;
  seesaw.mouse.damping = 5.0;
  run.bodies = { seesaw, tip };
  ContactGroup group = groupOf(run.bodies);
  ASSERT_EQ(group.touches.size(), 1u);
  run.rests.push_back(Rest());
  run.rests.front().touch = group.touches.front();
  run.runTo(0.3);
  EXPECT_GT(run.rests.front().force[0], 0.0);
  EXPECT_LT(run.worst_gap, 1e-14 * run.arcs);
  EXPECT_LT(run.arcs, 100);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
