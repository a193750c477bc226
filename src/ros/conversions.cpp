#include "conversions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "block_world/scene_yaml.h"

namespace block_world
{
namespace
{
Eigen::Vector2d toVector(const geometry_msgs::Point& point)
{
  return Eigen::Vector2d(point.x, point.y);
}

const std::pair<const char*, std::optional<double> SetCommand::*> PARAMETERS[] = {
  { "gravity", &SetCommand::gravity }, { "elasticity", &SetCommand::elasticity },
  { "damping", &SetCommand::damping }, { "thrust", &SetCommand::thrust },
  { "mass", &SetCommand::mass },
};

/// Fills in the payload of an Input, one overload per command.
struct Payload
{
  msg::Input& input;

  void operator()(const ThrustCommand& command)
  {
    input.kind = msg::Input::THRUST;
    input.thrust = toMessage(command);
  }
  void operator()(const SpringCommand& command)
  {
    input.kind = msg::Input::SPRING;
    input.spring = toMessage(command);
  }
  void operator()(const WrenchCommand& command)
  {
    input.kind = msg::Input::WRENCH;
    input.body = command.body;
    input.wrench = toMessage(command);
  }
  void operator()(const SetCommand& command)
  {
    input.kind = msg::Input::SET;
    for (const auto& [name, member] : PARAMETERS)
      if (command.*member)
      {
        input.names.push_back(name);
        input.values.push_back(*(command.*member));
      }
  }
  void operator()(const SetStateCommand& command)
  {
    input.kind = msg::Input::SET_STATE;
    input.state =
        toMessage(command.body, MotionState{ command.position, command.angle, command.velocity, command.omega });
  }
  void operator()(const SpawnCommand& command)
  {
    input.kind = msg::Input::SPAWN;
    Scene scene;
    scene.blocks.push_back(command.block);
    // One that suits the block, whatever its size: the text must load.
    double size = 0.0;
    for (const Eigen::Vector2d& vertex : command.block.vertices)
      size = std::max(size, vertex.norm());
    if (size > 0.0)
      scene.tolerance = 1e-6 * size;
    input.text = writeScene(scene);
  }
  void operator()(const DeleteCommand& command)
  {
    input.kind = msg::Input::DELETE;
    input.body = command.body;
  }
  void operator()(const ResetCommand&)
  {
    input.kind = msg::Input::RESET;
  }
};

std::uint8_t toKind(ContactKind kind)
{
  switch (kind)
  {
    case ContactKind::Impact:
      return msg::Contact::IMPACT;
    case ContactKind::RestBegin:
      return msg::Contact::REST_BEGIN;
    case ContactKind::RestEnd:
      return msg::Contact::REST_END;
    default:
      return msg::Contact::REST;
  }
}

}  // namespace

ThrustCommand toCommand(const msg::Thrust& message)
{
  return { message.body, message.levels, message.duration };
}

SpringCommand toCommand(const msg::SpringForce& message, double default_stiffness, double default_damping)
{
  SpringCommand command;
  command.active = message.active;
  command.body = message.body;
  command.attach = toVector(message.attach);
  command.anchor = toVector(message.anchor);
  command.stiffness = message.stiffness;
  command.damping = message.damping;
  command.duration = message.duration;
  if (message.stiffness == 0.0)
  {
    command.stiffness = default_stiffness;
    if (message.damping == 0.0)
      command.damping = default_damping;
  }
  return command;
}

WrenchCommand toCommand(const geometry_msgs::Wrench& message, const std::string& body)
{
  return { body, Eigen::Vector2d(message.force.x, message.force.y), message.torque.z };
}

SetStateCommand toCommand(const msg::BodyState& message)
{
  return { message.name, Eigen::Vector2d(message.x, message.y), message.angle, Eigen::Vector2d(message.vx, message.vy),
           message.omega };
}

namespace
{
SetCommand toSetCommand(const msg::Input& input)
{
  SetCommand command;
  if (input.names.size() != input.values.size())
    throw std::runtime_error("not one value per name");
  for (std::size_t i = 0; i < input.names.size(); ++i)
  {
    const auto place = std::find_if(std::begin(PARAMETERS), std::end(PARAMETERS),
                                    [&](const auto& parameter) { return input.names[i] == parameter.first; });
    if (place == std::end(PARAMETERS))
      throw std::runtime_error("there is no parameter '" + input.names[i] + "'");
    command.*(place->second) = input.values[i];
  }
  return command;
}
}  // namespace

Command toCommand(const msg::Input& input)
{
  switch (input.kind)
  {
    case msg::Input::THRUST:
      return toCommand(input.thrust);
    case msg::Input::SPRING:
      return toCommand(input.spring, 0.0, 0.0);  // none is left open
    case msg::Input::WRENCH:
      return toCommand(input.wrench, input.body);
    case msg::Input::SET:
      return toSetCommand(input);
    case msg::Input::SET_STATE:
      return toCommand(input.state);
    case msg::Input::SPAWN:
      return SpawnCommand{ loadSceneText(input.text).blocks.at(0) };
    case msg::Input::DELETE:
      return DeleteCommand{ input.body };
    case msg::Input::RESET:
      return ResetCommand();
    default:
      throw std::runtime_error("commands of kind " + std::to_string(input.kind) + " are unknown");
  }
}

std::string bodyOfFrame(const World& world, const std::string& frame, const std::string& prefix)
{
  const std::string name = frame.substr(!frame.empty() && frame[0] == '/' ? 1 : 0);
  if (name.compare(0, prefix.size(), prefix) == 0 && world.find(name.substr(prefix.size())) >= 0)
    return name.substr(prefix.size());
  return name;
}

msg::Thrust toMessage(const ThrustCommand& command)
{
  msg::Thrust message;
  message.body = command.body;
  message.levels = command.levels;
  message.duration = command.duration;
  return message;
}

msg::SpringForce toMessage(const SpringCommand& command)
{
  msg::SpringForce message;
  message.active = command.active;
  message.body = command.body;
  message.attach = toPoint(command.attach);
  message.anchor = toPoint(command.anchor);
  message.stiffness = command.stiffness;
  message.damping = command.damping;
  message.duration = command.duration;
  return message;
}

geometry_msgs::Wrench toMessage(const WrenchCommand& command)
{
  geometry_msgs::Wrench message;
  message.force.x = command.force.x();
  message.force.y = command.force.y();
  message.torque.z = command.torque;
  return message;
}

msg::Input toInput(const Command& command)
{
  msg::Input input;
  std::visit(Payload{ input }, command);
  return input;
}

msg::BodyState toMessage(const std::string& name, const MotionState& state)
{
  msg::BodyState message;
  message.name = name;
  message.x = state.position.x();
  message.y = state.position.y();
  message.angle = state.angle;
  message.vx = state.velocity.x();
  message.vy = state.velocity.y();
  message.omega = state.omega;
  return message;
}

msg::BodyStates bodyStates(const World& world)
{
  msg::BodyStates message;
  message.bodies.reserve(world.bodyCount());
  for (int body = 0; body < world.bodyCount(); ++body)
    message.bodies.push_back(toMessage(world.name(body), world.state(body)));
  message.state_hash = world.stateHash();
  return message;
}

msg::Energy energy(const World& world)
{
  const EnergyAccount energy = world.energy();
  msg::Energy message;
  message.time = world.now().seconds();
  message.gravity = energy.gravity;
  message.spring = energy.spring;
  message.translational = energy.translational;
  message.rotational = energy.rotational;
  message.total = energy.total;
  message.thrust_work = energy.thrust_work;
  message.spring_work = energy.spring_work;
  message.command_work = energy.command_work;
  message.damping_loss = energy.damping_loss;
  message.impact_loss = energy.impact_loss;
  message.balance_error = energy.balance_error;
  message.momentum_x = energy.momentum_x;
  message.momentum_y = energy.momentum_y;
  message.angular_momentum = energy.angular_momentum;
  return message;
}

msg::Contact toMessage(const World& world, const ContactEvent& contact)
{
  msg::Contact message;
  message.time = contact.time.seconds();
  message.kind = toKind(contact.kind);
  message.a = world.name(contact.a);
  message.b = world.name(contact.b);
  message.x = contact.point.x();
  message.y = contact.point.y();
  message.nx = contact.normal.x();
  message.ny = contact.normal.y();
  message.normal_velocity = contact.normal_velocity;
  message.impulse = contact.impulse;
  return message;
}

geometry_msgs::Transform toTransform(const MotionState& state)
{
  geometry_msgs::Transform transform;
  transform.translation.x = state.position.x();
  transform.translation.y = state.position.y();
  transform.rotation.z = std::sin(state.angle / 2.0);
  transform.rotation.w = std::cos(state.angle / 2.0);
  return transform;
}

geometry_msgs::Point toPoint(const Eigen::Vector2d& point, double z)
{
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = z;
  return message;
}

ros::Time stamp(std::int64_t origin_ns, std::int64_t simulated_ns)
{
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(1, origin_ns + simulated_ns)));
  return time;
}

}  // namespace block_world
