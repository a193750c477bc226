// The example scripts/park_block.py: a controller in lock-step gives the same bits, however busy the computer is.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "bags.h"
#include "node_client.h"

namespace block_world
{
namespace
{
/// Keeps every core busy, twice over.
class Load
{
public:
  Load()
  {
    for (unsigned i = 0; i < 2 * std::max(1u, std::thread::hardware_concurrency()); ++i)
      threads_.emplace_back([this] {
        while (!end_)
        {
        }
      });
  }
  ~Load()
  {
    end_ = true;
    for (std::thread& thread : threads_)
      thread.join();
  }

private:
  std::atomic<bool> end_{ false };
  std::vector<std::thread> threads_;
};

msg::BodyStates park(const std::string& ns)
{
  NodeClient client(ns + "/block_world");
  // As a user does: catkin gives tests the environment of the first configuration, when the messages' Python was not yet made.
  const std::string set_up = std::string(". ") + BLOCK_WORLD_SETUP + "; ";
  const std::string program = "$(dirname " + std::string(BLOCK_WORLD_NODE) + ")/park_block.py";
  const Outcome outcome = runCommand(set_up + "ROS_NAMESPACE=/" + ns + " " + program);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  return client.state();
}
}  // namespace

TEST(ParkBlock, SameBitsOnABusyComputer)
{
  const msg::BodyStates idle = park("idle");
  const Load load;
  const msg::BodyStates busy = park("busy");
  EXPECT_EQ(idle.state_hash, busy.state_hash);
  EXPECT_EQ(idle.time_ns, 60000000000);
  // Parked: the controller's closed loop is stable and has no steady error, as nothing else pushes the block.
  const msg::BodyState& block = idle.bodies.at(0);
  EXPECT_NEAR(block.x, 0.0, 1e-9);
  EXPECT_NEAR(block.y, 0.0, 1e-9);
  EXPECT_NEAR(block.angle, 0.0, 1e-9);
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "park_block_rostest");
  return RUN_ALL_TESTS();
}
