#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "block_world/scene.h"

namespace block_world
{
/// A private parameter that cannot be used; what() names it and says why.
class ParameterError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The node's private parameters. What is not given is the scene's.
struct Parameters
{
  std::string scene;                ///< path of a scene file
  SetCommand set;                   ///< gravity, elasticity, damping, thrust, mass
  std::optional<double> tolerance;  ///< m
  std::optional<int> count;         ///< of blocks
  double mouse_stiffness = 3.0;     ///< N/m, of a spring command that gives none
  double mouse_damping = 0.0;       ///< N s/m, of a spring command that gives none
  double real_time_factor = 1.0;    ///< simulated seconds per second; 0 = as fast as possible
  double publish_rate = 60.0;       ///< Hz, in simulated time
  bool paused = false;
  bool publish_clock = true;
  std::string frame_id = "world";
  std::string tf_prefix;
  std::string record;  ///< path of a bag file to write; empty = none
};

/// Reads and checks all; throws ParameterError.
Parameters readParameters(const ros::NodeHandle& handle);

/// Private parameters that the node does not know: most likely a typing mistake.
std::vector<std::string> unknownParameters(const ros::NodeHandle& handle);

/// A scene as it was given: kept, so that it can be built again with another number of blocks.
struct SceneSource
{
  std::string name;  ///< in messages
  std::string text;  ///< of the scene file
  std::optional<double> tolerance;
};

/// Reads the scene file. Throws SceneFileError.
SceneSource readSource(const Parameters& parameters);

/// Builds the scene with these values in place of its own. Throws SceneFileError or ParameterError.
Scene buildScene(const SceneSource& source, const std::optional<int>& count, const SetCommand& set);

}  // namespace block_world
