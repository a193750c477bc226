#include <ros/ros.h>

#include <stdexcept>

#include "joy_teleop.h"

int main(int argc, char** argv)
{
  ros::init(argc, argv, "joy_teleop");
  const ros::NodeHandle handle;
  try
  {
    // What ends it sends no last thrust: a thrust ends by itself.
    block_world::JoyTeleop teleop;
    ros::spin();
    return 0;
  }
  catch (const std::runtime_error& error)
  {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
}
