#include "node.h"

#include <algorithm>
#include <csignal>
#include <limits>
#include <utility>

namespace block_world
{
namespace
{
constexpr std::int64_t MS = 1000000;            // ns
constexpr std::int64_t FOLLOWER_WAIT = 2 * MS;  // nothing wakes us when the followed clock ticks
constexpr std::int64_t WORK_SLICE = 10 * MS;    // the engine's time between two looks at the callbacks
constexpr std::int64_t LONGEST_SLICE = 100 * MS;
constexpr std::int64_t LATE_LIMIT = 250 * MS;     // what is later than this is not caught up with
constexpr std::int64_t DISPLAY_PERIOD = 33 * MS;  // at least 30 Hz, however slow the motion
constexpr std::int64_t EVENTS_AT_ONCE = 20;       // a look at the clock costs little next to this many

volatile std::sig_atomic_t end_asked = 0;

/// The first whole ns not before a time.
std::int64_t wholeNanoseconds(const Time& time)
{
  const std::int64_t nearest = time.nanoseconds();
  return Time::fromNanoseconds(nearest) < time ? nearest + 1 : nearest;
}

/// The same handle with callbacks going to a queue of our own.
ros::NodeHandle onQueue(ros::NodeHandle handle, ros::CallbackQueue& queue)
{
  handle.setCallbackQueue(&queue);
  return handle;
}

std::unique_ptr<BagWriter> openBag(const std::string& path, const std::string& caller)
{
  return path.empty() ? nullptr : std::make_unique<BagWriter>(path, caller);
}

}  // namespace

Node::Node(const ros::NodeHandle& handle, const Parameters& parameters, const SceneSource& source, Scene scene)
  : handle_(onQueue(handle, callbacks_))
  , parameters_(parameters)
  , source_(source)
  , world_(std::move(scene))
  , time_(handle_, parameters.publish_clock)
  , bag_(openBag(parameters.record, handle_.getNamespace()))
  , publishers_({ &handle_, bag_.get(), handle_.getNamespace() }, world_, parameters.frame_id, parameters.tf_prefix)
  , pacer_(time_.follows() || parameters.real_time_factor == 0.0 ? 1.0 : parameters.real_time_factor)
  , schedule_(parameters.publish_rate)
  , diagnostics_(handle_)
  , paused_(parameters.paused)
{
  ROS_INFO_STREAM("scene " << source_.name << ": " << world_.bodyCount() << " blocks; " << time_.description()
                           << (paused_ ? "; paused" : ""));
  tellNotes();
}

/// What the engine has to say about the scene: at first about its tolerance, later about timed inputs that it refuses.
void Node::tellNotes()
{
  const std::vector<std::string>& notes = world_.notes();
  for (std::size_t i = std::min(notes_told_, notes.size()); i < notes.size(); ++i)
    ROS_WARN_STREAM(source_.name << ": " << notes[i]);
  notes_told_ = notes.size();
}

void Node::end()
{
  end_asked = 1;
}

bool Node::isEnding()
{
  return end_asked != 0 || !ros::ok();
}

void Node::run()
{
  while (!isEnding() && !start())
    ros::WallDuration(0.01).sleep();
  while (!isEnding())
  {
    callbacks_.callAvailable(patience());
    catchUp();
    applyPending();
    publishDue();
  }
  closeBag();
}

/// The run is over: what has happened since the last state belongs to it.
void Node::closeBag()
{
  if (!bag_)
    return;
  if (isSettled() && now_ns_ > state_ns_)
    publishState();
  try
  {
    bag_->close();
    ROS_INFO_STREAM("recorded " << bag_->path());
  }
  catch (const std::runtime_error& error)
  {
    ROS_ERROR_STREAM(error.what());
  }
}

bool Node::start()
{
  if (!time_.findOrigin())
  {
    warnings_.warn("clock", "waiting for /clock (another simulator's, as ~publish_clock is false)");
    return false;
  }
  publishers_.setOrigin(time_.origin());
  publishers_.publishScene(now_ns_);
  subscribe();
  serveScene();
  setPaused(paused_);
  publishState();
  return true;
}

ros::WallDuration Node::patience() const
{
  const bool stalled = world_.statistics().stalled;
  if (!stalled && (!isSettled() || !pending_.empty()))
    return ros::WallDuration(0);
  std::int64_t wait = time_.follows() ? FOLLOWER_WAIT : time_.untilDue();
  if (!paused_ && !stalled && !time_.follows())
  {
    if (parameters_.real_time_factor == 0.0)
      return ros::WallDuration(0);
    wait = std::min(wait, pacer_.clockAt(schedule_.after(now_ns_)) - time_.now());
    wait = std::min(wait, state_sent_ + DISPLAY_PERIOD - steadyNow());
  }
  return ros::WallDuration(static_cast<double>(std::max<std::int64_t>(wait, 0)) * 1e-9);
}

bool Node::isSettled() const
{
  return world_.now() == Time::fromNanoseconds(now_ns_);
}

/// Brings the world to the simulated time that belongs to the present moment, as far as a slice of work will do it.
void Node::catchUp()
{
  if (world_.statistics().stalled)
  {
    warnings_.warn("stalled", world_.statistics().mode + "; reset, or load another scene");
    if (!time_.follows())
      pacer_.anchor(now_ns_, time_.now());
    return;
  }
  std::int64_t target = now_ns_;
  if (!paused_ && parameters_.real_time_factor == 0.0 && !time_.follows())
  {
    target = std::numeric_limits<std::int64_t>::max();
  }
  else if (!paused_)
  {
    // A followed clock may jump where its owner steps: then this world has to catch up however long it takes.
    const std::int64_t late = time_.follows() ? 0 : pacer_.forgive(now_ns_, time_.now(), LATE_LIMIT);
    if (late > 0)
    {
      lost_ += static_cast<double>(late - LATE_LIMIT) * 1e-9;
      warnings_.warn("late", "too slow for the real-time factor asked for: simulated time falls behind, by " +
                                 std::to_string(lost_) + " s so far");
    }
    target = std::max(now_ns_, pacer_.due(time_.now()));
  }
  advance(target, steadyNow() + WORK_SLICE);
}

/// Advances towards target, publishing the states that are due on the way; stops early at the deadline.
void Node::advance(std::int64_t target, std::int64_t deadline)
{
  while ((now_ns_ < target || !isSettled()) && !isEnding())
  {
    const std::int64_t goal = std::min(target, schedule_.after(now_ns_));
    advanceWorld(std::max(goal, wholeNanoseconds(world_.now())), deadline);
    if (!isSettled())
      return;
    logSceneInputs();
    tellNotes();
    if (schedule_.isDue(now_ns_))
      publishState();
    if (steadyNow() >= deadline)
      return;
  }
}

/// Commands act at whole ns, so the deadline moves the goal to the next of these. Events that crowd within one ns must
/// not keep services from answering either: then the world is left between two of them and goes on the next time.
void Node::advanceWorld(std::int64_t goal, std::int64_t deadline)
{
  while (world_.advance(Time::fromNanoseconds(goal), EVENTS_AT_ONCE) < Time::fromNanoseconds(goal))
  {
    const std::int64_t now = steadyNow();
    if (isEnding() || world_.statistics().stalled || now >= deadline + LONGEST_SLICE)
      return;
    if (now >= deadline)
      goal = std::min(goal, wholeNanoseconds(world_.now()));
  }
  now_ns_ = goal;
}

void Node::setPaused(bool paused)
{
  paused_ = paused;
  publishers_.setPaused(paused, now_ns_);
  pacer_.anchor(now_ns_, time_.now());
  diagnostics_.restart(now_ns_, steadyNow());
}

void Node::setRealTimeFactor(double factor)
{
  const bool was_paced = !paused_ && parameters_.real_time_factor > 0.0;
  parameters_.real_time_factor = factor;
  pacer_.setFactor(factor > 0.0 ? factor : 1.0, time_.now());
  if (!was_paced)
    pacer_.anchor(now_ns_, time_.now());
  diagnostics_.restart(now_ns_, steadyNow());
}

void Node::publishState()
{
  time_.publish(now_ns_);
  publishers_.publishState(now_ns_, world_.takeContacts());
  state_ns_ = now_ns_;
  state_sent_ = steadyNow();
  overlay_changed_ = true;
}

/// What goes by the computer's clock.
void Node::publishDue()
{
  const std::int64_t now = steadyNow();
  time_.publish(now_ns_);
  if (isSettled() && now_ns_ > state_ns_ && now >= state_sent_ + DISPLAY_PERIOD)
    publishState();
  if (overlay_changed_ && now >= overlay_sent_ + DISPLAY_PERIOD)
  {
    publishers_.publishOverlay(now_ns_);
    overlay_changed_ = false;
    overlay_sent_ = now;
  }
  if (bag_ && !bag_->error().empty() && !bag_failed_)
  {
    bag_failed_ = true;
    ROS_ERROR_STREAM(bag_->error() << "; from here on nothing is recorded");
  }
  if (diagnostics_.isDue(now))
    publishDiagnostics(now);
}

void Node::publishDiagnostics(std::int64_t now)
{
  // Others are not waited for: they forgive what is late.
  const std::int64_t late = time_.follows() && !paused_ ? pacer_.due(time_.now()) - now_ns_ : 0;
  diagnostics_.publish(world_, { now_ns_, now, paused_, time_.follows(), parameters_.real_time_factor, lost_,
                                 late > LATE_LIMIT ? static_cast<double>(late) * 1e-9 : 0.0 });
}

}  // namespace block_world
