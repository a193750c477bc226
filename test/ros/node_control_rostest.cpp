// Time, services and bad input: what the node does around the physics. The tests share one world and run in this order.

#include <rosgraph_msgs/Clock.h>
#include <rosgraph_msgs/Log.h>
#include <std_msgs/String.h>
#include <sys/wait.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "node_client.h"

namespace block_world
{
namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

class NodeControl : public testing::Test
{
protected:
  NodeControl() : client("block_world")
  {
  }

  msg::Thrust thrust(const std::string& body, std::vector<double> levels, double duration) const
  {
    msg::Thrust message;
    message.body = body;
    message.levels = levels;
    message.duration = duration;
    return message;
  }

  template <class Message>
  ros::Publisher advertise(const char* topic)
  {
    ros::Publisher publisher = handle.advertise<Message>(client.topic(topic), 1000);
    EXPECT_TRUE(waitFor([&] { return publisher.getNumSubscribers() > 0; }));
    return publisher;
  }

  ros::NodeHandle handle;
  NodeClient client;
};

const visualization_msgs::Marker* findMarker(const visualization_msgs::MarkerArray& array, const std::string& kind)
{
  for (const auto& marker : array.markers)
    if (marker.ns == kind)
      return &marker;
  return nullptr;
}

/// Exit status of a node of its own that is given bad parameters.
int exitStatus(const std::string& arguments)
{
  const int status =
      std::system(("timeout 20 " BLOCK_WORLD_NODE " __name:=refused " + arguments + " 2>/dev/null").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_F(NodeControl, stateAtTimeZeroIsStampedOneNanosecond)
{
  Listener<msg::BodyStates> bodies(client.topic(topics::BODIES), 10);
  ASSERT_TRUE(bodies.waitForCount(1)) << "a late subscriber gets the state of a paused world";
  EXPECT_EQ(bodies.messages[0].header.stamp.toNSec(), 1u);
  EXPECT_EQ(bodies.messages[0].header.frame_id, "world");
  EXPECT_EQ(bodies.messages[0].bodies.size(), 2u);
  EXPECT_EQ(bodies.messages[0].state_hash, client.hash());
}

TEST_F(NodeControl, clockTicksWhilePaused)
{
  Listener<rosgraph_msgs::Clock> clock("/clock", 1000);
  ASSERT_TRUE(clock.waitForCount(1));
  clock.messages.clear();
  waitFor([] { return false; }, 1.0);
  EXPECT_GT(clock.messages.size(), 50u);
  EXPECT_LT(clock.messages.size(), 150u);
  for (const auto& message : clock.messages)
    EXPECT_EQ(message.clock.toNSec(), 1u);
}

TEST_F(NodeControl, lateJoinersSeeThePausedWorld)
{
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(waitFor([&] { return buffer.canTransform("world", "left/block2", ros::Time(0)); }));
  EXPECT_EQ(buffer.lookupTransform("world", "left/block2", ros::Time(0)).transform.translation.x, 3.0);

  Listener<visualization_msgs::MarkerArray> markers(client.topic(topics::MARKERS), 1);
  ASSERT_TRUE(markers.waitForCount(1));
  const visualization_msgs::Marker* block = findMarker(markers.messages[0], "blocks");
  ASSERT_TRUE(block != nullptr);
  EXPECT_TRUE(block->frame_locked);
  EXPECT_TRUE(block->header.stamp.isZero());
  EXPECT_EQ(block->header.frame_id, "left/block1");

  Listener<std_msgs::String> scene(client.topic(topics::SCENE), 1);
  ASSERT_TRUE(scene.waitForCount(1));
  EXPECT_NE(scene.messages[0].data.find("two to drive"), std::string::npos);
}

TEST_F(NodeControl, stepAdvancesExactlyAndPublishes)
{
  Listener<msg::BodyStates> bodies(client.topic(topics::BODIES), 100);
  Listener<rosgraph_msgs::Clock> clock("/clock", 1000);
  ASSERT_TRUE(bodies.waitForCount(1) && clock.waitForCount(1));
  msg::Step::Request request;
  request.duration = 0.123456789;
  const msg::Step::Response response = client.step(request);
  ASSERT_TRUE(response.success);
  EXPECT_EQ(response.state.header.stamp.toNSec(), 123456789u);
  ASSERT_TRUE(waitFor([&] { return bodies.messages.back().header.stamp == response.state.header.stamp; }));
  EXPECT_EQ(bodies.messages.back().state_hash, response.state.state_hash);
  // On the way the states at k / 60 s: 7 of them, after the one that a new subscriber gets.
  EXPECT_EQ(bodies.messages.size(), 1u + 7u + 1u);
  EXPECT_EQ(bodies.messages[1].header.stamp.toNSec(), 16666667u);
  EXPECT_TRUE(waitFor([&] { return clock.messages.back().clock == response.state.header.stamp; }));

  request.duration = -1.0;
  EXPECT_FALSE(client.step(request).success);
  request.duration = NaN;
  EXPECT_FALSE(client.step(request).success);
}

TEST_F(NodeControl, pauseStopsTimeAndStepIsRefusedWhileRunning)
{
  Listener<msg::BodyStates> bodies(client.topic(topics::BODIES), 1000);
  ASSERT_TRUE(bodies.waitForCount(1));
  const std::uint64_t before = bodies.messages.back().header.stamp.toNSec();
  client.pause(false);
  waitFor([] { return false; }, 0.5);
  const msg::Step::Response refused = client.step(msg::Step::Request());
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("running"), std::string::npos);
  client.pause(true);
  const msg::Step::Response stopped = client.step(msg::Step::Request());
  const double ran = static_cast<double>(stopped.state.header.stamp.toNSec() - before) * 1e-9;
  EXPECT_GT(ran, 0.4);
  EXPECT_LT(ran, 2.0);
  waitFor([] { return false; }, 0.2);
  EXPECT_EQ(client.step(msg::Step::Request()).state.header.stamp, stopped.state.header.stamp);
  // The state in which it stands was sent.
  EXPECT_TRUE(waitFor([&] { return bodies.messages.back().header.stamp == stopped.state.header.stamp; }));
}

TEST_F(NodeControl, resetBringsBackTheSceneWhileTimeGoesOn)
{
  msg::Step::Request push;
  push.duration = 0.5;
  push.thrust.push_back(thrust("block1", { 0, 0, 1, 0, 0, 0 }, 0.0));
  push.thrust.back().duration = 5.0;
  const msg::Step::Response pushed = client.step(push);
  ASSERT_TRUE(pushed.success) << pushed.message;
  EXPECT_GT(pushed.state.bodies[0].y, 0.0);

  Listener<tf2_msgs::TFMessage> transforms("/tf", 100);
  waitFor([&] { return !transforms.messages.empty(); });
  client.reset();
  const msg::Step::Response back = client.step(msg::Step::Request());
  EXPECT_EQ(back.state.bodies[0].y, 0.0);
  EXPECT_EQ(back.state.bodies[0].vy, 0.0);
  EXPECT_EQ(back.state.header.stamp, pushed.state.header.stamp);
  // The thrust has gone too.
  EXPECT_EQ(client.advance(1.0)[0].vy, 0.0);

  // Display follows at once: no transform repeats a stamp, which tf2 would ignore.
  ros::Time last;
  bool seen_reset = false;
  waitFor([] { return false; }, 0.2);
  for (const auto& message : transforms.messages)
  {
    if (message.transforms[0].child_frame_id != "left/block1")
      continue;
    EXPECT_GT(message.transforms[0].header.stamp, last);
    last = message.transforms[0].header.stamp;
    seen_reset = seen_reset || (last.toNSec() == back.state.header.stamp.toNSec() + 1 &&
                                message.transforms[0].transform.translation.y == 0.0);
  }
  EXPECT_TRUE(seen_reset);
}

TEST_F(NodeControl, commandsAreLoggedAsApplied)
{
  client.reset();
  const std::uint64_t now = client.step(msg::Step::Request()).state.header.stamp.toNSec();
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(inputs.waitForCount(1));
  EXPECT_EQ(inputs.messages[0].kind, static_cast<int>(msg::Input::LOAD_SCENE));
  EXPECT_NE(inputs.messages[0].text.find("two to drive"), std::string::npos);

  ros::Publisher spring = advertise<msg::SpringForce>(topics::SPRING);
  msg::SpringForce pull;
  pull.active = true;
  pull.body = "block1";
  pull.anchor.y = 4.0;
  spring.publish(pull);
  ASSERT_TRUE(inputs.waitForCount(2));
  EXPECT_EQ(inputs.messages[1].kind, static_cast<int>(msg::Input::SPRING));
  EXPECT_EQ(inputs.messages[1].time_ns, static_cast<std::int64_t>(now));
  EXPECT_EQ(inputs.messages[1].spring.stiffness, 2.0) << "the node's ~mouse_stiffness";
  EXPECT_FALSE(inputs.messages[1].from_scene);

  ros::Publisher wrench = advertise<geometry_msgs::WrenchStamped>(topics::WRENCH);
  geometry_msgs::WrenchStamped push;
  push.wrench.force.x = 1.0;
  for (const char* frame : { "block2", "left/block2", "/left/block2", "/block2" })
  {
    push.header.frame_id = frame;
    wrench.publish(push);
  }
  ASSERT_TRUE(inputs.waitForCount(6));
  for (std::size_t i = 2; i < 6; ++i)
  {
    EXPECT_EQ(inputs.messages[i].body, "block2");
    EXPECT_EQ(inputs.messages[i].index, inputs.messages[1].index + i - 1);
  }
  // 1 N on 1 kg for 1 s along the block's x axis.
  EXPECT_NEAR(client.advance(1.0)[1].vx, 1.0, 1e-12);
  client.reset();
}

TEST_F(NodeControl, badCommandsChangeNothing)
{
  client.reset();
  const std::uint64_t before = client.hash();
  Listener<rosgraph_msgs::Log> log("/rosout", 1000);
  Listener<msg::Input> inputs(client.topic(topics::INPUTS), 100);
  ASSERT_TRUE(log.waitForPublisher() && inputs.waitForCount(1));

  ros::Publisher thrusts = advertise<msg::Thrust>(topics::THRUST);
  ros::Publisher springs = advertise<msg::SpringForce>(topics::SPRING);
  ros::Publisher wrenches = advertise<geometry_msgs::WrenchStamped>(topics::WRENCH);
  msg::SpringForce negative, unknown;
  negative.active = unknown.active = true;
  negative.body = "block1";
  negative.stiffness = -1.0;
  unknown.body = "no such block";
  geometry_msgs::WrenchStamped not_finite;
  not_finite.header.frame_id = "block1";
  not_finite.wrench.torque.z = NaN;
  for (int i = 0; i < 20; ++i)
  {
    thrusts.publish(thrust("no such block", { 0, 0, 1, 0, 0, 0 }, 1.0));
    thrusts.publish(thrust("block1", { 1, 1 }, 1.0));
    thrusts.publish(thrust("block1", { 0, 0, 2, 0, 0, 0 }, 1.0));
    thrusts.publish(thrust("block1", { 0, 0, NaN, 0, 0, 0 }, 1.0));
    thrusts.publish(thrust("block1", { 0, 0, 1, 0, 0, 0 }, -1.0));
    springs.publish(negative);
    springs.publish(unknown);
    wrenches.publish(not_finite);
  }
  // A good one marks the end: topics have no order among each other, but each has one in itself.
  thrusts.publish(thrust("block1", { 0, 0, 0, 0, 0, 0 }, 0.0));
  msg::SpringForce release;
  springs.publish(release);
  geometry_msgs::WrenchStamped none;
  none.header.frame_id = "block1";
  wrenches.publish(none);
  ASSERT_TRUE(inputs.waitForCount(4));
  EXPECT_EQ(inputs.messages.size(), 4u);
  EXPECT_EQ(client.hash(), before);

  std::size_t warnings = 0;
  waitFor([] { return false; }, 0.3);
  for (const rosgraph_msgs::Log& line : log.messages)
  {
    if (line.name != "/block_world" || line.level != rosgraph_msgs::Log::WARN)
      continue;
    ++warnings;
    EXPECT_NE(line.msg.find("refused"), std::string::npos) << line.msg;
  }
  EXPECT_GE(warnings, 3u);
  EXPECT_LE(warnings, 16u) << "8 kinds, in at most two different seconds";
}

TEST_F(NodeControl, badCommandsInAStepRefuseTheStep)
{
  client.reset();
  const msg::Step::Response before = client.step(msg::Step::Request());
  msg::Step::Request request;
  request.duration = 1.0;
  request.thrust.push_back(thrust("block1", { 0, 0, 1, 0, 0, 0 }, 1.0));
  request.thrust.push_back(thrust("block1", { 0, 0, 1 }, 1.0));
  const msg::Step::Response refused = client.step(request);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("levels"), std::string::npos) << refused.message;
  const msg::Step::Response after = client.step(msg::Step::Request());
  EXPECT_EQ(after.state.header.stamp, before.state.header.stamp);
  EXPECT_EQ(after.state.state_hash, before.state.state_hash);
}

TEST_F(NodeControl, badParametersAndScenesEndWithStatusTwo)
{
  const std::string good = "_scene:=" BLOCK_WORLD_DIR "/test/scenes/head_on.yaml ";
  EXPECT_EQ(exitStatus("_scene:=/nowhere.yaml"), 2);
  ros::NodeHandle refused("/refused");
  refused.deleteParam("scene");
  for (const char* bad :
       { "gravity:=-1", "gravity:=down", "elasticity:=1.5", "count:=0", "count:=2.5", "paused:=2", "publish_rate:=0",
         "real_time_factor:=-1", "tf_prefix:=/a", "mass:=0", "tolerance:=1.0", "count:=7", "mouse_stiffness:=-3" })
  {
    EXPECT_EQ(exitStatus(good + "_" + bad), 2) << bad;
    refused.deleteParam(std::string(bad).substr(0, std::string(bad).find(':')));
  }
}

TEST_F(NodeControl, secondWorldFollowsTheClock)
{
  NodeClient follower("follower");
  Listener<msg::BodyStates> leading(client.topic(topics::BODIES), 1000);
  Listener<msg::BodyStates> following(follower.topic(topics::BODIES), 1000);
  client.pause(false);
  ASSERT_TRUE(leading.waitForCount(60) && following.waitForCount(40));
  const double apart = (leading.messages.back().header.stamp - following.messages.back().header.stamp).toSec();
  EXPECT_NEAR(apart, 0.0, 0.2);
  client.pause(true);
  const msg::Step::Response stopped = client.step(msg::Step::Request());
  waitFor([] { return false; }, 0.3);
  following.messages.clear();
  waitFor([] { return false; }, 0.3);
  EXPECT_TRUE(following.messages.empty()) << "where the clock stands, the follower stands";
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_control_rostest");
  return RUN_ALL_TESTS();
}
