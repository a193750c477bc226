#include "scene.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "limits.h"

// Reads what it needs and trusts that the simulation has refused what is wrong: the checker judges runs, not scenes.

namespace checker
{
namespace
{
void read(const YAML::Node& map, const char* key, double& value)
{
  if (map[key])
    value = map[key].as<double>();
}

std::optional<double> optionalNumber(const YAML::Node& map, const char* key)
{
  return map[key] ? std::optional<double>(map[key].as<double>()) : std::nullopt;
}

Vec2 vector(const YAML::Node& node)
{
  return Vec2(node[0].as<double>(), node[1].as<double>());
}

int blockIndex(const Scene& scene, const YAML::Node& node)
{
  const auto found = scene.index.find(node.as<std::string>());
  if (found == scene.index.end())
    throw std::runtime_error("unknown block " + node.as<std::string>());
  return found->second;
}

std::vector<Thruster> defaultThrusters(const Shape& shape)
{
  Vec2 low = shape.vertices[0], high = shape.vertices[0];
  for (const Vec2& vertex : shape.vertices)
  {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vec2 size = high - low;
  const bool wide = size.x() > size.y();
  const double reach = 0.3 * std::max(size.x(), size.y());
  // Turning by -90 degrees takes (x, y) to (y, -x).
  const auto oriented = [wide](const Vec2& v) { return wide ? Vec2(v.y(), -v.x()) : v; };
  const Vec2 top = oriented(Vec2(0, reach)), bottom = oriented(Vec2(0, -reach));
  const Vec2 left = oriented(Vec2(-1, 0)), right = oriented(Vec2(1, 0));
  const Vec2 up = oriented(Vec2(0, 1)), down = oriented(Vec2(0, -1));
  return { { top, left, 0.4 },    { top, right, 0.4 },   { top, up, 1.0 },
           { bottom, down, 1.0 }, { bottom, left, 0.4 }, { bottom, right, 0.4 } };
}

Shape readShape(const YAML::Node& node)
{
  std::vector<Vec2> vertices;
  if (node["vertices"])
  {
    for (const YAML::Node& vertex : node["vertices"])
      vertices.push_back(vector(vertex));
  }
  else
  {
    const Vec2 half = node["size"] ? Vec2(0.5 * vector(node["size"])) : Vec2(0.5, 1.5);
    vertices = { { -half.x(), -half.y() }, { half.x(), -half.y() }, { half.x(), half.y() }, { -half.x(), half.y() } };
  }
  if (vertices.size() < 3)
    throw std::runtime_error("a block with fewer than three vertices");
  return makeShape(vertices);
}

Block readBlock(const YAML::Node& node, size_t number)
{
  Block block;
  block.name = node["name"] ? node["name"].as<std::string>() : "block" + std::to_string(number);
  block.shape = readShape(node);
  read(node, "mass", block.mass);
  if (node["fixed"])
    block.fixed = node["fixed"].as<bool>();
  block.start.position = vector(node["pose"]);
  block.start.angle = node["pose"][2].as<double>();
  if (node["velocity"])
  {
    block.start.velocity = vector(node["velocity"]);
    block.start.omega = node["velocity"][2].as<double>();
  }
  block.elasticity = optionalNumber(node, "elasticity");
  block.default_thrusters = !node["thrusters"];
  if (block.default_thrusters)
    block.thrusters = defaultThrusters(block.shape);
  else
  {
    for (const YAML::Node& item : node["thrusters"])
    {
      Thruster thruster{ vector(item["point"]), vector(item["direction"]).normalized(), 1.5 };
      read(item, "strength", thruster.strength);
      block.thrusters.push_back(thruster);
    }
  }
  return block;
}

void readWalls(const YAML::Node& node, Scene& scene)
{
  const auto add = [&](const char* side, const Vec2& inward) {
    if (!node[side])
      return;
    const double place = node[side].as<double>();
    scene.walls.push_back({ std::string("wall_") + side, inward, place * (inward.x() + inward.y()) });
  };
  add("left", Vec2(1, 0));
  add("right", Vec2(-1, 0));
  add("bottom", Vec2(0, 1));
  add("top", Vec2(0, -1));
  scene.floor = optionalNumber(node, "bottom");
}

// Springs of blocks beyond `count` fall away with them.
void readSpring(const YAML::Node& node, Scene& scene)
{
  Spring spring;
  const auto end = [&](const YAML::Node& from, int& body, Vec2& point) {
    if (from["point"])
      point = vector(from["point"]);
    if (!from["block"])
      return true;
    const auto found = scene.index.find(from["block"].as<std::string>());
    body = found == scene.index.end() ? -1 : found->second;
    return body >= 0;
  };
  if (!end(node["from"], spring.from, spring.from_point) || !end(node["to"], spring.to, spring.to_point))
    return;
  read(node, "stiffness", spring.stiffness);
  read(node, "rest_length", spring.rest_length);
  read(node, "damping", spring.damping);
  scene.springs.push_back(spring);
}

void readSet(const YAML::Node& node, Input& input)
{
  input.kind = Input::Set;
  input.gravity = optionalNumber(node, "gravity");
  input.elasticity = optionalNumber(node, "elasticity");
  input.damping = optionalNumber(node, "damping");
  input.thrust = optionalNumber(node, "thrust");
  input.mass = optionalNumber(node, "mass");
}

void readMouseSpring(const YAML::Node& node, Input& input)
{
  input.kind = Input::MouseSpring;
  if (node["point"])
    input.point = vector(node["point"]);
  input.anchor = vector(node["anchor"]);
  read(node, "stiffness", input.stiffness);
  read(node, "damping", input.spring_damping);
  read(node, "duration", input.duration);
}

/// The number by which the files of a run name the same nanosecond: the sum of its whole seconds and its fraction.
double instantOf(double time)
{
  const double whole = std::floor(time), sum = whole + std::round((time - whole) * 1e9) / 1e9;
  return std::abs(sum - time) <= timeResolution(time) ? sum : time;
}

Input readInput(const YAML::Node& node, const Scene& scene)
{
  Input input;
  input.time = instantOf(node["time"].as<double>());
  for (const char* kind : { "thrust", "spring", "release", "wrench" })
  {
    if (node[kind] && node[kind]["block"])
      input.body = blockIndex(scene, node[kind]["block"]);
  }
  if (node["thrust"])
  {
    input.kind = Input::Thrust;
    input.levels = node["thrust"]["levels"].as<std::vector<double>>();
    read(node["thrust"], "duration", input.duration);
  }
  else if (node["spring"])
    readMouseSpring(node["spring"], input);
  else if (node["release"])
    input.kind = Input::Release;
  else if (node["wrench"])
  {
    input.kind = Input::Wrench;
    if (node["wrench"]["force"])
      input.force = vector(node["wrench"]["force"]);
    read(node["wrench"], "torque", input.torque);
  }
  else if (node["set"])
    readSet(node["set"], input);
  else
    throw std::runtime_error("an input of unknown kind");
  if (input.body < 0 && input.kind != Input::Set && input.kind != Input::Release)
    throw std::runtime_error("an input without a block");
  return input;
}

Scene readRoot(const YAML::Node& root)
{
  Scene scene;
  read(root, "gravity", scene.gravity);
  read(root, "elasticity", scene.elasticity);
  read(root, "damping", scene.damping);
  read(root, "rotational_damping_ratio", scene.rotational_ratio);
  read(root, "tolerance", scene.tolerance);
  if (root["thrusters"])
    read(root["thrusters"], "strength", scene.thrust);
  const size_t count = root["count"] ? root["count"].as<size_t>() : root["blocks"].size();
  for (size_t i = 0; i < std::min(count, root["blocks"].size()); ++i)
  {
    scene.blocks.push_back(readBlock(root["blocks"][i], i + 1));
    scene.index[scene.blocks.back().name] = static_cast<int>(i);
  }
  if (root["walls"])
    readWalls(root["walls"], scene);
  for (size_t i = 0; i < scene.walls.size(); ++i)
    scene.index[scene.walls[i].name] = static_cast<int>(scene.blocks.size() + i);
  for (const YAML::Node& node : root["springs"])
    readSpring(node, scene);
  for (const YAML::Node& node : root["inputs"])
    scene.inputs.push_back(readInput(node, scene));
  return scene;
}
}  // namespace

Scene parseScene(const std::string& text)
{
  try
  {
    return readRoot(YAML::Load(text));
  }
  catch (const YAML::Exception& error)
  {
    throw std::runtime_error(error.what());
  }
}

Scene readScene(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw std::runtime_error(path + ": cannot be read");
  try
  {
    return parseScene(text.str());
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace checker
