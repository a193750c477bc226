// Thrust and spring commands at 1 kHz, a tenth of them malformed: the node keeps real time, loses no valid one and
// warns no more than once per kind and second.

#include <rosgraph_msgs/Log.h>

#include <cmath>

#include "node_client.h"

namespace block_world
{
TEST(NodeLoad, thousandCommandsPerSecond)
{
  NodeClient client("block_world");
  ros::NodeHandle handle;
  const double seconds = ros::NodeHandle("~").param("seconds", 4.0);
  ros::Publisher thrusts = handle.advertise<msg::Thrust>(client.topic(topics::THRUST), 10000);
  ros::Publisher springs = handle.advertise<msg::SpringForce>(client.topic(topics::SPRING), 10000);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100000);
  Listener<rosgraph_msgs::Log> log("/rosout", 1000);
  ASSERT_TRUE(waitFor([&] { return thrusts.getNumSubscribers() > 0 && springs.getNumSubscribers() > 0; }));
  ASSERT_TRUE(inputs.waitForCount(1) && log.waitForPublisher());
  inputs.messages.clear();

  const double started = client.step(msg::Step::Request()).state.header.stamp.toSec();
  const ros::WallTime start = ros::WallTime::now();
  client.pause(false);
  const int count = static_cast<int>(seconds * 1000.0);
  std::size_t valid = 0;
  for (int i = 0; i < count; ++i)
  {
    const bool bad = i % 20 == 7 || i % 20 == 0;
    const std::string body = bad && i % 20 == 0 ? "no such block" : i % 4 < 2 ? "block1" : "block2";
    if (i % 2 == 0)
    {
      msg::Thrust message;
      message.body = body;
      message.levels = { 0, 0, i % 3 / 2.0, 0, i % 5 / 4.0, 0 };
      message.duration = 0.1;
      thrusts.publish(message);
    }
    else
    {
      msg::SpringForce message;
      message.active = true;
      message.body = body;
      message.anchor.x = 2.0 * std::cos(i * 0.003);
      message.anchor.y = 2.0 * std::sin(i * 0.003);
      message.stiffness = bad ? -1.0 : 3.0;
      message.damping = 0.5;
      springs.publish(message);
    }
    valid += bad ? 0 : 1;
    ros::spinOnce();
    const ros::WallDuration left = start + ros::WallDuration(i * 0.001) - ros::WallTime::now();
    if (left > ros::WallDuration(0))
      left.sleep();
  }
  client.pause(true);
  const double wall = (ros::WallTime::now() - start).toSec();
  const double simulated = client.step(msg::Step::Request()).state.header.stamp.toSec() - started;
  // The node may lag by a moment without losing time for good.
  EXPECT_NEAR(simulated, wall, 0.3);

  EXPECT_TRUE(inputs.waitForCount(valid));
  waitFor([] { return false; }, 0.3);
  EXPECT_EQ(inputs.messages.size(), valid);
  for (std::size_t i = 1; i < inputs.messages.size(); ++i)
    ASSERT_EQ(inputs.messages[i].index, inputs.messages[i - 1].index + 1);

  std::size_t warnings = 0;
  for (const rosgraph_msgs::Log& line : log.messages)
    warnings += line.name == "/block_world" && line.level >= rosgraph_msgs::Log::WARN ? 1 : 0;
  EXPECT_GE(warnings, 1u);
  EXPECT_LE(warnings, 2u * static_cast<std::size_t>(seconds + 2.0)) << "two kinds, once a second each";
  ROS_INFO_STREAM(count << " commands, " << valid << " of them valid, in " << wall << " s: " << simulated
                        << " s simulated, " << inputs.messages.size() << " applied, " << warnings << " warnings");
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_load_rostest");
  return RUN_ALL_TESTS();
}
