#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>

#include <cstddef>
#include <string>
#include <vector>

namespace block_world
{
/// Levels of a block's six default thrusters that push it along its own axes and spin it; each input -1..1: right,
/// forward, counter-clockwise. What they ask of one thruster adds up, to 1 at most.
std::vector<double> thrustLevels(double right, double forward, double spin);

/// Drives one block at a time with a joystick: sensor_msgs/Joy in, thrusts and calls of services out.
class JoyTeleop
{
public:
  /// Throws std::runtime_error where a parameter is bad.
  JoyTeleop();

private:
  /// Indices in sensor_msgs/Joy.
  struct Layout
  {
    int side_axis = 0, forward_axis = 1, spin_axis = 3;
    int next_block = 0, previous_block = 1, pause = 7, reset = 6;
  };

  void onJoy(const sensor_msgs::Joy::ConstPtr& joy);
  void onPaused(const std_msgs::Bool::ConstPtr& message);
  bool isPressed(const sensor_msgs::Joy& joy, int button) const;
  double axis(const sensor_msgs::Joy& joy, int index) const;
  void release();
  void choose(std::size_t block);
  void send();
  void togglePause();
  void reset();

  ros::NodeHandle handle_;
  ros::Publisher thrust_;
  ros::Subscriber joy_subscriber_, paused_subscriber_;
  ros::ServiceClient pause_, reset_;
  ros::WallTimer refresh_;

  Layout layout_;
  std::vector<std::string> blocks_;
  std::size_t block_ = 0;
  std::vector<double> levels_;
  std::vector<int> buttons_;  ///< as they were in the last message
  bool paused_ = false;
};

}  // namespace block_world
