#include "joy_teleop.h"

#include <ros/console.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "messages.h"
#include "topics.h"

namespace block_world
{
namespace
{
constexpr double REFRESH = 0.1;  // s of the computer's clock, of a thrust that is held
// s of simulated time: what is left of a thrust when this program dies.
constexpr double THRUST_DURATION = 0.5;

std::string inNode(const char* name)
{
  return std::string(topics::NODE) + "/" + name;
}

int readIndex(const ros::NodeHandle& handle, const std::string& name, int otherwise)
{
  int index = otherwise;
  if (handle.hasParam(name) && (!handle.getParam(name, index) || index < 0))
    throw std::runtime_error("parameter " + handle.resolveName(name) + ": must be a whole number >= 0");
  return index;
}

}  // namespace

std::vector<double> thrustLevels(double right, double forward, double spin)
{
  const auto positive = [](double value) { return std::max(value, 0.0); };
  // Thrusters 0 and 4 push to the left, 1 and 5 to the right, 2 forward, 3 back; 0 and 5 spin counter-clockwise.
  std::vector<double> levels = {
    positive(-right) + positive(spin),  positive(right) + positive(-spin), positive(forward), positive(-forward),
    positive(-right) + positive(-spin), positive(right) + positive(spin)
  };
  for (double& level : levels)
    level = std::min(level, 1.0);
  return levels;
}

JoyTeleop::JoyTeleop() : levels_(thrustLevels(0.0, 0.0, 0.0))
{
  const ros::NodeHandle own("~");
  layout_.side_axis = readIndex(own, "side_axis", layout_.side_axis);
  layout_.forward_axis = readIndex(own, "forward_axis", layout_.forward_axis);
  layout_.spin_axis = readIndex(own, "spin_axis", layout_.spin_axis);
  layout_.next_block = readIndex(own, "next_block_button", layout_.next_block);
  layout_.previous_block = readIndex(own, "previous_block_button", layout_.previous_block);
  layout_.pause = readIndex(own, "pause_button", layout_.pause);
  layout_.reset = readIndex(own, "reset_button", layout_.reset);
  blocks_ = { "block1", "block2" };
  if (own.hasParam("blocks") && (!own.getParam("blocks", blocks_) || blocks_.empty()))
    throw std::runtime_error("parameter " + own.resolveName("blocks") + ": must be a list of names");

  thrust_ = handle_.advertise<msg::Thrust>(inNode(topics::THRUST), 100);
  pause_ = handle_.serviceClient<std_srvs::SetBool>(inNode(topics::PAUSE));
  reset_ = handle_.serviceClient<std_srvs::Trigger>(inNode(topics::RESET));
  paused_subscriber_ = handle_.subscribe(inNode(topics::PAUSED), 1, &JoyTeleop::onPaused, this);
  joy_subscriber_ = handle_.subscribe("joy", 10, &JoyTeleop::onJoy, this);
  refresh_ = handle_.createWallTimer(ros::WallDuration(REFRESH), [this](const ros::WallTimerEvent&) {
    if (levels_ != thrustLevels(0.0, 0.0, 0.0))
      send();
  });
}

void JoyTeleop::release()
{
  levels_ = thrustLevels(0.0, 0.0, 0.0);
  send();
}

void JoyTeleop::onPaused(const std_msgs::Bool::ConstPtr& message)
{
  paused_ = message->data;
}

/// A joystick that lacks an axis leaves it at rest.
double JoyTeleop::axis(const sensor_msgs::Joy& joy, int index) const
{
  const bool is_there = static_cast<std::size_t>(index) < joy.axes.size() && std::isfinite(joy.axes[index]);
  return is_there ? std::max(-1.0, std::min<double>(joy.axes[index], 1.0)) : 0.0;
}

/// Whether a button has gone down since the last message.
bool JoyTeleop::isPressed(const sensor_msgs::Joy& joy, int button) const
{
  const auto is_down = [button](const std::vector<int>& buttons) {
    return static_cast<std::size_t>(button) < buttons.size() && buttons[button] != 0;
  };
  return is_down(joy.buttons) && !is_down(buttons_);
}

void JoyTeleop::onJoy(const sensor_msgs::Joy::ConstPtr& joy)
{
  if (isPressed(*joy, layout_.next_block))
    choose((block_ + 1) % blocks_.size());
  if (isPressed(*joy, layout_.previous_block))
    choose((block_ + blocks_.size() - 1) % blocks_.size());
  if (isPressed(*joy, layout_.pause))
    togglePause();
  if (isPressed(*joy, layout_.reset))
    reset();
  buttons_ = joy->buttons;

  // In sensor_msgs/Joy left and up are positive.
  const std::vector<double> levels =
      thrustLevels(-axis(*joy, layout_.side_axis), axis(*joy, layout_.forward_axis), axis(*joy, layout_.spin_axis));
  if (levels == levels_)
    return;
  levels_ = levels;
  send();
}

/// The block driven so far is let go.
void JoyTeleop::choose(std::size_t block)
{
  release();
  block_ = block;
  ROS_INFO_STREAM("driving " << blocks_[block_]);
}

void JoyTeleop::send()
{
  msg::Thrust message;
  message.body = blocks_[block_];
  message.levels = levels_;
  const bool on = std::any_of(levels_.begin(), levels_.end(), [](double level) { return level > 0.0; });
  message.duration = on ? THRUST_DURATION : 0.0;
  thrust_.publish(message);
}

void JoyTeleop::togglePause()
{
  std_srvs::SetBool service;
  service.request.data = !paused_;
  if (!pause_.call(service))
    ROS_WARN("no answer to pause");
}

void JoyTeleop::reset()
{
  std_srvs::Trigger service;
  if (!reset_.call(service) || !service.response.success)
    ROS_WARN_STREAM("reset: " << (service.response.message.empty() ? "no answer" : service.response.message));
}

}  // namespace block_world
