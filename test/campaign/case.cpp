#include "case.h"

#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "block_world/scene_yaml.h"

namespace campaign
{
namespace
{
using namespace block_world;

void write(std::ostream& out, const Eigen::Vector2d& position, double angle, const Eigen::Vector2d& velocity,
           double omega)
{
  out << ' ' << position.x() << ' ' << position.y() << ' ' << angle << ' ' << velocity.x() << ' ' << velocity.y() << ' '
      << omega;
}

/// One line of a script: time, command, block, numbers.
void write(std::ostream& out, const TimedCommand& item)
{
  out << item.time.seconds() << ' ';
  if (const auto* gone = std::get_if<DeleteCommand>(&item.command))
    out << "delete " << gone->body;
  else if (const auto* put = std::get_if<SetStateCommand>(&item.command))
  {
    out << "set_state " << put->body;
    write(out, put->position, put->angle, put->velocity, put->omega);
  }
  else
  {
    const Block& block = std::get<SpawnCommand>(item.command).block;
    out << "spawn " << block.name;
    write(out, block.position, block.angle, block.velocity, block.omega);
    out << ' ' << block.mass << ' ' << block.elasticity.value_or(-1.0) << ' ' << block.vertices.size();
    for (const Eigen::Vector2d& vertex : block.vertices)
      out << ' ' << vertex.x() << ' ' << vertex.y();
  }
  out << '\n';
}

TimedCommand read(const std::string& line)
{
  std::istringstream in(line);
  double time = 0.0;
  std::string kind;
  Block block;
  in >> time >> kind >> block.name;
  const auto state = [&] {
    in >> block.position.x() >> block.position.y() >> block.angle >> block.velocity.x() >> block.velocity.y() >>
        block.omega;
  };
  TimedCommand item{ Time::fromSeconds(time), DeleteCommand{ block.name } };
  if (kind == "set_state")
  {
    state();
    item.command = SetStateCommand{ block.name, block.position, block.angle, block.velocity, block.omega };
  }
  else if (kind == "spawn")
  {
    double elasticity = 0.0;
    std::size_t corners = 0;
    state();
    in >> block.mass >> elasticity >> corners;
    if (elasticity >= 0.0)
      block.elasticity = elasticity;
    block.vertices.resize(corners);
    for (Eigen::Vector2d& vertex : block.vertices)
      in >> vertex.x() >> vertex.y();
    item.command = SpawnCommand{ block };
  }
  else if (kind != "delete")
    throw std::runtime_error("a script holds delete, set_state and spawn: " + line);
  if (!in)
    throw std::runtime_error("a line of a script cannot be read: " + line);
  return item;
}

template <class Named>
auto bodyIn(const Named& command, int) -> decltype(command.body)
{
  return command.body;
}

template <class Nameless>
std::string bodyIn(const Nameless&, long)
{
  return std::string();
}

std::string writeScript(const Case& item)
{
  std::ostringstream out;
  out << std::setprecision(17);
  for (const TimedCommand& command : item.script)
    write(out, command);
  return out.str();
}

std::vector<TimedCommand> readScript(std::istream& in)
{
  std::vector<TimedCommand> script;
  for (std::string line; std::getline(in, line);)
    script.push_back(read(line));
  return script;
}
}  // namespace

std::string scriptPath(const std::string& scene_path)
{
  return scene_path + ".script";
}

void saveCase(const Case& item, const std::string& scene_path)
{
  std::ofstream scene(scene_path);
  if (!(scene << writeScene(item.scene)).flush())
    throw std::runtime_error(scene_path + ": cannot be written");
  if (item.fitsSceneFile())
    return;
  std::ofstream script(scriptPath(scene_path));
  if (!(script << writeScript(item)).flush())
    throw std::runtime_error(scriptPath(scene_path) + ": cannot be written");
}

Case loadCase(const std::string& scene_path, double duration)
{
  Case item;
  item.scene = loadSceneFile(scene_path);
  item.duration = duration;
  std::ifstream script(scriptPath(scene_path));
  if (script)
    item.script = readScript(script);
  return item;
}

Case throughFile(const Case& item)
{
  Case read = item;
  read.scene = loadSceneText(writeScene(item.scene));
  std::istringstream script(writeScript(item));
  read.script = readScript(script);
  return read;
}

std::string bodyOf(const Command& command)
{
  return std::visit([](const auto& c) { return bodyIn(c, 0); }, command);
}

}  // namespace campaign
