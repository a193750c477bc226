#include "block_world/scene_yaml.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <type_traits>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "colors.h"
#include "yaml_entry.h"

namespace block_world
{
namespace
{
/// A scene as read, with the places in the file of what count left of the lists.
struct Reading
{
  Scene scene;
  std::vector<std::size_t> springs, inputs;  ///< index in the file of each that is kept
};

std::array<double, 3> readColor(const YamlEntry& entry)
{
  if (entry.node().IsSequence())
  {
    const std::vector<double> parts = entry.numbers(3);
    return { { parts[0], parts[1], parts[2] } };
  }
  const std::optional<std::array<double, 3>> color = findColor(entry.text());
  if (!color)
    entry.fail("must be [r, g, b] in 0 to 1 or one of " + colorNames() + "; is '" + entry.text() + "'");
  return *color;
}

std::vector<Thruster> readThrusters(const YamlEntry& entry)
{
  std::vector<Thruster> thrusters;
  for (const YamlEntry& item : entry.list())
  {
    const YamlMapping map(item, { "point", "direction", "strength" });
    thrusters.push_back(
        { map.require("point").vector(), map.require("direction").vector(), map.require("strength").number() });
  }
  return thrusters;
}

void readShape(const YamlMapping& map, Block& block)
{
  const auto size = map.find("size");
  const auto vertices = map.find("vertices");
  if (size && vertices)
    vertices->fail("a block has either a size or vertices");
  if (vertices)
    for (const YamlEntry& vertex : vertices->list())
      block.vertices.push_back(vertex.vector());
  else
    block.size = size ? size->vector() : Eigen::Vector2d(1.0, 3.0);
}

Block readBlock(const YamlEntry& entry, std::size_t index)
{
  const YamlMapping map(
      entry, { "name", "size", "vertices", "mass", "fixed", "pose", "velocity", "elasticity", "color", "thrusters" });
  Block block;
  const auto name = map.find("name");
  block.name = name ? name->text() : "block" + std::to_string(index + 1);
  readShape(map, block);
  block.mass = map.number("mass", 1.0);
  if (const auto fixed = map.find("fixed"))
    block.fixed = fixed->flag();
  const std::vector<double> pose = map.require("pose").numbers(3);
  block.position = Eigen::Vector2d(pose[0], pose[1]);
  block.angle = pose[2];
  if (const auto given = map.find("velocity"))
  {
    const std::vector<double> velocity = given->numbers(3);
    block.velocity = Eigen::Vector2d(velocity[0], velocity[1]);
    block.omega = velocity[2];
  }
  if (const auto elasticity = map.find("elasticity"))
    block.elasticity = elasticity->number();
  const auto color = map.find("color");
  block.color = color ? readColor(*color) : *findColor("cyan");
  if (const auto thrusters = map.find("thrusters"))
    block.thrusters = readThrusters(*thrusters);
  return block;
}

Walls readWalls(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "left", "right", "bottom", "top" });
  const auto position = [&](const char* side) {
    const auto given = map.find(side);
    return given ? std::optional<double>(given->number()) : std::nullopt;
  };
  return Walls{ position("left"), position("right"), position("bottom"), position("top") };
}

Spring readSpring(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "from", "to", "stiffness", "rest_length", "damping" });
  const YamlMapping from(map.require("from"), { "block", "point" });
  const YamlMapping to(map.require("to"), { "block", "point" });
  Spring spring;
  spring.from_block = from.require("block").text();
  spring.from_point = from.require("point").vector();
  if (const auto block = to.find("block"))
  {
    spring.to_block = block->text();
    if (spring.to_block.empty())
      block->fail("must not be empty; leave it out for a world point");
  }
  spring.to_point = to.require("point").vector();
  spring.stiffness = map.number("stiffness", 1.0);
  spring.rest_length = map.number("rest_length", 0.75);
  spring.damping = map.number("damping", 0.0);
  return spring;
}

/// An instant from its decimal digits, so that 1000000.1 s is the same nanosecond as 1000000 s + 0.1 s.
Time readTime(const YamlEntry& entry)
{
  const double seconds = entry.number();
  const std::string& digits = entry.node().Scalar();
  const std::size_t point = digits.find('.');
  const std::string whole = digits.substr(0, point);
  if (point == std::string::npos || whole.empty() || digits.find_first_not_of("0123456789.") != std::string::npos)
    return std::isfinite(seconds) ? Time::fromSeconds(seconds) : Time::infinity();
  const double fraction = YAML::Node("0" + digits.substr(point)).as<double>();
  return Time::fromSeconds(std::floor(YAML::Node(whole).as<double>())) + fraction;
}

ThrustCommand readThrust(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "block", "levels", "duration" });
  return { map.require("block").text(), map.require("levels").numbers(), map.require("duration").number() };
}

