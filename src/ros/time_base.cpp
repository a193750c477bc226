#include "time_base.h"

#include <rosgraph_msgs/Clock.h>

#include <algorithm>

#include "conversions.h"

namespace block_world
{
namespace
{
constexpr std::int64_t CLOCK_PERIOD = 10000000;  // ns
constexpr int CLOCK_QUEUE = 10;
}  // namespace

std::int64_t steadyNow()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

TimeBase::TimeBase(ros::NodeHandle& handle, bool publish_clock)
{
  bool use_sim_time = false;
  handle.getParam("/use_sim_time", use_sim_time);
  if (!use_sim_time)
    return;
  kind_ = publish_clock ? Kind::OwnClock : Kind::FollowedClock;
  if (publish_clock)
    clock_ = handle.advertise<rosgraph_msgs::Clock>("/clock", CLOCK_QUEUE);
}

bool TimeBase::findOrigin()
{
  if (kind_ == Kind::TimeOfDay)
    origin_ = static_cast<std::int64_t>(ros::WallTime::now().toNSec());
  else if (kind_ == Kind::FollowedClock)
    origin_ = now();
  return kind_ == Kind::OwnClock || origin_ > 0;
}

std::int64_t TimeBase::origin() const
{
  return origin_;
}

bool TimeBase::follows() const
{
  return kind_ == Kind::FollowedClock;
}

std::int64_t TimeBase::now() const
{
  return follows() ? static_cast<std::int64_t>(ros::Time::now().toNSec()) : steadyNow();
}

void TimeBase::publish(std::int64_t simulated_ns, bool at_once)
{
  if (kind_ != Kind::OwnClock)
    return;
  const std::int64_t now = steadyNow();
  const bool new_time = simulated_ns > sent_simulated_;
  const bool due = now >= sent_at_ + CLOCK_PERIOD || simulated_ns >= sent_simulated_ + CLOCK_PERIOD;
  if (!due && !(at_once && new_time))
    return;
  rosgraph_msgs::Clock message;
  message.clock = stamp(origin_, simulated_ns);
  clock_.publish(message);
  // Keeps the rate where a message comes a little late, and does not make up for a long silence.
  sent_at_ = std::min(now, std::max(sent_at_ + CLOCK_PERIOD, now - CLOCK_PERIOD / 2));
  sent_simulated_ = simulated_ns;
}

std::int64_t TimeBase::untilDue() const
{
  return kind_ == Kind::OwnClock ? sent_at_ + CLOCK_PERIOD - steadyNow() : CLOCK_PERIOD;
}

std::string TimeBase::description() const
{
  switch (kind_)
  {
    case Kind::OwnClock:
      return "publishing /clock";
    case Kind::FollowedClock:
      return "following /clock";
    default:
      return "/use_sim_time is not true: stamps are the time of day at the start plus simulated time";
  }
}

}  // namespace block_world
