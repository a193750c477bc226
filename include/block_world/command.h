#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "block_world/block.h"

namespace block_world
{
/// Sets the thrusters of a block; replaces the block's former thrust.
struct ThrustCommand
{
  std::string body;
  std::vector<double> levels;  ///< one per thruster of the block, each 0..1
  double duration = 0.0;       ///< s of simulated time; 0 switches off now
};

/// Adds, moves or removes a block's mouse spring: force -k d - c d', with d the vector from the anchor to the attachment.
struct SpringCommand
{
  bool active = true;                                ///< false releases; with an empty body, releases all
  std::string body;                                  ///< empty: the block nearest to the anchor, at its point nearest to the anchor
  Eigen::Vector2d attach = Eigen::Vector2d::Zero();  ///< m, body frame, from the centre of mass
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< m, world frame
  double stiffness = 0.0;                            ///< N/m, >= 0
  double damping = 0.0;                              ///< N s/m, >= 0
  double duration = 0.0;                             ///< s of simulated time; 0 = until released
};

/// A force along the block's own axes at its centre of mass, and a torque; held until the next one.
struct WrenchCommand
{
  std::string body;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< N, body axes
  double torque = 0.0;                              ///< N m, counter-clockwise
};

/// Changes parameters of the world. What is not given stays.
struct SetCommand
{
  std::optional<double> gravity;     ///< m/s^2, >= 0
  std::optional<double> elasticity;  ///< 0..1, of the walls and of all blocks without a value of their own
  std::optional<double> damping;     ///< N s/m, >= 0
  std::optional<double> thrust;      ///< N, strength of the default thrusters, >= 0
  std::optional<double> mass;        ///< kg, > 0, of the first block; its moment of inertia changes in proportion
};

/// Puts a movable block somewhere else; refused where it would overlap.
struct SetStateCommand
{
  std::string body;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double angle = 0.0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double omega = 0.0;
};

/// Adds a block; refused where it would overlap or its name is taken.
struct SpawnCommand
{
  Block block;
};

/// Removes a block with its springs.
struct DeleteCommand
{
  std::string body;
};

/// Brings back the scene as loaded, restarts its timed inputs and the energy account; time goes on.
struct ResetCommand
{
};

using Command = std::variant<ThrustCommand, SpringCommand, WrenchCommand, SetCommand, SetStateCommand, SpawnCommand, DeleteCommand, ResetCommand>;

/// What World::apply did.
struct Applied
{
  bool ok = false;
  std::string reason;  ///< why not; names the command's field
  Command command;     ///< the command as applied: an empty spring body is filled in
};

}  // namespace block_world