SpringCommand readMouseSpring(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "block", "point", "anchor", "stiffness", "damping", "duration" });
  SpringCommand command;
  command.body = map.require("block").text();
  // Without a block the engine picks the nearest one, and the point of it.
  if (!command.body.empty() || map.find("point"))
    command.attach = map.require("point").vector();
  command.anchor = map.require("anchor").vector();
  command.stiffness = map.number("stiffness", 3.0);
  command.damping = map.number("damping", 0.0);
  command.duration = map.number("duration", 0.0);
  return command;
}

SpringCommand readRelease(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "block" });
  SpringCommand command;
  command.active = false;
  command.body = map.require("block").text();
  return command;
}

WrenchCommand readWrench(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "block", "force", "torque" });
  WrenchCommand command;
  command.body = map.require("block").text();
  if (const auto force = map.find("force"))
    command.force = force->vector();
  command.torque = map.number("torque", 0.0);
  return command;
}

SetCommand readSet(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "gravity", "elasticity", "damping", "thrust", "mass" });
  const auto value = [&](const char* key) {
    const auto given = map.find(key);
    return given ? std::optional<double>(given->number()) : std::nullopt;
  };
  return { value("gravity"), value("elasticity"), value("damping"), value("thrust"), value("mass") };
}

TimedCommand readInput(const YamlEntry& entry)
{
  const YamlMapping map(entry, { "time", "thrust", "spring", "release", "wrench", "set" });
  TimedCommand input;
  input.time = readTime(map.require("time"));
  int commands = 0;
  const auto take = [&](const char* key, const auto& read) {
    if (const auto given = map.find(key))
    {
      input.command = read(*given);
      ++commands;
    }
  };
  take("thrust", readThrust);
  take("spring", readMouseSpring);
  take("release", readRelease);
  take("wrench", readWrench);
  take("set", readSet);
  if (commands != 1)
    map.fail("must hold exactly one of thrust, spring, release, wrench, set");
  return input;
}

/// The block that a command is for; empty where it names none.
std::string bodyOf(const Command& command)
{
  if (const auto* thrust = std::get_if<ThrustCommand>(&command))
    return thrust->body;
  if (const auto* spring = std::get_if<SpringCommand>(&command))
    return spring->body;
  if (const auto* wrench = std::get_if<WrenchCommand>(&command))
    return wrench->body;
  return std::string();
}

/// Leaves the first blocks, and of springs and inputs those that need no other.
void keepFirst(std::size_t count, Reading& reading)
{
  Scene& scene = reading.scene;
  std::vector<std::string> cut;
  for (std::size_t i = count; i < scene.blocks.size(); ++i)
    cut.push_back(scene.blocks[i].name);
  scene.blocks.resize(count);
  const auto is_cut = [&](const std::string& name) { return std::find(cut.begin(), cut.end(), name) != cut.end(); };

  const auto filter = [](auto& items, std::vector<std::size_t>& places, const auto& goes) {
    std::remove_reference_t<decltype(items)> kept;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (!goes(items[i]))
      {
        kept.push_back(items[i]);
        places.push_back(i);
      }
    items = kept;
  };
  filter(scene.springs, reading.springs,
         [&](const Spring& spring) { return is_cut(spring.from_block) || is_cut(spring.to_block); });
  filter(scene.inputs, reading.inputs, [&](const TimedCommand& input) { return is_cut(bodyOf(input.command)); });
}

std::size_t readCount(const YamlMapping& map, const SceneOverrides& overrides, std::size_t blocks,
                      const std::string& file)
{
  const auto given = map.find("count");
  if (!given && !overrides.count)
    return blocks;
  const int count = overrides.count ? *overrides.count : given->wholeNumber();
  if (count >= 0 && static_cast<std::size_t>(count) <= blocks)
    return static_cast<std::size_t>(count);
  const std::string reason =
      "must be 0 to " + std::to_string(blocks) + ", the number of blocks in the file; is " + std::to_string(count);
  if (overrides.count)
    throw SceneFileError(complaint(file, 0, "count", reason));
  given->fail(reason);
}

void readLists(const YamlMapping& map, Scene& scene)
{
  if (const auto blocks = map.find("blocks"))
    for (const YamlEntry& entry : blocks->list())
      scene.blocks.push_back(readBlock(entry, scene.blocks.size()));
  if (const auto springs = map.find("springs"))
    for (const YamlEntry& entry : springs->list())
      scene.springs.push_back(readSpring(entry));
  if (const auto inputs = map.find("inputs"))
    for (const YamlEntry& entry : inputs->list())
      scene.inputs.push_back(readInput(entry));
}

