#include "variants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "dice.h"

namespace campaign
{
namespace
{
using namespace block_world;

void mirror(Eigen::Vector2d& vector)
{
  vector.x() *= -1.0;
}

void mirror(Block& block)
{
  mirror(block.position);
  mirror(block.velocity);
  block.angle *= -1.0;
  block.omega *= -1.0;
  for (Eigen::Vector2d& vertex : block.vertices)
    mirror(vertex);
  // Counter-clockwise again, the first vertex first.
  if (!block.vertices.empty())
    std::reverse(block.vertices.begin() + 1, block.vertices.end());
}

/// The mirror image of each default thruster, from the table of their places.
std::vector<double> mirroredLevels(const std::vector<double>& levels, const std::vector<Eigen::Vector2d>& vertices)
{
  const std::vector<Thruster> thrusters = defaultThrusters(vertices, 1.0);
  std::vector<double> images(levels.size(), 0.0);
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (std::size_t j = 0; j < levels.size(); ++j)
    {
      Eigen::Vector2d point = thrusters[i].point, direction = thrusters[i].direction;
      mirror(point);
      mirror(direction);
      if ((point - thrusters[j].point).norm() < 1e-9 && (direction - thrusters[j].direction).norm() < 1e-9)
        images[j] = levels[i];
    }
  return images;
}

struct Mirror
{
  const std::map<std::string, std::vector<Eigen::Vector2d>>& shapes;

  void operator()(ThrustCommand& c) const
  {
    c.levels = mirroredLevels(c.levels, shapes.at(c.body));
  }
  void operator()(SpringCommand& c) const
  {
    mirror(c.attach);
    mirror(c.anchor);
  }
  void operator()(WrenchCommand& c) const
  {
    mirror(c.force);
    c.torque *= -1.0;
  }
  void operator()(SetStateCommand& c) const
  {
    mirror(c.position);
    mirror(c.velocity);
    c.angle *= -1.0;
    c.omega *= -1.0;
  }
  void operator()(SpawnCommand& c) const
  {
    mirror(c.block);
  }
  template <class Symmetric>
  void operator()(Symmetric&) const
  {
  }
};
}  // namespace

Case mirrored(const Case& item)
{
  Case image = item;
  Scene& scene = image.scene;
  std::map<std::string, std::vector<Eigen::Vector2d>> shapes;
  for (const Block& block : scene.blocks)
    shapes[block.name] = block.vertices;
  scene.walls.left.reset();
  scene.walls.right.reset();
  if (item.scene.walls.left)
    scene.walls.right = -*item.scene.walls.left;
  if (item.scene.walls.right)
    scene.walls.left = -*item.scene.walls.right;
  for (Block& block : scene.blocks)
    mirror(block);
  for (Spring& spring : scene.springs)
  {
    mirror(spring.from_point);
    mirror(spring.to_point);
  }
  for (auto* commands : { &scene.inputs, &image.script })
    for (TimedCommand& command : *commands)
      std::visit(Mirror{ shapes }, command.command);
  return image;
}

std::optional<Case> reordered(const Case& item)
{
  const std::string& first = item.scene.blocks.front().name;
  for (const TimedCommand& command : item.script)
    if (std::holds_alternative<DeleteCommand>(command.command) && bodyOf(command.command) == first)
      return std::nullopt;
  Case other = item;
  std::reverse(other.scene.blocks.begin() + 1, other.scene.blocks.end());
  return other;
}

Case disturbed(const Case& item, double length, std::uint64_t seed, double roundings)
{
  const double epsilon = roundings * std::numeric_limits<double>::epsilon();
  Case other = item;
  Dice dice(seed);
  const auto nudge = [&](double& value, double size) {
    value += (dice.chance(0.5) ? epsilon : -epsilon) * std::max(size, std::abs(value));
  };
  for (Block& block : other.scene.blocks)
  {
    if (block.fixed)
      continue;
    nudge(block.position.x(), length);
    nudge(block.position.y(), length);
    nudge(block.angle, 1.0);
    nudge(block.velocity.x(), 0.0);
    nudge(block.velocity.y(), 0.0);
    nudge(block.omega, 0.0);
  }
  return other;
}

}  // namespace campaign
