// What comes in: commands by topic, and services.

#include <cmath>

#include "conversions.h"
#include "node.h"
#include "topics.h"

namespace block_world
{
namespace
{
// Commands at 1 kHz fit while the engine has its longest slice; none may be dropped.
constexpr int COMMAND_QUEUE = 1000;
// ns between two looks at the clock and at Ctrl-C.
constexpr std::int64_t STEP_SLICE = 10000000;
// s, about a century: within what stamps can hold.
constexpr double LONGEST_STEP = 3e9;
}  // namespace

void Node::subscribe()
{
  // Nagle's algorithm would hold small messages back for up to 40 ms.
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  subscribers_ = { handle_.subscribe(topics::THRUST, COMMAND_QUEUE, &Node::onThrust, this, hints),
                   handle_.subscribe(topics::SPRING, COMMAND_QUEUE, &Node::onSpring, this, hints),
                   handle_.subscribe(topics::WRENCH, COMMAND_QUEUE, &Node::onWrench, this, hints) };
  services_ = { handle_.advertiseService(topics::PAUSE, &Node::onPause, this),
                handle_.advertiseService(topics::STEP, &Node::onStep, this) };
}

void Node::onThrust(const msg::Thrust::ConstPtr& message)
{
  pending_.push_back({ topics::THRUST, toCommand(*message) });
}

void Node::onSpring(const msg::SpringForce::ConstPtr& message)
{
  pending_.push_back({ topics::SPRING, toCommand(*message, parameters_.mouse_stiffness, parameters_.mouse_damping) });
}

void Node::onWrench(const geometry_msgs::WrenchStamped::ConstPtr& message)
{
  const std::string body = bodyOfFrame(world_, message->header.frame_id, parameters_.tf_prefix);
  pending_.push_back({ topics::WRENCH, toCommand(message->wrench, body) });
}

void Node::applyPending()
{
  if (!isSettled())
    return;
  for (const Pending& pending : pending_)
  {
    const std::string reason = apply(pending.command);
    // A reason begins with the field that it is about: that is the kind.
    if (!reason.empty())
      warnings_.warn(pending.topic + reason.substr(0, reason.find(':')),
                     handle_.resolveName(pending.topic) + " refused: " + reason);
  }
  pending_.clear();
}

/// Returns why not, or nothing.
std::string Node::apply(const Command& command)
{
  const Applied applied = world_.apply(command);
  if (!applied.ok)
    return applied.reason.empty() ? "not possible" : applied.reason;
  publishers_.publishInput(applied.command, now_ns_, false);
  overlay_changed_ = true;
  return std::string();
}

void Node::logSceneInputs()
{
  bool set = false;
  for (const TimedCommand& input : world_.takeInputs())
  {
    publishers_.publishInput(input.command, input.time.nanoseconds(), true);
    set = set || std::holds_alternative<SetCommand>(input.command);
  }
  if (set)
    shareLiveValues();
}

bool Node::onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response)
{
  catchUp();
  applyPending();
  if (static_cast<bool>(request.data) != paused_)
    setPaused(request.data);
  if (paused_ && isSettled() && now_ns_ > state_ns_)
    publishState();
  response.success = true;
  response.message = (paused_ ? "paused at " : "running from ") + std::to_string(world_.now().seconds()) + " s";
  return true;
}

std::vector<Node::Pending> Node::commandsOf(const msg::Step::Request& request) const
{
  std::vector<Pending> commands;
  for (const msg::Thrust& thrust : request.thrust)
    commands.push_back({ topics::THRUST, toCommand(thrust) });
  for (const msg::SpringForce& spring : request.spring)
    commands.push_back({ topics::SPRING, toCommand(spring, parameters_.mouse_stiffness, parameters_.mouse_damping) });
  for (const geometry_msgs::WrenchStamped& wrench : request.wrench)
    commands.push_back({ topics::WRENCH, toCommand(wrench.wrench, bodyOfFrame(world_, wrench.header.frame_id,
                                                                              parameters_.tf_prefix)) });
  return commands;
}

/// Applies all of them or, where one is bad, none, and says why.
std::string Node::applyAll(const std::vector<Pending>& commands)
{
  for (const Pending& pending : commands)
  {
    const Applied applied = world_.check(pending.command);
    if (!applied.ok)
      return std::string(pending.topic) + ": " + applied.reason;
  }
  for (const Pending& pending : commands)
    apply(pending.command);
  return std::string();
}

bool Node::onStep(msg::Step::Request& request, msg::Step::Response& response)
{
  const std::string busy = makeReady();
  if (!paused_)
    response.message = "refused: the world is running; call pause first";
  else if (!(request.duration >= 0.0 && request.duration <= LONGEST_STEP))
    response.message = "duration: must be finite, >= 0 and <= 3e9 s";
  else if (!busy.empty())
    response.message = busy;
  else
    response.message = applyAll(commandsOf(request));
  if (!response.message.empty())
    return true;

  const std::int64_t target = now_ns_ + std::llround(request.duration * 1e9);
  while (!isEnding() && !world_.statistics().stalled && (now_ns_ < target || !isSettled()))
  {
    advance(target, steadyNow() + STEP_SLICE);
    time_.publish(now_ns_);
  }
  response.success = now_ns_ == target;
  response.message = response.success ? "" : world_.statistics().stalled ? world_.statistics().mode : "interrupted";
  if (now_ns_ > state_ns_)
    publishState();
  time_.publish(now_ns_, true);
  response.state = publishers_.states(now_ns_);
  return true;
}

}  // namespace block_world
