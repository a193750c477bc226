#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "block_world/scene_yaml.h"
#include "block_world/world.h"

// Scenes in code, and what tests ask of a world. Shipped scenes come from config/scenes.

namespace block_world
{
using Eigen::Vector2d;

const double pi = std::acos(-1.0);

inline Block makeBox(const std::string& name, const Vector2d& size, const Vector2d& position, double angle = 0.0)
{
  Block block;
  block.name = name;
  block.size = size;
  block.position = position;
  block.angle = angle;
  return block;
}

inline Block moving(Block block, const Vector2d& velocity, double omega = 0.0)
{
  block.velocity = velocity;
  block.omega = omega;
  return block;
}

inline Block withMass(Block block, double mass)
{
  block.mass = mass;
  return block;
}

inline Block fixedOne(Block block)
{
  block.fixed = true;
  return block;
}

inline Scene makeScene(double gravity, double elasticity, const std::vector<Block>& blocks,
                       const Walls& walls = Walls())
{
  Scene scene;
  scene.gravity = gravity;
  scene.elasticity = elasticity;
  scene.blocks = blocks;
  scene.walls = walls;
  return scene;
}

inline Walls onFloor(double bottom = 0.0)
{
  Walls walls;
  walls.bottom = bottom;
  return walls;
}

inline Scene shipped(const std::string& name)
{
  return loadSceneFile(std::string(BLOCK_WORLD_DIR) + "/config/scenes/" + name + ".yaml");
}

/// The scene seen in a mirror along the y axis.
inline Scene mirrored(Scene scene)
{
  completeScene(scene);
  const Walls walls = scene.walls;
  scene.walls.left.reset();
  scene.walls.right.reset();
  if (walls.left)
    scene.walls.right = -*walls.left;
  if (walls.right)
    scene.walls.left = -*walls.right;
  for (Block& block : scene.blocks)
  {
    block.position.x() *= -1.0;
    block.velocity.x() *= -1.0;
    block.angle *= -1.0;
    block.omega *= -1.0;
    for (Vector2d& vertex : block.vertices)
      vertex.x() *= -1.0;
  }
  return scene;
}

inline void run(World& world, double seconds)
{
  world.advance(Time::fromSeconds(seconds));
}

inline MotionState stateAt(World& world, double seconds, int body = 0)
{
  run(world, seconds);
  return world.state(body);
}

inline void expectState(const MotionState& found, const MotionState& wanted, double error)
{
  EXPECT_NEAR(found.position.x(), wanted.position.x(), error);
  EXPECT_NEAR(found.position.y(), wanted.position.y(), error);
  EXPECT_NEAR(found.angle, wanted.angle, error);
  EXPECT_NEAR(found.velocity.x(), wanted.velocity.x(), error);
  EXPECT_NEAR(found.velocity.y(), wanted.velocity.y(), error);
  EXPECT_NEAR(found.omega, wanted.omega, error);
}

inline void expectSameBits(const MotionState& found, const MotionState& wanted)
{
  expectState(found, wanted, 0.0);
}

/// Velocities x (axis 0) or y (axis 1) of all blocks in their order.
inline void expectSpeeds(const World& world, int axis, const std::vector<double>& wanted, double error)
{
  ASSERT_EQ(world.bodyCount(), static_cast<int>(wanted.size()));
  for (int i = 0; i < world.bodyCount(); ++i)
    EXPECT_NEAR(world.state(i).velocity[axis], wanted[i], error) << world.name(i);
}

/// Sum of the resting forces on a body.
inline double restingForce(const World& world, const std::string& body)
{
  double sum = 0.0;
  for (const ContactEvent& contact : world.restingContacts())
    if (world.name(contact.a) == body || world.name(contact.b) == body)
      sum += contact.impulse;
  return sum;
}

/// Simulated exactly, without overlap, and energy accounted for to `error` (J).
inline void expectExact(const World& world, double error)
{
  EXPECT_EQ(world.statistics().mode, "exact");
  EXPECT_LT(world.statistics().worst_overlap, world.scene().tolerance);
  EXPECT_LE(world.overlap(), world.scene().tolerance);
  EXPECT_NEAR(world.energy().balance_error, 0.0, error);
}

/// The first contact of a kind among those since last asked; fails where there is none.
inline ContactEvent firstContact(World& world, ContactKind kind)
{
  for (const ContactEvent& contact : world.takeContacts())
    if (contact.kind == kind)
      return contact;
  ADD_FAILURE() << "no such contact";
  return ContactEvent();
}

}  // namespace block_world
