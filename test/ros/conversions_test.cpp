#include "conversions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "block_world/scene_yaml.h"

namespace block_world
{
namespace
{
World twoBlocks()
{
  return World(loadSceneText("blocks: [{name: a, pose: [0, 0, 0]}, {name: p_a, pose: [5, 0, 0]}, {name: b, pose: [9, "
                             "0, 0]}]"));
}
}  // namespace

TEST(Stamp, timeZeroIsOneNanosecond)
{
  EXPECT_EQ(stamp(0, 0).toNSec(), 1u);
  EXPECT_EQ(stamp(0, 1).toNSec(), 1u);
  EXPECT_EQ(stamp(0, 1500000000).toNSec(), 1500000000u);
  EXPECT_EQ(stamp(1700000000000000000, 250).toNSec(), 1700000000000000250u);
}

TEST(Command, springWithoutStiffnessGetsTheDefaults)
{
  msg::SpringForce message;
  message.active = true;
  EXPECT_EQ(toCommand(message, 3.0, 0.25).stiffness, 3.0);
  EXPECT_EQ(toCommand(message, 3.0, 0.25).damping, 0.25);
  message.damping = 1.0;
  EXPECT_EQ(toCommand(message, 3.0, 0.25).stiffness, 3.0);
  EXPECT_EQ(toCommand(message, 3.0, 0.25).damping, 1.0);
  message.stiffness = 7.0;
  message.damping = 0.0;
  EXPECT_EQ(toCommand(message, 3.0, 0.25).stiffness, 7.0);
  EXPECT_EQ(toCommand(message, 3.0, 0.25).damping, 0.0);
}

TEST(Command, wrenchIsTakenInThePlane)
{
  geometry_msgs::Wrench message;
  message.force.x = 1.0;
  message.force.y = 2.0;
  message.force.z = 3.0;
  message.torque.x = 4.0;
  message.torque.z = 5.0;
  const WrenchCommand command = toCommand(message, "a");
  EXPECT_EQ(command.body, "a");
  EXPECT_EQ(command.force, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(command.torque, 5.0);
}

TEST(BodyOfFrame, prefixAndSlashMayBeThereOrNot)
{
  const World world = twoBlocks();
  for (const char* frame : { "b", "/b", "p_b", "/p_b" })
    EXPECT_EQ(bodyOfFrame(world, frame, "p_"), "b");
  EXPECT_EQ(bodyOfFrame(world, "p_a", "p_"), "a") << "a frame's name comes before a block's";
  EXPECT_EQ(bodyOfFrame(world, "p_p_a", "p_"), "p_a");
  EXPECT_EQ(bodyOfFrame(world, "q", "p_"), "q");
  EXPECT_EQ(bodyOfFrame(world, "", "p_"), "");
}

TEST(Input, holdsWhatIsNeededToRebuildEveryCommand)
{
  msg::Input input = toInput(ThrustCommand{ "a", { 0.5, 1.0 }, 2.0 });
  EXPECT_EQ(input.kind, static_cast<int>(msg::Input::THRUST));
  const ThrustCommand thrust = toCommand(input.thrust);
  EXPECT_EQ(thrust.body, "a");
  EXPECT_EQ(thrust.levels, (std::vector<double>{ 0.5, 1.0 }));
  EXPECT_EQ(thrust.duration, 2.0);

  SpringCommand spring;
  spring.body = "a";
  spring.attach = { 0.1, 0.2 };
  spring.anchor = { 0.3, 0.4 };
  spring.stiffness = 5.0;
  spring.damping = 6.0;
  spring.duration = 7.0;
  input = toInput(spring);
  EXPECT_EQ(input.kind, static_cast<int>(msg::Input::SPRING));
  const SpringCommand same = toCommand(input.spring, 99.0, 99.0);
  EXPECT_TRUE(same.active);
  EXPECT_EQ(same.attach, spring.attach);
  EXPECT_EQ(same.anchor, spring.anchor);
  EXPECT_EQ(same.stiffness, 5.0);
  EXPECT_EQ(same.damping, 6.0);
  EXPECT_EQ(same.duration, 7.0);

  SetCommand set;
  set.elasticity = 0.5;
  set.mass = 2.0;
  input = toInput(set);
  EXPECT_EQ(input.kind, static_cast<int>(msg::Input::SET));
  EXPECT_EQ(input.names, (std::vector<std::string>{ "elasticity", "mass" }));
  EXPECT_EQ(input.values, (std::vector<double>{ 0.5, 2.0 }));

  input = toInput(SetStateCommand{ "a", { 1, 2 }, 3, { 4, 5 }, 6 });
  EXPECT_EQ(input.kind, static_cast<int>(msg::Input::SET_STATE));
  EXPECT_EQ(input.state.name, "a");
  EXPECT_EQ(input.state.angle, 3.0);
  EXPECT_EQ(input.state.vy, 5.0);

  SpawnCommand spawn;
  spawn.block = twoBlocks().block(2);
  input = toInput(spawn);
  EXPECT_EQ(input.kind, static_cast<int>(msg::Input::SPAWN));
  EXPECT_EQ(loadSceneText(input.text).blocks.at(0).name, "b");
  for (const double size : { 1e-6, 1e6 })
  {
    spawn.block.vertices = { { -size, -size }, { size, -size }, { size, size }, { -size, size } };
    spawn.block.size.reset();
    spawn.block.position.setZero();
    EXPECT_EQ(loadSceneText(toInput(spawn).text).blocks.at(0).vertices, spawn.block.vertices) << size;
  }

  EXPECT_EQ(toInput(DeleteCommand{ "a" }).body, "a");
  EXPECT_EQ(toInput(ResetCommand()).kind, static_cast<int>(msg::Input::RESET));
}

TEST(Transform, holdsTheAngleAboutZ)
{
  MotionState state;
  state.position = { 1.0, 2.0 };
  state.angle = 7.0;
  const geometry_msgs::Transform transform = toTransform(state);
  EXPECT_EQ(transform.translation.y, 2.0);
  EXPECT_EQ(transform.rotation.x, 0.0);
  EXPECT_EQ(transform.rotation.z, std::sin(3.5));
  EXPECT_EQ(transform.rotation.w, std::cos(3.5));
}

TEST(States, areInTheOrderOfTheScene)
{
  const World world = twoBlocks();
  const msg::BodyStates states = bodyStates(world);
  ASSERT_EQ(states.bodies.size(), 3u);
  EXPECT_EQ(states.bodies[1].name, "p_a");
  EXPECT_EQ(states.bodies[1].x, 5.0);
  EXPECT_EQ(states.state_hash, world.stateHash());
}

}  // namespace block_world
