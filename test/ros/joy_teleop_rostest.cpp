// Messages of a joystick drive the blocks, choose between them, pause and reset.

#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>

#include "joy_teleop.h"
#include "node_client.h"

namespace block_world
{
namespace
{
class JoyTeleopTest : public testing::Test
{
protected:
  JoyTeleopTest() : client("block_world"), inputs(client.topic(topics::INPUTS), 1000)
  {
    stick = handle.advertise<sensor_msgs::Joy>("/stick", 10);
    EXPECT_TRUE(waitFor([this] { return stick.getNumSubscribers() > 0; }));
    EXPECT_TRUE(inputs.waitForCount(1));
  }

  /// Left, up and counter-clockwise are positive; button is held down where it is not -1.
  void send(double left, double up, double spin, int button = -1)
  {
    sensor_msgs::Joy joy;
    joy.axes = { static_cast<float>(left), static_cast<float>(up), static_cast<float>(spin) };
    joy.buttons.assign(5, 0);
    if (button >= 0)
      joy.buttons[button] = 1;
    stick.publish(joy);
  }

  void press(int button)
  {
    send(0.0, 0.0, 0.0, button);
    send(0.0, 0.0, 0.0);
  }

  bool waitForThrust(const std::string& body, const std::vector<double>& levels)
  {
    return waitFor([&] {
      const msg::Input& last = inputs.messages.back();
      return last.kind == static_cast<int>(msg::Input::THRUST) && last.thrust.body == body &&
             last.thrust.levels == levels;
    });
  }

  ros::NodeHandle handle;
  NodeClient client;
  Listener<msg::Input> inputs;
  ros::Publisher stick;
};

}  // namespace

// In the table of default thrusters, 0 and 4 push along -x, 1 and 5 along +x, 2 along +y, 3 along -y; 0 and 1 sit above
// the centre of mass, 4 and 5 below.
TEST(ThrustLevels, pushAndSpin)
{
  EXPECT_EQ(thrustLevels(0, 0, 0), std::vector<double>({ 0, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(thrustLevels(0.5, 0, 0), std::vector<double>({ 0, 0.5, 0, 0, 0, 0.5 }));
  EXPECT_EQ(thrustLevels(-0.5, 0, 0), std::vector<double>({ 0.5, 0, 0, 0, 0.5, 0 }));
  EXPECT_EQ(thrustLevels(0, 0.25, 0), std::vector<double>({ 0, 0, 0.25, 0, 0, 0 }));
  EXPECT_EQ(thrustLevels(0, -0.25, 0), std::vector<double>({ 0, 0, 0, 0.25, 0, 0 }));
  EXPECT_EQ(thrustLevels(0, 0, 1), std::vector<double>({ 1, 0, 0, 0, 0, 1 }));
  EXPECT_EQ(thrustLevels(0, 0, -1), std::vector<double>({ 0, 1, 0, 0, 1, 0 }));
  EXPECT_EQ(thrustLevels(0.75, 0, 0.75), std::vector<double>({ 0.75, 0.75, 0, 0, 0, 1 }));
}

TEST_F(JoyTeleopTest, axesPushTheBlockInProportion)
{
  send(0.0, 0.5, 0.0);
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 0.5, 0, 0, 0 }));
  // Half of 1.5 N on 1 kg.
  EXPECT_NEAR(client.advance(0.4)[0].vy, 0.5 * 1.5 * 0.4, 1e-12);
  // Held: the thrust is told again before it ends.
  const std::size_t count = inputs.messages.size();
  EXPECT_TRUE(inputs.waitForCount(count + 3));
  send(0.0, 0.0, 0.0);
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 0, 0, 0, 0 }));
  send(1.0, 0.0, 0.0);
  EXPECT_TRUE(waitForThrust("block1", { 1, 0, 0, 0, 1, 0 }));
  send(0.0, 0.0, -1.0);
  EXPECT_TRUE(waitForThrust("block1", { 0, 1, 0, 0, 1, 0 }));
  send(0.0, 0.0, 0.0);
  EXPECT_TRUE(waitForThrust("block1", { 0, 0, 0, 0, 0, 0 }));
  client.reset();
}

TEST_F(JoyTeleopTest, buttonsChooseTheBlock)
{
  press(0);
  send(0.0, -1.0, 0.0);
  ASSERT_TRUE(waitForThrust("block2", { 0, 0, 0, 1, 0, 0 }));
  // Another block is chosen while the stick is held: the former one is let go first.
  send(0.0, -1.0, 0.0, 1);
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 0, 1, 0, 0 }));
  const msg::Input& before = inputs.messages[inputs.messages.size() - 2];
  EXPECT_EQ(before.thrust.body, "block2");
  EXPECT_EQ(before.thrust.duration, 0.0);
  send(0.0, 0.0, 0.0);
  ASSERT_TRUE(waitForThrust("block1", { 0, 0, 0, 0, 0, 0 }));
}

TEST_F(JoyTeleopTest, buttonsPauseAndReset)
{
  Listener<std_msgs::Bool> paused(client.topic(topics::PAUSED), 10);
  ASSERT_TRUE(paused.waitForCount(1));
  press(3);
  ASSERT_TRUE(waitFor([&] { return !paused.messages.back().data; }));
  press(3);
  ASSERT_TRUE(waitFor([&] { return paused.messages.back().data; }));
  // Somebody else's doing is known too.
  client.pause(false);
  waitFor([] { return false; }, 0.3);
  press(3);
  ASSERT_TRUE(waitFor([&] { return paused.messages.back().data; }));
  press(4);
  EXPECT_TRUE(waitFor([&] { return inputs.messages.back().kind == static_cast<int>(msg::Input::RESET); }));
}

TEST_F(JoyTeleopTest, aSmallerJoystickWillDo)
{
  sensor_msgs::Joy joy;
  joy.axes = { -1.0f };
  stick.publish(joy);
  EXPECT_TRUE(waitForThrust("block1", { 0, 1, 0, 0, 0, 1 }));
  joy.axes.clear();
  stick.publish(joy);
  EXPECT_TRUE(waitForThrust("block1", { 0, 0, 0, 0, 0, 0 }));
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "joy_teleop_rostest");
  return RUN_ALL_TESTS();
}
