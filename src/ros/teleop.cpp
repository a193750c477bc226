#include "teleop.h"

#include <ros/callback_queue.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "time_base.h"
#include "topics.h"

namespace block_world
{
namespace
{
constexpr std::int64_t MS = 1000000;        // ns
constexpr std::int64_t REFRESH = 100 * MS;  // of a thrust that is held
constexpr int REDRAW_MS = 50;
// s of simulated time: what is left of a thrust when the teleop dies.
constexpr double THRUST_DURATION = 0.5;
constexpr double STEP_DURATION = 1.0 / 60.0;

std::string inNode(const char* name)
{
  return std::string(topics::NODE) + "/" + name;
}

double parameter(const char* name, double otherwise)
{
  return ros::NodeHandle("~").param(name, otherwise);
}

/// NAME  value J  ######      as wide as the terminal allows.
std::string bar(const char* name, double value, double largest, int columns)
{
  char text[64];
  std::snprintf(text, sizeof(text), "  %-13s %12.6g J  ", name, value);
  const int room = std::max(columns - 34, 5);
  const double share = largest > 0.0 ? std::min(std::fabs(value) / largest, 1.0) : 0.0;
  return text + std::string(static_cast<std::size_t>(std::lround(share * room)), value < 0.0 ? '-' : '#');
}

}  // namespace

Teleop::Teleop(Terminal& terminal)
  : terminal_(terminal)
  , held_(static_cast<std::int64_t>(parameter("first_hold", 0.5) * 1e9),
          static_cast<std::int64_t>(parameter("repeat_hold", 0.12) * 1e9))
{
  ros::NodeHandle own("~");
  blocks_ = { { own.param<std::string>("first_block", "block1"), own.param<std::string>("second_block", "block2") } };
  thrust_ = handle_.advertise<msg::Thrust>(inNode(topics::THRUST), 100);
  energy_subscriber_ = handle_.subscribe(inNode(topics::ENERGY), 10, &Teleop::onEnergy, this);
  paused_subscriber_ = handle_.subscribe(inNode(topics::PAUSED), 1, &Teleop::onPaused, this);
  pause_ = handle_.serviceClient<std_srvs::SetBool>(inNode(topics::PAUSE));
  reset_ = handle_.serviceClient<std_srvs::Trigger>(inNode(topics::RESET));
  step_ = handle_.serviceClient<msg::Step>(inNode(topics::STEP));
  sent_levels_.fill(std::vector<double>(6, 0.0));
}

void Teleop::run()
{
  while (ros::ok() && !Terminal::endAsked() && !leave_)
  {
    const std::vector<unsigned char> bytes = terminal_.read(REDRAW_MS);
    const std::int64_t now = steadyNow();
    for (const unsigned char byte : bytes)
      if (const std::optional<int> key = reader_.read(byte))
        onKey(*key, now);
    ros::spinOnce();
    drive(now);
    show();
  }
  held_.releaseAll();
  drive(steadyNow());
  // The last message is on its way only when roscpp has had a moment for it.
  ros::WallDuration(0.05).sleep();
}

void Teleop::onEnergy(const msg::Energy::ConstPtr& message)
{
  energy_ = *message;
}

void Teleop::onPaused(const std_msgs::Bool::ConstPtr& message)
{
  paused_ = message->data;
}

void Teleop::onKey(int key, std::int64_t now)
{
  if (driveOf(key))
    held_.press(key, now);
  else if (key == ' ')
    togglePause();
  else if (key == 'r' || key == 'R')
    reset();
  else if (key == 'n' || key == 'N')
    step();
  else if (key == 'q' || key == 'Q')
    leave_ = true;
}

/// Sends thrusts when they change, and again while they last.
void Teleop::drive(std::int64_t now)
{
  for (int block = 0; block < 2; ++block)
  {
    const std::vector<double> levels = held_.levels(block, now);
    const bool on = std::any_of(levels.begin(), levels.end(), [](double level) { return level > 0.0; });
    if (levels != sent_levels_[block] || (on && now >= sent_at_[block] + REFRESH))
      sendThrust(block, levels, now);
  }
}

void Teleop::sendThrust(int block, const std::vector<double>& levels, std::int64_t now)
{
  msg::Thrust message;
  message.body = blocks_[block];
  message.levels = levels;
  const bool on = std::any_of(levels.begin(), levels.end(), [](double level) { return level > 0.0; });
  message.duration = on ? THRUST_DURATION : 0.0;
  thrust_.publish(message);
  sent_levels_[block] = levels;
  sent_at_[block] = now;
}

void Teleop::togglePause()
{
  std_srvs::SetBool service;
  service.request.data = !paused_;
  answer_ = pause_.call(service) ? service.response.message : "no answer to pause";
}

void Teleop::reset()
{
  std_srvs::Trigger service;
  answer_ = reset_.call(service) ? service.response.message : "no answer to reset";
}

void Teleop::step()
{
  msg::Step service;
  service.request.duration = STEP_DURATION;
  answer_ = step_.call(service) ? service.response.message : "no answer to step";
}

std::string Teleop::status() const
{
  if (!energy_)
    return thrust_.getNumSubscribers() > 0 ? "connected, no state yet" :
                                             "waiting for the node " + std::string(topics::NODE);
  char text[80];
  std::snprintf(text, sizeof(text), "%s at %.3f s", paused_ ? "paused" : "running", energy_->time);
  return text;
}

void Teleop::show()
{
  const msg::Energy energy = energy_.value_or(msg::Energy());
  const double potential = energy.gravity + energy.spring;
  largest_ = std::max({ largest_ * 0.995, std::fabs(potential), energy.translational, energy.rotational,
                        std::fabs(energy.total), 1e-12 });
  const int columns = terminal_.columns();
  terminal_.show({
      "block_world: " + status(),
      "",
      "  " + blocks_[0] + ":  E forward  D back  S left  F right       Shift+S / Shift+F spin",
      "  " + blocks_[1] + ":  I forward  K back  J left  L right       Shift+J / Shift+L spin   (or the arrows)",
      "  space pause/go on   r reset   n step 1/60 s   q quit",
      "",
      bar("potential", potential, largest_, columns),
      bar("rotational", energy.rotational, largest_, columns),
      bar("translational", energy.translational, largest_, columns),
      bar("total", energy.total, largest_, columns),
      "",
      "  A terminal cannot tell when a key is let go: thrust ends when the key has not come again for a moment,",
      "  and only the key pressed last repeats. rviz has no such limits.",
      "",
      "  " + answer_,
  });
}

}  // namespace block_world
