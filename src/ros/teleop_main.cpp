#include <ros/ros.h>

#include <iostream>
#include <stdexcept>

#include "teleop.h"
#include "terminal.h"

int main(int argc, char** argv)
{
  // The terminal handles signals itself: it must be put back before the program ends.
  ros::init(argc, argv, "teleop", ros::init_options::NoSigintHandler | ros::init_options::AnonymousName);
  try
  {
    block_world::Terminal terminal;
    block_world::Teleop(terminal).run();
    return 0;
  }
  catch (const std::runtime_error& error)
  {
    std::cerr << "teleop: " << error.what() << std::endl;
    return 1;
  }
}
