#include "replay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "block_world/scene_yaml.h"
#include "conversions.h"
#include "saved_state.h"

namespace block_world
{
namespace
{
std::string digits(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string secondsOf(std::int64_t ns)
{
  char text[48];
  std::snprintf(text, sizeof text, "%lld.%09lld s", static_cast<long long>(ns / 1000000000),
                static_cast<long long>(ns % 1000000000));
  return text;
}

const std::pair<const char*, double msg::BodyState::*> FIELDS[] = {
  { "x", &msg::BodyState::x },   { "y", &msg::BodyState::y },   { "angle", &msg::BodyState::angle },
  { "vx", &msg::BodyState::vx }, { "vy", &msg::BodyState::vy }, { "omega", &msg::BodyState::omega },
};

/// Bits, so that -0 is not 0.
bool same(double a, double b)
{
  return a == b && std::signbit(a) == std::signbit(b);
}

/// What a command does, without when and where it comes in the log.
bool samePayload(msg::Input a, msg::Input b)
{
  a.header = b.header = std_msgs::Header();
  a.index = b.index = 0;
  const auto bytes = [](const msg::Input& input) {
    std::vector<std::uint8_t> buffer(ros::serialization::serializationLength(input));
    ros::serialization::OStream stream(buffer.data(), static_cast<std::uint32_t>(buffer.size()));
    ros::serialization::serialize(stream, input);
    return buffer;
  };
  return bytes(a) == bytes(b);
}

msg::Input sceneInput(const TimedCommand& timed)
{
  msg::Input input = toInput(timed.command);
  input.time_ns = timed.time.nanoseconds();
  input.from_scene = true;
  return input;
}
}  // namespace

std::string describe(const msg::Input& input)
{
  static const char* const KINDS[] = { "THRUST", "SPRING", "WRENCH", "SET",        "SET_STATE",
                                       "SPAWN",  "DELETE", "RESET",  "LOAD_SCENE", "RESTORE" };
  const std::string kind = input.kind < std::size(KINDS) ? KINDS[input.kind] : "of kind " + std::to_string(input.kind);
  return "input " + std::to_string(input.index) + " (" + kind + (input.from_scene ? ", the scene's" : "") + ") at " +
         secondsOf(input.time_ns);
}

Replay::Replay(const RunLog& log, const std::optional<double>& tolerance)
  : log_(log), tolerance_(tolerance), world_(startWorld(log.inputs().front()))
{
}

void Replay::refuse(const msg::Input& input, const std::string& reason) const
{
  throw RunLogError(log_.path() + ": " + describe(input) + ": " + reason);
}

World Replay::startWorld(const msg::Input& input) const
{
  try
  {
    if (input.kind == msg::Input::LOAD_SCENE)
    {
      SceneOverrides overrides;
      overrides.tolerance = tolerance_;
      return World(loadSceneText(input.text, "scene", overrides), Time::fromNanoseconds(input.time_ns));
    }
    if (tolerance_)
      throw std::runtime_error("a saved state has its tolerance and cannot be given another one");
    RestoredWorld restored = restoreNotBefore(std::string(input.data.begin(), input.data.end()), input.time_ns);
    if (restored.time_ns != input.time_ns)
      throw std::runtime_error("the saved state cannot begin at this instant");
    return std::move(restored.world);
  }
  catch (const std::runtime_error& error)
  {
    refuse(input, error.what());
  }
}

void Replay::writeTo(const std::string& path)
{
  bag_ = std::make_unique<BagWriter>(path, log_.node());
  publishers_ = std::make_unique<Publishers>(Outlets{ nullptr, bag_.get(), log_.node() }, world_, "world", "");
  publish(log_.inputs().front(), Command());
}

void Replay::close()
{
  if (bag_)
    bag_->close();
}

std::string Replay::compare(const msg::BodyStates& logged)
{
  const std::vector<msg::Input>& inputs = log_.inputs();
  if (logged.inputs <= inputs.front().index)
  {
    ++left_out_;
    return std::string();
  }
  if (logged.inputs > inputs.back().index + 1)
    throw RunLogError(log_.path() + ": command " + std::to_string(inputs.back().index + 1) +
                      " is missing, which the state at " + secondsOf(logged.time_ns) + " depends on");
  std::string difference;
  while (difference.empty() && next_ < inputs.size() && inputs[next_].index < logged.inputs)
    difference = apply(inputs[next_++]);
  if (difference.empty())
    difference = advance(logged.time_ns, "the state at " + secondsOf(logged.time_ns));
  if (difference.empty())
    difference = compareSceneInputs();
  if (!difference.empty())
    return difference;
  ++states_;
  if (publishers_)
  {
    publishers_->publishState(logged.time_ns, world_.takeContacts());
    publishers_->publishOverlay(logged.time_ns);
  }
  world_.takeContacts();
  return differences(logged);
}

/// The world, up to here, and then this command.
std::string Replay::apply(const msg::Input& input)
{
  if (input.from_scene)
  {
    // The world does it by itself.
    logged_scene_inputs_.push_back(input);
    publish(input, Command());
    return std::string();
  }
  const std::string difference = advance(input.time_ns, describe(input));
  if (!difference.empty())
    return difference;
  if (input.kind == msg::Input::LOAD_SCENE || input.kind == msg::Input::RESTORE)
  {
    world_ = startWorld(input);
    publish(input, Command());
    return std::string();
  }
  Command command;
  try
  {
    command = toCommand(input);
  }
  catch (const std::runtime_error& error)
  {
    refuse(input, error.what());
  }
  const Applied applied = world_.apply(command);
  if (!applied.ok)
    return describe(input) + ": acted in the recorded run and is refused here: " + applied.reason;
  publish(input, command);
  return std::string();
}

std::string Replay::advance(std::int64_t time_ns, const std::string& what)
{
  const Time time = Time::fromNanoseconds(time_ns);
  if (time < world_.now())
    return what + ": comes after what happened at " + secondsOf(world_.now().nanoseconds()) + ", which is later";
  // Where the instant is the present one nothing is to be done: what comes due right now comes due when time goes on.
  if (time > world_.now() && world_.advance(time) < time)
    return what + ": time has stopped before: " + world_.statistics().mode;
  for (const TimedCommand& timed : world_.takeInputs())
    own_scene_inputs_.push_back(sceneInput(timed));
  return std::string();
}

/// What the scene's timed inputs did, and what the log says that they did.
std::string Replay::compareSceneInputs()
{
  for (std::size_t i = 0; i < std::max(logged_scene_inputs_.size(), own_scene_inputs_.size()); ++i)
  {
    if (i >= logged_scene_inputs_.size())
      return "the scene's " + describe(own_scene_inputs_[i]) + ": not in the log";
    if (i >= own_scene_inputs_.size())
      return describe(logged_scene_inputs_[i]) + ": does not act here";
    if (!samePayload(logged_scene_inputs_[i], own_scene_inputs_[i]))
      return describe(logged_scene_inputs_[i]) + ": is not what the scene has";
  }
  logged_scene_inputs_.clear();
  own_scene_inputs_.clear();
  return std::string();
}

void Replay::publish(const msg::Input& input, const Command& command)
{
  if (!publishers_)
    return;
  if (input.kind == msg::Input::LOAD_SCENE)
    publishers_->publishScene(input.time_ns);
  else if (input.kind == msg::Input::RESTORE)
    publishers_->publishRestored(std::string(input.data.begin(), input.data.end()), input.time_ns);
  else
    publishers_->publishInput(input.from_scene ? toCommand(input) : command, input.time_ns, input.from_scene);
  if (input.kind == msg::Input::SPAWN || input.kind == msg::Input::DELETE || input.kind == msg::Input::RESET)
    publishers_->publishBlocks(input.time_ns);
}

std::string Replay::differences(const msg::BodyStates& logged)
{
  const msg::BodyStates own = bodyStates(world_);
  if (tolerance_)
    measure(logged, own);
  if (own.state_hash == logged.state_hash)
    return std::string();
  const std::string where = secondsOf(logged.time_ns) + ", after " + describe(log_.inputs()[next_ - 1]) + ": ";
  if (own.bodies.size() != logged.bodies.size())
    return where + std::to_string(logged.bodies.size()) + " blocks in the bag, " + std::to_string(own.bodies.size()) +
           " here";
  for (std::size_t i = 0; i < own.bodies.size(); ++i)
  {
    if (own.bodies[i].name != logged.bodies[i].name)
      return where + "block " + std::to_string(i) + " is " + logged.bodies[i].name + " in the bag, " +
             own.bodies[i].name + " here";
    for (const auto& [name, member] : FIELDS)
      if (!same(own.bodies[i].*member, logged.bodies[i].*member))
        return where + own.bodies[i].name + "." + name + " is " + digits(logged.bodies[i].*member) + " in the bag, " +
               digits(own.bodies[i].*member) + " here";
  }
  return where + "state_hash is " + std::to_string(logged.state_hash) + " in the bag, " +
         std::to_string(own.state_hash) + " here: all blocks move alike, but a force in force or a parameter differs";
}

void Replay::measure(const msg::BodyStates& logged, const msg::BodyStates& own)
{
  for (std::size_t i = 0; i < std::min(own.bodies.size(), logged.bodies.size()); ++i)
  {
    const double distance = std::hypot(own.bodies[i].x - logged.bodies[i].x, own.bodies[i].y - logged.bodies[i].y);
    if (distance > largest_.distance)
      largest_ = { distance, static_cast<double>(logged.time_ns) * 1e-9, own.bodies[i].name };
  }
}

}  // namespace block_world
