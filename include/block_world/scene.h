#pragma once

#include <Eigen/Core>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "block_world/block.h"
#include "block_world/command.h"
#include "block_world/time.h"

namespace block_world
{
/// Immovable half-planes around the scene, each optional; positions in m.
struct Walls
{
  std::optional<double> left, right, bottom, top;
};

/// Hooke spring between a point of a block and a point of another block or of the world.
/// rest_length > 0: stiffness and damper act along the line of the two points. rest_length = 0: force -k d - c d'.
struct Spring
{
  std::string from_block;
  Eigen::Vector2d from_point = Eigen::Vector2d::Zero();  ///< body frame
  std::string to_block;                                  ///< empty: to_point is a world point
  Eigen::Vector2d to_point = Eigen::Vector2d::Zero();
  double stiffness = 1.0;    ///< N/m
  double rest_length = 0.0;  ///< m
  double damping = 0.0;      ///< N s/m
};

/// A command at an exact simulated time after load or reset.
struct TimedCommand
{
  Time time;
  Command command;
};

/// Everything that a run depends on. SI units.
struct Scene
{
  std::string name;
  double gravity = 0.0;                   ///< m/s^2, along -y
  double elasticity = 1.0;                ///< 0..1
  double damping = 0.0;                   ///< N s/m: force -k v
  double rotational_damping_ratio = 0.1;  ///< m^2: torque -k r omega
  double tolerance = 1e-6;                ///< m
  double thrust = 1.5;                    ///< N, strength of the default thrusters
  Walls walls;
  std::vector<Block> blocks;
  std::vector<Spring> springs;
  std::vector<TimedCommand> inputs;  ///< in the order of their times
};

/// Why a scene is refused: the key as a path ("blocks[2].mass") and the reason.
class SceneError : public std::runtime_error
{
public:
  SceneError(const std::string& key, const std::string& reason)
    : std::runtime_error(key.empty() ? reason : key + ": " + reason), key_(key), reason_(reason)
  {
  }
  const std::string& key() const
  {
    return key_;
  }
  const std::string& reason() const
  {
    return reason_;
  }

private:
  std::string key_, reason_;
};

/// Fills in what follows from the rest (vertices from size, polygons turned counter-clockwise and re-centred on their centre of
/// mass) and checks every number and every overlap. Throws SceneError. A completed scene is completed to itself.
/// Returns notes worth telling the user (a tolerance raised to what the coordinates can resolve).
std::vector<std::string> completeScene(Scene& scene);

}  // namespace block_world
