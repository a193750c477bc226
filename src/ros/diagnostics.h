#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <string>

#include "block_world/world.h"

namespace block_world
{
/// How fast time goes, for the diagnostics.
struct Pace
{
  std::int64_t simulated = 0;  ///< ns
  std::int64_t clock = 0;      ///< ns, the computer's
  bool paused = false;
  bool follows = false;  ///< another's /clock
  double asked = 1.0;    ///< simulated seconds per second; 0 = as fast as possible
  double lost = 0.0;     ///< s that simulated time has fallen behind for good
  double late = 0.0;     ///< s that it is behind now, where that is too much
};

/// Publishes /diagnostics once a second of the computer's clock, also while simulated time stands still.
class Diagnostics
{
public:
  explicit Diagnostics(const ros::NodeHandle& handle);

  /// The pace is measured anew from here on: it was changed on purpose.
  void restart(std::int64_t simulated, std::int64_t clock);

  bool isDue(std::int64_t clock) const;
  void publish(const World& world, const Pace& pace);

private:
  void tellPace(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void tellAccuracy(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  diagnostic_updater::Updater updater_;
  std::int64_t sent_at_ = 0;
  std::int64_t since_simulated_ = 0, since_clock_ = 0;
  std::int64_t events_ = 0;  ///< that the world had counted then
  CostMeter meter_;
  Time metered_;
  double lost_ = 0.0;

  // What is being told.
  const World* world_ = nullptr;
  std::string slowest_;  ///< island since the last time, and why
  Pace pace_;
};

}  // namespace block_world
