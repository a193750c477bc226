#pragma once

#include <ros/node_handle.h>
#include <std_msgs/Bool.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "messages.h"
#include "teleop_keys.h"
#include "terminal.h"

namespace block_world
{
/// Drives two blocks from a terminal's keyboard and shows the energies.
class Teleop
{
public:
  explicit Teleop(Terminal& terminal);

  /// Until q or a signal.
  void run();

private:
  void onEnergy(const msg::Energy::ConstPtr& message);
  void onPaused(const std_msgs::Bool::ConstPtr& message);
  void onKey(int key, std::int64_t now);
  void drive(std::int64_t now);
  void sendThrust(int block, const std::vector<double>& levels, std::int64_t now);
  void togglePause();
  void reset();
  void step();
  void show();
  std::string status() const;

  Terminal& terminal_;
  ros::NodeHandle handle_;
  ros::Publisher thrust_;
  ros::Subscriber energy_subscriber_, paused_subscriber_;
  ros::ServiceClient pause_, reset_, step_;

  KeyReader reader_;
  HeldKeys held_;
  std::array<std::string, 2> blocks_;
  std::array<std::vector<double>, 2> sent_levels_;
  std::array<std::int64_t, 2> sent_at_{ { 0, 0 } };

  std::optional<msg::Energy> energy_;
  bool paused_ = false;
  double largest_ = 0.0;  ///< J, the most that a bar has had to show
  std::string answer_;    ///< of the last service
  bool leave_ = false;
};

}  // namespace block_world
