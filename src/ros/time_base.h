#pragma once

#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace block_world
{
/// The computer's clock, which never jumps: ns since the computer started.
std::int64_t steadyNow();

/// Where stamps and the pace of a run come from.
///
/// With /use_sim_time the node owns the time of all nodes and publishes /clock, unless it is told to follow another
/// simulator's /clock. Without it, stamps are the time of day at the start plus simulated time.
class TimeBase
{
public:
  TimeBase(ros::NodeHandle& handle, bool publish_clock);

  /// True when the stamp of simulated time 0 is known: at once, or when the followed clock has been heard.
  bool findOrigin();

  /// Stamp of simulated time 0, in ns.
  std::int64_t origin() const;

  /// True where another simulator's /clock sets the pace.
  bool follows() const;

  /// The clock that sets the pace, in ns.
  std::int64_t now() const;

  /// Sends /clock, where the node owns it, if it is due: at 100 Hz, and more often where simulated time runs faster.
  void publish(std::int64_t simulated_ns, bool at_once = false);

  /// ns until /clock is due again.
  std::int64_t untilDue() const;

  std::string description() const;

private:
  enum class Kind
  {
    OwnClock,
    FollowedClock,
    TimeOfDay
  };

  Kind kind_ = Kind::TimeOfDay;
  std::int64_t origin_ = 0;
  std::int64_t sent_simulated_ = -1, sent_at_ = 0;
  ros::Publisher clock_;
};

}  // namespace block_world
