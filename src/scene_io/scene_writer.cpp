#include <yaml-cpp/yaml.h>

#include <iomanip>
#include <locale>
#include <sstream>

#include "block_world/scene_yaml.h"

namespace block_world
{
namespace
{
/// Numbers with all their digits, whatever the locale says.
std::string digits(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(17) << value;
  return text.str();
}

std::string quoted(const std::string& value)
{
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}

template <class Numbers>
std::string listed(const Numbers& numbers)
{
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "" : ", ") + digits(number);
  return "[" + text + "]";
}

std::string listed(const Eigen::Vector2d& vector)
{
  return "[" + digits(vector.x()) + ", " + digits(vector.y()) + "]";
}

/// Whole seconds and the digits of the fraction: as few as give the same instant back, since a double has too few for
/// both.
std::string instant(const Time& time)
{
  std::string text;
  for (const int places : { 9, 17, 40 })
  {
    std::ostringstream fraction;
    fraction.imbue(std::locale::classic());
    fraction << std::fixed << std::setprecision(places) << time.fraction();
    text = fraction.str();
    if (text.front() == '0' && YAML::Node(text).as<double>() == time.fraction())
      break;
  }
  return std::to_string(time.wholeSeconds()) + text.substr(1);
}

/// Writes the "key: value" parts of one mapping in braces.
class Braces
{
public:
  Braces& add(const std::string& key, const std::string& value)
  {
    text_ += (text_.empty() ? "" : ", ") + key + ": " + value;
    return *this;
  }
  Braces& add(const std::string& key, double value)
  {
    return add(key, digits(value));
  }
  Braces& add(const std::string& key, const std::optional<double>& value)
  {
    return value ? add(key, *value) : *this;
  }
  std::string text() const
  {
    return "{" + text_ + "}";
  }

private:
  std::string text_;
};

std::string written(const Thruster& thruster)
{
  return Braces()
      .add("point", listed(thruster.point))
      .add("direction", listed(thruster.direction))
      .add("strength", thruster.strength)
      .text();
}

void write(std::ostream& out, const Block& block)
{
  out << "  - name: " << quoted(block.name) << "\n";
  if (block.size)
    out << "    size: " << listed(*block.size) << "\n";
  else
  {
    out << "    vertices:\n";
    for (const Eigen::Vector2d& vertex : block.vertices)
      out << "      - " << listed(vertex) << "\n";
  }
  out << "    mass: " << digits(block.mass) << "\n";
  if (block.fixed)
    out << "    fixed: true\n";
  out << "    pose: " << listed(std::array<double, 3>{ { block.position.x(), block.position.y(), block.angle } })
      << "\n";
  out << "    velocity: " << listed(std::array<double, 3>{ { block.velocity.x(), block.velocity.y(), block.omega } })
      << "\n";
  if (block.elasticity)
    out << "    elasticity: " << digits(*block.elasticity) << "\n";
  out << "    color: " << listed(block.color) << "\n";
  if (!block.thrusters)
    return;
  out << "    thrusters:" << (block.thrusters->empty() ? " []" : "") << "\n";
  for (const Thruster& thruster : *block.thrusters)
    out << "      - " << written(thruster) << "\n";
}

void write(std::ostream& out, const Spring& spring)
{
  Braces to;
  if (!spring.to_block.empty())
    to.add("block", quoted(spring.to_block));
  to.add("point", listed(spring.to_point));
  out << "  - from: " << Braces().add("block", quoted(spring.from_block)).add("point", listed(spring.from_point)).text()
      << "\n"
      << "    to: " << to.text() << "\n"
      << "    stiffness: " << digits(spring.stiffness) << "\n"
      << "    rest_length: " << digits(spring.rest_length) << "\n"
      << "    damping: " << digits(spring.damping) << "\n";
}

/// A command as the inputs of a scene file hold it: "thrust: {...}".
struct CommandWriter
{
  std::string operator()(const ThrustCommand& command) const
  {
    Braces braces;
    braces.add("block", quoted(command.body)).add("levels", listed(command.levels)).add("duration", command.duration);
    return "thrust: " + braces.text();
  }
  std::string operator()(const SpringCommand& command) const
  {
    Braces braces;
    braces.add("block", quoted(command.body));
    if (!command.active)
      return "release: " + braces.text();
    braces.add("point", listed(command.attach)).add("anchor", listed(command.anchor));
    braces.add("stiffness", command.stiffness).add("damping", command.damping).add("duration", command.duration);
    return "spring: " + braces.text();
  }
  std::string operator()(const WrenchCommand& command) const
  {
    Braces braces;
    braces.add("block", quoted(command.body)).add("force", listed(command.force)).add("torque", command.torque);
    return "wrench: " + braces.text();
  }
  std::string operator()(const SetCommand& command) const
  {
    Braces braces;
    braces.add("gravity", command.gravity).add("elasticity", command.elasticity).add("damping", command.damping);
    braces.add("thrust", command.thrust).add("mass", command.mass);
    return "set: " + braces.text();
  }
  template <class Other>
  std::string operator()(const Other&) const
  {
    throw SceneError("inputs", "a scene file can only hold thrust, spring, release, wrench, set");
  }
};

}  // namespace

std::string writeScene(const Scene& scene)
{
  std::ostringstream out;
  if (!scene.name.empty())
    out << "name: " << quoted(scene.name) << "\n";
  out << "gravity: " << digits(scene.gravity) << "\n"
      << "elasticity: " << digits(scene.elasticity) << "\n"
      << "damping: " << digits(scene.damping) << "\n"
      << "rotational_damping_ratio: " << digits(scene.rotational_damping_ratio) << "\n"
      << "tolerance: " << digits(scene.tolerance) << "\n";
  const Walls& walls = scene.walls;
  out << "walls: "
      << Braces()
             .add("left", walls.left)
             .add("right", walls.right)
             .add("bottom", walls.bottom)
             .add("top", walls.top)
             .text()
      << "\n"
      << "thrusters: " << Braces().add("strength", scene.thrust).text() << "\n"
      << "blocks:" << (scene.blocks.empty() ? " []" : "") << "\n";
  for (const Block& block : scene.blocks)
    write(out, block);
  out << "springs:" << (scene.springs.empty() ? " []" : "") << "\n";
  for (const Spring& spring : scene.springs)
    write(out, spring);
  out << "inputs:" << (scene.inputs.empty() ? " []" : "") << "\n";
  for (const TimedCommand& input : scene.inputs)
    out << "  - {time: " << instant(input.time) << ", " << std::visit(CommandWriter(), input.command) << "}\n";
  return out.str();
}

}  // namespace block_world