Reading readScene(const YamlEntry& root, const std::string& file, const SceneOverrides& overrides)
{
  const YamlMapping map(root, { "name", "gravity", "elasticity", "damping", "rotational_damping_ratio", "tolerance",
                                "walls", "count", "blocks", "springs", "thrusters", "inputs" });
  Reading reading;
  Scene& scene = reading.scene;
  if (const auto name = map.find("name"))
    scene.name = name->text();
  scene.gravity = map.number("gravity", 0.0);
  scene.elasticity = map.number("elasticity", 1.0);
  scene.damping = map.number("damping", 0.0);
  scene.rotational_damping_ratio = map.number("rotational_damping_ratio", 0.1);
  scene.tolerance = overrides.tolerance.value_or(map.number("tolerance", 1e-6));
  if (const auto walls = map.find("walls"))
    scene.walls = readWalls(*walls);
  if (const auto thrusters = map.find("thrusters"))
    scene.thrust = YamlMapping(*thrusters, { "strength" }).number("strength", 1.5);
  readLists(map, scene);
  keepFirst(readCount(map, overrides, scene.blocks.size(), file), reading);
  return reading;
}

/// The key as the file counts it, where count has left springs or inputs out.
std::string keyInFile(const std::string& key, const Reading& reading)
{
  for (const auto& [list, places] :
       { std::make_pair("springs[", &reading.springs), std::make_pair("inputs[", &reading.inputs) })
    if (key.rfind(list, 0) == 0)
    {
      const std::size_t begin = std::strlen(list), end = key.find(']');
      return list + std::to_string(places->at(std::stoul(key.substr(begin, end - begin)))) + key.substr(end);
    }
  return key;
}

void complete(Reading& reading, const YAML::Node& root, const std::string& file, const SceneOverrides& overrides)
{
  const double tolerance = reading.scene.tolerance;
  try
  {
    completeScene(reading.scene);
  }
  catch (const SceneError& error)
  {
    const std::string key = keyInFile(error.key(), reading);
    const bool from_file = !(overrides.tolerance && key == "tolerance");
    throw SceneFileError(complaint(file, from_file ? lineOf(root, key) : 0, key, error.reason()));
  }
  reading.scene.tolerance = tolerance;
}

/// Listens to the parser for the line on which each document's content begins.
class DocumentLines : public YAML::EventHandler
{
public:
  void OnDocumentStart(const YAML::Mark&) override
  {
    begins_ = true;
  }
  void OnDocumentEnd() override
  {
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override
  {
    note(mark);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override
  {
    note(mark);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override
  {
    note(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override
  {
    note(mark);
  }
  void OnSequenceEnd() override
  {
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override
  {
    note(mark);
  }
  void OnMapEnd() override
  {
  }

  std::vector<int> lines;

private:
  void note(const YAML::Mark& mark)
  {
    if (begins_)
      lines.push_back(mark.line + 1);
    begins_ = false;
  }

  bool begins_ = false;
};

/// Refuses a second document. Not by YAML::LoadAll, which never ends where a stray comma follows the first one.
void requireOneDocument(const std::string& text, const std::string& file)
{
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentLines documents;
  while (documents.lines.size() < 2 && parser.HandleNextDocument(documents))
    ;
  if (documents.lines.size() > 1)
    throw SceneFileError(complaint(file, std::max(documents.lines[1], 1), "",
                                   "a scene file holds one YAML document, this is a second one"));
}

YAML::Node parse(const std::string& text, const std::string& file)
{
  try
  {
    requireOneDocument(text, file);
    return YAML::Load(text);
  }
  catch (const YAML::Exception& error)
  {
    throw SceneFileError(complaint(file, std::max(error.mark.line + 1, 1), "", "not valid YAML: " + error.msg));
  }
}

}  // namespace

Scene loadSceneText(const std::string& text, const std::string& name, const SceneOverrides& overrides)
{
  const YAML::Node root = parse(text, name);
  Reading reading = readScene(YamlEntry(root, name), name, overrides);
  complete(reading, root, name, overrides);
  return reading.scene;
}

Block loadBlockText(const std::string& text, const Scene& scene, const std::string& name)
{
  const YAML::Node root = parse(text, name);
  Scene alone;
  alone.tolerance = scene.tolerance;
  alone.blocks.push_back(readBlock(YamlEntry(root, name), scene.blocks.size()));
  try
  {
    completeScene(alone);
  }
  catch (const SceneError& error)
  {
    const std::string list = "blocks[0].";
    const std::string key = error.key().rfind(list, 0) == 0 ? error.key().substr(list.size()) : error.key();
    throw SceneFileError(complaint(name, lineOf(root, key), key, error.reason()));
  }
  return alone.blocks.front();
}

std::string readSceneFile(const std::string& path)
{
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  // A directory opens, but cannot be read; an empty file sets the failbit of text, which is no error.
  if (!file || (file.peek() == std::ifstream::traits_type::eof() && errno != 0))
    throw SceneFileError(path + ": cannot be read: " + std::strerror(errno));
  text << file.rdbuf();
  return text.str();
}

Scene loadSceneFile(const std::string& path, const SceneOverrides& overrides)
{
  return loadSceneText(readSceneFile(path), path, overrides);
}

}  // namespace block_world
