// Free motion, springs and impacts of World, against closed forms and at default tolerance unless a test says
// otherwise.

#include <Eigen/Geometry>

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

// The direction of a spring whose ends meet is that in which they part, and turns from there on. Without damping the energy tells, from the states alone.
TEST(SpringMotion, EndsThatMeet)
{
  Scene scene = makeScene(3.0, 1.0, { moving(withMass(makeBox("a", { 1, 3 }, { 0.5, -0.25 }), 1.5), { 0.4, -0.3 }, 0.5) });
  Spring spring;
  spring.from_block = "a";
  spring.from_point = Vector2d(0.25, 0.75);
  spring.to_point = Vector2d(0.75, 0.5);
  spring.stiffness = 20.0;
  spring.rest_length = 0.75;
  scene.springs = { spring };
  World world(scene);
  const auto energy = [&](const MotionState& state) {
    const Vector2d end = state.position + Eigen::Rotation2Dd(state.angle) * spring.from_point;
    const double stretch = (end - spring.to_point).norm() - spring.rest_length;
    return 0.5 * 1.5 * state.velocity.squaredNorm() + 0.5 * 1.25 * state.omega * state.omega + 1.5 * 3.0 * state.position.y() +
           0.5 * spring.stiffness * stretch * stretch;
  };
  const double start = energy(world.state(0));
  for (const double t : { 0.01, 0.05, 0.2, 1.0 })
    EXPECT_NEAR(energy(stateAt(world, t)), start, 1e-13 * start) << t;  // some hundred roundings
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

// The stack is knocked over by a fast block between two walls; nothing known of the end but that it comes.
TEST(Impact, StackKnockedOver)
{
  Scene scene = shipped("stack");
  scene.walls.left = -8.0;
  scene.walls.right = 8.0;
  scene.damping = 0.5;
  scene.blocks.push_back(moving(makeBox("hammer", { 1, 1 }, { -5, 6.3 }), { 5, 0 }));
  World world(scene);
  run(world, 30.0);
  EXPECT_EQ(world.now(), Time::fromSeconds(30.0));
  EXPECT_NEAR(restingForce(world, "wall_bottom"), 11 * 9.8, 1e-3);
  expectExact(world, 1e-9);
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
