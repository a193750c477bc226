#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace block_world
{
/// Pushes a block with strength x level along direction at point, both fixed in the body.
struct Thruster
{
  Eigen::Vector2d point = Eigen::Vector2d::Zero();       ///< m, body frame, from the centre of mass
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< body frame, unit length
  double strength = 0.0;                                 ///< N
};

/// A block as a scene describes it. Lengths in m, angles in rad counter-clockwise, masses in kg.
struct Block
{
  std::string name;
  std::optional<Eigen::Vector2d> size;    ///< width, height, for a rectangle
  std::vector<Eigen::Vector2d> vertices;  ///< convex, body frame; filled in from size by completeScene, and re-centred there
  double mass = 1.0;
  bool fixed = false;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of the centre of mass
  double angle = 0.0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double omega = 0.0;
  std::optional<double> elasticity;                ///< overrides the scene's
  std::array<double, 3> color{ { .7, .7, .7 } };   ///< red, green, blue in 0..1
  std::optional<std::vector<Thruster>> thrusters;  ///< replaces the default six
};

/// The six thrusters of a block that lists none: a table by its body-frame bounding box, times strength in N.
///
/// Of a block of height L, not wider than tall: 0 / 1 at (0, .3 L) along -x / +x, factor .4; 2 at (0, .3 L) along +y, factor 1; 3 at
/// (0, -.3 L) along -y, factor 1; 4 / 5 at (0, -.3 L) along -x / +x, factor .4. A wider block: the table turned by -90 degrees.
std::vector<Thruster> defaultThrusters(const std::vector<Eigen::Vector2d>& vertices, double strength);

}  // namespace block_world
