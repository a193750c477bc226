// What changes the scene: services, and parameters while the node runs.

#include <cmath>
#include <utility>

#include "block_world/scene_yaml.h"
#include "conversions.h"
#include "node.h"
#include "saved_state.h"
#include "topics.h"

namespace block_world
{
namespace
{
const std::pair<const char*, double BlockWorldConfig::*> NUMBERS[] = {
  { "gravity", &BlockWorldConfig::gravity },
  { "elasticity", &BlockWorldConfig::elasticity },
  { "damping", &BlockWorldConfig::damping },
  { "thrust", &BlockWorldConfig::thrust },
  { "mass", &BlockWorldConfig::mass },
  { "mouse_stiffness", &BlockWorldConfig::mouse_stiffness },
  { "mouse_damping", &BlockWorldConfig::mouse_damping },
  { "real_time_factor", &BlockWorldConfig::real_time_factor },
};

/// A value as the log tells it; one at a bound may have been clamped to it, which the caller was not told.
void tell(const char* name, double from, double to, double least, double most)
{
  const char* const remark = to == least ? " (the least there is)" : to == most ? " (the most there is)" : "";
  ROS_INFO_STREAM(name << " changed from " << from << " to " << to << remark);
}

/// What is asked for in a parameter where that is not what it is now.
std::optional<double> changed(double BlockWorldConfig::*member, const BlockWorldConfig& now,
                              const BlockWorldConfig& asked)
{
  return asked.*member == now.*member ? std::nullopt : std::optional<double>(asked.*member);
}

/// The values of a world in the form of a command.
SetCommand worldValues(const BlockWorldConfig& values)
{
  SetCommand set;
  set.gravity = values.gravity;
  set.elasticity = values.elasticity;
  set.damping = values.damping;
  set.thrust = values.thrust;
  return set;
}

}  // namespace

void Node::serveScene()
{
  for (const ros::ServiceServer& service :
       { handle_.advertiseService(topics::RESET, &Node::onReset, this),
         handle_.advertiseService(topics::LOAD_SCENE, &Node::onLoadScene, this),
         handle_.advertiseService(topics::SET_STATE, &Node::onSetState, this),
         handle_.advertiseService(topics::SPAWN_BLOCK, &Node::onSpawnBlock, this),
         handle_.advertiseService(topics::DELETE_BLOCK, &Node::onDeleteBlock, this),
         handle_.advertiseService(topics::SAVE_STATE, &Node::onSaveState, this),
         handle_.advertiseService(topics::RESTORE_STATE, &Node::onRestoreState, this) })
    services_.push_back(service);
  live_ = std::make_unique<LiveParameters>(handle_, liveValues(),
                                           [this](BlockWorldConfig& values) { onLiveChange(values); });
}

/// Brings the world to the present, with all that was asked for before; says why that is not possible just now.
std::string Node::makeReady()
{
  catchUp();
  applyPending();
  if (isSettled())
    return std::string();
  return world_.statistics().stalled ? world_.statistics().mode :
                                       "the engine is in the middle of a burst of events: try again";
}

/// Applies a command here and now and shows the state before and after it; returns why not, or nothing.
std::string Node::applyNow(const Command& command)
{
  std::string reason = makeReady();
  if (!reason.empty())
    return reason;
  if (now_ns_ > state_ns_)
    publishState();
  reason = apply(command);
  if (reason.empty())
    publishState();
  return reason;
}

/// Another world in the place of this one. If this one is in the middle of events, what is not told of it yet never
/// will be: a world that has got stuck can always be got rid of.
void Node::exchangeWorld(World world)
{
  if (isSettled() && now_ns_ > state_ns_)
    publishState();
  pending_.clear();
  world_ = std::move(world);
}

/// Another scene in the place of this one, from here and now on; returns why not, or nothing.
std::string Node::replaceWorld(const SceneSource& source, const std::optional<int>& count, const SetCommand& set)
{
  makeReady();
  try
  {
    exchangeWorld(World(buildScene(source, count, set), Time::fromNanoseconds(now_ns_)));
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  source_ = source;
  notes_told_ = 0;
  blocks_changed_ = false;
  tellNotes();
  publishers_.publishScene(now_ns_);
  showNewWorld();
  return std::string();
}

void Node::showNewWorld()
{
  publishState();
  // Loading has taken its time, which is not to be caught up with.
  if (!time_.follows())
    pacer_.anchor(now_ns_, time_.now());
}

/// A saved world in the place of this one; returns why not, or nothing.
std::string Node::restore(const std::string& path)
{
  makeReady();
  try
  {
    const std::string saved = readFile(path);
    RestoredWorld restored = restoreNotBefore(saved, now_ns_);
    exchangeWorld(std::move(restored.world));
    now_ns_ = restored.time_ns;
    publishers_.publishRestored(saved, now_ns_);
  }
  catch (const std::runtime_error& error)
  {
    return path + ": " + error.what();
  }
  // The scene from which the state comes, in case that another number of its blocks is asked for.
  source_ = { path, writeScene(world_.scene()), std::nullopt };
  notes_told_ = world_.notes().size();
  blocks_changed_ = true;
  showNewWorld();
  return std::string();
}

template <class Response>
bool Node::answer(const char* done, const std::string& reason, Response& response) const
{
  response.success = reason.empty();
  response.message = reason.empty() ? done + (" at " + std::to_string(world_.now().seconds())) + " s" : reason;
  return true;
}

bool Node::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response)
{
  std::string reason;
  if (makeReady().empty())
    reason = applyNow(ResetCommand());
  else
  {
    exchangeWorld(World(world_.loaded(), Time::fromNanoseconds(now_ns_)));
    notes_told_ = world_.notes().size();
    publishers_.publishScene(now_ns_);
    showNewWorld();
  }
  if (reason.empty())
  {
    publishers_.forgetImpulses();
    if (blocks_changed_)
      publishers_.publishBlocks(now_ns_);
    blocks_changed_ = false;
    shareLiveValues();
  }
  return answer("reset", reason, response);
}

bool Node::onLoadScene(msg::LoadScene::Request& request, msg::LoadScene::Response& response)
{
  if (request.path.empty() == request.text.empty())
    return answer("", "give either a path or a text", response);
  std::string reason;
  try
  {
    const std::string text = request.path.empty() ? request.text : readSceneFile(request.path);
    reason = replaceWorld({ request.path.empty() ? "text" : request.path, text, std::nullopt }, std::nullopt, {});
  }
  catch (const SceneFileError& error)
  {
    reason = error.what();
  }
  if (reason.empty())
    shareLiveValues();
  return answer("loaded", reason, response);
}

bool Node::onSetState(msg::SetState::Request& request, msg::SetState::Response& response)
{
  return answer("set", applyNow(toCommand(request.state)), response);
}

bool Node::onSpawnBlock(msg::SpawnBlock::Request& request, msg::SpawnBlock::Response& response)
{
  std::string reason;
  try
  {
    reason = applyNow(SpawnCommand{ loadBlockText(request.block, world_.scene()) });
  }
  catch (const SceneFileError& error)
  {
    reason = error.what();
  }
  if (reason.empty())
  {
    blocks_changed_ = true;
    publishers_.publishBlocks(now_ns_);
    shareLiveValues();
  }
  return answer("spawned", reason, response);
}

bool Node::onSaveState(msg::SaveState::Request& request, msg::SaveState::Response& response)
{
  std::string reason = makeReady();
  try
  {
    if (reason.empty())
      writeFile(request.path, world_.save());
  }
  catch (const std::runtime_error& error)
  {
    reason = request.path + ": " + error.what();
  }
  return answer("saved", reason, response);
}

bool Node::onRestoreState(msg::RestoreState::Request& request, msg::RestoreState::Response& response)
{
  const std::string reason = restore(request.path);
  if (reason.empty())
    shareLiveValues();
  return answer("restored", reason, response);
}

bool Node::onDeleteBlock(msg::DeleteBlock::Request& request, msg::DeleteBlock::Response& response)
{
  const std::string reason = applyNow(DeleteCommand{ request.name });
  if (reason.empty())
  {
    blocks_changed_ = true;
    publishers_.publishBlocks(now_ns_);
    shareLiveValues();
  }
  return answer("deleted", reason, response);
}

BlockWorldConfig Node::liveValues() const
{
  const Scene& scene = world_.scene();
  BlockWorldConfig values = BlockWorldConfig::__getDefault__();
  values.gravity = scene.gravity;
  values.elasticity = scene.elasticity;
  values.damping = scene.damping;
  values.thrust = scene.thrust;
  values.count = world_.bodyCount();
  if (world_.bodyCount() > 0)
    values.mass = world_.block(0).mass;
  values.mouse_stiffness = parameters_.mouse_stiffness;
  values.mouse_damping = parameters_.mouse_damping;
  values.real_time_factor = parameters_.real_time_factor;
  return values;
}

void Node::shareLiveValues()
{
  live_->update(liveValues());
}

/// Does what is asked for, as far as it can be done, and leaves the values that hold afterwards.
void Node::onLiveChange(BlockWorldConfig& values)
{
  const BlockWorldConfig before = liveValues(), asked = values;
  for (const std::string& reason : { changeWorld(before, asked), changeNode(asked) })
    if (!reason.empty())
      ROS_WARN_STREAM("live parameters refused: " << reason);
  values = liveValues();

  const BlockWorldConfig &least = BlockWorldConfig::__getMin__(), &most = BlockWorldConfig::__getMax__();
  for (const auto& [name, member] : NUMBERS)
    if (values.*member != before.*member)
      tell(name, before.*member, values.*member, least.*member, most.*member);
  if (values.count != before.count)
    tell("count", before.count, values.count, least.count, most.count);
}

/// Another number of blocks is another scene, with the values as they are asked for; everything else is one command.
std::string Node::changeWorld(const BlockWorldConfig& now, const BlockWorldConfig& asked)
{
  const std::optional<double> mass = changed(&BlockWorldConfig::mass, now, asked);
  if (asked.count != now.count)
  {
    if (asked.count < 1)
      return "count: must be at least 1";
    SetCommand set = worldValues(asked);
    // The first block is the scene's first only while none was spawned or deleted.
    if (mass || (!blocks_changed_ && world_.bodyCount() > 0 && !world_.isFixed(0)))
      set.mass = asked.mass;
    return replaceWorld(source_, asked.count, set);
  }
  SetCommand set;
  set.gravity = changed(&BlockWorldConfig::gravity, now, asked);
  set.elasticity = changed(&BlockWorldConfig::elasticity, now, asked);
  set.damping = changed(&BlockWorldConfig::damping, now, asked);
  set.thrust = changed(&BlockWorldConfig::thrust, now, asked);
  set.mass = mass;
  if (!set.gravity && !set.elasticity && !set.damping && !set.thrust && !set.mass)
    return std::string();
  return applyNow(set);
}

/// What concerns the node and not the world: a replay needs none of it.
std::string Node::changeNode(const BlockWorldConfig& asked)
{
  for (const double value : { asked.mouse_stiffness, asked.mouse_damping, asked.real_time_factor })
    if (!std::isfinite(value))
      return "mouse_stiffness, mouse_damping and real_time_factor must be finite";
  parameters_.mouse_stiffness = asked.mouse_stiffness;
  parameters_.mouse_damping = asked.mouse_damping;
  if (asked.real_time_factor == parameters_.real_time_factor)
    return std::string();
  if (time_.follows())
    return "real_time_factor: this world follows /clock, whose owner sets the pace";
  catchUp();
  setRealTimeFactor(asked.real_time_factor);
  return std::string();
}

}  // namespace block_world
