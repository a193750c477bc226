#include "commands.h"

#include <algorithm>
#include <cmath>

#include "shapes.h"

namespace campaign
{
using namespace block_world;

namespace
{
/// The instants at which runs are sampled, too: a double of seconds would lie beside most of them.
Time milliseconds(double seconds)
{
  return Time::fromNanoseconds(std::llround(1000.0 * seconds) * 1000000);
}
}  // namespace

CommandMaker::CommandMaker(Dice& dice, Case& item, const Vector2d& size) : dice_(dice), case_(item), size_(size)
{
  for (const Block& block : item.scene.blocks)
    if (!block.fixed)
      movable_.push_back(block);
}

void CommandMaker::make()
{
  if (movable_.empty())
    return;
  if (dice_.chance(0.4))
    for (int count = dice_.from(1, 8); count > 0; --count)
    {
      const Block& block = movable_[dice_.below(static_cast<int>(movable_.size()))];
      const double time = dice_.round(0.0, case_.duration);
      const Command command = inputFor(block);
      case_.scene.inputs.push_back({ milliseconds(time), command });
      if (std::holds_alternative<SpringCommand>(command) && dice_.chance(0.6))
        moveMouse(block, time);
    }
  if (dice_.chance(0.2))
    for (int number = 0, count = dice_.from(1, 5); number < count; ++number)
      case_.script.push_back({ milliseconds(dice_.round(0.0, case_.duration)), scripted(number) });
  sort();
}

void CommandMaker::sort()
{
  const auto earlier = [](const TimedCommand& p, const TimedCommand& q) { return p.time < q.time; };
  std::stable_sort(case_.scene.inputs.begin(), case_.scene.inputs.end(), earlier);
  std::stable_sort(case_.script.begin(), case_.script.end(), earlier);
}

Vector2d CommandMaker::place()
{
  return dice_.vector(0.5 * size_);
}

Vector2d CommandMaker::pointIn(const Block& block)
{
  return dice_.vector(0.3 * widthOf(block));
}

/// Ends between two samples: before or after one would be a matter of how the sum is rounded.
double CommandMaker::duration()
{
  return dice_.round(0.0, 3.0) + 0.0005;
}

/// Forces are measured by the block's mass, so that light ones do not leave for the stars.
Command CommandMaker::inputFor(const Block& block)
{
  const double mass = block.mass;
  switch (dice_.below(4))
  {
    case 0: {
      ThrustCommand thrust{ block.name, std::vector<double>(6, 0.0), duration() };
      for (double& level : thrust.levels)
        level = dice_.chance(0.5) ? 0.0 : dice_.round(0.0, 1.0);
      return thrust;
    }
    case 1: {
      SpringCommand spring;
      spring.body = block.name;
      spring.attach = pointIn(block);
      spring.anchor = place();
      spring.stiffness = Dice::few(mass * dice_.in(0.0, 30.0));
      spring.damping = dice_.chance(0.5) ? 0.0 : Dice::few(mass * dice_.in(0.0, 3.0));
      spring.duration = dice_.chance(0.5) ? 0.0 : duration();
      return spring;
    }
    case 2: {
      const double most = 8.0 * mass, turn = 0.5 * mass * widthOf(block);
      return WrenchCommand{ block.name, dice_.vector(most), dice_.round(-turn, turn) };
    }
    default:
      return set();
  }
}

SetCommand CommandMaker::set()
{
  SetCommand command;
  switch (dice_.below(5))
  {
    case 0:
      command.gravity = dice_.round(0.0, 10.0);
      break;
    case 1:
      command.elasticity = dice_.round(0.0, 1.0);
      break;
    case 2:
      command.damping = dice_.octaves(0.01, 8);
      break;
    case 3:
      command.thrust = dice_.round(0.0, 5.0);
      break;
    default:
      if (case_.scene.blocks.front().fixed)
        command.gravity = 0.0;
      else
        command.mass = dice_.octaves(0.1, 10);
  }
  return command;
}

/// The mouse drags on in steps, then may let go.
void CommandMaker::moveMouse(const Block& block, double time)
{
  SpringCommand spring = std::get<SpringCommand>(case_.scene.inputs.back().command);
  const Vector2d step = 0.05 * (place() - spring.anchor);
  for (int count = dice_.from(3, 20); count > 0; --count)
  {
    time += 0.017;
    spring.anchor += step;
    case_.scene.inputs.push_back({ milliseconds(Dice::few(time)), spring });
  }
  if (!dice_.chance(0.5))
    return;
  SpringCommand release;
  release.active = false;
  release.body = block.name;
  case_.scene.inputs.push_back({ milliseconds(Dice::few(time + dice_.in(0.0, 2.0))), release });
}

Command CommandMaker::scripted(int number)
{
  const Block& block = movable_[dice_.below(static_cast<int>(movable_.size()))];
  const Vector2d velocity = dice_.vector(3.0);
  switch (dice_.below(3))
  {
    case 0:
      return SetStateCommand{ block.name, place(), dice_.round(-3.0, 3.0), velocity, dice_.round(-3.0, 3.0) };
    case 1:
      return DeleteCommand{ block.name };
    default: {
      Block spawned = makeShape(dice_);
      spawned.size.reset();
      spawned.name = "s" + std::to_string(number + 1);
      spawned.mass = dice_.octaves(0.1, 10);
      spawned.position = place();
      spawned.angle = dice_.round(-3.0, 3.0);
      spawned.velocity = velocity;
      return SpawnCommand{ spawned };
    }
  }
}

}  // namespace campaign
