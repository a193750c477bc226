#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shape.h"

namespace checker
{
/// Pose of a centre of mass and its velocity.
struct State
{
  Vec2 position = Vec2::Zero();
  double angle = 0.0;
  Vec2 velocity = Vec2::Zero();
  double omega = 0.0;

  /// Velocity of the point of the body that is now at a world point.
  Vec2 velocityAt(const Vec2& point) const
  {
    const Vec2 arm = point - position;
    return velocity + omega * Vec2(-arm.y(), arm.x());
  }
};

struct Thruster
{
  Vec2 point, direction;  ///< body frame
  double strength = 0.0;  ///< N; a factor of the scene's thrust where the block has the default six
};

struct Block
{
  std::string name;
  Shape shape;
  double mass = 1.0;
  bool fixed = false;
  State start;
  std::optional<double> elasticity;
  std::vector<Thruster> thrusters;
  bool default_thrusters = true;
};

/// Half-plane of points with normal.p <= offset is solid.
struct Wall
{
  std::string name;
  Vec2 normal;
  double offset = 0.0;
};

/// Force along the line of its ends; with rest_length 0: -k d - c d'. to < 0: to_point is a world point.
struct Spring
{
  int from = -1, to = -1;
  Vec2 from_point = Vec2::Zero(), to_point = Vec2::Zero();
  double stiffness = 1.0, rest_length = 0.0, damping = 0.0;
};

/// A timed command of the scene file.
struct Input
{
  enum Kind
  {
    Thrust,
    MouseSpring,
    Release,
    Wrench,
    Set
  };
  double time = 0.0;
  Kind kind = Set;
  int body = -1;  ///< -1 for a release: all blocks
  std::vector<double> levels;
  double duration = 0.0;
  Vec2 point = Vec2::Zero(), anchor = Vec2::Zero();
  double stiffness = 3.0, spring_damping = 0.0;
  Vec2 force = Vec2::Zero();
  double torque = 0.0;
  std::optional<double> gravity, elasticity, damping, thrust, mass;
};

struct Scene
{
  double gravity = 0.0, elasticity = 1.0, damping = 0.0, rotational_ratio = 0.1, tolerance = 1e-6, thrust = 1.5;
  std::vector<Block> blocks;
  std::vector<Wall> walls;
  std::optional<double> floor;  ///< height of the bottom wall: where the gravity energy is zero
  std::vector<Spring> springs;
  std::vector<Input> inputs;
  std::map<std::string, int> index;  ///< of every block and, after the blocks, every wall

  bool isWall(int body) const
  {
    return body >= static_cast<int>(blocks.size());
  }
  bool movable(int body) const
  {
    return !isWall(body) && !blocks[body].fixed;
  }
  const Wall& wall(int body) const
  {
    return walls[body - blocks.size()];
  }
  const std::string& name(int body) const
  {
    return isWall(body) ? wall(body).name : blocks[body].name;
  }
};

/// Reads a scene file. Throws std::runtime_error where it cannot.
Scene readScene(const std::string& path);
Scene parseScene(const std::string& text);

}  // namespace checker
