// Two worlds under one master, in the namespaces a and b, with one clock. a is paused and stepped, which moves the
// clock that b follows. The tests share the worlds and run in this order.

#include <rosgraph_msgs/Clock.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>
#include <map>
#include <set>

#include "node_client.h"

namespace block_world
{
namespace
{
// A few roundings of numbers around 10.
constexpr double ROUNDING = 1e-13;

/// Who publishes what, as the master knows it.
std::map<std::string, std::set<std::string>> publishers()
{
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = "two_worlds_rostest";
  EXPECT_TRUE(ros::master::execute("getSystemState", request, response, payload, false));
  std::map<std::string, std::set<std::string>> publishers;
  for (int i = 0; i < payload[0].size(); ++i)
    for (int j = 0; j < payload[0][i][1].size(); ++j)
      publishers[payload[0][i][0]].insert(payload[0][i][1][j]);
  return publishers;
}

/// The last state that a world has told, when it is of this time.
const msg::BodyStates& waitForTime(const Listener<msg::BodyStates>& bodies, const ros::Time& time)
{
  EXPECT_TRUE(waitFor([&] { return !bodies.messages.empty() && bodies.messages.back().header.stamp >= time; }));
  return bodies.messages.back();
}

}  // namespace

TEST(TwoWorlds, haveOneClockAndNamesOfTheirOwn)
{
  NodeClient a("a/block_world"), b("b/block_world");
  Listener<rosgraph_msgs::Clock> clock("/clock", 10);
  ASSERT_TRUE(clock.waitForCount(1));
  std::map<std::string, std::set<std::string>> topics = publishers();
  EXPECT_EQ(topics["/clock"], std::set<std::string>({ "/a/block_world" }));
  EXPECT_EQ(topics["/tf"], std::set<std::string>({ "/a/block_world", "/b/block_world" }));
  for (const char* world : { "/a/block_world", "/b/block_world" })
    for (const char* topic : { topics::BODIES, topics::ENERGY, topics::CONTACTS, topics::INPUTS, topics::SCENE,
                               topics::MARKERS, topics::OVERLAY, topics::PAUSED })
      EXPECT_EQ(topics[std::string(world) + "/" + topic], std::set<std::string>({ world })) << topic;
  for (const auto& [topic, nodes] : topics)
    EXPECT_TRUE(topic.compare(0, 12, "/block_world") != 0) << topic << " is in no namespace";
}

TEST(TwoWorlds, doNotMix)
{
  NodeClient a("a/block_world"), b("b/block_world");
  Listener<msg::BodyStates> bodies_a(a.topic(topics::BODIES), 1000), bodies_b(b.topic(topics::BODIES), 1000);
  Listener<msg::Input> inputs_a(a.topic(topics::INPUTS), 100), inputs_b(b.topic(topics::INPUTS), 100);
  ros::NodeHandle handle;
  ros::Publisher wrench = handle.advertise<geometry_msgs::WrenchStamped>(b.topic(topics::WRENCH), 10);
  ASSERT_TRUE(waitFor([&] { return wrench.getNumSubscribers() == 1; }));
  ASSERT_TRUE(bodies_a.waitForCount(1) && inputs_a.waitForCount(1) && inputs_b.waitForCount(1));

  // block1 of a is thrust, block2 of b is pushed; only b has gravity. Time stands still until a is stepped.
  geometry_msgs::WrenchStamped push;
  push.header.frame_id = "b/block2";
  push.wrench.force.x = 3.0;
  wrench.publish(push);
  ASSERT_TRUE(inputs_b.waitForCount(2));
  msg::Step::Request thrust;
  thrust.thrust.resize(1);
  thrust.thrust[0].body = "block1";
  thrust.thrust[0].levels = { 0, 0, 1, 0, 0, 0 };
  thrust.thrust[0].duration = 2.0;
  thrust.duration = 1.0;
  const msg::BodyStates end = a.step(thrust).state;
  ASSERT_TRUE(inputs_a.waitForCount(2));
  EXPECT_EQ(end.header.stamp.toSec(), 1.0);
  EXPECT_NEAR(end.bodies[0].vy, 1.5, ROUNDING);
  EXPECT_EQ(end.bodies[1].vx, 0.0);

  // b follows: its last state is of the last of its own 60 Hz instants, and it began when it first heard the clock.
  const msg::BodyStates& followed = waitForTime(bodies_b, ros::Time(0.98));
  const double t = followed.header.stamp.toSec() - 1e-9;
  EXPECT_LE(t, 1.0);
  EXPECT_NEAR(followed.bodies[0].vy, -t, 1e-6);
  EXPECT_EQ(followed.bodies[0].vx, 0.0);
  EXPECT_NEAR(followed.bodies[1].vx, 3.0 * t, 1e-6);

  EXPECT_EQ(inputs_a.messages.size(), 2u);
  EXPECT_EQ(inputs_a.messages[1].kind, static_cast<int>(msg::Input::THRUST));
  EXPECT_EQ(inputs_b.messages.size(), 2u);
  EXPECT_EQ(inputs_b.messages[1].kind, static_cast<int>(msg::Input::WRENCH));
}

TEST(TwoWorlds, framesAreKeptApartByTheirPrefix)
{
  NodeClient a("a/block_world");
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  for (const char* frame : { "a/block1", "a/block2", "b/block1", "b/block2" })
    ASSERT_TRUE(waitFor([&] {
      a.advance(0.02);
      return buffer.canTransform("world", frame, ros::Time(0));
    })) << frame;
  EXPECT_FALSE(buffer.canTransform("world", "block1", ros::Time(0)));
  EXPECT_GT(buffer.lookupTransform("world", "a/block1", ros::Time(0)).transform.translation.y, 0.5);
  EXPECT_LT(buffer.lookupTransform("world", "b/block1", ros::Time(0)).transform.translation.y, -0.4);
}

TEST(TwoWorlds, haveScenesAndParametersOfTheirOwn)
{
  NodeClient a("a/block_world"), b("b/block_world");
  ros::NodeHandle handle;
  EXPECT_EQ(handle.param("/a/block_world/gravity", -1.0), 0.0);
  EXPECT_EQ(handle.param("/b/block_world/gravity", -1.0), 1.0);
  const std::uint64_t before = a.hash();
  b.load("name: other\ngravity: 5\nblocks: [{name: stone, pose: [0, 0, 0]}]");
  EXPECT_EQ(a.hash(), before);
  EXPECT_EQ(handle.param("/a/block_world/gravity", -1.0), 0.0);
  EXPECT_EQ(handle.param("/b/block_world/gravity", -1.0), 5.0);
  b.reset();
  EXPECT_EQ(a.hash(), before);
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "two_worlds_rostest");
  return RUN_ALL_TESTS();
}
