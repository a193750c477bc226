#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "block_world/world.h"

namespace campaign
{
using Eigen::Vector2d;

/// A block in the world, or a wall as one half-plane: the campaign's own geometry, by which it judges the engine's.
struct Outline
{
  std::vector<Vector2d> corners;       ///< counter-clockwise; none for a wall
  Vector2d inward = Vector2d::Zero();  ///< of a wall: unit, towards where blocks may be
  double offset = 0.0;                 ///< of a wall: its points p have inward.p = offset
  Vector2d centre = Vector2d::Zero();
  double radius = 0.0;
};

Outline outlineOf(const block_world::Block& block, const Vector2d& position, double angle);
std::vector<Outline> outlinesOf(const block_world::Walls& walls);

/// Separating axes: distance along the side that separates best; negative is the depth of the overlap. Beyond `enough`
/// a lower bound will do.
double separation(const Outline& a, const Outline& b, double enough = 0.0);

}  // namespace campaign
