#include "scene_checks.h"

#include <cmath>
#include <locale>
#include <map>
#include <sstream>

namespace block_world
{
namespace
{
using BlockIndex = std::map<std::string, const Block*>;

BlockIndex indexBlocks(const Scene& scene)
{
  BlockIndex index;
  for (const Block& block : scene.blocks)
    index.emplace(block.name, &block);
  return index;
}

const Block& requireBlock(const BlockIndex& index, const std::string& name, const std::string& key)
{
  const auto found = index.find(name);
  if (found == index.end())
    refuse(key, "there is no block '" + name + "'");
  return *found->second;
}

const Block& requireMovable(const BlockIndex& index, const std::string& name, const std::string& key)
{
  const Block& block = requireBlock(index, name, key);
  if (block.fixed)
    refuse(key, "block '" + name + "' is fixed");
  return block;
}

/// Checks one command of a scene's inputs; key is that of the input.
class InputCheck
{
public:
  InputCheck(const Scene& scene, const BlockIndex& index, const std::string& key)
    : scene_(scene), index_(index), key_(key)
  {
  }

  void operator()(const ThrustCommand& command) const
  {
    const std::string key = key_ + ".thrust";
    const Block& block = requireMovable(index_, command.body, key + ".block");
    const std::size_t needed = block.thrusters ? block.thrusters->size() : 6;
    if (command.levels.size() != needed)
      refuse(key + ".levels", "block '" + block.name + "' has " + std::to_string(needed) + " thrusters, given are " +
                                  std::to_string(command.levels.size()) + " levels");
    for (std::size_t i = 0; i < needed; ++i)
      requireShare(command.levels[i], indexed(key + ".levels", i));
    requireNotNegative(command.duration, key + ".duration");
  }

  void operator()(const SpringCommand& command) const
  {
    const std::string key = key_ + (command.active ? ".spring" : ".release");
    if (!command.body.empty())
      requireMovable(index_, command.body, key + ".block");
    if (!command.active)
      return;
    requireFinite(command.attach, key + ".point");
    requireFinite(command.anchor, key + ".anchor");
    requireNotNegative(command.stiffness, key + ".stiffness");
    requireNotNegative(command.damping, key + ".damping");
    requireNotNegative(command.duration, key + ".duration");
  }

  void operator()(const WrenchCommand& command) const
  {
    requireMovable(index_, command.body, key_ + ".wrench.block");
    requireFinite(command.force, key_ + ".wrench.force");
    requireFinite(command.torque, key_ + ".wrench.torque");
  }

  void operator()(const SetCommand& command) const
  {
    const std::string key = key_ + ".set";
    if (!command.gravity && !command.elasticity && !command.damping && !command.thrust && !command.mass)
      refuse(key, "sets nothing");
    if (command.gravity)
      requireNotNegative(*command.gravity, key + ".gravity");
    if (command.elasticity)
      requireShare(*command.elasticity, key + ".elasticity");
    if (command.damping)
      requireNotNegative(*command.damping, key + ".damping");
    if (command.thrust)
      requireNotNegative(*command.thrust, key + ".thrust");
    if (command.mass)
      checkMass(*command.mass, key + ".mass");
  }

  template <class Other>
  void operator()(const Other&) const
  {
    refuse(key_, "can only be one of thrust, spring, release, wrench, set");
  }

private:
  void checkMass(double mass, const std::string& key) const
  {
    requireFinite(mass, key);
    if (!(mass > 0.0))
      refuse(key, "must be > 0, is " + shown(mass));
    if (scene_.blocks.empty() || scene_.blocks.front().fixed)
      refuse(key, "is the mass of the first block, and there is none that can move");
  }

  const Scene& scene_;
  const BlockIndex& index_;
  const std::string& key_;
};

}  // namespace

void refuse(const std::string& key, const std::string& reason)
{
  throw SceneError(key, reason);
}

std::string shown(double number)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << number;
  return text.str();
}

std::string shown(const Eigen::Vector2d& vector)
{
  return "[" + shown(vector.x()) + ", " + shown(vector.y()) + "]";
}

std::string indexed(const std::string& key, std::size_t index)
{
  return key + "[" + std::to_string(index) + "]";
}

void requireFinite(double value, const std::string& key)
{
  if (!std::isfinite(value))
    refuse(key, "must be finite, is " + shown(value));
}

void requireFinite(const Eigen::Vector2d& value, const std::string& key)
{
  if (!value.allFinite())
    refuse(key, "must be finite, is " + shown(value));
}

void requireNotNegative(double value, const std::string& key)
{
  requireFinite(value, key);
  if (value < 0.0)
    refuse(key, "must be >= 0, is " + shown(value));
}

void requireShare(double value, const std::string& key)
{
  requireFinite(value, key);
  if (value < 0.0 || value > 1.0)
    refuse(key, "must be 0 to 1, is " + shown(value));
}

void checkSprings(const Scene& scene)
{
  const BlockIndex index = indexBlocks(scene);
  for (std::size_t i = 0; i < scene.springs.size(); ++i)
  {
    const Spring& spring = scene.springs[i];
    const std::string key = indexed("springs", i);
    requireBlock(index, spring.from_block, key + ".from.block");
    if (!spring.to_block.empty())
      requireBlock(index, spring.to_block, key + ".to.block");
    if (spring.to_block == spring.from_block)
      refuse(key + ".to.block", "both ends are at block '" + spring.from_block + "'");
    requireFinite(spring.from_point, key + ".from.point");
    requireFinite(spring.to_point, key + ".to.point");
    requireNotNegative(spring.stiffness, key + ".stiffness");
    requireNotNegative(spring.rest_length, key + ".rest_length");
    requireNotNegative(spring.damping, key + ".damping");
  }
}

void checkInputs(const Scene& scene)
{
  const BlockIndex index = indexBlocks(scene);
  Time last;
  for (std::size_t i = 0; i < scene.inputs.size(); ++i)
  {
    const TimedCommand& input = scene.inputs[i];
    const std::string key = indexed("inputs", i);
    if (input.time.isInfinite())
      refuse(key + ".time", "must be finite");
    if (input.time < Time())
      refuse(key + ".time", "must be >= 0, is " + shown(input.time.seconds()));
    if (input.time < last)
      refuse(key + ".time", "must not be earlier than the input before it, at " + shown(last.seconds()) + " s");
    last = input.time;
    std::visit(InputCheck(scene, index, key), input.command);
  }
}

}  // namespace block_world
